#include "command/forecast.hpp"

#include "command/complain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

/// What takes less is not announced [s]: people wait that long without asking.
constexpr double long_work = 10;
/// As long is measured before anything is said [s]. Small: the first steps are cold. Large: who waits wonders.
constexpr double measured_for = 1;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void Forecast::preparation(const std::string& scene, double seconds, const std::string& why) const {
  if (wanted_ && seconds >= long_work)
    complain(fmt::format("{}: about {} until the first step: {}", scene, duration_in_words(seconds), why));
}

void Forecast::begin_scene(double steps) {
  steps_before_ += steps_of_scene_;
  steps_of_scene_ = steps;
}

void Forecast::done(double share) {
  if (share == 0) scene_begin_ = Clock::now();
  if (!wanted_ || share == 0) return;
  // Once a scene is through, the rate includes what is done before and after the steps.
  const bool some_through = steps_before_ > 0;
  const double done = share * steps_of_scene_ + (some_through ? steps_before_ : 0);
  const double took = seconds_since(some_through ? begin_ : scene_begin_);
  if (took < measured_for) return;
  const double left = (steps_ - steps_before_ - share * steps_of_scene_) * took / done;
  if (left < long_work) return;
  wanted_ = false;
  complain(fmt::format("about {} for {:.0f} {}, as the first {:.0f} took {:.1f} s", duration_in_words(took + left),
                       steps_, noun_, std::max(1.0, done), took));
}

std::string duration_in_words(double seconds) {
  struct Unit {
    double seconds;
    const char* name;
  };
  constexpr Unit units[] = {{86'400, "days"}, {3'600, "hours"}, {60, "minutes"}};
  for (const Unit& unit : units)
    if (seconds >= 2 * unit.seconds) return fmt::format("{:.0f} {}", seconds / unit.seconds, unit.name);
  return fmt::format("{:.0f} seconds", std::ceil(seconds));
}

}  // namespace paperproof::compare
