#include "campaign/random_run.hpp"

namespace paperproof::compare {

void InputNotes::note(int step, const Input& input) {
  if (input.move == last_.move && input.jump == last_.jump && input.drop == last_.drop) return;
  events_->push_back({.step = step, .move = input.move, .jump = input.jump, .drop = input.drop});
  last_ = input;
}

}  // namespace paperproof::compare
