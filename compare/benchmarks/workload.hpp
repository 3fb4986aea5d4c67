/// What is timed: a level, a character in it, and what it does.
#pragma once

#include "scenes/scene.hpp"

#include <memory>
#include <string>
#include <vector>

namespace paperproof::benchmarks {

/// A scene with the input of every step, formed before anything is timed. Immutable; shared by all subjects.
struct Workload {
  Workload(std::string name_, compare::Scene scene_, const std::vector<compare::InputEvent>& events);

  std::string name;
  compare::Scene scene;
  std::vector<Input> inputs;  ///< One per step.
  Scenery scenery;
};

/// A level of SuperTux, where its data is installed; and 10,000 tiles of 1 m with the character at rest, walking,
/// walking and jumping, and doing so at 100 m/s.
[[nodiscard]] std::vector<std::shared_ptr<const Workload>> all_workloads();

}  // namespace paperproof::benchmarks
