/// Stability: stiff and extreme cases, each a region over two parameters, and the borders between what holds and what
/// does not.
#pragma once

#include "studies/sweep.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One picture: a sweep over the parameters `x` and `y`.
struct StabilityRegion {
  std::string name;
  std::string question;
  Sweep sweep;
  /// Key of an axis along which the sequence of events stays that of its first value; empty: no such axis.
  std::string replicas_along;
  bool has_slopes = false;  ///< On which Box2D's characters slide: that is their law, and no drift.
};

/// octagon_sweep in double and in float, and Box2D; others where they are asked for.
/// @param grid `quick` (three values of an axis), `standard` or `full` (the longest runs whole).
[[nodiscard]] std::vector<StabilityRegion> stability_regions(const std::vector<std::string>& contenders,
                                                             const std::string& grid = "standard");

/// A value that a stable run has, and what it is measured by.
struct Predicate {
  std::string name;
  std::string meaning;  ///< With its bound.
};
[[nodiscard]] const std::vector<Predicate>& stability_predicates();

/// Says of a row that was run which predicates hold (`penetration_ok`, `drift_ok`, `energy_ok`, `hanging_ok`), each
/// where it applies, and makes what fails a fault.
void judge_stability(Row& row, bool has_slopes = false);

/// The row of a case with its predicates, `events_ok` among them where it is a replica.
[[nodiscard]] Row run_at(const StabilityRegion& region, std::size_t index);

/// A parameter that is bisected to where a contender ceases to be stable.
struct StabilityBorder {
  std::string name;
  Sweep sweep;  ///< With a border.
  /// Only this is asked: that no answer of the scene is missed by more [in its unit]. 0: all predicates are, and the
  /// answers to the letter.
  double most_off = 0;
  int strides = 0;  ///< In which the border is looked for before it is bisected.
};
/// @param grid as of `stability_regions`: `quick` looks in fewer strides.
[[nodiscard]] std::vector<StabilityBorder> stability_borders(const std::vector<std::string>& contenders,
                                                             const std::string& grid = "standard");
[[nodiscard]] Row run_at(const StabilityBorder& border, std::size_t index);

}  // namespace paperproof::compare
