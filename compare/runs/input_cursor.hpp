/// The input of one step after the other: how long it is, what the players do, without looking at all events each
/// time, and how the movers go.
#pragma once

#include "runs/contestant.hpp"
#include "scenes/scene.hpp"
#include "scenes/step_times.hpp"

namespace paperproof::compare {

/// `at` must be called with ascending steps. The scene and the script must outlive the cursor.
class InputCursor {
 public:
  /// @param script instead of the scene's own; one list for each character.
  InputCursor(const Scene& scene, const Script& script)
      : scene_(scene),
        script_(script),
        times_(scene),
        next_(script.size()),
        now_(script.size()),
        motions_(scene.movers.size()),
        turns_(scene.movers.size()) {}

  /// The players do what `input_at` says. What is returned holds until the next call.
  [[nodiscard]] StepInput at(int step) {
    for (std::size_t i = 0; i < motions_.size(); ++i) {
      motions_[i] = motion_between(scene_.movers[i], times_.begin(step), times_.end(step));
      turns_[i] = turn_between(scene_.movers[i], times_.begin(step), times_.end(step));
    }
    for (std::size_t k = 0; k < script_.size(); ++k) advance(k, step);
    return {times_.length(step), now_, motions_, turns_};
  }

 private:
  void advance(std::size_t character, int step) {
    const std::vector<InputEvent>& events = script_[character];
    for (std::size_t& next = next_[character]; next < events.size() && events[next].step <= step; ++next)
      apply(events[next], now_[character]);
  }

  const Scene& scene_;
  const Script& script_;
  StepTimes times_;
  std::vector<std::size_t> next_;
  std::vector<Input> now_;
  std::vector<MoverMotion<double>> motions_;
  std::vector<TurnMotion> turns_;
};

}  // namespace paperproof::compare
