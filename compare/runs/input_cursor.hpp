/// The input of one step after the other: what the player does, without looking at all events each time, and how the
/// movers go.
#pragma once

#include "runs/contestant.hpp"
#include "scenes/scene.hpp"

namespace paperproof::compare {

/// `at` must be called with ascending steps. The scene and the events must outlive the cursor.
class InputCursor {
 public:
  /// @param events instead of the scene's own.
  InputCursor(const Scene& scene, const std::vector<InputEvent>& events)
      : scene_(scene), events_(events), motions_(scene.movers.size()) {}

  /// The player does what `input_at` says. What is returned holds until the next call.
  [[nodiscard]] StepInput at(int step) {
    for (std::size_t i = 0; i < motions_.size(); ++i) motions_[i] = motion_in_step(scene_.movers[i], step, scene_.dt);
    for (; next_ < events_.size() && events_[next_].step <= step; ++next_) {
      if (events_[next_].move) now_.move = events_[next_].move;
      if (events_[next_].jump) now_.jump = *events_[next_].jump;
    }
    return {now_, motions_};
  }

 private:
  const Scene& scene_;
  const std::vector<InputEvent>& events_;
  std::size_t next_ = 0;
  Input now_;
  std::vector<MoverMotion<double>> motions_;
};

}  // namespace paperproof::compare
