/// The frame of a character: across it and up.
#pragma once

#include <paperproof/types.hpp>

#include <cmath>
#include <limits>

namespace paperproof {

/// Whether up is (0, 1).
[[nodiscard]] inline bool is_upright(const Vec2d& up) noexcept { return up.x() == 0 && up.y() == 1; }

/// What rounding makes of a number, as a share of it.
inline constexpr double rounding_of_up = std::numeric_limits<double>::epsilon() * 8;

/// Whether a vector is of length 1 but for rounding; false for NaN.
[[nodiscard]] inline bool is_unit(const Vec2d& v) noexcept {
  return std::abs(v.x() * v.x() + v.y() * v.y() - 1) <= rounding_of_up;
}

/// Up of a character, and vectors as the character sees them: x across, y up. Across is (up.y, -up.x), the right-hand
/// side of a character that stands. Upright is no arithmetic at all, and quarter turns round nothing.
class UpFrame {
 public:
  UpFrame() = default;
  /// @param up unit vector.
  UpFrame(const Vec2d& up) noexcept : up_(up), is_turned_(!is_upright(up)) {}

  [[nodiscard]] const Vec2d& up() const noexcept { return up_; }
  /// Up is not (0, 1).
  [[nodiscard]] bool is_turned() const noexcept { return is_turned_; }
  /// Neither upright nor turned by quarters: what is seen is rounded.
  [[nodiscard]] bool is_slanted() const noexcept { return up_.x() != 0 && up_.y() != 0; }

  [[nodiscard]] double up_of(const Vec2d& v) const noexcept {
    if (is_turned_) [[unlikely]]
      return sum(v.x() * up_.x(), v.y() * up_.y());
    return v.y();
  }
  [[nodiscard]] double across_of(const Vec2d& v) const noexcept {
    if (is_turned_) [[unlikely]]
      return sum(v.x() * up_.y(), -(v.y() * up_.x()));
    return v.x();
  }
  /// A vector of the world as the character sees it.
  [[nodiscard]] Vec2d seen(const Vec2d& v) const noexcept { return {across_of(v), up_of(v)}; }
  /// The vector of the world that the character sees so.
  [[nodiscard]] Vec2d in_world(const Vec2d& v) const noexcept {
    if (is_turned_) [[unlikely]]
      return {v.x() * up_.y() + v.y() * up_.x(), v.y() * up_.y() - v.x() * up_.x()};
    return v;
  }
  /// The side of the character, as it stands, that a contact normal of the world belongs to.
  [[nodiscard]] Side side_of(const Vec2d& normal) const noexcept {
    return side_of_normal(across_of(normal), up_of(normal));
  }

 private:
  /// What is left of two terms by rounding alone is zero: gravity along -up has no part across, and a wall along up is
  /// no ceiling.
  [[nodiscard]] static double sum(double a, double b) noexcept {
    const double result = a + b;
    return std::abs(result) <= rounding_of_up * (std::abs(a) + std::abs(b)) ? 0.0 : result;
  }

  Vec2d up_{0, 1};
  bool is_turned_ = false;
};

}  // namespace paperproof
