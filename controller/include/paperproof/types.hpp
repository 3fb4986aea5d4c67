/// Vectors, boxes, identifiers and other small values that all parts share.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <type_traits>

namespace paperproof {

using Vec2d = Eigen::Matrix<double, 2, 1, Eigen::DontAlign>;
using Vec2f = Eigen::Matrix<float, 2, 1, Eigen::DontAlign>;

/// Position of a collider in `SceneryDef::colliders`, or its id in a `Level`. A collider is what a user placed: one
/// polygon, chain or circle.
using ColliderIndex = std::uint32_t;

/// Position of a convex piece in `Scenery::pieces()`. A collider has one or more pieces.
using PieceIndex = std::uint32_t;

/// Index of a mover, counted from 0. Several colliders may share one mover.
using MoverIndex = std::uint32_t;
inline constexpr MoverIndex no_mover = ~MoverIndex{0};
/// Of the body of a character: see `body_of`.
inline constexpr MoverIndex its_character = no_mover - 1;
inline constexpr ColliderIndex no_collider = ~ColliderIndex{0};

/// The motion of a mover during one step, from one pose to another: a point v of its colliders is at
/// offset + R(angle) v. Offset and angle change evenly.
struct MoverMotion {
  Vec2d from{Vec2d::Zero()};  ///< Offset when the step begins: `to` of the step before, bit for bit [m].
  Vec2d to{Vec2d::Zero()};    ///< When it ends [m].
  double from_angle = 0;      ///< Counter-clockwise, when the step begins: `to_angle` of the step before [rad].
  double to_angle = 0;        ///< When it ends [rad].

  /// The offset at a fraction of the step. It is not rounded at the end, because the next step begins there.
  [[nodiscard]] Vec2d at(double fraction) const noexcept {
    if (!(fraction < 1)) return to;
    return from + (to - from) * fraction;
  }
  [[nodiscard]] bool has_angle() const noexcept { return from_angle != 0 || to_angle != 0; }
  [[nodiscard]] double turn() const noexcept { return to_angle - from_angle; }
};

/// The side of the *character* that a contact is on: standing on the ground is a `bottom` contact.
enum class Side : std::uint8_t { top, bottom, left, right };

/// The side of an upright character that a contact normal (unit, from the obstacle towards the character) belongs to;
/// of another character `UpFrame::side_of` tells it. The larger component decides; at exactly 45 degrees the vertical
/// one does.
[[nodiscard]] constexpr Side side_of_normal(double normal_x, double normal_y) noexcept {
  const double width = normal_x < 0 ? -normal_x : normal_x;
  if (normal_y >= width) return Side::bottom;
  if (-normal_y >= width) return Side::top;
  return normal_x > 0 ? Side::left : Side::right;
}

/// Closed axis-aligned box [m].
struct Box2 {
  Vec2d lower{Vec2d::Zero()};
  Vec2d upper{Vec2d::Zero()};

  [[nodiscard]] bool overlaps(const Box2& other) const noexcept {
    return lower.x() <= other.upper.x() && other.lower.x() <= upper.x() && lower.y() <= other.upper.y() &&
           other.lower.y() <= upper.y();
  }
  [[nodiscard]] bool contains(const Box2& other) const noexcept {
    return lower.x() <= other.lower.x() && other.upper.x() <= upper.x() && lower.y() <= other.lower.y() &&
           other.upper.y() <= upper.y();
  }
  [[nodiscard]] Box2 merged(const Box2& other) const noexcept {
    return {lower.cwiseMin(other.lower), upper.cwiseMax(other.upper)};
  }
  /// Around this box and a point.
  [[nodiscard]] Box2 with(const Vec2d& point) const noexcept { return merged({point, point}); }
  [[nodiscard]] Vec2d middle() const noexcept { return (lower + upper) / 2; }
  [[nodiscard]] Vec2d size() const noexcept { return upper - lower; }
  [[nodiscard]] Box2 inflated(double by) const noexcept {
    return {lower - Vec2d::Constant(by), upper + Vec2d::Constant(by)};
  }
  /// Where the sums of a point of each are: what a shape covers from positions in a box.
  friend Box2 operator+(const Box2& a, const Box2& b) noexcept { return {a.lower + b.lower, a.upper + b.upper}; }
  friend Box2 operator+(const Box2& box, const Vec2d& by) noexcept { return {box.lower + by, box.upper + by}; }
  [[nodiscard]] static Box2 between(const Vec2d& a, const Vec2d& b) noexcept { return {a.cwiseMin(b), a.cwiseMax(b)}; }
  /// Around no point: it meets no box.
  [[nodiscard]] static Box2 nowhere() noexcept {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {Vec2d::Constant(infinity), Vec2d::Constant(-infinity)};
  }
  [[nodiscard]] static Box2 around(std::span<const Vec2d> points) noexcept {
    Box2 box = nowhere();
    for (const Vec2d& point : points) box = box.with(point);
    return box;
  }
};

/// A vector with inline storage, so that a step stores its report without allocating. Elements past `size()` are not
/// initialised. A full vector refuses `push_back` and remembers the refusal: see `overflowed()`.
template <class T, std::size_t Capacity>
class FixedVector {
 public:
  // The union keeps elements uninitialised until they are added: a step makes many short vectors.
  FixedVector() noexcept {}
  FixedVector(const FixedVector& other) noexcept { copy(other); }
  FixedVector& operator=(const FixedVector& other) noexcept {
    if (this != &other) copy(other);
    return *this;
  }

  bool push_back(const T& value) noexcept {
    if (size_ == Capacity) {
      overflowed_ = true;
      return false;
    }
    std::construct_at(items_.data() + size_++, value);
    return true;
  }
  void clear() noexcept {
    size_ = 0;
    overflowed_ = false;
  }
  friend bool operator==(const FixedVector& a, const FixedVector& b) noexcept {
    return a.overflowed_ == b.overflowed_ && std::equal(a.begin(), a.end(), b.begin(), b.end());
  }
  void pop_back() noexcept {
    assert(size_ > 0);
    --size_;
  }
  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] bool empty() const noexcept { return size_ == 0; }
  [[nodiscard]] bool overflowed() const noexcept { return overflowed_; }
  [[nodiscard]] static constexpr std::size_t capacity() noexcept { return Capacity; }
  [[nodiscard]] T& operator[](std::size_t i) noexcept { return items_[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const noexcept { return items_[i]; }
  [[nodiscard]] T& back() noexcept { return items_[size_ - 1]; }
  [[nodiscard]] const T& back() const noexcept { return items_[size_ - 1]; }
  [[nodiscard]] T* begin() noexcept { return items_.data(); }
  [[nodiscard]] T* end() noexcept { return items_.data() + size_; }
  [[nodiscard]] const T* begin() const noexcept { return items_.data(); }
  [[nodiscard]] const T* end() const noexcept { return items_.data() + size_; }

 private:
  static_assert(std::is_trivially_destructible_v<T>);

  void copy(const FixedVector& other) noexcept {
    std::uninitialized_copy(other.begin(), other.end(), items_.data());
    size_ = other.size_;
    overflowed_ = other.overflowed_;
  }

  union {
    std::array<T, Capacity> items_;
  };
  std::size_t size_ = 0;
  bool overflowed_ = false;
};

}  // namespace paperproof
