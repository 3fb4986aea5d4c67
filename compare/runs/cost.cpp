#include "runs/cost.hpp"

#include "runs/input_cursor.hpp"

#include <algorithm>
#include <chrono>
#include <limits>

namespace paperproof::compare {
namespace {

constexpr std::size_t repeats = 9;
/// Enough for a clock that ticks every microsecond, few enough that a comparison of hundreds of levels stays short.
constexpr int most_steps = 1000;
/// A step is timed alone after all steps before it, in every repeat.
constexpr int most_steps_before_one = 120;
/// More than the caches that a core has for itself, of instructions, too [bytes].
constexpr std::size_t other_memory = 4'000'000;

using Clock = std::chrono::steady_clock;

double nanoseconds(Clock::duration time) { return std::chrono::duration<double, std::nano>(time).count(); }

/// The input of every step, formed before anything is timed.
class TimedSteps {
 public:
  TimedSteps(const Scene& scene, const Script& script, int steps) {
    const auto count = static_cast<std::size_t>(std::min(steps, most_steps));
    players_.reserve(count * script.size());
    motions_.reserve(count * scene.movers.size());
    InputCursor cursor(scene, script);
    for (std::size_t step = 0; step < count; ++step) {
      const StepInput now = cursor.at(static_cast<int>(step));
      const auto players = players_.insert(players_.end(), now.players.begin(), now.players.end());
      const auto movers = motions_.insert(motions_.end(), now.movers.begin(), now.movers.end());
      StepInput& kept = inputs_.emplace_back(now);
      kept.players = {players, now.players.size()};
      kept.movers = {movers, now.movers.size()};
    }
  }
  TimedSteps(const TimedSteps&) = delete;
  TimedSteps& operator=(const TimedSteps&) = delete;
  [[nodiscard]] std::span<const StepInput> inputs() const noexcept { return inputs_; }

 private:
  std::vector<MoverMotion> motions_;
  std::vector<Input> players_;
  std::vector<StepInput> inputs_;
};

/// All steps from the start, put back where the judged run was.
/// @param step_at takes one step, by its number.
/// @return nanoseconds per step; what is put somewhere is put there between two clock readings that do not count.
template <class StepAt>
double timed_pass(const TimedRun& run, const Scene& scene, std::size_t steps, const StepAt& step_at) {
  place_at_start(*run.contender, scene);
  Clock::duration took{0};
  auto next = run.respawns.begin();
  for (std::size_t step = 0; step < steps;) {
    for (; next != run.respawns.end() && static_cast<std::size_t>(next->step) <= step; ++next)
      run.contender->place(pose_at(start_of(scene, next->character)), next->character);
    const std::size_t end = next == run.respawns.end() ? steps : std::min(steps, static_cast<std::size_t>(next->step));
    const Clock::time_point begin = Clock::now();
    for (; step < end; ++step) step_at(step);
    took += Clock::now() - begin;
  }
  return nanoseconds(took) / static_cast<double>(steps);
}

void write_other_memory() {
  static std::vector<char> memory(other_memory);
  for (std::size_t at = 0; at < memory.size(); at += 64) static_cast<volatile char&>(memory[at]) = 1;
}

/// Least time between two readings [ns].
double time_of_reading() {
  double least = std::numeric_limits<double>::infinity();
  for (int reading = 0; reading < 100; ++reading) {
    const Clock::time_point begin = Clock::now();
    least = std::min(least, nanoseconds(Clock::now() - begin));
  }
  return least;
}

/// One contender with what its passes took.
class Timing {
 public:
  Timing(const TimedRun& run, const Scene& scene, std::span<const StepInput> inputs)
      : run_(run), scene_(scene), inputs_(inputs) {}

  /// The first pass records the wanted velocities; bare passes replay them.
  void warm_up() {
    has_bare_ = run_.contender->keep_wishes(true);
    (void)pass(false);
    if (!has_bare_) return;
    run_.contender->keep_wishes(false);
    (void)pass(true);
  }
  void repeat() {
    full_.push_back(pass(false));
    if (has_bare_) bare_.push_back(pass(true));
    if (!step_is_timed()) return;
    const StepCost now{one_step(false), one_step(true)};
    if (!step_) step_ = now;
    step_ = StepCost{std::min(step_->warm, now.warm), std::min(step_->cold, now.cold)};
  }
  [[nodiscard]] Costs costs() {
    Costs costs{cost_of(full_), {}, step_};
    if (has_bare_) costs.bare = cost_of(bare_);
    return costs;
  }

 private:
  void step(std::size_t number, bool bare) const {
    if (bare)
      run_.contender->step_bare(inputs_[number], number);
    else
      run_.contender->step_unrecorded(inputs_[number]);
  }
  [[nodiscard]] double pass(bool bare) const {
    return timed_pass(run_, scene_, inputs_.size(), [&](std::size_t number) { step(number, bare); });
  }
  [[nodiscard]] bool step_is_timed() const {
    return run_.step && *run_.step < std::min(static_cast<int>(inputs_.size()), most_steps_before_one) &&
           (run_.respawns.empty() || run_.respawns.front().step > *run_.step);
  }
  [[nodiscard]] double one_step(bool cold) const {
    const auto number = static_cast<std::size_t>(*run_.step);
    (void)timed_pass(run_, scene_, number, [&](std::size_t before) { step(before, has_bare_); });
    if (cold) write_other_memory();
    const Clock::time_point begin = Clock::now();
    step(number, has_bare_);
    const double took = nanoseconds(Clock::now() - begin);
    static const double reading = time_of_reading();
    return std::max(0.0, took - reading);
  }
  static Cost cost_of(std::vector<double>& passes) {
    std::ranges::sort(passes);
    return {passes.front(), passes[passes.size() / 2], passes.back()};
  }

  TimedRun run_;
  const Scene& scene_;
  std::span<const StepInput> inputs_;
  bool has_bare_ = false;
  std::vector<double> full_;
  std::vector<double> bare_;
  std::optional<StepCost> step_;
};

}  // namespace

std::vector<Costs> measure_costs(std::span<const TimedRun> runs, const Scene& scene, const Script& script, int steps) {
  const TimedSteps timed(scene, script, steps);
  std::vector<Timing> timings;
  for (const TimedRun& run : runs) timings.emplace_back(run, scene, timed.inputs());
  for (Timing& timing : timings) timing.warm_up();
  for (std::size_t repeat = 0; repeat < repeats; ++repeat)
    for (Timing& timing : timings) timing.repeat();
  std::vector<Costs> costs;
  for (Timing& timing : timings) costs.push_back(timing.costs());
  return costs;
}

}  // namespace paperproof::compare
