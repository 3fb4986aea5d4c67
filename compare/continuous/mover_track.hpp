/// The way of a mover that does not turn, in extended precision: straight legs at constant speed.
#pragma once

#include "continuous/number.hpp"
#include "scenes/mover.hpp"

#include <optional>

namespace paperproof::compare::continuous {

/// Where a mover is from some moment on.
struct Leg {
  Point offset;               ///< At that moment [m].
  Point velocity;             ///< [m/s]
  std::optional<Real> until;  ///< When it ends [s]; absent: never.
};

/// The leg that a mover is on at a time and right after it. Seconds count from the start of the scene.
[[nodiscard]] inline Leg leg_at(const MoverDef& mover, const Real& time) {
  const auto place = [&](std::size_t i) { return point_of(mover.path[i].at); };
  const auto moment = [&](std::size_t i) { return Real(mover.path[i].time); };
  const std::size_t last = mover.path.size() - 1;
  if (time < moment(0)) return {place(0), {}, moment(0)};
  const Real length = moment(last) - moment(0);
  if (length == 0) return {place(last), {}, std::nullopt};
  const bool repeats = mover.loop != MoverDef::Loop::once;
  const Real run = repeats ? floor((time - moment(0)) / length) : Real(0);
  const bool back = mover.loop == MoverDef::Loop::ping_pong && fmod(run, Real(2)) == 1;
  const Real begun = moment(0) + run * length;
  const auto reached = [&](std::size_t k) -> Real {
    return begun + abs(moment(back ? last - k : k) - moment(back ? last : 0));
  };
  for (std::size_t k = 0; k < last; ++k) {
    if (time >= reached(k + 1)) continue;
    const Point from = place(back ? last - k : k);
    const Point to = place(back ? last - k - 1 : k + 1);
    const Point velocity = (to - from) * (1 / (reached(k + 1) - reached(k)));
    return {from + velocity * (time - reached(k)), velocity, reached(k + 1)};
  }
  return {place(last), {}, std::nullopt};
}

}  // namespace paperproof::compare::continuous
