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
  const std::size_t movers = scene.movers.size();
  std::vector<MoverMotion<double>> motions;
  std::vector<Input> players;
  InputCursor cursor(scene, input);
  for (int step = 0; step < timed; ++step) {
    const StepInput now = cursor.at(step);
    players.push_back(now.player);
    motions.insert(motions.end(), now.movers.begin(), now.movers.end());
  }
  std::vector<StepInput> inputs;
  for (std::size_t step = 0; step < players.size(); ++step)
    inputs.push_back({players[step], std::span(motions).subspan(step * movers, movers)});

  Cost cost{std::numeric_limits<double>::infinity(), 0};
  for (int repeat = 0; repeat <= repeats; ++repeat) {
    contestant.place({.position = scene.start.position, .velocity = scene.start.velocity});
    const auto begin = std::chrono::steady_clock::now();
    for (const StepInput& now : inputs) contestant.step_unrecorded(now);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    if (repeat == 0) continue;
    cost.ns_per_step_min = std::min(cost.ns_per_step_min, took.count() / timed);
    cost.ns_per_step_max = std::max(cost.ns_per_step_max, took.count() / timed);
  }
  return cost;
}

}  // namespace paperproof::compare
