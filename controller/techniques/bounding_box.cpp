/// The article's bounding boxes: every piece and the character are replaced by the smallest box that holds them, and
/// only boxes meet boxes. Right on flat ground; on a slope the character walks into its box as into a wall, and stands
/// in the air above the rest of it.
///
/// The boxes are compared where the movement would end, one component at a time (vertical first, as the article's pairs
/// are): what the component has entered stops it at the face that it came from. Nothing between start and end is looked
/// at, so paper is passed. A box that the character was in already pushes it out along the axis of least overlap, both
/// repeated up to the knob `iterations`; the other knobs have no meaning here.
///
/// Enemies are boxes, too: what moves is where it will be at the end of the frame, and pushes out whom it came over. It
/// carries nobody. A conveyor is refused.
///
/// A chain is the boxes of its segments, which have no thickness where a segment is level or upright. A one-way
/// segment stops only what comes from the side that its blocking normal mostly points to. A contact is only known at
/// the end of the frame: its fraction is 1. Where it ended outside of all boxes, it did so exactly, whatever the
/// rounding.
#include "techniques/article_response.hpp"
#include "techniques/knobs.hpp"
#include "techniques/registry.hpp"
#include "techniques/rounding.hpp"

#include <paperproof/scenery.hpp>

#include <limits>

namespace paperproof {
namespace {

/// Where the position must not be, so that the character's box does not meet the piece's: its interior. Never smaller
/// than that by rounding.
Box2 grown(const Box2& piece, const Box2& character) noexcept {
  Box2 box;
  for (const Eigen::Index i : {0, 1}) {
    box.lower[i] = -difference_rounded_up(character.upper[i], piece.lower[i]);
    box.upper[i] = difference_rounded_up(piece.upper[i], character.lower[i]);
  }
  return box;
}

bool holds_inside(const Box2& box, const Vec2d& position) noexcept {
  return box.lower.x() < position.x() && position.x() < box.upper.x() && box.lower.y() < position.y() &&
         position.y() < box.upper.y();
}

/// Along with a mover. Never smaller by rounding.
Box2 shifted(const Box2& box, const Vec2d& by) noexcept {
  Box2 result;
  for (const Eigen::Index i : {0, 1}) {
    result.lower[i] = -difference_rounded_up(-box.lower[i], by[i]);
    result.upper[i] = difference_rounded_up(box.upper[i], -by[i]);
  }
  return result;
}

class BoundingBox final : public Technique {
 public:
  BoundingBox(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character)
      : scenery_(&scenery),
        moving_(moving_pieces(scenery)),
        character_(character.shape.box()),
        iterations_(def.article.iterations) {
    grown_.reserve(scenery.pieces().size());  // the broad phase looks at them where they are
    for (const Box2& box : standing_boxes(scenery)) grown_.push_back(grown(box, character_));
    broad_phase_ = make_broad_phase(def.broad_phase, grown_);
    for (PieceIndex piece = moving_.first; piece < moving_.end; ++piece)
      grown_.push_back(grown(scenery.box(piece), character_));
  }

  [[nodiscard]] std::string_view name() const noexcept override { return "bounding_box"; }
  [[nodiscard]] Scratch make_scratch() const override {
    Scratch scratch;
    scratch.solids.pieces.reserve(grown_.size());
    return scratch;
  }
  void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept override;

 private:
  using Pieces = std::span<const PieceIndex>;
  using Movers = std::span<const MoverMotion>;

  /// Where a piece is at the end of the step, relative to where it was defined [m].
  [[nodiscard]] Vec2d offset(PieceIndex piece, Movers movers) const noexcept {
    const MoverIndex mover = scenery_->pieces()[piece].mover;
    return mover == no_mover ? Vec2d(Vec2d::Zero()) : movers[mover].to;
  }
  [[nodiscard]] Box2 box_of(PieceIndex piece, Movers movers) const noexcept {
    return scenery_->pieces()[piece].mover == no_mover ? grown_[piece] : shifted(grown_[piece], offset(piece, movers));
  }
  [[nodiscard]] std::vector<PieceIndex>& near(const Vec2d& here, const Vec2d& there, Movers movers,
                                              Scratch& scratch) const noexcept;
  [[nodiscard]] bool blocks(PieceIndex piece, Side side) const noexcept;
  void advance(Pieces nearby, Eigen::Index component, const MoveRequest& request, MoveResult& result) const noexcept;
  void push_out(Movers movers, Scratch& scratch, MoveResult& result) const noexcept;
  void meet(PieceIndex piece, Side side, Movers movers, MoveResult& result) const noexcept;

  const Scenery* scenery_;
  PieceRange moving_;
  Box2 character_;
  int iterations_;
  std::vector<Box2> grown_;  ///< By piece; of what moves, where it is defined.
  std::unique_ptr<BroadPhase> broad_phase_;
};

void BoundingBox::move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept {
  if (article::refuse_out_of_range(request, result)) return;
  result.clear();
  result.position = request.position;
  result.velocity = request.velocity;
  std::vector<PieceIndex>& nearby =
      near(request.position, request.position + request.displacement, request.movers, scratch);
  if (request.drop) remove_one_way(*scenery_, 0, nearby);
  for (const Eigen::Index component : {1, 0}) advance(nearby, component, request, result);
  push_out(request.movers, scratch, result);
  result.path.push_back({request.position, 0});
  result.path.push_back({result.position, 1});
}

std::vector<PieceIndex>& BoundingBox::near(const Vec2d& here, const Vec2d& there, Movers movers,
                                           Scratch& scratch) const noexcept {
  const Box2 total = Box2::between(here, there);
  std::vector<PieceIndex>& found = scratch.solids.pieces;
  found.clear();
  broad_phase_->query(total, found);
  for (PieceIndex piece = moving_.first; piece < moving_.end; ++piece)
    if (box_of(piece, movers).overlaps(total)) found.push_back(piece);
  return found;
}

/// A one-way segment runs so that its blocking normal is on its left.
bool BoundingBox::blocks(PieceIndex piece, Side side) const noexcept {
  if (!scenery_->pieces()[piece].one_way) return true;
  const PieceVertices ends = scenery_->vertices_of(piece);
  return side_of_normal(ends[0].y() - ends[1].y(), ends[1].x() - ends[0].x()) == side;
}

/// One component of the movement, stopped by the boxes that it has entered where it, and they, end. Going back to the
/// nearest of their faces may end in a thinner box, hence the iterations.
void BoundingBox::advance(Pieces nearby, Eigen::Index component, const MoveRequest& request,
                          MoveResult& result) const noexcept {
  const double by = request.displacement[component];
  const Vec2d start = result.position;
  const bool forwards = by > 0;
  const Side side = article::side_ahead(component, forwards);
  const auto face_of = [&](PieceIndex piece) {
    const Box2 box = box_of(piece, request.movers);
    return forwards ? box.lower[component] : box.upper[component];
  };
  const auto entered = [&](PieceIndex piece, const Vec2d& end) {
    const Box2 box = box_of(piece, request.movers);
    return holds_inside(box, end) && !holds_inside(box, start) && blocks(piece, side);
  };
  Vec2d last_entered = start;
  result.position[component] += by;
  bool hit = false;
  for (int iteration = 0; iteration < iterations_; ++iteration) {
    const Vec2d end = result.position;
    bool free = true;
    for (const PieceIndex piece : nearby) {
      if (!entered(piece, end)) continue;
      free = false;
      const double face = face_of(piece);
      const bool nearer = forwards ? face < result.position[component] : face > result.position[component];
      if (nearer) result.position[component] = face;
    }
    if (free) break;
    hit = true;
    last_entered = end;
  }
  if (!hit) return;
  for (const PieceIndex piece : nearby) {
    if (entered(piece, last_entered) && face_of(piece) == result.position[component])
      meet(piece, side, request.movers, result);
  }
}

/// Only where the step began inside something, what moves came over it, or iterations were too few.
void BoundingBox::push_out(Movers movers, Scratch& scratch, MoveResult& result) const noexcept {
  /// The first box that holds the position, other than one-way ones; null where there is none.
  const auto inside = [&]() -> const PieceIndex* {
    const std::vector<PieceIndex>& nearby = near(result.position, result.position, movers, scratch);
    const auto found = std::ranges::find_if(nearby, [&](PieceIndex piece) {
      return !scenery_->pieces()[piece].one_way && holds_inside(box_of(piece, movers), result.position);
    });
    return found == nearby.end() ? nullptr : &*found;
  };
  for (int iteration = 0; iteration < iterations_; ++iteration) {
    const PieceIndex* const piece = inside();
    if (piece == nullptr) return;
    const Box2 box = box_of(*piece, movers);
    double least = std::numeric_limits<double>::infinity();
    Side side = Side::bottom;
    for (const Side each : article::all_sides) {
      const Eigen::Index component = article::component_of(each);
      const double overlap = article::outwards(each) < 0 ? box.upper[component] - result.position[component]
                                                         : result.position[component] - box.lower[component];
      if (!(overlap < least)) continue;
      least = overlap;
      side = each;
    }
    const Eigen::Index component = article::component_of(side);
    result.position[component] = article::outwards(side) < 0 ? box.upper[component] : box.lower[component];
    meet(*piece, side, movers, result);
  }
  if (inside() != nullptr) result.status = StepStatus::stuck;
}

void BoundingBox::meet(PieceIndex piece, Side side, Movers movers, MoveResult& result) const noexcept {
  const Eigen::Index component = article::component_of(side);
  const Eigen::Index along = 1 - component;
  const int outwards = article::outwards(side);
  const Vec2d by = offset(piece, movers);
  const Box2 box{scenery_->box(piece).lower + by, scenery_->box(piece).upper + by};
  PointHit hit{.piece = piece};
  hit.normal[component] = static_cast<double>(-outwards);
  hit.point[component] = outwards < 0 ? box.upper[component] : box.lower[component];
  const double lower = std::max(box.lower[along], result.position[along] + character_.lower[along]);
  const double upper = std::min(box.upper[along], result.position[along] + character_.upper[along]);
  hit.point[along] = lower + (upper - lower) / 2;
  article::add_contact(*scenery_, hit, side, 1.0, result);
  if (side == Side::bottom) result.grounded = true;
  if (result.velocity[component] * static_cast<double>(outwards) > 0) result.velocity[component] = 0;
}

std::unique_ptr<Technique> make_bounding_box(const TechniqueDef& def, const Scenery& scenery,
                                             const CharacterDef& character) {
  if (scenery.counts().conveyors > 0) throw NotExpressible("bounding_box carries nobody: there is a conveyor");
  return std::make_unique<BoundingBox>(def, scenery, character);
}

}  // namespace

TechniqueEntry bounding_box_entry() {
  return {.name = "bounding_box",
          .make = make_bounding_box,
          .knobs = {knob::iterations, knob::broad_phase},
          .knows_movers = true};
}

}  // namespace paperproof
