/// The questions themselves, once for both kinds of number. All points are relative to where the octagon is, so the
/// approximate ones are as sharp a million metres from the origin as beside it.
#pragma once

#include "oracle/number.hpp"

#include <optional>
#include <span>

namespace paperproof::compare::detail {

/// Most corners of a character that the oracle takes.
inline constexpr std::size_t max_points = 16;

/// An open convex polygon, counter-clockwise: the octagon, or everything that it passes on a straight way.
template <class Number>
struct Hull {
  std::array<Point<Number>, max_points + 2> corners;
  std::array<Point<Number>, max_points + 2> edges;  ///< From each corner to the next.
  std::size_t size = 0;

  void push(const Point<Number>& corner, const Point<Number>& edge) {
    corners[size] = corner;
    edges[size++] = edge;
  }
};

template <class Number>
struct Octagon {
  std::array<Point<Number>, max_points> corners;
  std::size_t size = 0;
  [[nodiscard]] Point<Number> edge(std::size_t k) const { return corners[(k + 1) % size] - corners[k]; }
};

template <class Number>
[[nodiscard]] Octagon<Number> convert_octagon(const Convert<Number>& to, std::span<const Vec2d> points) {
  Octagon<Number> octagon;
  for (const Vec2d& point : points) octagon.corners[octagon.size++] = convert(to, point);
  return octagon;
}

/// The interior of the union of the octagon over a straight way: edges that look ahead are taken at its end, the others
/// at its start, and two copies of the way join them.
/// @returns false where a number does not know which way an edge looks.
template <class Number>
[[nodiscard]] bool sweep_hull(const Octagon<Number>& octagon, const Point<Number>& way, Hull<Number>& hull) {
  std::array<bool, max_points> ahead{};
  for (std::size_t k = 0; k < octagon.size; ++k) {
    const Sign sign = sign_of(cross(way, octagon.edge(k)));
    if (sign == Sign::unknown) return false;
    ahead[k] = sign == Sign::positive;
  }
  for (std::size_t k = 0; k < octagon.size; ++k) {
    const Point<Number>& corner = octagon.corners[k];
    const bool before = ahead[(k + octagon.size - 1) % octagon.size];
    if (before != ahead[k]) hull.push(before ? corner + way : corner, before ? -way : way);
    hull.push(ahead[k] ? corner + way : corner, octagon.edge(k));
  }
  return true;
}

/// Whether the open disc around a point meets the hull: the point is inside, or nearer to an edge than the radius.
template <class Number>
[[nodiscard]] Answer disc_enters(const Hull<Number>& hull, const Point<Number>& centre, const Number& radius) {
  const auto is_below = [](const Number& a, const Number& b) { return is(sign_of(a - b), Sign::negative); };
  const Number square = radius * radius;
  Answer inside = Answer::yes;
  Answer near = Answer::no;
  for (std::size_t k = 0; k < hull.size && near != Answer::yes; ++k) {
    const Point<Number> arm = centre - hull.corners[k];
    const Number aside = cross(hull.edges[k], arm);
    inside = both(inside, is(sign_of(aside), Sign::positive));
    near = either(near, is_below(dot(arm, arm), square));
    const Number along = dot(hull.edges[k], arm);
    const Number length = dot(hull.edges[k], hull.edges[k]);
    const Answer beside = both(is(sign_of(along), Sign::positive), is_below(along, length));
    near = either(near, both(beside, is_below(aside * aside, square * length)));
  }
  return either(inside, near);
}

/// Plain doubles with a static bound decide most of the edges that are near but not met: both ends certainly outside
/// one edge of the hull. Every entry carries one rounding (the edge) or two (the corner), so 16 half ulp of the
/// products' magnitudes is more than everything that can go wrong.
[[nodiscard]] inline bool certainly_outside(const Hull<Approximate>& hull, const Point<Approximate>& a,
                                            const Point<Approximate>& b) noexcept {
  constexpr double bound = 16 * 0x1p-52;
  const auto below = [&](const Point<Approximate>& p, std::size_t j) {
    const Point<Approximate>& corner = hull.corners[j];
    const Point<Approximate>& edge = hull.edges[j];
    const double one = edge.x.value * (p.y.value - corner.y.value);
    const double two = edge.y.value * (p.x.value - corner.x.value);
    const double size =
        std::abs(edge.x.value) * (std::abs(p.y.value) + std::abs(corner.y.value) + corner.y.radius * 0x1p53) +
        std::abs(edge.y.value) * (std::abs(p.x.value) + std::abs(corner.x.value) + corner.x.radius * 0x1p53);
    return one - two < -(size * bound + 0x1p-900);
  };
  for (std::size_t j = 0; j < hull.size; ++j) {
    if (below(a, j) && below(b, j)) return true;
  }
  return false;
}

[[nodiscard]] inline bool certainly_outside(const Hull<Integer>&, const Point<Integer>&,
                                            const Point<Integer>&) noexcept {
  return false;
}

/// Whether a closed segment enters an open convex polygon: Cyrus and Beck 1978, with strict insides. What is left of
/// the segment's parameter interval after every edge must contain more than a point.
template <class Number>
[[nodiscard]] Answer segment_enters(const Hull<Number>& hull, const Point<Number>& a, const Point<Number>& b) {
  if (certainly_outside(hull, a, b)) return Answer::no;
  std::array<Number, max_points + 2> at_a;
  std::array<Number, max_points + 2> at_b;
  bool unknown = false;
  for (std::size_t j = 0; j < hull.size; ++j) {
    at_a[j] = cross(hull.edges[j], a - hull.corners[j]);
    at_b[j] = cross(hull.edges[j], b - hull.corners[j]);
    const Sign sign_a = sign_of(at_a[j]);
    const Sign sign_b = sign_of(at_b[j]);
    const bool out_a = sign_a == Sign::negative || sign_a == Sign::zero;
    const bool out_b = sign_b == Sign::negative || sign_b == Sign::zero;
    if (out_a && out_b) return Answer::no;
    unknown = unknown || sign_a == Sign::unknown || sign_b == Sign::unknown;
  }
  if (unknown) return Answer::unknown;

  const Convert<Number> number;
  Number low = number(0);
  Number low_over = number(1);
  Number high = low_over;
  Number high_over = low_over;
  for (std::size_t j = 0; j < hull.size; ++j) {
    const bool in_a = sign_of(at_a[j]) == Sign::positive;
    const bool in_b = sign_of(at_b[j]) == Sign::positive;
    if (in_a && in_b) continue;
    const Number numerator = in_a ? at_a[j] : -at_a[j];
    const Number denominator = in_a ? at_a[j] - at_b[j] : at_b[j] - at_a[j];
    Number& limit = in_a ? high : low;
    Number& limit_over = in_a ? high_over : low_over;
    const Number difference = numerator * limit_over - limit * denominator;
    const Sign order = sign_of(in_a ? -difference : difference);
    if (order == Sign::unknown) return Answer::unknown;
    if (order == Sign::positive) {
      limit = numerator;
      limit_over = denominator;
    }
  }
  const Sign left = sign_of(high * low_over - low * high_over);
  if (left == Sign::unknown) return Answer::unknown;
  return left == Sign::positive ? Answer::yes : Answer::no;
}

/// Whether a ray from `point` to the right crosses the edge from a to b. `point` must not lie on the edge.
template <class Number>
[[nodiscard]] Answer crosses_ray(const Point<Number>& point, const Point<Number>& a, const Point<Number>& b) {
  const Sign sign_a = sign_of(a.y - point.y);
  const Sign sign_b = sign_of(b.y - point.y);
  if (sign_a == Sign::unknown || sign_b == Sign::unknown) return Answer::unknown;
  const bool above_a = sign_a == Sign::positive;
  const bool above_b = sign_b == Sign::positive;
  if (above_a == above_b) return Answer::no;
  const Sign turn = sign_of(cross(b - a, point - a));
  if (turn == Sign::unknown) return Answer::unknown;
  return (turn == Sign::positive) == above_b ? Answer::yes : Answer::no;
}

}  // namespace paperproof::compare::detail
