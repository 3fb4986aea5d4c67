#include "geometry/overlap_time.hpp"

#include "geometry/vectors.hpp"

#include <algorithm>
#include <limits>

namespace paperproof::geometry {
namespace {

/// The edge that ends at vertex `i`.
Vec2d edge_to(std::span<const Vec2d> outline, std::size_t i) noexcept {
  return outline[i] - outline[i == 0 ? outline.size() - 1 : i - 1];
}

SeparatingAxis axis_of_standing(std::span<const Vec2d> mover, std::span<const Vec2d> standing, std::size_t i) noexcept {
  const Vec2d along = edge_to(standing, i);
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2d& point : mover) least = std::min(least, -cross(along, point));
  return {along, standing[i], Vec2d::Zero(), least};
}

/// The vertex that the mover meets with its edge lies farthest to the edge's inner side.
SeparatingAxis axis_of_mover(std::span<const Vec2d> mover, std::span<const Vec2d> standing, std::size_t i) noexcept {
  const Vec2d along = edge_to(mover, i);
  Vec2d met = standing[0];
  for (const Vec2d& point : standing)
    if (cross(along, Vec2d(point - met)) > 0) met = point;
  return {-along, met, mover[i], 0};
}

/// Calls `visit` with one axis after the other until it returns false.
template <class Visit>
void for_each_axis(std::span<const Vec2d> mover, std::span<const Vec2d> standing,
                   const Visit& visit) noexcept(noexcept(visit(SeparatingAxis{}))) {
  for (std::size_t i = 0; i < standing.size(); ++i)
    if (!visit(axis_of_standing(mover, standing, i))) return;
  for (std::size_t i = 0; i < mover.size(); ++i)
    if (!visit(axis_of_mover(mover, standing, i))) return;
}

}  // namespace

std::vector<SeparatingAxis> separating_axes(std::span<const Vec2d> mover, std::span<const Vec2d> standing) {
  std::vector<SeparatingAxis> axes;
  axes.reserve(mover.size() + standing.size());
  for_each_axis(mover, standing, [&](const SeparatingAxis& axis) {
    axes.push_back(axis);
    return true;
  });
  return axes;
}

OverlapTime overlap_time(std::span<const SeparatingAxis> axes, const Vec2d& from, const Vec2d& to) noexcept {
  OverlapTime time;
  for (const SeparatingAxis& axis : axes) {
    time.narrow(axis.separation(from), axis.separation(to), 0);
    if (!time.any()) break;
  }
  return time;
}

OverlapTime overlap_time(std::span<const Vec2d> mover, std::span<const Vec2d> standing, const Vec2d& from,
                         const Vec2d& to) noexcept {
  OverlapTime time;
  for_each_axis(mover, standing, [&](const SeparatingAxis& axis) noexcept {
    time.narrow(axis.separation(from), axis.separation(to), 0);
    return time.any();
  });
  return time;
}

Box2 deep_overlap(std::span<const Vec2d> mover, std::span<const Vec2d> standing, double depth) noexcept {
  const Box2 a = Box2::around(mover);
  const Box2 b = Box2::around(standing);
  const Vec2d middle = (b.lower + b.upper - a.lower - a.upper) / 2;
  const Vec2d half = (b.upper - b.lower + a.upper - a.lower) / 2;
  double share = 1;  // of the box around all positions that overlap
  for_each_axis(mover, standing, [&](const SeparatingAxis& axis) noexcept {
    const Vec2d along = axis.along.cwiseAbs();
    share = std::min(share,
                     (-axis.separation(middle) - depth * along.sum()) / (along.x() * half.y() + along.y() * half.x()));
    return true;
  });
  return {middle - share * half, middle + share * half};
}

}  // namespace paperproof::geometry
