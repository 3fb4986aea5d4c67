/// Stability: stiff and extreme cases, each a region over two parameters, and the borders between what holds and what
/// does not.
#pragma once

#include "studies/prepared_studies.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// Regions, each a sweep over the parameters of one picture, then borders: octagon_sweep in double and in float, and
/// Box2D, which computes in float alone; others where they are asked for. On the quick grid an axis has three values
/// and borders are looked for in fewer strides; the full one has the longest runs whole.
[[nodiscard]] std::vector<StudyPart> stability_parts(GridSize size, const std::vector<std::string>& contenders);

/// Each predicate with its bound.
[[nodiscard]] std::vector<std::string> stability_predicates();

/// Says of a row that was run which predicates hold (`penetration_ok`, `drift_ok`, `energy_ok`, `hanging_ok`), each
/// where it applies, and makes what fails a fault.
void judge_stability(Row& row, bool has_slopes = false);

/// The row of a case with its predicates, `events_ok` among them where it is a replica.
/// @param replicas_along key of an axis along which the sequence of events stays that of its first value; empty: no
/// such axis. @param has_slopes on which Box2D's characters slide: that is their law, and no drift.
[[nodiscard]] Row run_stable(const Sweep& sweep, std::size_t index, const std::string& replicas_along,
                             bool has_slopes = false);

}  // namespace paperproof::compare
