/// What the tables of controller/README.md and box2d_adapter/README.md are made of: each measurement steps the
/// controller and Box2D in turns, in one process. Box2D is given the velocities, and reads no contact.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace paperproof::benchmarks {

/// By name: `paperproof` and `box2d`, each the fastest pass [ns], or what the name says in its unit.
using Figures = std::map<std::string, double>;

struct Measurement {
  std::string name;
  /// @throws std::runtime_error where the steps do not end as they must.
  std::function<Figures()> measure;
};

/// Steps of one character and of many, on what turns, and from a start inside.
[[nodiscard]] std::vector<Measurement> step_measurements();
/// Set-up of a level, its memory, and edits.
[[nodiscard]] std::vector<Measurement> level_measurements();
/// What a hero of the adapter costs a game [ns]: its `step`; by how much `its_body` makes a step of the world dearer;
/// and `plain_body`, the same of a body of Box2D alone.
[[nodiscard]] std::vector<Measurement> hero_measurements();

/// How long it takes [ns].
template <class Run>
[[nodiscard]] double nanoseconds_of(const Run& run) {
  const auto begin = std::chrono::steady_clock::now();
  run();
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

/// @return of each the fastest pass, divided by its steps [ns].
template <class Paperproof, class Box2d>
[[nodiscard]] Figures fastest_in_turns(int passes, double steps, const Paperproof& paperproof, const Box2d& box2d) {
  double ours = std::numeric_limits<double>::infinity();
  double theirs = ours;
  for (int pass = 0; pass < passes; ++pass) {
    ours = std::min(ours, nanoseconds_of(paperproof));
    theirs = std::min(theirs, nanoseconds_of(box2d));
  }
  return {{"paperproof", ours / steps}, {"box2d", theirs / steps}};
}

}  // namespace paperproof::benchmarks
