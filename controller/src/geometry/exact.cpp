#include "geometry/exact.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace paperproof::geometry {
namespace {

/// Largest relative error of one rounded operation.
constexpr double rounding = 0x1p-53;

/// Veltkamp's split into two halves of at most 26 bits, so that products of halves are exact.
TwoDoubles split(double a) {
  constexpr double splitter = 0x1p27 + 1;
  const double scaled = splitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

/// Dekker's product. A fused multiply-add would be shorter, but would give other bits where it is emulated badly.
TwoDoubles two_product(double a, double b) {
  const double product = a * b;
  const TwoDoubles x = split(a);
  const TwoDoubles y = split(b);
  const double missing = ((product - x.high * y.high) - x.low * y.high) - x.high * y.low;
  return {product, x.low * y.low - missing};
}

/// A sum of doubles without rounding: parts that do not overlap, in ascending magnitude, none of them zero
/// (Shewchuk's GROW-EXPANSION with the zeros left out). Each `add` makes it at most one part longer.
template <std::size_t Capacity>
class ExactSum {
 public:
  void add(double term) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoDoubles sum = two_sum(term, parts_[i]);
      if (sum.low != 0) parts_[kept++] = sum.low;
      term = sum.high;
    }
    if (term != 0) parts_[kept++] = term;
    size_ = kept;
  }
  void add_product(double a, double b) {
    const TwoDoubles product = two_product(a, b);
    add(product.low);
    add(product.high);
  }
  /// Sign of the largest part: all other parts together are smaller.
  [[nodiscard]] int sign() const { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }
  /// Adds the product of two sums, or takes it away.
  template <std::size_t N, std::size_t M>
  void add_product(const ExactSum<N>& a, const ExactSum<M>& b, double sign = 1) {
    for (const double part : a)
      for (const double other : b) add_product(sign * part, other);
  }
  [[nodiscard]] const double* begin() const { return parts_.data(); }
  [[nodiscard]] const double* end() const { return parts_.data() + size_; }

 private:
  std::array<double, Capacity> parts_{};
  std::size_t size_ = 0;
};

/// One component of the unrounded sum of some terms.
template <std::size_t most>
ExactSum<most> component(std::span<const Vec2d> terms, Eigen::Index i) {
  ExactSum<most> sum;
  for (const Vec2d& term : terms) sum.add(term[i]);
  return sum;
}

/// (to - from) x (the unrounded sum of all terms). Two parts times as many as there are terms, each product in two
/// parts, twice.
template <std::size_t most>
ExactSum<8 * most> exact_cross(const Vec2d& from, const Vec2d& to, std::span<const Vec2d> arm) {
  const std::array<Vec2d, 2> edge{to, -from};
  ExactSum<8 * most> cross;
  cross.add_product(component<2>(edge, 0), component<most>(arm, 1));
  cross.add_product(component<2>(edge, 1), component<most>(arm, 0), -1);
  return cross;
}

}  // namespace

int orientation_sign(const Vec2d& a, const Vec2d& b, const Vec2d& c) { return turn_sign(a, b, a, c); }

/// The filter: with u = 2^-53 the edges e and f are off by u|e| and u|f|. A product is then off by 3u|e||f|, and their
/// difference by another u of both; terms of order u^2 and the rounding of the bound itself are covered by taking 5u
/// for 4u.
int turn_sign(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  const Vec2d edge = b - a;
  const Vec2d other = d - c;
  const double cross = edge.x() * other.y() - edge.y() * other.x();
  const double bound =
      5 * rounding * (std::abs(edge.x()) * std::abs(other.y()) + std::abs(edge.y()) * std::abs(other.x()));
  if (cross > bound) return 1;
  if (cross < -bound) return -1;
  if (bound == 0) return 0;
  return exact_cross<2>(a, b, std::array{d, Vec2d(-c)}).sign();
}

/// The filter: n additions are off by at most n u times the sum of all magnitudes, the edge by u, and the products and
/// their difference by two more; one is for terms of order u^2 and the rounding of the bound itself.
int orientation_sign_of_sum(const Vec2d& a, const Vec2d& b, std::span<const Vec2d> terms) {
  assert(terms.size() <= most_terms);
  Vec2d arm = -a;
  Vec2d size = a.cwiseAbs();
  for (const Vec2d& term : terms) {
    arm += term;
    size += term.cwiseAbs();
  }
  const Vec2d edge = b - a;
  const double cross = edge.x() * arm.y() - edge.y() * arm.x();
  const double bound = (static_cast<double>(terms.size()) + 4) * rounding *
                       (std::abs(edge.x()) * size.y() + std::abs(edge.y()) * size.x());
  if (cross > bound) return 1;
  if (cross < -bound) return -1;
  if (bound == 0) return 0;
  std::array<Vec2d, most_terms + 1> from_a;
  std::copy(terms.begin(), terms.end(), from_a.begin());
  from_a[terms.size()] = -a;
  return exact_cross<most_terms + 1>(a, b, std::span(from_a).first(terms.size() + 1)).sign();
}

int height_sign_of_sum(const Vec2d& normal, std::span<const Vec2d> terms, double factor, double length) {
  assert(terms.size() <= most_terms);
  ExactSum<4 * most_terms + 2> height;
  for (const Vec2d& term : terms)
    for (const Eigen::Index i : {0, 1}) height.add_product(normal[i], term[i]);
  height.add_product(-factor, length);
  return height.sign();
}

int dot_sign_of_sums(std::span<const Vec2d> terms, std::span<const Vec2d> others) {
  assert(terms.size() <= most_terms && others.size() <= 2 * most_terms);
  ExactSum<2 * 2 * most_terms * 2 * most_terms> dot;
  for (const Eigen::Index i : {0, 1})
    dot.add_product(component<most_terms>(terms, i), component<2 * most_terms>(others, i));
  return dot.sign();
}

double length_rounded_up(const Vec2d& v) {
  double length = std::sqrt(v.x() * v.x() + v.y() * v.y());
  length -= length * (4 * rounding);
  while (height_sign_of_sum(v, {&v, 1}, length, length) > 0)  // 8 ulp at most
    length = std::nextafter(length, std::numeric_limits<double>::infinity());
  return length;
}

bool is_sum_as_long_as(std::span<const Vec2d> terms, double length) {
  assert(terms.size() <= most_terms);
  ExactSum<4 * most_terms * most_terms + 2> over;
  for (const Eigen::Index i : {0, 1}) {
    const auto sum = component<most_terms>(terms, i);
    over.add_product(sum, sum);
  }
  over.add_product(-length, length);
  return over.sign() >= 0;
}

/// The height over the line is the cross product over the length of the edge: the squares are compared.
bool is_sum_as_far_right(const Vec2d& from, const Vec2d& to, std::span<const Vec2d> terms, double distance) {
  assert(terms.size() <= most_terms);
  const auto cross = exact_cross<most_terms>(from, to, terms);  // positive on the left
  if (cross.sign() >= 0) return cross.sign() == 0 && distance == 0;
  ExactSum<4> squared_distance;
  squared_distance.add_product(distance, distance);
  ExactSum<16> squared_length;
  for (const Eigen::Index i : {0, 1}) {
    const auto edge = component<2>(std::array<Vec2d, 2>{to, -from}, i);
    squared_length.add_product(edge, edge);
  }
  ExactSum<2 * 64 * most_terms * most_terms + 2 * 4 * 16> over;
  over.add_product(cross, cross);
  over.add_product(squared_distance, squared_length, -1);
  return over.sign() >= 0;
}

std::array<Vec2d, 4> part_of_way(const Vec2d& from, const Vec2d& to, double factor) {
  std::array<Vec2d, 4> terms;
  for (Eigen::Index i = 0; i < 2; ++i) {
    const TwoDoubles way = two_sum(to[i], -from[i]);
    const TwoDoubles high = two_product(way.high, factor);
    const TwoDoubles low = two_product(way.low, factor);
    terms[0][i] = high.high;
    terms[1][i] = high.low;
    terms[2][i] = low.high;
    terms[3][i] = low.low;
  }
  return terms;
}

}  // namespace paperproof::geometry
