/// The motions of `work-precision`: scenes whose continuous course is known.
#pragma once

#include "scenes/scene.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// A scene that can be run with steps of any length that divides `longest_step`.
struct Motion {
  std::string name;
  double duration;  ///< [s]
};

inline constexpr double longest_step = 1.0 / 15;  ///< [s]

[[nodiscard]] const std::vector<Motion>& motions();

/// The motion's scene with steps of a length that divides `longest_step` [s].
[[nodiscard]] Scene scene_of(const Motion& motion, double dt);

}  // namespace paperproof::compare
