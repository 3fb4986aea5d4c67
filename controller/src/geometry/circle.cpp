#include "geometry/circle.hpp"

#include "geometry/vectors.hpp"

#include <limits>

namespace paperproof::geometry {
namespace {

/// A motion that grazes converges by a quarter of its distance each time; 1e6 m to rounding are 40 of them.
constexpr int most_tangents = 128;

}  // namespace

NearCircle near_circle(std::span<const Vec2d> outline, const Vec2d& position, const Circle& circle) {
  const Vec2d centre = circle.centre - position;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  NearCircle inside{-infinity, Vec2d::Zero()};  // by the edge that the centre is furthest outside of
  double nearest = infinity;
  Vec2d to_nearest = Vec2d::Zero();  // from the nearest corner to the centre
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2d edge = outline[k + 1 < outline.size() ? k + 1 : 0] - outline[k];
    const Vec2d arm = centre - outline[k];
    const double length = length_of(edge);
    const Vec2d out{edge.y() / length, -edge.x() / length};
    const double height = dot(out, arm);
    const double place = dot(edge, arm);
    if (height >= 0 && place >= 0 && place <= length * length) return {height - circle.radius, -out};
    if (height > inside.separation) inside = {height, -out};
    const double distance = length_of(arm);
    if (!(distance < nearest)) continue;
    nearest = distance;
    to_nearest = arm;
  }
  if (inside.separation < 0 || nearest == 0) return {inside.separation - circle.radius, inside.normal};
  return {nearest - circle.radius, -to_nearest / nearest};
}

std::optional<Approach> approach(std::span<const Vec2d> outline, const Vec2d& from, const Vec2d& displacement,
                                 const Circle& circle, double level) {
  Approach result{0, near_circle(outline, from, circle)};
  for (int tangents = 0; tangents < most_tangents; ++tangents) {
    const double above = result.there.separation - level;
    const double rate = dot(result.there.normal, displacement);
    if (rate >= 0 || above + rate * (1 - result.time) >= 0) return std::nullopt;
    const double later = result.time + above / -rate;
    if (!(later > result.time)) break;
    result.time = later;
    result.there = near_circle(outline, Vec2d(from + displacement * later), circle);
  }
  return result;
}

OverlapTime overlap_time(std::span<const Vec2d> mover, const Circle& standing, const Vec2d& from, const Vec2d& to) {
  OverlapTime time;
  if (!(near_circle(mover, from, standing).separation < 0)) {
    const auto enters = approach(mover, from, Vec2d(to - from), standing, 0.0);
    if (!enters) return {.begin = OverlapTime::after, .end = OverlapTime::before};
    time.begin = enters->time;
  }
  if (!(near_circle(mover, to, standing).separation < 0)) {
    const auto leaves = approach(mover, to, Vec2d(from - to), standing, 0.0);
    if (!leaves) return {.begin = OverlapTime::after, .end = OverlapTime::before};
    time.end = 1 - leaves->time;
  }
  return time;
}

}  // namespace paperproof::geometry
