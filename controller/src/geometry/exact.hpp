/// Orientation of three points, and distances, with the exact sign.
#pragma once

#include <paperproof/types.hpp>

#include <span>

namespace paperproof::geometry {

/// Smallest magnitude, other than zero, that the functions below are exact for. Its square is far above where doubles
/// lose bits to underflow.
inline constexpr double smallest_exact = 0x1p-300;

/// Zero instead of a magnitude below `smallest_exact`, else the value itself: brings finite lengths into the range.
[[nodiscard]] constexpr double without_traces(double value) {
  return value < smallest_exact && value > -smallest_exact ? 0.0 : value;
}

/// The number high + low, where high is that sum rounded.
struct TwoDoubles {
  double high;
  double low;
};

/// Knuth's sum: exact for any order of magnitudes.
[[nodiscard]] inline TwoDoubles two_sum(double a, double b) {
  const double sum = a + b;
  const double b_virtual = sum - a;
  const double a_virtual = sum - b_virtual;
  return {sum, (a - a_virtual) + (b - b_virtual)};
}

/// On which side of the directed line a->b does c lie?
///
/// All functions of this header read every coordinate as the exact number that it stores. They are exact while
/// coordinates are zero or have a magnitude in [`smallest_exact`, 2^300]. They never allocate, hold no state
/// (any thread), and give the same answer on every target with IEEE 754 doubles. A floating-point filter decides most
/// cases; expansions of doubles decide the others: J. R. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates", 1997.
/// @return +1: to the left (a, b, c turn counter-clockwise), -1: to the right, 0: on the line, or a equals b.
[[nodiscard]] int orientation_sign(const Vec2d& a, const Vec2d& b, const Vec2d& c);

/// Which way one turns from the direction a->b to the direction c->d: +1 to the left, -1 to the right, 0 not at all or
/// half round.
[[nodiscard]] int turn_sign(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d);

inline constexpr std::size_t most_terms = 8;

/// `orientation_sign(a, b, c)` for the unrounded sum c of at most `most_terms` terms.
[[nodiscard]] int orientation_sign_of_sum(const Vec2d& a, const Vec2d& b, std::span<const Vec2d> terms);

/// Sign of normal · (the unrounded sum of the terms) - factor * length.
[[nodiscard]] int height_sign_of_sum(const Vec2d& normal, std::span<const Vec2d> terms, double factor, double length);

/// The least double that is not below the length of a vector.
[[nodiscard]] double length_rounded_up(const Vec2d& v);

/// Sign of (the unrounded sum of some terms) · (that of others). @param others at most twice `most_terms`.
[[nodiscard]] int dot_sign_of_sums(std::span<const Vec2d> terms, std::span<const Vec2d> others);

/// Whether the unrounded sum of the terms is a vector of at least this length.
[[nodiscard]] bool is_sum_as_long_as(std::span<const Vec2d> terms, double length);

/// Whether `from` plus the unrounded sum of the terms is at least this far on the right of the line from -> to. A
/// fourth power is compared: it is exact while magnitudes are zero or at least 2^-230.
[[nodiscard]] bool is_sum_as_far_right(const Vec2d& from, const Vec2d& to, std::span<const Vec2d> terms,
                                       double distance);

/// Terms whose unrounded sum is (to - from) * factor.
[[nodiscard]] std::array<Vec2d, 4> part_of_way(const Vec2d& from, const Vec2d& to, double factor);

}  // namespace paperproof::geometry
