#include "techniques/article_response.hpp"

#include <paperproof/tolerances.hpp>

#include <cmath>

namespace paperproof::article {
namespace {

template <class Scalar>
struct Groups final : OwnMemory {
  std::vector<PieceGroup<Scalar>> all;
};

template <class Scalar>
CollisionPoints<Scalar> points_of(const CharacterShape& shape) {
  CollisionPoints<Scalar> points;
  for (const Vec2d& point : shape.points()) points.offsets.push_back(point.cast<Scalar>());
  for (const Side side : all_sides) points.pairs[static_cast<std::size_t>(side)] = shape.pair(side);
  points.box = {shape.box().lower.cast<Scalar>(), shape.box().upper.cast<Scalar>()};
  return points;
}

template <class Scalar>
CollisionPoints<Scalar> corners_of_box(const CharacterShape& shape) {
  CollisionPoints<Scalar> points;
  points.box = {shape.box().lower.cast<Scalar>(), shape.box().upper.cast<Scalar>()};
  const Box2<Scalar>& box = points.box;
  for (const Scalar y : {box.lower.y(), box.upper.y()}) {
    for (const Scalar x : {box.lower.x(), box.upper.x()}) points.offsets.push_back({x, y});
  }
  points.pairs[static_cast<std::size_t>(Side::bottom)] = {0, 1};
  points.pairs[static_cast<std::size_t>(Side::top)] = {2, 3};
  points.pairs[static_cast<std::size_t>(Side::left)] = {0, 2};
  points.pairs[static_cast<std::size_t>(Side::right)] = {1, 3};
  return points;
}

}  // namespace

template <class Scalar>
Scalar length(const Vec2<Scalar>& vector) noexcept {
  return std::sqrt(vector.x() * vector.x() + vector.y() * vector.y());
}

template <class Scalar>
Parts<Scalar>::Parts(const TechniqueDef& def, const Scenery<Scalar>& where, const CharacterDef& character)
    : scenery(&where),
      broad_phase(make_broad_phase<Scalar>(def.broad_phase, where.static_boxes())),
      points(def.article.points == 4 ? corners_of_box<Scalar>(character.shape) : points_of<Scalar>(character.shape)),
      unit(static_cast<Scalar>(def.article.unit)),
      something_carries(paperproof::something_carries(where)),
      fastest_surface(paperproof::fastest_surface(where)),
      knobs(def.article) {}

template <class Scalar>
Scratch<Scalar> Parts<Scalar>::make_scratch() const {
  Scratch<Scalar> scratch;
  scratch.solids.pieces = PieceBuffer(scenery->pieces().size());
  auto groups = std::make_unique<Groups<Scalar>>();
  groups->all.reserve(scenery->mover_count() + 1);
  scratch.own = std::move(groups);
  return scratch;
}

template <class Scalar>
NearbyScenery<Scalar> Parts<Scalar>::near(const Vec2<Scalar>& here, const Vec2<Scalar>& there,
                                          Scratch<Scalar>& scratch) const noexcept {
  const Box2<Scalar> total{here.cwiseMin(there) + points.box.lower, here.cwiseMax(there) + points.box.upper};
  scratch.solids.valid = false;  // found anew in every iteration: never valid for the next
  scratch.solids.count = broad_phase->query(total, scratch.solids.pieces);
  return {*scenery, std::span<const PieceIndex>(scratch.solids.pieces).first(scratch.solids.count)};
}

template <class Scalar>
std::span<const PieceGroup<Scalar>> Parts<Scalar>::groups_near(const Box2<Scalar>& box,
                                                               const FrameOfReference<Scalar>& frame,
                                                               Scratch<Scalar>& scratch) const noexcept {
  std::vector<PieceGroup<Scalar>>& groups = static_cast<Groups<Scalar>&>(*scratch.own).all;
  groups.clear();  // keeps its memory
  const std::span<PieceIndex> found(scratch.solids.pieces);
  scratch.solids.valid = false;  // found anew in every iteration: never valid for the next
  scratch.solids.count = 0;
  const auto add = [&](MoverIndex mover, const auto& find) {
    const Vec2<Scalar> first = frame.shift_at_start(mover);
    const Vec2<Scalar> last = frame.shift_at_end(mover);
    const std::span<PieceIndex> room = found.subspan(scratch.solids.count);
    std::size_t count = find(Box2<Scalar>{box.lower + first.cwiseMin(last), box.upper + first.cwiseMax(last)}, room);
    if (frame.drops()) count = without_one_way(*scenery, room.first(count));
    scratch.solids.count += count;
    if (count > 0) groups.push_back({{*scenery, room.first(count)}, mover, first, last});
  };
  add(no_mover, [&](const Box2<Scalar>& seen, std::span<PieceIndex> room) { return broad_phase->query(seen, room); });
  for (MoverIndex mover = 0; mover < scenery->mover_count(); ++mover) {
    add(mover, [&](const Box2<Scalar>& seen, std::span<PieceIndex> room) {
      std::size_t count = 0;
      const PieceRange pieces = scenery->pieces_of_mover(mover);
      for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece)
        if (scenery->box(piece).overlaps(seen)) room[count++] = piece;
      return count;
    });
  }
  return groups;
}

template <class Scalar>
bool Parts<Scalar>::inside(const NearbyScenery<Scalar>& nearby, const Vec2<Scalar>& position) const noexcept {
  return std::any_of(points.offsets.begin(), points.offsets.end(),
                     [&](const Vec2<Scalar>& offset) { return nearby.containing(position + offset).has_value(); });
}

template <class Scalar>
bool collides(const Parts<Scalar>& parts, const NearbyScenery<Scalar>& nearby, const CharacterShape::Pair& pair,
              const Vec2<Scalar>& from, const Vec2<Scalar>& to) noexcept {
  for (const std::size_t i : distinct(pair)) {
    const Vec2<Scalar> here = from + parts.points.offsets[i];
    const Vec2<Scalar> there = to + parts.points.offsets[i];
    if (nearby.containing(there) || nearby.crossed(here, there)) return true;
  }
  return false;
}

template <class Scalar>
bool in_range(const Vec2<Scalar>& position) noexcept {
  const Scalar range = Tolerances<Scalar>{}.range;
  return std::abs(position.x()) <= range && std::abs(position.y()) <= range;
}

template <class Scalar>
void refuse(const MoveRequest<Scalar>& request, MoveResult<Scalar>& result, MoveStatus why) noexcept {
  result.clear();
  result.status = why;
  if (why == MoveStatus::refused) result.refusal = too_many_units;
  result.position = request.position;
  result.velocity = request.velocity + request.ride.velocity;
  result.technique_memory = request.technique_memory;
  result.ride = request.ride;
  result.path.push_back({request.position, 0});
  result.path.push_back({request.position, 1});
}

template <class Scalar>
void stay_crushed(const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
  result.status = MoveStatus::crushed;
  result.position = request.position;
  result.velocity.setZero();
  result.grounded = false;
  result.ride = {};
  result.path.clear();
  result.path.push_back({request.position, 0});
  result.path.push_back({request.position, 1});
}

template <class Scalar>
bool refuse_out_of_range(const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) noexcept {
  const Vec2<Scalar> end = request.position + request.displacement;
  if (in_range(request.position) && in_range(end)) return false;
  refuse(request, result);
  return true;
}

namespace {

/// The most that a mover goes during the step, and a surface on it, by component [m]; sensors may go where they like.
template <class Scalar>
Vec2<Scalar> farthest_motion(const Scenery<Scalar>& scenery, Scalar fastest_surface,
                             const MoveRequest<Scalar>& request) noexcept {
  Vec2<Scalar> farthest{Vec2<Scalar>::Zero()};
  for (MoverIndex mover = 0; mover < request.movers.size(); ++mover) {
    if (scenery.pieces_of_mover(mover).size() == 0) continue;
    const MoverMotion<Scalar>& motion = request.movers[mover];
    farthest = farthest.cwiseMax((motion.to - motion.from).cwiseAbs());
  }
  farthest.x() += fastest_surface * request.dt;
  return farthest;
}

template <class Scalar>
bool leaves_range(const Vec2<Scalar>& position, const Vec2<Scalar>& wanted, const Vec2<Scalar>& farthest) noexcept {
  return !in_range(position) || !in_range<Scalar>(position + wanted) || !in_range(farthest);
}

}  // namespace

template <class Scalar>
bool leaves_range(const Scenery<Scalar>& scenery, Scalar fastest_surface, const MoveRequest<Scalar>& request) noexcept {
  const Vec2<Scalar> wanted = FrameOfReference<Scalar>(scenery, request).wanted();
  return leaves_range<Scalar>(request.position, wanted, farthest_motion(scenery, fastest_surface, request));
}

template <class Scalar>
bool refuse(const Parts<Scalar>& parts, bool searches_by_units, const MoveRequest<Scalar>& request,
            MoveResult<Scalar>& result) noexcept {
  // Relative to one mover, on another one or pushed by it.
  const Vec2<Scalar> wanted = FrameOfReference<Scalar>(*parts.scenery, request).wanted();
  const Vec2<Scalar> farthest = farthest_motion(*parts.scenery, parts.fastest_surface, request);
  const Vec2<Scalar> searched = wanted.cwiseAbs() + 2 * farthest;
  const bool quick = !searches_by_units || length(searched) <= parts.unit * Scalar(max_search_steps);
  const bool leaves = leaves_range(request.position, wanted, farthest);
  if (quick && !leaves) return false;
  refuse(request, result, leaves ? MoveStatus::out_of_range : MoveStatus::refused);
  return true;
}

template <class Scalar>
bool add_contact(const Scenery<Scalar>& scenery, const PointHit<Scalar>& hit, Side side, Scalar fraction,
                 MoveResult<Scalar>& result) noexcept {
  const ColliderIndex collider = scenery.pieces()[hit.piece].collider;
  for (const Contact<Scalar>& known : result.contacts) {
    if (known.collider == collider && known.side == side) return false;
  }
  return result.contacts.push_back({collider, hit.point, hit.normal, fraction, 0, side});
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                                                        \
  template struct Parts<Scalar>;                                                                              \
  template Scalar length(const Vec2<Scalar>&) noexcept;                                                       \
  template bool collides(const Parts<Scalar>&, const NearbyScenery<Scalar>&, const CharacterShape::Pair&,     \
                         const Vec2<Scalar>&, const Vec2<Scalar>&) noexcept;                                  \
  template bool in_range(const Vec2<Scalar>&) noexcept;                                                       \
  template bool leaves_range(const Scenery<Scalar>&, Scalar, const MoveRequest<Scalar>&) noexcept;            \
  template void stay_crushed(const MoveRequest<Scalar>&, MoveResult<Scalar>&) noexcept;                       \
  template void refuse(const MoveRequest<Scalar>&, MoveResult<Scalar>&, MoveStatus) noexcept;                 \
  template bool refuse_out_of_range(const MoveRequest<Scalar>&, MoveResult<Scalar>&) noexcept;                \
  template bool refuse(const Parts<Scalar>&, bool, const MoveRequest<Scalar>&, MoveResult<Scalar>&) noexcept; \
  template bool add_contact(const Scenery<Scalar>&, const PointHit<Scalar>&, Side, Scalar, MoveResult<Scalar>&) noexcept
PAPERPROOF_INSTANTIATE(float);
PAPERPROOF_INSTANTIATE(double);
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::article
