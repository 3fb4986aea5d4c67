/// When are separations that change evenly all below a level?
#pragma once

#include <algorithm>

namespace paperproof::geometry {

/// When all separations so far are below a level. Times are fractions of a motion, from 0 to 1. A separation that
/// changes evenly is below the level in one open interval, and so are all of them together. Empty where `begin >= end`.
/// `begin` is `before` if they are below it at the start already, and `end` is `after` if they still are at the end.
/// Else both are fractions in [0, 1].
template <class Number>
struct TimeBelow {
  static constexpr Number before = -1;
  static constexpr Number after = 2;
  Number begin = before;
  Number end = after;

  [[nodiscard]] constexpr bool any() const { return begin < end; }

  /// One more separation, by its values at both ends. Whether it is below the level at an end depends on its value
  /// there alone. One that is not a number is not below it.
  constexpr void narrow(Number at_start, Number at_end, Number level) {
    const bool starts_below = at_start < level;
    const bool ends_below = at_end < level;
    if (!starts_below && !ends_below) *this = {after, before};
    if (starts_below == ends_below) return;
    const Number crosses = (at_start - level) / (at_start - at_end);
    if (starts_below)
      end = std::min(end, crosses);
    else
      begin = std::max(begin, crosses);
  }
};

}  // namespace paperproof::geometry
