#include "techniques/article_response.hpp"

#include "step_parts.hpp"

#include <paperproof/tolerances.hpp>

#include <cmath>

namespace paperproof::article {

using step_parts::in_range;

namespace {

struct Groups final : OwnMemory {
  std::vector<PieceGroup> all;
};

/// @param count 8: the character's points; 4: the corners of their box.
CollisionPoints points_of(const CharacterShape& shape, int count) {
  const Box2& box = shape.box();
  CollisionPoints points{.offsets = {}, .box = box};
  if (count == 4)
    for (const double y : {box.lower.y(), box.upper.y()})
      for (const double x : {box.lower.x(), box.upper.x()}) points.offsets.push_back({x, y});
  else
    for (const Vec2d& point : shape.points()) points.offsets.push_back(point);
  for (const Side side : all_sides)
    points.pairs[static_cast<std::size_t>(side)] = points_of_side({points.offsets.begin(), points.offsets.end()}, side);
  return points;
}

}  // namespace

Parts::Parts(const TechniqueDef& def, const Scenery& where, const CharacterDef& character)
    : scenery(&where),
      broad_phase(make_broad_phase(def.broad_phase, standing_boxes(where))),
      points(points_of(character.shape, def.article.points)),
      unit(def.article.unit),
      something_carries(paperproof::something_carries(where)),
      fastest_surface(paperproof::fastest_surface(where)),
      knobs(def.article) {}

Scratch Parts::make_scratch() const {
  Scratch scratch;
  scratch.solids.pieces.reserve(scenery->pieces().size());
  auto groups = std::make_unique<Groups>();
  groups->all.reserve(scenery->mover_count() + 1);
  scratch.own = std::move(groups);
  return scratch;
}

NearbyScenery Parts::near(const Vec2d& here, const Vec2d& there, Scratch& scratch) const noexcept {
  const Box2 total = Box2::between(here, there) + points.box;
  scratch.solids.pieces.clear();
  broad_phase->query(total, scratch.solids.pieces);
  return {*scenery, scratch.solids.pieces};
}

std::span<const PieceGroup> Parts::groups_near(const Box2& box, const FrameOfReference& frame,
                                               Scratch& scratch) const noexcept {
  std::vector<PieceGroup>& groups = static_cast<Groups&>(*scratch.own).all;
  groups.clear();  // keeps its memory
  std::vector<PieceIndex>& found = scratch.solids.pieces;
  found.clear();  // keeps its memory: there is room for all
  const auto add = [&](MoverIndex mover, const auto& find) {
    const Vec2d first = frame.shift_at_start(mover);
    const Vec2d last = frame.shift_at_end(mover);
    const std::size_t before = found.size();
    find(box + Box2::between(first, last));
    if (frame.drops()) remove_one_way(*scenery, before, found);
    const std::span pieces = std::span(found).subspan(before);
    if (!pieces.empty()) groups.push_back({{*scenery, pieces}, mover, first, last});
  };
  add(no_mover, [&](const Box2& seen) { broad_phase->query(seen, found); });
  for (MoverIndex mover = 0; mover < scenery->mover_count(); ++mover)
    add(mover, [&](const Box2& seen) {
      const PieceRange pieces = pieces_of_mover(*scenery, mover);
      for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece)
        if (scenery->box(piece).overlaps(seen)) found.push_back(piece);
    });
  return groups;
}

bool Parts::inside(const NearbyScenery& nearby, const Vec2d& position) const noexcept {
  return std::any_of(points.offsets.begin(), points.offsets.end(),
                     [&](const Vec2d& offset) { return nearby.containing(position + offset).has_value(); });
}

bool collides(const Parts& parts, const NearbyScenery& nearby, const PointPair& pair, const Vec2d& from,
              const Vec2d& to) noexcept {
  for (const std::size_t i : distinct(pair)) {
    const Vec2d here = from + parts.points.offsets[i];
    const Vec2d there = to + parts.points.offsets[i];
    if (nearby.containing(there) || nearby.crossed(here, there)) return true;
  }
  return false;
}

void refuse(const MoveRequest& request, MoveResult& result, StepStatus why) noexcept {
  result.clear();
  if (why == StepStatus::refused) result.refusal = too_many_units;
  result.technique_memory = request.technique_memory;
  step_parts::refuse(why, request.position, request.velocity + request.ride.velocity, request.ride, result);
}

void stay_crushed(const MoveRequest& request, MoveResult& result) noexcept {
  result.status = StepStatus::crushed;
  result.position = request.position;
  result.velocity.setZero();
  result.grounded = false;
  result.ride = {};
  result.path.clear();
  result.path.push_back({request.position, 0});
  result.path.push_back({request.position, 1});
}

bool refuse_out_of_range(const MoveRequest& request, MoveResult& result) noexcept {
  if (in_range(request.position) && in_range(request.position + request.displacement)) return false;
  refuse(request, result);
  return true;
}

namespace {

/// The most that a mover goes during the step, and a surface on it, by component [m]; sensors may go where they like.
Vec2d farthest_motion(const Scenery& scenery, double fastest_surface, const MoveRequest& request) noexcept {
  Vec2d farthest{Vec2d::Zero()};
  for (MoverIndex mover = 0; mover < request.movers.size(); ++mover) {
    if (pieces_of_mover(scenery, mover).size() == 0) continue;
    const MoverMotion& motion = request.movers[mover];
    farthest = farthest.cwiseMax((motion.to - motion.from).cwiseAbs());
  }
  farthest.x() += fastest_surface * request.dt;
  return farthest;
}

bool leaves_range(const Vec2d& position, const Vec2d& wanted, const Vec2d& farthest) noexcept {
  return !in_range(position) || !in_range(position + wanted) || !in_range(farthest);
}

}  // namespace

bool leaves_range(const Scenery& scenery, double fastest_surface, const MoveRequest& request) noexcept {
  const Vec2d wanted = FrameOfReference(scenery, request).wanted();
  return leaves_range(request.position, wanted, farthest_motion(scenery, fastest_surface, request));
}

bool refuse(const Parts& parts, bool searches_by_units, const MoveRequest& request, MoveResult& result) noexcept {
  // Relative to one mover, on another one or pushed by it.
  const Vec2d wanted = FrameOfReference(*parts.scenery, request).wanted();
  const Vec2d farthest = farthest_motion(*parts.scenery, parts.fastest_surface, request);
  const Vec2d searched = wanted.cwiseAbs() + 2 * farthest;
  const bool quick = !searches_by_units || searched.norm() <= parts.unit * double(max_search_steps);
  const bool leaves = leaves_range(request.position, wanted, farthest);
  if (quick && !leaves) return false;
  refuse(request, result, leaves ? StepStatus::out_of_range : StepStatus::refused);
  return true;
}

bool add_contact(const Scenery& scenery, const PointHit& hit, Side side, double fraction, MoveResult& result) noexcept {
  const ColliderIndex collider = scenery.pieces()[hit.piece].collider;
  for (const Contact& known : result.contacts) {
    if (known.collider == collider && known.side == side) return false;
  }
  if (result.contacts.size() == MoveResult::max_contacts) return false;
  result.contacts.push_back({collider, hit.point, hit.normal, fraction, 0, side});
  return true;
}

}  // namespace paperproof::article
