/// Puts the twin where the controller is, as far as Box2D's skin allows.
#pragma once

#include "runs/lane.hpp"

namespace paperproof::compare {

/// Where the twin begins its step.
struct TwinStart {
  Pose pose;
  Vec2d shift{Vec2d::Zero()};  ///< From the controller's position [m].
  bool room = true;            ///< Something is nearer than Box2D's rest gap all the same: the step is not compared.
};

/// Box2D keeps bodies 15 mm apart and pushes out what is nearer, every step. The controller keeps 0.5 micrometres. So
/// the twin is moved out along the contacts that the controller holds, to Box2D's own rest gap.
/// @param input of the step that is about to begin.
[[nodiscard]] TwinStart twin_start(Lane& lane, const StepInput& input);

}  // namespace paperproof::compare
