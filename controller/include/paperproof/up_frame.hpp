/// The frame of a character: across it and up.
#pragma once

#include <paperproof/types.hpp>

#include <cmath>
#include <limits>

namespace paperproof {

/// Whether up is (0, 1).
template <class Scalar>
[[nodiscard]] bool is_upright(const Vec2<Scalar>& up) noexcept {
  return up.x() == 0 && up.y() == 1;
}

/// What rounding makes of a number, as a share of it.
template <class Scalar>
inline constexpr Scalar rounding_of_up = std::numeric_limits<Scalar>::epsilon() * 8;

/// Whether a vector is of length 1 but for rounding; false for NaN.
template <class Scalar>
[[nodiscard]] bool is_unit(const Vec2<Scalar>& v) noexcept {
  return std::abs(v.x() * v.x() + v.y() * v.y() - 1) <= rounding_of_up<Scalar>;
}

/// Up of a character, and vectors as the character sees them: x across, y up. Across is (up.y, -up.x), the right-hand
/// side of a character that stands. Upright is no arithmetic at all, and quarter turns round nothing.
template <class Scalar>
class UpFrame {
 public:
  UpFrame() = default;
  /// @param up unit vector.
  UpFrame(const Vec2<Scalar>& up) noexcept : up_(up), is_turned_(!is_upright(up)) {}

  [[nodiscard]] const Vec2<Scalar>& up() const noexcept { return up_; }
  /// Up is not (0, 1).
  [[nodiscard]] bool is_turned() const noexcept { return is_turned_; }
  /// Neither upright nor turned by quarters: what is seen is rounded.
  [[nodiscard]] bool is_slanted() const noexcept { return up_.x() != 0 && up_.y() != 0; }

  [[nodiscard]] Scalar up_of(const Vec2<Scalar>& v) const noexcept {
    if (is_turned_) [[unlikely]]
      return sum(v.x() * up_.x(), v.y() * up_.y());
    return v.y();
  }
  [[nodiscard]] Scalar across_of(const Vec2<Scalar>& v) const noexcept {
    if (is_turned_) [[unlikely]]
      return sum(v.x() * up_.y(), -(v.y() * up_.x()));
    return v.x();
  }
  /// A vector of the world as the character sees it.
  [[nodiscard]] Vec2<Scalar> seen(const Vec2<Scalar>& v) const noexcept { return {across_of(v), up_of(v)}; }
  /// The vector of the world that the character sees so.
  [[nodiscard]] Vec2<Scalar> in_world(const Vec2<Scalar>& v) const noexcept {
    if (is_turned_) [[unlikely]]
      return {v.x() * up_.y() + v.y() * up_.x(), v.y() * up_.y() - v.x() * up_.x()};
    return v;
  }
  /// The side of the character, as it stands, that a contact normal of the world belongs to.
  [[nodiscard]] Side side_of(const Vec2<Scalar>& normal) const noexcept {
    return side_of_normal(across_of(normal), up_of(normal));
  }

 private:
  /// What is left of two terms by rounding alone is zero: gravity along -up has no part across, and a wall along up is
  /// no ceiling.
  [[nodiscard]] static Scalar sum(Scalar a, Scalar b) noexcept {
    const Scalar result = a + b;
    return std::abs(result) <= rounding_of_up<Scalar> * (std::abs(a) + std::abs(b)) ? Scalar(0) : result;
  }

  Vec2<Scalar> up_{0, 1};
  bool is_turned_ = false;
};

/// The frame of a character whose up is (0, 1), known when the program is compiled.
template <class Scalar>
struct Upright {
  Upright() = default;
  Upright(const UpFrame<Scalar>&) noexcept {}

  [[nodiscard]] static constexpr bool is_slanted() noexcept { return false; }
  [[nodiscard]] static Scalar up_of(const Vec2<Scalar>& v) noexcept { return v.y(); }
  [[nodiscard]] static Scalar across_of(const Vec2<Scalar>& v) noexcept { return v.x(); }
  [[nodiscard]] static Vec2<Scalar> seen(const Vec2<Scalar>& v) noexcept { return v; }
  [[nodiscard]] static Vec2<Scalar> in_world(const Vec2<Scalar>& v) noexcept { return v; }
  [[nodiscard]] static Side side_of(const Vec2<Scalar>& normal) noexcept {
    return side_of_normal(normal.x(), normal.y());
  }
};

}  // namespace paperproof
