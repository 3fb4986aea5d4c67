/// How the movers of a scene go, step by step.
#pragma once

#include "scenes/scene.hpp"
#include "scenes/step_times.hpp"

#include <paperproof/box2d/body_world.hpp>

#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare {

/// Along their paths; bodies as a Box2D world moves them in which there is no character. So they go the same way for
/// every contender, Box2D's twin included, and what is compared is the characters alone.
class MoverMotions {
 public:
  /// @param scene must outlive this. @throws NotApplicable where Box2D cannot have its bodies.
  explicit MoverMotions(const Scene& scene);

  /// Computes the next step.
  /// @param step from 0 on, one after the other. @param times of the scene.
  void advance(int step, const StepTimes& times);
  [[nodiscard]] std::span<const MoverMotion> motions() const noexcept { return motions_; }
  [[nodiscard]] std::span<const TurnMotion> turns() const noexcept { return turns_; }

 private:
  const Scene& scene_;
  std::optional<box2d::BodyWorld> bodies_;
  std::vector<MoverMotion> motions_;
  std::vector<TurnMotion> turns_;
  std::vector<box2d::MoverTurn> body_turns_;  ///< The same, for the bodies' world.
};

}  // namespace paperproof::compare
