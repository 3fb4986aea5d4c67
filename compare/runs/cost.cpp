#include "runs/cost.hpp"

#include "runs/input_cursor.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace paperproof::compare {
namespace {

constexpr int repeats = 9;
/// Enough for a clock that ticks every microsecond, few enough that a comparison of hundreds of levels stays short.
constexpr int most_steps = 1000;

}  // namespace

Cost measure_cost(Contestant& contestant, const Scene& scene, const std::vector<InputEvent>& input, int steps) {
  const int timed = std::min(steps, most_steps);
  std::vector<Input> inputs;
  inputs.reserve(static_cast<std::size_t>(timed));
  InputCursor cursor(input);
  for (int step = 0; step < timed; ++step) inputs.push_back(cursor.at(step));

  Cost cost{std::numeric_limits<double>::infinity(), 0};
  for (int repeat = 0; repeat <= repeats; ++repeat) {
    contestant.place({.position = scene.start.position, .velocity = scene.start.velocity});
    const auto begin = std::chrono::steady_clock::now();
    for (const Input& now : inputs) contestant.step_unrecorded(now);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    if (repeat == 0) continue;
    cost.ns_per_step_min = std::min(cost.ns_per_step_min, took.count() / timed);
    cost.ns_per_step_max = std::max(cost.ns_per_step_max, took.count() / timed);
  }
  return cost;
}

}  // namespace paperproof::compare
