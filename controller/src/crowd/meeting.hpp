/// When two characters that go along polylines meet.
#pragma once

#include "crowd/pair_space.hpp"

#include <paperproof/technique.hpp>

#include <span>

namespace paperproof::crowd {

/// A way that is made between two moments of a step.
template <class Scalar>
struct Way {
  std::span<const PathPoint<Scalar>> path;  ///< Its fractions run from 0 to 1 between the two.
  Scalar begin = 0;                         ///< Fraction of the step.
  Scalar end = 1;

  /// When a corner is reached, as a fraction of the step. Of a way that takes the whole step these are its own bits.
  [[nodiscard]] Scalar time(std::size_t corner) const noexcept { return time_of(path[corner].fraction); }
  [[nodiscard]] Scalar time_of(Scalar fraction) const noexcept {
    return fraction == 1 ? end : begin + fraction * (end - begin);
  }
};

template <class Scalar>
struct Meeting {
  bool meets = false;
  Scalar time = 0;                                ///< When to stop, as a fraction of the step.
  Scalar impact = 0;                              ///< Time of impact, likewise, at most 1.
  Vec2<Scalar> normal{Vec2<Scalar>::Zero()};      ///< Unit, from the second towards the first.
  Vec2<Scalar> first_rate{Vec2<Scalar>::Zero()};  ///< How the first was going, in metres per step.
  Vec2<Scalar> second_rate{Vec2<Scalar>::Zero()};
  /// They met in a part of a way that takes no time (out of a solid, down to the ground); its rate is its length, and
  /// that of the other is zero.
  bool at_once = false;
};

/// The first time from `from` on that the two come nearer than `least`: see `PairSpace::sweep`. Between corners the
/// relative motion is straight. Parts that take no time come one after the other, those of the first way first.
template <class Scalar>
[[nodiscard]] Meeting<Scalar> first_meeting(const PairSpace<Scalar>& space, const Way<Scalar>& first,
                                            const Way<Scalar>& second, Scalar from, Scalar least) noexcept;

}  // namespace paperproof::crowd
