#include "techniques/discrete/discrete.hpp"

#include "geometry/overlap_time.hpp"
#include "techniques/article_response.hpp"
#include "techniques/discrete/solver.hpp"

namespace paperproof {
namespace {

using discrete::Body;
using discrete::Solver;

template <class Scalar>
struct Workplace final : OwnMemory {
  Solver<Scalar> solver{Tolerances<Scalar>{}.stop, Tolerances<Scalar>{}.touch};
  std::vector<Body<Scalar>> bodies;  ///< The character, then what is near.
  std::vector<PieceIndex> in_way;    ///< Of a push.
};

template <class Scalar>
class Discrete final : public Technique<Scalar> {
 public:
  Discrete(const TechniqueDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
      : scenery_(&scenery),
        broad_phase_(make_broad_phase<Scalar>(def.broad_phase, scenery.static_boxes())),
        box_{character.shape.box().lower.cast<Scalar>(), character.shape.box().upper.cast<Scalar>()},
        iterations_(def.article.iterations),
        fastest_surface_(fastest_surface(scenery)) {
    for (const Vec2d& corner : character.shape.hull()) outline_.push_back(corner.cast<Scalar>());
  }

  [[nodiscard]] std::string_view name() const noexcept override { return name_of(TechniqueKind::discrete); }
  [[nodiscard]] Scratch<Scalar> make_scratch() const override;
  void move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
            MoveResult<Scalar>& result) const noexcept override;

 private:
  /// One frame while it is worked out, in its frame of reference.
  struct Frame {
    const MoveRequest<Scalar>& request;
    FrameOfReference<Scalar> place;
    Scratch<Scalar>& scratch;
    MoveResult<Scalar>& result;
    Body<Scalar> character;
    decltype(MoveResult<Scalar>::crushed) pushers{};  ///< Colliders of movers that pushed the character.
  };

  /// What the character overlaps.
  struct Inside {
    bool anything = false;
    bool what_stands_still = false;                  ///< By however little: a push must not lead into it.
    decltype(MoveResult<Scalar>::crushed) movers{};  ///< Colliders of those that move in this step.
  };

  [[nodiscard]] Body<Scalar> body_of(PieceIndex piece, const FrameOfReference<Scalar>& place) const noexcept;
  [[nodiscard]] std::span<Body<Scalar>> gather(Frame& frame) const noexcept;
  bool report(Frame& frame) const noexcept;
  [[nodiscard]] bool take_along(Frame& frame, ColliderIndex ground, Scalar time) const noexcept;
  [[nodiscard]] bool pushed_through(Frame& frame, Vec2<Scalar> expected) const noexcept;
  [[nodiscard]] bool passes_static(const Vec2<Scalar>& from, const Vec2<Scalar>& to,
                                   Scratch<Scalar>& scratch) const noexcept;
  [[nodiscard]] Inside find_inside(Frame& frame, bool at_end) const noexcept;
  void stay(Frame& frame) const noexcept;
  void finish(Frame& frame) const noexcept;
  void measure_gaps(const Vec2<Scalar>& position, MoveResult<Scalar>& result) const noexcept;

  const Scenery<Scalar>* scenery_;
  std::unique_ptr<BroadPhase<Scalar>> broad_phase_;
  FixedVector<Vec2<Scalar>, CharacterShape::max_points> outline_;
  Box2<Scalar> box_;
  int iterations_;
  Scalar fastest_surface_;
};

template <class Scalar>
Workplace<Scalar>& workplace_of(Scratch<Scalar>& scratch) noexcept {
  return static_cast<Workplace<Scalar>&>(*scratch.own);
}

template <class Scalar>
Scratch<Scalar> Discrete<Scalar>::make_scratch() const {
  const std::size_t pieces = scenery_->pieces().size();
  Scratch<Scalar> scratch;
  scratch.candidates.resize(pieces);
  auto own = std::make_unique<Workplace<Scalar>>();
  own->bodies.reserve(pieces + 1);
  own->in_way.resize(pieces);
  own->solver.reserve(pieces + 1, pieces);  // the character with each piece; pieces do not meet each other
  scratch.own = std::move(own);
  return scratch;
}

template <class Scalar>
void Discrete<Scalar>::move(const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
                            MoveResult<Scalar>& result) const noexcept {
  if (article::leaves_range(*scenery_, fastest_surface_, request)) return article::refuse(request, result);
  result.clear();
  Frame frame{request, {*scenery_, request}, scratch, result, {}};
  frame.character.outline = {outline_.begin(), outline_.end()};
  frame.character.box = box_;
  frame.character.position = frame.place.start();
  frame.character.movement = frame.place.wanted();
  frame.character.velocity = frame.place.velocity();
  bool left_over = true;
  for (int iteration = 0; left_over && iteration < iterations_; ++iteration) {
    const Vec2<Scalar> expected = frame.character.expected();
    const std::span<Body<Scalar>> bodies = gather(frame);
    left_over = workplace_of(scratch).solver.solve_once(bodies);
    frame.character = bodies.front();
    left_over = report(frame) || left_over;
    if (pushed_through(frame, expected)) return stay(frame);
  }
  if (left_over || scenery_->mover_count() > 0) {
    const Inside begin = find_inside(frame, false);
    const Inside end = find_inside(frame, true);
    if (end.what_stands_still && !begin.what_stands_still && !frame.pushers.empty()) return stay(frame);
    result.crushed = end.movers;
    if (left_over && begin.anything && end.anything) result.status = MoveStatus::stuck;
    if (!result.crushed.empty()) result.status = MoveStatus::crushed;
  }
  finish(frame);
}

/// A piece as it goes in the frame of reference.
template <class Scalar>
Body<Scalar> Discrete<Scalar>::body_of(PieceIndex piece, const FrameOfReference<Scalar>& place) const noexcept {
  const PieceInfo& info = scenery_->pieces()[piece];
  Body<Scalar> body;
  body.outline = scenery_->vertices_of(piece);
  body.box = scenery_->box(piece);
  body.position = Vec2<Scalar>::Zero() - place.shift_at_start(info.mover);
  body.movement = place.shift_at_start(info.mover) - place.shift_at_end(info.mover);
  body.velocity = place.velocity(info.mover);
  body.inverse_mass = 0;
  body.one_way = info.one_way;
  return body;
}

/// The character and all pieces near its total box.
template <class Scalar>
std::span<Body<Scalar>> Discrete<Scalar>::gather(Frame& frame) const noexcept {
  Scratch<Scalar>& scratch = frame.scratch;
  const Box2<Scalar> total = frame.character.total_box();
  const Vec2<Scalar> first = frame.place.shift_at_start(no_mover);
  const Vec2<Scalar> last = frame.place.shift_at_end(no_mover);
  scratch.valid = false;
  scratch.candidate_count =
      broad_phase_->query({total.lower + first.cwiseMin(last), total.upper + first.cwiseMax(last)}, scratch.candidates);
  const PieceIndex movers_end = scenery_->sensor_pieces().first;
  for (PieceIndex piece = scenery_->static_pieces().end; piece < movers_end; ++piece) {
    if (body_of(piece, frame.place).total_box().overlaps(total)) scratch.candidates[scratch.candidate_count++] = piece;
  }
  if (frame.request.drop)
    scratch.candidate_count = without_one_way(*scenery_, std::span(scratch.candidates).first(scratch.candidate_count));
  std::vector<Body<Scalar>>& bodies = workplace_of(scratch).bodies;
  bodies.clear();  // keeps its memory
  bodies.push_back(frame.character);
  for (const PieceIndex piece : std::span(scratch.candidates).first(scratch.candidate_count))
    bodies.push_back(body_of(piece, frame.place));
  return bodies;
}

/// What the last round pushed apart. @return whether the character is carried from now on: that needs another round.
template <class Scalar>
bool Discrete<Scalar>::report(Frame& frame) const noexcept {
  bool taken = false;
  for (const discrete::SolvedImpact<Scalar>& each : workplace_of(frame.scratch).solver.solved()) {
    const discrete::Impact<Scalar>& impact = each.impact;
    const PieceIndex piece = frame.scratch.candidates[each.bodies.second - 1];
    const PieceInfo& info = scenery_->pieces()[piece];
    const Side side = side_of_normal(impact.normal.x(), impact.normal.y());
    article::add_contact(*scenery_, {piece, impact.point, impact.normal, impact.time}, side, impact.time, frame.result);
    if (info.mover != no_mover && !frame.place.motion(info.mover).isZero(0))
      article::add_once(info.collider, frame.pushers);
    if (side != Side::bottom) continue;
    frame.result.grounded = true;
    frame.result.ride.ground = frame.place.carries(info.collider) ? info.collider : Ride<Scalar>::none;
    taken = take_along(frame, info.collider, impact.time) || taken;
  }
  return taken;
}

/// What comes to rest on moving ground is carried for the rest of the frame, unless it had a speed of its own along it.
template <class Scalar>
bool Discrete<Scalar>::take_along(Frame& frame, ColliderIndex ground, Scalar time) const noexcept {
  if (!frame.place.carries(ground) || frame.request.ride.ground != Ride<Scalar>::none) return false;
  if (frame.request.velocity.x() != 0 || frame.character.velocity.x() != 0) return false;
  const Vec2<Scalar> motion = frame.place.motion(frame.place.mover_of(ground)) + frame.place.surface_motion(ground);
  frame.character.movement.x() += motion.x() * (1 - time);
  frame.character.velocity.x() = frame.place.velocity_of(ground).x();
  return motion.x() != 0;
}

/// One of the last round's pushes by a mover led through something that stands still.
/// @param expected where the character was expected before that round.
template <class Scalar>
bool Discrete<Scalar>::pushed_through(Frame& frame, Vec2<Scalar> expected) const noexcept {
  if (frame.pushers.empty()) return false;
  for (const discrete::SolvedImpact<Scalar>& each : workplace_of(frame.scratch).solver.solved()) {
    const MoverIndex mover = scenery_->pieces()[frame.scratch.candidates[each.bodies.second - 1]].mover;
    const Vec2<Scalar> from = expected;
    expected += each.impact.normal * (each.impact.depth + Tolerances<Scalar>{}.stop);
    const Vec2<Scalar> shift = frame.place.shift_at_end(no_mover);
    if (mover != no_mover && passes_static(from + shift, expected + shift, frame.scratch)) return true;
  }
  return false;
}

/// A push leads through a piece that stands still, from one side of it to another.
template <class Scalar>
bool Discrete<Scalar>::passes_static(const Vec2<Scalar>& from, const Vec2<Scalar>& to,
                                     Scratch<Scalar>& scratch) const noexcept {
  using Time = geometry::OverlapTime<Scalar>;
  std::vector<PieceIndex>& in_way = workplace_of(scratch).in_way;
  const std::size_t count =
      broad_phase_->query({from.cwiseMin(to) + box_.lower, from.cwiseMax(to) + box_.upper}, in_way);
  return std::any_of(in_way.begin(), in_way.begin() + static_cast<std::ptrdiff_t>(count), [&](PieceIndex piece) {
    if (scenery_->pieces()[piece].one_way) return false;
    const Time time =
        geometry::overlap_time<Scalar>({outline_.begin(), outline_.end()}, scenery_->vertices_of(piece), from, to);
    return time.any() && time.begin != Time::before && time.end != Time::after;
  });
}

/// Where the step begins, or where the character is expected to end.
template <class Scalar>
typename Discrete<Scalar>::Inside Discrete<Scalar>::find_inside(Frame& frame, bool at_end) const noexcept {
  const auto placed = [&](Body<Scalar> body) {
    if (at_end) body.position = body.expected();
    body.movement.setZero();
    return body;
  };
  Inside inside;
  const std::span<const Body<Scalar>> bodies = gather(frame);
  const Body<Scalar> character = placed(bodies.front());
  for (std::size_t i = 1; i < bodies.size(); ++i) {
    const Body<Scalar> body = placed(bodies[i]);
    const PieceInfo& info = scenery_->pieces()[frame.scratch.candidates[i - 1]];
    if (info.mover == no_mover && discrete::began_overlapping<Scalar>(character, body, 0))
      inside.what_stands_still = true;
    if (!discrete::began_overlapping<Scalar>(character, body, Tolerances<Scalar>{}.touch)) continue;
    inside.anything = true;
    if (info.mover != no_mover && !frame.place.motion(info.mover).isZero(0))
      article::add_once(info.collider, inside.movers);
  }
  return inside;
}

/// Nothing is pushed into what stands still, or through it.
template <class Scalar>
void Discrete<Scalar>::stay(Frame& frame) const noexcept {
  frame.result.crushed = frame.pushers;
  article::stay_crushed(frame.request, frame.result);
}

/// In the world, and on what carries the character.
template <class Scalar>
void Discrete<Scalar>::finish(Frame& frame) const noexcept {
  MoveResult<Scalar>& result = frame.result;
  const Vec2<Scalar> position = frame.character.expected();
  measure_gaps(position, result);
  for (Contact<Scalar>& contact : result.contacts) contact.point = frame.place.in_world(contact.point, 1);
  result.velocity = frame.character.velocity;
  frame.place.arrive(position, result);
  result.path.push_back({frame.request.position, 0});
  result.path.push_back({result.position, 1});
}

/// Along each contact's normal, from the obstacle to the nearest corner of the character where it ended.
template <class Scalar>
void Discrete<Scalar>::measure_gaps(const Vec2<Scalar>& position, MoveResult<Scalar>& result) const noexcept {
  for (Contact<Scalar>& contact : result.contacts) {
    const auto height_of = [&](const Vec2<Scalar>& corner) {
      const Vec2<Scalar> from_point = position + corner - contact.point;
      return from_point.dot(contact.normal);
    };
    contact.separation = height_of(outline_[0]);
    for (const Vec2<Scalar>& corner : outline_) contact.separation = std::min(contact.separation, height_of(corner));
  }
}

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_discrete(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                 const CharacterDef& character) {
  return std::make_unique<Discrete<Scalar>>(def, scenery, character);
}

template std::unique_ptr<Technique<float>> make_discrete(const TechniqueDef&, const Scenery<float>&,
                                                         const CharacterDef&);
template std::unique_ptr<Technique<double>> make_discrete(const TechniqueDef&, const Scenery<double>&,
                                                          const CharacterDef&);

}  // namespace paperproof
