#include "sensors.hpp"

#include <paperproof/tolerances.hpp>

#include "geometry/circle.hpp"

#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace paperproof {
namespace {

using geometry::OverlapTime;

/// Fractions of a segment that count as one instant. Zero: rounding parts the pieces of one sensor where the character
/// grazes the corner that they share. Large: short visits are joined.
template <class Scalar>
inline constexpr Scalar one_instant = std::is_same_v<Scalar, float> ? Scalar(1e-5) : Scalar(1e-12);

/// Depth of an overlap that no rounding can hide, at the distance `furthest` from the origin [m]. Zero: a character
/// that grazes a sensor would count as inside. Large: more overlaps than necessary are calculated.
template <class Scalar>
Scalar beyond_rounding(Scalar furthest) {
  return Tolerances<Scalar>{}.look + 64 * std::numeric_limits<Scalar>::epsilon() * furthest;
}

/// Inserts in order of time, in whichever order the sensors are tested. A full vector keeps the earliest events.
template <class Scalar, std::size_t capacity>
void add_in_order(const SensorEvent<Scalar>& event, FixedVector<SensorEvent<Scalar>, capacity>& events) noexcept {
  const auto comes_before = [&event](const SensorEvent<Scalar>& other) {
    return event.fraction < other.fraction || (event.fraction == other.fraction && event.sensor < other.sensor);
  };
  if (!events.push_back(event)) {
    if (!comes_before(events.back())) return;
    events.back() = event;
  }
  for (std::size_t i = events.size() - 1; i > 0 && comes_before(events[i - 1]); --i)
    std::swap(events[i], events[i - 1]);
}

/// The stays of a character in the pieces of one sensor during one segment, joined where they overlap. Each call
/// calculates the stays anew, so that any number of pieces needs no memory.
/// @tparam StayIn called with a piece: the character's stay in it.
template <class Scalar, class StayIn>
class Stays {
 public:
  Stays(std::span<const PieceIndex> pieces, const StayIn& stay_in) noexcept : pieces_(pieces), stay_in_(stay_in) {}

  /// The first stay that begins later than `time`; empty if there is none.
  [[nodiscard]] OverlapTime<Scalar> after(Scalar time) const noexcept {
    OverlapTime<Scalar> first{.begin = OverlapTime<Scalar>::after, .end = OverlapTime<Scalar>::before};
    for (const PieceIndex piece : pieces_) {
      const OverlapTime<Scalar> stay = stay_in_(piece);
      if (stay.any() && stay.begin > time && stay.begin < first.begin) first = stay;
    }
    // Each round but the last reaches the end of one more stay.
    while (pieces_.size() > 1 && first.any() && first.end != OverlapTime<Scalar>::after && extend(first)) {
    }
    return first;
  }

 private:
  /// Extends a stay by the stays that continue it. @return whether there were any.
  [[nodiscard]] bool extend(OverlapTime<Scalar>& stay) const noexcept {
    const Scalar end = stay.end;
    for (const PieceIndex piece : pieces_) {
      const OverlapTime<Scalar> next = stay_in_(piece);
      if (next.any() && next.begin <= end + one_instant<Scalar>) stay.end = std::max(stay.end, next.end);
    }
    return stay.end > end;
  }

  std::span<const PieceIndex> pieces_;
  const StayIn& stay_in_;
};

std::vector<PieceIndex> all_of(PieceRange range) {
  std::vector<PieceIndex> pieces(range.size());
  std::iota(pieces.begin(), pieces.end(), range.first);
  return pieces;
}

}  // namespace

template <class Scalar>
Sensors<Scalar>::Sensors(const Scenery<Scalar>& scenery, const CharacterShape& shape, PieceSearch search)
    : scenery_(&scenery), finder_(scenery, shape, all_of(scenery.sensor_pieces()), search) {
  const Vec2<Scalar> lower = shape.box().lower.cast<Scalar>();
  const Vec2<Scalar> upper = shape.box().upper.cast<Scalar>();
  for (const Vec2d& corner : shape.hull()) outline_.push_back(corner.cast<Scalar>());
  const std::span<const Vec2<Scalar>> outline = outline_;
  overlaps_.reserve(scenery.sensor_pieces().size());
  for (const PieceIndex piece : all_of(scenery.sensor_pieces())) {
    const PieceVertices<Scalar> vertices = scenery.vertices_of(piece);
    const Box2<Scalar>& box = scenery.box(piece);
    const Scalar furthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    // A little larger, so that rounding here cannot hide an overlap that the separations show.
    const Box2<Scalar> any = Box2<Scalar>{box.lower - upper, box.upper - lower}.inflated(Tolerances<Scalar>{}.look);
    if (scenery.pieces()[piece].is_circle())
      overlaps_.push_back({any, {upper - lower, lower - upper}, {}});
    else
      overlaps_.push_back({any, geometry::deep_overlap<Scalar>(outline, vertices, beyond_rounding(furthest)),
                           geometry::separating_axes<Scalar>(outline, vertices)});
  }
}

template <class Scalar>
typename Sensors<Scalar>::Segment Sensors<Scalar>::seen_by(const MoverMotion<Scalar>& motion,
                                                           const PathPoint<Scalar>& begin,
                                                           const PathPoint<Scalar>& end) noexcept {
  Segment segment;
  segment.from = begin.position - motion.at(begin.fraction);
  segment.to = end.position - motion.at(end.fraction);
  segment.begin = begin.fraction;
  segment.end = end.fraction;
  segment.positions = {segment.from.cwiseMin(segment.to), segment.from.cwiseMax(segment.to)};
  return segment;
}

template <class Scalar>
void Sensors<Scalar>::observe(std::span<const PathPoint<Scalar>> path, std::span<const MoverMotion<Scalar>> movers,
                              Candidates<Scalar>& candidates, Events& events,
                              const ColliderFilter* filter) const noexcept {
  if (const std::span<const PieceIndex> near = finder_.near_standing(path, candidates); !near.empty())
    candidates.quiet = observe(near, path, {}, candidates.box, filter, events);
  finder_.along_movers(path, movers, candidates,
                       [&](std::span<const PieceIndex> near, const MoverMotion<Scalar>& motion) {
                         observe(near, path, motion, {}, filter, events);
                       });
}

/// The pieces of one sensor are consecutive.
template <class Scalar>
Box2<Scalar> Sensors<Scalar>::observe(std::span<const PieceIndex> near, std::span<const PathPoint<Scalar>> path,
                                      const MoverMotion<Scalar>& motion, Box2<Scalar> quiet,
                                      const ColliderFilter* filter, Events& events) const noexcept {
  const Box2<Scalar> way = PieceFinder<Scalar>::positions_seen(path, motion);
  bool all_quiet = true;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const std::size_t first = i;
    const ColliderIndex sensor = scenery_->pieces()[near[i]].collider;
    bool is_quiet = keep_quiet(near[i], way, quiet);
    while (i + 1 < near.size() && scenery_->pieces()[near[i + 1]].collider == sensor)
      is_quiet = keep_quiet(near[++i], way, quiet) && is_quiet;
    if (is_quiet) continue;
    all_quiet = false;
    if (filter != nullptr && !(*filter)(*scenery_, sensor)) continue;
    for (std::size_t corner = 1; corner < path.size(); ++corner) {
      const Segment segment = seen_by(motion, path[corner - 1], path[corner]);
      // A character that does not move relative to the sensor neither enters nor leaves it.
      if (segment.from != segment.to) observe(sensor, near.subspan(first, i + 1 - first), segment, events);
    }
  }
  return all_quiet ? quiet : Candidates<Scalar>{}.quiet;
}

template <class Scalar>
bool Sensors<Scalar>::keep_quiet(PieceIndex piece, const Box2<Scalar>& way, Box2<Scalar>& quiet) const noexcept {
  const Box2<Scalar>& any = overlap_with(piece).any;
  const Box2<Scalar>& well_inside = overlap_with(piece).well_inside;
  if (way.upper.x() < any.lower.x()) {
    quiet.upper.x() = std::min(quiet.upper.x(), any.lower.x());
  } else if (way.lower.x() > any.upper.x()) {
    quiet.lower.x() = std::max(quiet.lower.x(), any.upper.x());
  } else if (way.upper.y() < any.lower.y()) {
    quiet.upper.y() = std::min(quiet.upper.y(), any.lower.y());
  } else if (way.lower.y() > any.upper.y()) {
    quiet.lower.y() = std::max(quiet.lower.y(), any.upper.y());
  } else {
    quiet = {quiet.lower.cwiseMax(well_inside.lower), quiet.upper.cwiseMin(well_inside.upper)};
    return well_inside.contains(way);
  }
  return true;
}

template <class Scalar>
void Sensors<Scalar>::observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment,
                              Events& events) const noexcept {
  using Change = typename SensorEvent<Scalar>::Change;
  using Time = OverlapTime<Scalar>;
  // Nearly all characters in a sensor are well inside.
  for (const PieceIndex piece : pieces)
    if (overlap_with(piece).well_inside.contains(segment.positions)) return;
  const auto stay_in = [&](PieceIndex piece) -> Time {
    if (!overlap_with(piece).any.overlaps(segment.positions)) return {.begin = Time::after, .end = Time::before};
    if (scenery_->pieces()[piece].is_circle())
      return geometry::overlap_time<Scalar>(outline_, scenery_->circle(piece), segment.from, segment.to);
    return geometry::overlap_time<Scalar>(overlap_with(piece).axes, segment.from, segment.to);
  };
  const Stays<Scalar, decltype(stay_in)> stays(pieces, stay_in);
  for (Time stay = stays.after(Time::before - 1); stay.any(); stay = stays.after(stay.end)) {
    if (stay.begin != Time::before) add_in_order({sensor, Change::enter, segment.fraction(stay.begin)}, events);
    if (stay.end == Time::after) return;
    add_in_order({sensor, Change::exit, segment.fraction(stay.end)}, events);
    if (pieces.size() == 1) return;  // convex: it is left once
  }
}

template class Sensors<float>;
template class Sensors<double>;

}  // namespace paperproof
