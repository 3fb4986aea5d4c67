#include "geometry/overlap_time.hpp"

#include "geometry/vectors.hpp"

#include <algorithm>

namespace paperproof::geometry {
namespace {

/// The edge that ends at vertex `i`.
Vec2d edge_to(std::span<const Vec2d> outline, std::size_t i) {
  return outline[i] - outline[i == 0 ? outline.size() - 1 : i - 1];
}

/// The axes of the standing outline's edges come first, then those of the mover's.
SeparatingAxis axis(std::span<const Vec2d> mover, std::span<const Vec2d> standing, std::size_t i) {
  if (i < standing.size()) {
    const Vec2d along = edge_to(standing, i);
    return {along, standing[i], Vec2d::Zero(), least_along(mover, {along.y(), -along.x()})};
  }
  const std::size_t edge = i - standing.size();
  const Vec2d along = edge_to(mover, edge);
  Vec2d met = standing[0];  // by the mover's edge: it lies farthest to the edge's inner side
  for (const Vec2d& point : standing)
    if (cross(along, Vec2d(point - met)) > 0) met = point;
  return {-along, met, mover[edge], 0};
}

}  // namespace

SeparatingAxes separating_axes(std::span<const Vec2d> mover, std::span<const Vec2d> standing) {
  SeparatingAxes axes;
  for (std::size_t i = 0; i < mover.size() + standing.size(); ++i) axes.push_back(axis(mover, standing, i));
  return axes;
}

OverlapTime overlap_time(std::span<const SeparatingAxis> axes, const Vec2d& from, const Vec2d& to) {
  OverlapTime time;
  for (std::size_t i = 0; i < axes.size() && time.any(); ++i)
    time.narrow(axes[i].separation(from), axes[i].separation(to), 0);
  return time;
}

Box2 deep_overlap(std::span<const Vec2d> mover, std::span<const Vec2d> standing, double depth) {
  const Box2 a = Box2::around(mover);
  const Box2 b = Box2::around(standing);
  const Vec2d middle = (b.lower + b.upper - a.lower - a.upper) / 2;
  const Vec2d half = (b.upper - b.lower + a.upper - a.lower) / 2;
  double share = 1;  // of the box around all positions that overlap
  for (const SeparatingAxis& axis : separating_axes(mover, standing)) {
    const Vec2d along = axis.along.cwiseAbs();
    share = std::min(share,
                     (-axis.separation(middle) - depth * along.sum()) / (along.x() * half.y() + along.y() * half.x()));
  }
  return {middle - share * half, middle + share * half};
}

}  // namespace paperproof::geometry
