#include "runs/cost.hpp"

#include "runs/input_cursor.hpp"

#include <algorithm>
#include <array>
#include <chrono>

namespace paperproof::compare {
namespace {

constexpr std::size_t repeats = 9;
/// Enough for a clock that ticks every microsecond, few enough that a comparison of hundreds of levels stays short.
constexpr int most_steps = 1000;

}  // namespace

Cost measure_cost(Contestant& contestant, const Scene& scene, const Script& script, int steps) {
  const int timed = std::min(steps, most_steps);
  const std::size_t movers = scene.movers.size();
  std::vector<MoverMotion<double>> motions;
  std::vector<TurnMotion> turns;
  std::vector<Input> players;
  std::vector<double> lengths;
  InputCursor cursor(scene, script);
  for (int step = 0; step < timed; ++step) {
    const StepInput now = cursor.at(step);
    lengths.push_back(now.dt);
    players.insert(players.end(), now.players.begin(), now.players.end());
    turns.insert(turns.end(), now.turns.begin(), now.turns.end());
    motions.insert(motions.end(), now.movers.begin(), now.movers.end());
  }
  std::vector<StepInput> inputs;
  const std::size_t characters = script.size();
  for (std::size_t step = 0; step < lengths.size(); ++step)
    inputs.push_back({lengths[step], std::span(players).subspan(step * characters, characters),
                      std::span(motions).subspan(step * movers, movers),
                      std::span(turns).subspan(step * movers, movers)});

  std::array<double, repeats> costs{};
  for (std::size_t run = 0; run <= repeats; ++run) {
    place_at_start(contestant, scene);
    const auto begin = std::chrono::steady_clock::now();
    for (const StepInput& now : inputs) contestant.step_unrecorded(now);
    const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
    if (run > 0) costs[run - 1] = took.count() / timed;
  }
  std::sort(costs.begin(), costs.end());
  return {costs.front(), costs[repeats / 2], costs.back()};
}

}  // namespace paperproof::compare
