/// The input of one step after the other: how long it is, what the players do, without looking at all events each
/// time, and how the movers go.
#pragma once

#include "runs/contender.hpp"
#include "runs/mover_motions.hpp"
#include "scenes/scene.hpp"
#include "scenes/step_times.hpp"

namespace paperproof::compare {

/// `at` must be called with one step after the other, from 0 on. The scene and the script must outlive the cursor.
class InputCursor {
 public:
  /// @param script instead of the scene's own; one list for each character.
  /// @throws NotApplicable where Box2D cannot have the scene's bodies.
  InputCursor(const Scene& scene, const Script& script)
      : script_(script),
        times_(scene),
        next_(script.size()),
        now_(script.size()),
        movers_(scene),
        gravity_(scene.gravity) {}

  /// The players do what `input_at` says. What is returned holds until the next call.
  [[nodiscard]] StepInput at(int step) {
    movers_.advance(step, times_);
    for (std::size_t k = 0; k < script_.size(); ++k) advance(k, step);
    return {times_.length(step), now_, movers_.motions(), movers_.turns(), gravity_};
  }

 private:
  void advance(std::size_t character, int step) {
    const std::vector<InputEvent>& events = script_[character];
    for (std::size_t& next = next_[character]; next < events.size() && events[next].step <= step; ++next)
      apply(events[next], now_[character]);
  }

  const Script& script_;
  StepTimes times_;
  std::vector<std::size_t> next_;
  std::vector<Input> now_;
  MoverMotions movers_;
  Vec2d gravity_;
};

}  // namespace paperproof::compare
