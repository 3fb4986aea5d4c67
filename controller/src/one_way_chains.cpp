#include "one_way_chains.hpp"

#include <algorithm>
#include <limits>

#include "geometry/overlap_time.hpp"

namespace paperproof {
namespace {

/// Margin around the character in which passed chains are looked for, as a share of its size. Zero: rounding hides a
/// chain whose tip the character grazes. Large: chains beside the way are named.
constexpr double margin_share = 1e-6;

/// Rounding error of the height over a segment, as a share of the coordinates.
inline constexpr double height_rounding = std::numeric_limits<double>::epsilon() * 24;

bool passes(const OneWaySegment& segment, const CharacterShape& shape, const Vec2d& from, const Vec2d& to) {
  const auto& [begin, end] = segment.ends;
  const Vec2d along = end - begin;
  const bool against = Vec2d(-along.y(), along.x()).dot(to - from) < 0;
  // A character above a straight surface does not pass it along the normal, but another part of a bent surface may be
  // in the way. A segment that is not met against its normal is tested without the margin.
  if (!against && segment.surfaces->is_straight(segment.surface)) return false;
  Vec2d middle = Vec2d::Zero();
  for (const Vec2d& corner : shape.hull()) middle += corner / static_cast<double>(shape.hull().size());
  FixedVector<Vec2d, CharacterShape::max_points> outline;
  for (const Vec2d& corner : shape.hull())
    outline.push_back(against ? Vec2d(corner + margin_share * (corner - middle)) : corner);
  if (!geometry::overlap_time(geometry::separating_axes(outline, segment.ends), from, to).any()) return false;
  const double size = from.cwiseAbs().maxCoeff() + begin.cwiseAbs().maxCoeff() + end.cwiseAbs().maxCoeff();
  return segment.surfaces->may_be_above(segment.surface, from, height_rounding * size);
}

}  // namespace

void add_if_passed(const OneWaySegment& segment, const CharacterShape& shape, std::span<const PathPoint> path,
                   const MoverMotion& motion, std::vector<ColliderIndex>& passed) {
  const auto place = std::lower_bound(passed.begin(), passed.end(), segment.chain);
  if (place != passed.end() && *place == segment.chain) return;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2d from = path[i - 1].position - motion.at(path[i - 1].fraction);
    const Vec2d to = path[i].position - motion.at(path[i].fraction);
    if (from != to && passes(segment, shape, from, to)) return void(passed.insert(place, segment.chain));
  }
}

}  // namespace paperproof
