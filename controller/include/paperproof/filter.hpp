/// Filters: which characters collide with which colliders.
#pragma once

#include <cstdint>

namespace paperproof {

/// The rule of Box2D's `b2Filter`, with more bits.
struct Filter {
  std::uint32_t category = 1;              ///< Its own kinds, one bit each.
  std::uint32_t mask = ~std::uint32_t{0};  ///< The kinds that it collides with.
  std::int32_t group = 0;                  ///< See `collide`.

  friend bool operator==(const Filter&, const Filter&) = default;
};

/// Two of one group collide if the group is positive, and do not if it is negative. Otherwise, or in group zero, they
/// collide if the mask of each has a bit of the category of the other.
[[nodiscard]] constexpr bool collide(const Filter& a, const Filter& b) noexcept {
  if (a.group == b.group && a.group != 0) return a.group > 0;
  return (a.mask & b.category) != 0 && (b.mask & a.category) != 0;
}

}  // namespace paperproof
