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
inline constexpr double one_instant = 1e-12;

/// Depth of an overlap that no rounding can hide, at the distance `furthest` from the origin [m]. Zero: a character
/// that grazes a sensor would count as inside. Large: more overlaps than necessary are calculated.
double beyond_rounding(double furthest) {
  return Tolerances{}.look + 64 * std::numeric_limits<double>::epsilon() * furthest;
}

/// Inserts in order of time, in whichever order the sensors are tested. A full vector keeps the earliest events.
template <std::size_t capacity>
void add_in_order(const SensorEvent& event, FixedVector<SensorEvent, capacity>& events) noexcept {
  const auto comes_before = [&event](const SensorEvent& other) {
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
template <class StayIn>
class Stays {
 public:
  Stays(std::span<const PieceIndex> pieces, const StayIn& stay_in) noexcept : pieces_(pieces), stay_in_(stay_in) {}

  /// The first stay that begins later than `time`; empty if there is none.
  [[nodiscard]] OverlapTime after(double time) const noexcept {
    OverlapTime first{.begin = OverlapTime::after, .end = OverlapTime::before};
    for (const PieceIndex piece : pieces_) {
      const OverlapTime stay = stay_in_(piece);
      if (stay.any() && stay.begin > time && stay.begin < first.begin) first = stay;
    }
    // Each round but the last reaches the end of one more stay.
    while (pieces_.size() > 1 && first.any() && first.end != OverlapTime::after && extend(first)) {
    }
    return first;
  }

 private:
  /// Extends a stay by the stays that continue it. @return whether there were any.
  [[nodiscard]] bool extend(OverlapTime& stay) const noexcept {
    const double end = stay.end;
    for (const PieceIndex piece : pieces_) {
      const OverlapTime next = stay_in_(piece);
      if (next.any() && next.begin <= end + one_instant) stay.end = std::max(stay.end, next.end);
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

Sensors::Sensors(const Scenery& scenery, const CharacterShape& shape, PieceSearch search)
    : scenery_(&scenery), finder_(scenery, shape, all_of(scenery.sensor_pieces()), search) {
  const Vec2d lower = shape.box().lower;
  const Vec2d upper = shape.box().upper;
  for (const Vec2d& corner : shape.hull()) outline_.push_back(corner);
  const std::span<const Vec2d> outline = outline_;
  overlaps_.reserve(scenery.sensor_pieces().size());
  for (const PieceIndex piece : all_of(scenery.sensor_pieces())) {
    const PieceVertices vertices = scenery.vertices_of(piece);
    const Box2& box = scenery.box(piece);
    const double furthest = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    // A little larger, so that rounding here cannot hide an overlap that the separations show.
    const Box2 any = Box2{box.lower - upper, box.upper - lower}.inflated(Tolerances{}.look);
    if (scenery.pieces()[piece].is_circle())
      overlaps_.push_back({any, {upper - lower, lower - upper}, {}});
    else
      overlaps_.push_back({any, geometry::deep_overlap(outline, vertices, beyond_rounding(furthest)),
                           geometry::separating_axes(outline, vertices)});
  }
}

typename Sensors::Segment Sensors::seen_by(const MoverMotion& motion, const PathPoint& begin,
                                           const PathPoint& end) noexcept {
  Segment segment;
  segment.from = begin.position - motion.at(begin.fraction);
  segment.to = end.position - motion.at(end.fraction);
  segment.begin = begin.fraction;
  segment.end = end.fraction;
  segment.positions = {segment.from.cwiseMin(segment.to), segment.from.cwiseMax(segment.to)};
  return segment;
}

void Sensors::observe(std::span<const PathPoint> path, std::span<const MoverMotion> movers, Candidates& candidates,
                      Events& events, const ColliderFilter* filter) const noexcept {
  if (const std::span<const PieceIndex> near = finder_.near_standing(path, candidates); !near.empty())
    candidates.quiet = observe(near, path, {}, candidates.box, filter, events);
  finder_.along_movers(path, movers, candidates, [&](std::span<const PieceIndex> near, const MoverMotion& motion) {
    observe(near, path, motion, {}, filter, events);
  });
}

/// The pieces of one sensor are consecutive.
Box2 Sensors::observe(std::span<const PieceIndex> near, std::span<const PathPoint> path, const MoverMotion& motion,
                      Box2 quiet, const ColliderFilter* filter, Events& events) const noexcept {
  const Box2 way = PieceFinder::positions_seen(path, motion);
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
  return all_quiet ? quiet : Candidates{}.quiet;
}

bool Sensors::keep_quiet(PieceIndex piece, const Box2& way, Box2& quiet) const noexcept {
  const Box2& any = overlap_with(piece).any;
  const Box2& well_inside = overlap_with(piece).well_inside;
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

void Sensors::observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment,
                      Events& events) const noexcept {
  using Change = SensorEvent::Change;
  // Nearly all characters in a sensor are well inside.
  for (const PieceIndex piece : pieces)
    if (overlap_with(piece).well_inside.contains(segment.positions)) return;
  const auto stay_in = [&](PieceIndex piece) -> OverlapTime {
    if (!overlap_with(piece).any.overlaps(segment.positions))
      return {.begin = OverlapTime::after, .end = OverlapTime::before};
    if (scenery_->pieces()[piece].is_circle())
      return geometry::overlap_time(outline_, scenery_->circle(piece), segment.from, segment.to);
    return geometry::overlap_time(overlap_with(piece).axes, segment.from, segment.to);
  };
  const Stays<decltype(stay_in)> stays(pieces, stay_in);
  for (OverlapTime stay = stays.after(OverlapTime::before - 1); stay.any(); stay = stays.after(stay.end)) {
    if (stay.begin != OverlapTime::before) add_in_order({sensor, Change::enter, segment.fraction(stay.begin)}, events);
    if (stay.end == OverlapTime::after) return;
    add_in_order({sensor, Change::exit, segment.fraction(stay.end)}, events);
    if (pieces.size() == 1) return;  // convex: it is left once
  }
}

}  // namespace paperproof
