/// A character in a level that changes between steps, among movers that turn.
#pragma once

#include "campaign/shapes.hpp"
#include "support/random_runs.hpp"

#include <paperproof/controller.hpp>

#include <vector>

namespace paperproof::test {

inline constexpr double frame = 1.0 / 60;

inline Input random_input(Random& random) {
  return {.move = static_cast<double>(random.integer(-1, 1)), .jump = random.chance(0.4)};
}

struct Played {
  explicit Played(const SceneryDef& def, const Vec2d& position = {0, compare::half_height + 0.005}) : level(def) {
    state.position = position;
  }

  StepStatus step(const Input& input = {}) { return controller.step(state, input, context(), scratch, report); }
  [[nodiscard]] StepContext context() const { return {gravity, frame, movers}; }
  void steps(int count) {
    for (int i = 0; i < count; ++i) step();
  }
  /// Every mover goes on from where it is.
  StepStatus step_by(const Vec2d& way, double turn = 0, const Input& input = {}) {
    for (MoverMotion& mover : movers) mover = {mover.to, mover.to + way, mover.to_angle, mover.to_angle + turn};
    return step(input);
  }

  Level level;
  Controller controller{level, {}};
  Scratch scratch = controller.make_scratch();
  CharacterState state;
  StepReport report;
  Vec2d gravity{0, -30};
  std::vector<MoverMotion> movers{level.mover_count()};  ///< How they go in the next step.
};

}  // namespace paperproof::test
