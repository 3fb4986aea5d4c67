#include "geometry/circle.hpp"

#include "geometry/vectors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::geometry {
namespace {

/// A motion that grazes converges by a quarter of its distance each time; 1e6 m to rounding are 40 of them.
constexpr int most_tangents = 128;

}  // namespace

template <class Scalar>
NearCircle<Scalar> near_circle(std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& position,
                               const Circle<Scalar>& circle) noexcept {
  const Vec2<Scalar> centre = circle.centre - position;
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  NearCircle<Scalar> inside{-infinity, Vec2<Scalar>::Zero()};  // by the edge that the centre is furthest outside of
  Scalar nearest = infinity;
  Vec2<Scalar> to_nearest = Vec2<Scalar>::Zero();  // from the nearest corner to the centre
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2<Scalar> edge = outline[k + 1 < outline.size() ? k + 1 : 0] - outline[k];
    const Vec2<Scalar> arm = centre - outline[k];
    const Scalar length = length_of(edge);
    const Vec2<Scalar> out{edge.y() / length, -edge.x() / length};
    const Scalar height = dot(out, arm);
    const Scalar place = dot(edge, arm);
    if (height >= 0 && place >= 0 && place <= length * length) return {height - circle.radius, -out};
    if (height > inside.separation) inside = {height, -out};
    const Scalar distance = length_of(arm);
    if (!(distance < nearest)) continue;
    nearest = distance;
    to_nearest = arm;
  }
  if (inside.separation < 0 || nearest == 0) return {inside.separation - circle.radius, inside.normal};
  return {nearest - circle.radius, -to_nearest / nearest};
}

template <class Scalar>
std::optional<Approach<Scalar>> approach(std::span<const Vec2<Scalar>> outline, const Vec2<Scalar>& from,
                                         const Vec2<Scalar>& displacement, const Circle<Scalar>& circle,
                                         Scalar level) noexcept {
  Approach<Scalar> result{0, near_circle(outline, from, circle)};
  for (int tangents = 0; tangents < most_tangents; ++tangents) {
    const Scalar above = result.there.separation - level;
    const Scalar rate = dot(result.there.normal, displacement);
    if (rate >= 0 || above + rate * (1 - result.time) >= 0) return std::nullopt;
    const Scalar later = result.time + above / -rate;
    if (!(later > result.time)) break;
    result.time = later;
    result.there = near_circle(outline, Vec2<Scalar>(from + displacement * later), circle);
  }
  return result;
}

template <class Scalar>
OverlapTime<Scalar> overlap_time(std::span<const Vec2<Scalar>> mover, const Circle<Scalar>& standing,
                                 const Vec2<Scalar>& from, const Vec2<Scalar>& to) noexcept {
  using Time = OverlapTime<Scalar>;
  Time time;
  if (!(near_circle(mover, from, standing).separation < 0)) {
    const auto enters = approach(mover, from, Vec2<Scalar>(to - from), standing, Scalar(0));
    if (!enters) return {.begin = Time::after, .end = Time::before};
    time.begin = enters->time;
  }
  if (!(near_circle(mover, to, standing).separation < 0)) {
    const auto leaves = approach(mover, to, Vec2<Scalar>(from - to), standing, Scalar(0));
    if (!leaves) return {.begin = Time::after, .end = Time::before};
    time.end = 1 - leaves->time;
  }
  return time;
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                                                                 \
  template NearCircle<Scalar> near_circle(std::span<const Vec2<Scalar>>, const Vec2<Scalar>&,                          \
                                          const Circle<Scalar>&) noexcept;                                             \
  template std::optional<Approach<Scalar>> approach(std::span<const Vec2<Scalar>>, const Vec2<Scalar>&,                \
                                                    const Vec2<Scalar>&, const Circle<Scalar>&, Scalar) noexcept;      \
  template OverlapTime<Scalar> overlap_time(std::span<const Vec2<Scalar>>, const Circle<Scalar>&, const Vec2<Scalar>&, \
                                            const Vec2<Scalar>&) noexcept;
PAPERPROOF_INSTANTIATE(float)
PAPERPROOF_INSTANTIATE(double)
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::geometry
