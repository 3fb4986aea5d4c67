#include "sensors.hpp"

#include <paperproof/tolerances.hpp>

#include "geometry/circle.hpp"

#include <algorithm>
#include <limits>
#include <vector>

namespace paperproof {
namespace {

using geometry::OverlapTime;

/// Fractions of a segment that count as one instant. Zero: rounding parts the pieces of one sensor where the character
/// grazes the corner that they share. Large: short visits are joined.
inline constexpr double one_instant = 1e-12;

/// Depth of an overlap that no rounding can hide, at the distance `far` from the origin [m]. Zero: a character
/// that grazes a sensor would count as inside. Large: more overlaps than necessary are calculated.
double beyond_rounding(double far) { return Tolerances{}.look + 64 * std::numeric_limits<double>::epsilon() * far; }

/// Inserts in order of time, in whichever order the sensors are tested.
void add_in_order(const SensorEvent& event, std::vector<SensorEvent>& events) {
  const auto comes_before = [](const SensorEvent& a, const SensorEvent& b) {
    return a.fraction < b.fraction || (a.fraction == b.fraction && a.sensor < b.sensor);
  };
  events.insert(std::upper_bound(events.begin(), events.end(), event, comes_before), event);
}

}  // namespace

Sensors::Sensors(const Scenery& scenery, const CharacterShape& shape, PieceSearch search)
    : finder_(scenery, PieceFinder::Kind::sensors, shape.box().inflated(Tolerances{}.look), search),
      outline_(shape.hull().begin(), shape.hull().end()) {}

void Sensors::prepare(std::span<PieceIndex> pieces, MoverIndex, double angle) {
  for (PieceIndex& piece : pieces) {
    const auto [known, is_new] = known_.try_emplace(piece, static_cast<PieceIndex>(overlaps_.size()));
    if (is_new)
      overlaps_.push_back(overlap_with(piece, angle));
    else if (overlaps_[known->second].angle != angle)
      overlaps_[known->second] = overlap_with(piece, angle);
    piece = known->second;
  }
  stays_.reserve(overlaps_.size());
}

void Sensors::follow_edits() {
  overlaps_.clear();
  known_.clear();
}

Sensors::Overlap Sensors::overlap_with(PieceIndex piece, double angle) const {
  const Scenery& scenery = finder_.scenery();
  const PieceInfo& info = scenery.pieces()[piece];
  const PieceVertices given = scenery.vertices_of(piece);
  std::vector<Vec2d> vertices(given.begin(), given.end());
  Box2 box = scenery.box(piece);
  if (angle != 0) {
    vertices.clear();
    geometry::place({given.begin(), given.end()}, {.angle = angle}, vertices);
    box = geometry::Turn(angle)(box);
  }
  const Box2 shape = Box2::around(outline_);
  const double far = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
  // A little larger, so that rounding here cannot hide an overlap that the separations show.
  const Box2 any = Box2{box.lower - shape.upper, box.upper - shape.lower}.inflated(Tolerances{}.look);
  if (info.is_circle())
    return {info.collider, angle, {vertices[0], scenery.circle(piece).radius}, any, Box2::nowhere(), {}};
  const Box2 well_inside = geometry::deep_overlap(outline_, vertices, beyond_rounding(far));
  const geometry::SeparatingAxes axes = geometry::separating_axes(outline_, vertices);
  return {info.collider, angle, {}, any, well_inside, {axes.begin(), axes.end()}};
}

Sensors::Segment Sensors::seen_by(const MoverMotion& motion, const PathPoint& begin, const PathPoint& end) {
  const Vec2d from = begin.position - motion.at(begin.fraction);
  const Vec2d to = end.position - motion.at(end.fraction);
  return {from, to, Box2::between(from, to), begin.fraction, end.fraction};
}

void Sensors::observe(std::span<const PathPoint> path, const Moving& moving, Events& events,
                      const ColliderFilter* filter) {
  Nearby near(finder_, near_, &moving, filter, this);
  const Vec2d way = path.back().position - path.front().position;
  near.for_each_group(box_around(path, {}), way, [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    const MoverMotion motion = moving.motion_of(mover);
    while (!pieces.empty()) {  // those of one sensor follow each other
      const ColliderIndex sensor = overlaps_[pieces[0]].sensor;
      const auto is_other = [&](PieceIndex piece) { return overlaps_[piece].sensor != sensor; };
      const std::span its(pieces.begin(), std::ranges::find_if(pieces, is_other));
      for (std::size_t corner = 1; corner < path.size(); ++corner) {
        const Segment segment = seen_by(motion, path[corner - 1], path[corner]);
        // A character that does not move relative to the sensor neither enters nor leaves it.
        if (segment.from != segment.to) observe(sensor, its, segment, events);
      }
      pieces = pieces.subspan(its.size());
    }
  });
}

OverlapTime Sensors::stay_in(PieceIndex piece, const Segment& segment) const {
  const Overlap& overlap = overlaps_[piece];
  if (!overlap.any.overlaps(segment.positions)) return {.begin = OverlapTime::after, .end = OverlapTime::before};
  if (overlap.axes.empty()) return geometry::overlap_time(outline_, overlap.circle, segment.from, segment.to);
  return geometry::overlap_time(overlap.axes, segment.from, segment.to);
}

std::size_t Sensors::around(const Vec2d& position, const Moving& moving, const ColliderFilter* filter,
                            std::span<ColliderIndex> found) {
  std::size_t count = 0;
  ColliderIndex last = no_collider;
  Nearby near(finder_, near_, &moving, filter, this);
  near.for_each_group({position, position}, Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    const MoverMotion motion = moving.motion_of(mover);
    const Segment here = seen_by(motion, {position, 0}, {position, 0});
    for (const PieceIndex piece : pieces) {
      const ColliderIndex sensor = overlaps_[piece].sensor;
      if (sensor == last || !stay_in(piece, here).any()) continue;
      last = sensor;
      if (count < found.size()) found[count] = sensor;
      ++count;
    }
  });
  return count;
}

void Sensors::observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment,
                      Events& events) {
  using Change = SensorEvent::Change;
  // Nearly all characters in a sensor are well inside.
  for (const PieceIndex piece : pieces)
    if (overlaps_[piece].well_inside.contains(segment.positions)) return;
  stays_.clear();
  for (const PieceIndex piece : pieces)
    if (const OverlapTime stay = stay_in(piece, segment); stay.any()) stays_.push_back(stay);
  std::ranges::sort(stays_, {}, &OverlapTime::begin);
  for (auto stay = stays_.begin(); stay != stays_.end();) {
    const double begin = stay->begin;
    double end = stay->end;
    // Stays that overlap are one.
    for (++stay; stay != stays_.end() && stay->begin <= end + one_instant; ++stay) end = std::max(end, stay->end);
    if (begin != OverlapTime::before) add_in_order({sensor, Change::enter, segment.fraction(begin)}, events);
    if (end != OverlapTime::after) add_in_order({sensor, Change::exit, segment.fraction(end)}, events);
  }
}

}  // namespace paperproof
