#include "campaign/random_run.hpp"

#include <algorithm>

namespace paperproof::compare {

std::span<const Launch> RandomRun::launches_before(int step) const {
  return std::ranges::equal_range(launches, step, {}, &Launch::step);
}

void InputNotes::note(int step, const Input& input) {
  if (input.move == last_.move && input.jump == last_.jump && input.drop == last_.drop) return;
  events_->push_back({.step = step, .move = input.move, .jump = input.jump, .drop = input.drop});
  last_ = input;
}

}  // namespace paperproof::compare
