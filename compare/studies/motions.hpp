/// The motions of `work-precision`: scenes whose continuous course is known.
#pragma once

#include "scenes/scene.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// A scene that can be run with steps of any length that divides `longest_step`.
struct Motion {
  std::string name;
  std::string description;  ///< With the formula where there is a short one.
  double duration;          ///< [s]
  /// Where a body without friction goes another way than octagon_sweep's law has it: how. Empty: both go the same way.
  std::string without_friction;
};

inline constexpr double longest_step = 1.0 / 15;  ///< [s]

[[nodiscard]] const std::vector<Motion>& motions();

/// The motion's scene with steps of a length that divides `longest_step` [s].
[[nodiscard]] Scene scene_of(const Motion& motion, double dt);

}  // namespace paperproof::compare
