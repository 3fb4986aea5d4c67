/// The input of one step after the other: how long it is, what the players do, without looking at all events each
/// time, and how the movers go.
#pragma once

#include "runs/contender.hpp"
#include "scenes/scene.hpp"
#include "scenes/step_times.hpp"

#include <paperproof/box2d/body_world.hpp>

#include <optional>

namespace paperproof::compare {

/// `at` must be called with one step after the other, from 0 on. The scene and the script must outlive the cursor.
///
/// Movers go along their paths; bodies as a Box2D world moves them in which there is no character. So they go the same
/// way for every contender, Box2D's twin included, and what is compared is the characters alone.
class InputCursor {
 public:
  /// @param script instead of the scene's own; one list for each character.
  /// @throws NotApplicable where Box2D cannot have the scene's bodies.
  InputCursor(const Scene& scene, const Script& script);

  /// The players do what `input_at` says. What is returned holds until the next call.
  [[nodiscard]] StepInput at(int step);

 private:
  const Scene& scene_;
  const Script& script_;
  StepTimes times_;
  std::vector<std::size_t> next_;
  std::vector<Input> now_;
  std::optional<box2d::BodyWorld> bodies_;
  std::vector<MoverMotion> motions_;
};

}  // namespace paperproof::compare
