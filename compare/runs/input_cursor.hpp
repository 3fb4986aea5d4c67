/// The input of one step after the other, without looking at all events each time.
#pragma once

#include "scenes/scene.hpp"

namespace paperproof::compare {

/// `at` must be called with ascending steps. The events must outlive the cursor.
class InputCursor {
 public:
  explicit InputCursor(const std::vector<InputEvent>& events) : events_(events) {}

  /// The same as `input_at`.
  [[nodiscard]] const Input& at(int step) {
    for (; next_ < events_.size() && events_[next_].step <= step; ++next_) {
      if (events_[next_].move) now_.move = events_[next_].move;
      if (events_[next_].jump) now_.jump = *events_[next_].jump;
    }
    return now_;
  }

 private:
  const std::vector<InputEvent>& events_;
  std::size_t next_ = 0;
  Input now_;
};

}  // namespace paperproof::compare
