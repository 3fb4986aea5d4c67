#include "geometry/exact.hpp"

#include <cmath>

namespace paperproof::geometry {
namespace {

/// Largest relative error of one rounded operation.
constexpr double rounding = 0x1p-53;

/// The number high + low, where high is that sum rounded.
struct TwoDoubles {
  double high;
  double low;
};

/// Knuth's sum: exact for any order of magnitudes.
TwoDoubles two_sum(double a, double b) noexcept {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

/// Veltkamp's split into two halves of at most 26 bits, so that products of halves are exact.
TwoDoubles split(double a) noexcept {
  constexpr double splitter = 0x1p27 + 1;
  const double scaled = splitter * a;
  const double high = scaled - (scaled - a);
  return {high, a - high};
}

/// Dekker's product. A fused multiply-add would be shorter, and other bits where it is emulated badly.
TwoDoubles two_product(double a, double b) noexcept {
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
  void add(double term) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const TwoDoubles sum = two_sum(term, parts_[i]);
      if (sum.low != 0) parts_[kept++] = sum.low;
      term = sum.high;
    }
    if (term != 0) parts_[kept++] = term;
    size_ = kept;
  }
  void add_product(double a, double b) noexcept {
    const TwoDoubles product = two_product(a, b);
    add(product.low);
    add(product.high);
  }
  /// That of the largest part: all others together are smaller.
  [[nodiscard]] int sign() const noexcept { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }
  [[nodiscard]] const double* begin() const noexcept { return parts_.data(); }
  [[nodiscard]] const double* end() const noexcept { return parts_.data() + size_; }

 private:
  std::array<double, Capacity> parts_;
  std::size_t size_ = 0;
};

ExactSum<4> sum_of(double a, double b, double c, double d) noexcept {
  ExactSum<4> sum;
  sum.add(a);
  sum.add(b);
  sum.add(c);
  sum.add(d);
  return sum;
}

/// Sign of (to - from) x (a - b + c + d), exactly. Two parts times four parts, each product in two parts, twice: 32.
int exact_cross_sign(const Vec2d& from, const Vec2d& to, const Vec2d& a, const Vec2d& b, const Vec2d& c,
                     const Vec2d& d) noexcept {
  const ExactSum<4> arm_x = sum_of(a.x(), -b.x(), c.x(), d.x());
  const ExactSum<4> arm_y = sum_of(a.y(), -b.y(), c.y(), d.y());
  ExactSum<32> cross;
  for (const double edge : sum_of(to.x(), -from.x(), 0, 0)) {
    for (const double arm : arm_y) cross.add_product(edge, arm);
  }
  for (const double edge : sum_of(to.y(), -from.y(), 0, 0)) {
    for (const double arm : arm_x) cross.add_product(-edge, arm);
  }
  return cross.sign();
}

/// Sign of (to - from) x (a - b + c + d), where d is a small rest or zero.
///
/// The filter leaves d out and counts it among its errors. With u = 2^-53 and t = fl(a - b), the arm f = fl(t + c) is
/// off by at most u(|t| + |f|) + |d| and the edge e by u|e|. A product is then off by |e|(3u(|t| + |f|) + |d|), and
/// their difference by another u of both; terms of order u^2 and the rounding of the bound itself are covered by taking
/// 5u for 4u, and twice |d|.
int cross_sign(const Vec2d& from, const Vec2d& to, const Vec2d& a, const Vec2d& b, const Vec2d& c,
               const Vec2d& d = Vec2d::Zero()) noexcept {
  const double edge_x = to.x() - from.x();
  const double edge_y = to.y() - from.y();
  const double between_x = a.x() - b.x();
  const double between_y = a.y() - b.y();
  const double arm_x = between_x + c.x();
  const double arm_y = between_y + c.y();
  const double cross = edge_x * arm_y - edge_y * arm_x;
  const double bound =
      std::abs(edge_x) * (5 * rounding * (std::abs(between_y) + std::abs(arm_y)) + 2 * std::abs(d.y())) +
      std::abs(edge_y) * (5 * rounding * (std::abs(between_x) + std::abs(arm_x)) + 2 * std::abs(d.x()));
  if (cross > bound) return 1;
  if (cross < -bound) return -1;
  if (bound == 0) return 0;
  return exact_cross_sign(from, to, a, b, c, d);
}

}  // namespace

int orientation_sign(const Vec2d& a, const Vec2d& b, const Vec2d& c) noexcept {
  return cross_sign(a, b, c, a, Vec2d::Zero());
}

int orientation_sign_of_offset(const Vec2d& a, const Vec2d& b, const Vec2d& position, const Vec2d& offset,
                               const Vec2d& rest) noexcept {
  return cross_sign(a, b, position, a, offset, rest);
}

int orientation_sign_of_edge_offset(const Vec2d& position, const Vec2d& from, const Vec2d& to, const Vec2d& v,
                                    const Vec2d& rest) noexcept {
  return cross_sign(from, to, v, position, -from, -rest);
}

int turn_sign(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) noexcept {
  return cross_sign(a, b, d, c, Vec2d::Zero());
}

int turn_sign_of_offset(const Vec2d& direction, const Vec2d& through, const Vec2d& position, const Vec2d& offset,
                        const Vec2d& rest) noexcept {
  return cross_sign(Vec2d::Zero(), direction, position, through, offset, rest);
}

}  // namespace paperproof::geometry
