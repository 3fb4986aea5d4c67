#include "geometry/overlap_time.hpp"

#include <algorithm>
#include <limits>

namespace paperproof::geometry {
namespace {

/// Twice the area that an edge spans with a vector: the component along the edge's left normal, times its length.
template <class Scalar>
Scalar cross(const Vec2<Scalar>& edge, const Vec2<Scalar>& vector) noexcept {
  return edge.x() * vector.y() - edge.y() * vector.x();
}

template <class Scalar>
struct Edge {
  Vec2<Scalar> end;
  Vec2<Scalar> along;

  /// The one that ends at vertex `i`.
  Edge(std::span<const Vec2<Scalar>> outline, std::size_t i) noexcept
      : end(outline[i]), along(outline[i] - outline[i == 0 ? outline.size() - 1 : i - 1]) {}

  /// How far a point is on the outer side. In units of the edge's length: only the sign is used, and the ratio of two.
  [[nodiscard]] Scalar beyond(const Vec2<Scalar>& point) const noexcept {
    const Vec2<Scalar> from_end = point - end;
    return -cross(along, from_end);
  }
};

/// How far an outline at the origin reaches to the outer side of an edge, at least. What is nearest is subtracted
/// first: positions are large, outlines small.
template <class Scalar>
Scalar least_reach(const Edge<Scalar>& edge_of_standing, std::span<const Vec2<Scalar>> mover) noexcept {
  Scalar least = std::numeric_limits<Scalar>::infinity();
  for (const Vec2<Scalar>& point : mover) least = std::min(least, -cross(edge_of_standing.along, point));
  return least;
}

/// Along an edge of the mover.
template <class Scalar>
Scalar separation(std::span<const Vec2<Scalar>> standing, const Edge<Scalar>& edge_of_mover,
                  const Vec2<Scalar>& at) noexcept {
  Scalar least = std::numeric_limits<Scalar>::infinity();
  for (const Vec2<Scalar>& point : standing) least = std::min(least, edge_of_mover.beyond(point - at));
  return least;
}

template <class Scalar>
Box2<Scalar> box_around(std::span<const Vec2<Scalar>> outline) noexcept {
  Box2<Scalar> box{outline.front(), outline.front()};
  for (const Vec2<Scalar>& point : outline) box = box.merged({point, point});
  return box;
}

/// Narrows the time in which all separations so far were negative by one that changes linearly.
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
OverlapTime<Scalar> overlap_time(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                                 const Vec2<Scalar>& from, const Vec2<Scalar>& to) noexcept {
  OverlapTime<Scalar> time;
  for (std::size_t i = 0; i < standing.size() && time.any(); ++i) {
    const Edge<Scalar> edge(standing, i);
    const Scalar least = least_reach(edge, mover);
    narrow(time, least + edge.beyond(from), least + edge.beyond(to));
  }
  for (std::size_t i = 0; i < mover.size() && time.any(); ++i) {
    const Edge<Scalar> edge(mover, i);
    narrow(time, separation(standing, edge, from), separation(standing, edge, to));
  }
  return time;
}

template <class Scalar>
Box2<Scalar> deep_overlap(std::span<const Vec2<Scalar>> mover, std::span<const Vec2<Scalar>> standing,
                          Scalar depth) noexcept {
  const Box2<Scalar> a = box_around(mover);
  const Box2<Scalar> b = box_around(standing);
  const Vec2<Scalar> middle = (b.lower + b.upper - a.lower - a.upper) / 2;
  const Vec2<Scalar> half = (b.upper - b.lower + a.upper - a.lower) / 2;
  Scalar share = 1;  // of the box around all positions that overlap
  const auto narrow_by = [&](const Edge<Scalar>& edge, Scalar separation_at_middle) {
    const Vec2<Scalar> along = edge.along.cwiseAbs();
    share =
        std::min(share, (-separation_at_middle - depth * along.sum()) / (along.x() * half.y() + along.y() * half.x()));
  };
  for (std::size_t i = 0; i < standing.size(); ++i) {
    const Edge<Scalar> edge(standing, i);
    narrow_by(edge, least_reach(edge, mover) + edge.beyond(middle));
  }
  for (std::size_t i = 0; i < mover.size(); ++i) {
    const Edge<Scalar> edge(mover, i);
    narrow_by(edge, separation(standing, edge, middle));
  }
  return {middle - share * half, middle + share * half};
}

template Box2<float> deep_overlap(std::span<const Vec2<float>>, std::span<const Vec2<float>>, float) noexcept;
template Box2<double> deep_overlap(std::span<const Vec2<double>>, std::span<const Vec2<double>>, double) noexcept;
template OverlapTime<float> overlap_time(std::span<const Vec2<float>>, std::span<const Vec2<float>>, const Vec2<float>&,
                                         const Vec2<float>&) noexcept;
template OverlapTime<double> overlap_time(std::span<const Vec2<double>>, std::span<const Vec2<double>>,
                                          const Vec2<double>&, const Vec2<double>&) noexcept;

}  // namespace paperproof::geometry
