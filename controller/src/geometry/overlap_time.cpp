#include "geometry/overlap_time.hpp"

#include "geometry/vectors.hpp"

#include <algorithm>
#include <limits>

namespace paperproof::geometry {
namespace {

/// The edge that ends at vertex `i`.
template <class Scalar>
Vec2<Scalar> edge_to(std::span<const Vec2<Scalar>> outline, std::size_t i) noexcept {
  return outline[i] - outline[i == 0 ? outline.size() - 1 : i - 1];
}

template <class Scalar>
SeparatingAxis<Scalar> axis_of_standing(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                                        std::size_t i) noexcept {
  const Vec2<Scalar> along = edge_to(standing, i);
  Scalar least = std::numeric_limits<Scalar>::infinity();
  for (const Vec2<Scalar>& point : mover) least = std::min(least, -cross(along, point));
  return {along, standing[i], Vec2<Scalar>::Zero(), least};
}

/// The vertex that the mover meets with its edge lies farthest to the edge's inner side.
template <class Scalar>
SeparatingAxis<Scalar> axis_of_mover(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                                     std::size_t i) noexcept {
  const Vec2<Scalar> along = edge_to(mover, i);
  Vec2<Scalar> met = standing[0];
  for (const Vec2<Scalar>& point : standing)
    if (cross(along, Vec2<Scalar>(point - met)) > 0) met = point;
  return {-along, met, mover[i], 0};
}

/// Calls `visit` with one axis after the other until it returns false.
template <class Scalar, class Visit>
void for_each_axis(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                   const Visit& visit) noexcept(noexcept(visit(SeparatingAxis<Scalar>{}))) {
  for (std::size_t i = 0; i < standing.size(); ++i)
    if (!visit(axis_of_standing(mover, standing, i))) return;
  for (std::size_t i = 0; i < mover.size(); ++i)
    if (!visit(axis_of_mover(mover, standing, i))) return;
}

/// Narrows `time`, in which all separations so far are negative, by one more separation that changes linearly.
template <class Scalar>
void narrow(OverlapTime<Scalar>& time, Scalar at_start, Scalar at_end) noexcept {
  const bool apart_at_start = !(at_start < 0);
  const bool apart_at_end = !(at_end < 0);
  if (!apart_at_start && !apart_at_end) return;
  if (apart_at_start && apart_at_end) {
    time = {.begin = OverlapTime<Scalar>::after, .end = OverlapTime<Scalar>::before};
  } else if (apart_at_start) {
    time.begin = std::max(time.begin, at_start / (at_start - at_end));
  } else {
    time.end = std::min(time.end, at_start / (at_start - at_end));
  }
}

}  // namespace

template <class Scalar>
std::vector<SeparatingAxis<Scalar>> separating_axes(std::span<const Vec2<Scalar>> mover,
                                                    std::span<const Vec2<Scalar>> standing) {
  std::vector<SeparatingAxis<Scalar>> axes;
  axes.reserve(mover.size() + standing.size());
  for_each_axis(mover, standing, [&](const SeparatingAxis<Scalar>& axis) {
    axes.push_back(axis);
    return true;
  });
  return axes;
}

template <class Scalar>
OverlapTime<Scalar> overlap_time(std::span<const SeparatingAxis<Scalar>> axes, const Vec2<Scalar>& from,
                                 const Vec2<Scalar>& to) noexcept {
  OverlapTime<Scalar> time;
  for (const SeparatingAxis<Scalar>& axis : axes) {
    narrow(time, axis.separation(from), axis.separation(to));
    if (!time.any()) break;
  }
  return time;
}

template <class Scalar>
OverlapTime<Scalar> overlap_time(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                                 const Vec2<Scalar>& from, const Vec2<Scalar>& to) noexcept {
  OverlapTime<Scalar> time;
  for_each_axis(mover, standing, [&](const SeparatingAxis<Scalar>& axis) noexcept {
    narrow(time, axis.separation(from), axis.separation(to));
    return time.any();
  });
  return time;
}

template <class Scalar>
Box2<Scalar> deep_overlap(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                          Scalar depth) noexcept {
  const Box2<Scalar> a = Box2<Scalar>::around(mover);
  const Box2<Scalar> b = Box2<Scalar>::around(standing);
  const Vec2<Scalar> middle = (b.lower + b.upper - a.lower - a.upper) / 2;
  const Vec2<Scalar> half = (b.upper - b.lower + a.upper - a.lower) / 2;
  Scalar share = 1;  // of the box around all positions that overlap
  for_each_axis(mover, standing, [&](const SeparatingAxis<Scalar>& axis) noexcept {
    const Vec2<Scalar> along = axis.along.cwiseAbs();
    share = std::min(share,
                     (-axis.separation(middle) - depth * along.sum()) / (along.x() * half.y() + along.y() * half.x()));
    return true;
  });
  return {middle - share * half, middle + share * half};
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                                                    \
  template std::vector<SeparatingAxis<Scalar>> separating_axes(std::span<const Vec2<Scalar>>,             \
                                                               std::span<const Vec2<Scalar>>);            \
  template OverlapTime<Scalar> overlap_time(std::span<const SeparatingAxis<Scalar>>, const Vec2<Scalar>&, \
                                            const Vec2<Scalar>&) noexcept;                                \
  template OverlapTime<Scalar> overlap_time(std::span<const Vec2<Scalar>>, std::span<const Vec2<Scalar>>, \
                                            const Vec2<Scalar>&, const Vec2<Scalar>&) noexcept;           \
  template Box2<Scalar> deep_overlap(std::span<const Vec2<Scalar>>, std::span<const Vec2<Scalar>>, Scalar) noexcept;
PAPERPROOF_INSTANTIATE(float)
PAPERPROOF_INSTANTIATE(double)
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::geometry
