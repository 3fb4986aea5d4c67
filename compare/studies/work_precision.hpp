/// Work and precision: how far contenders are from continuous motion, against what a step costs.
#pragma once

#include "records/row.hpp"

#include <functional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What a study of work and precision found.
struct WorkPrecision {
  std::vector<Row> points;             ///< One for each contender and value of its knob; failures with their reason.
  std::vector<Row> curves;             ///< One for each motion, contender and knob: `slope`.
  std::vector<std::string> sentences;  ///< Who is on the front of which motion, and where octagon_sweep is not.
};

/// Each contender over the length of a step, and over its own knobs at 1/60 s: unit, pixels per metre, square,
/// iterations, substeps. Runs are those of `compare`: every step is judged, and measured at its end against the
/// continuous reference, Box2D's against the course of a body without friction, all others' against that of design §4.
/// Costs are measured in a phase of their own, the contenders of one length of a step or value of a knob taking turns,
/// minimum of nine runs after a warm-up.
/// - `error_max_m`, `error_rms_m`: distance from the continuous motion. Box2D's includes its skin of 15 mm.
/// - `slope`, `slope_within`: of log error over log knob, and half its 95 % interval; over points that count (`counts`)
///   and have an error above 1e-9 m: see `slope_within_a_regime`.
/// - `on_front`: no other point of the motion that counts has less error for less time per second of motion. Of a
///   curve: of any of its points.
/// @param wanted names of motions (studies/motions.hpp). @param contenders those asked for. Empty: all.
/// @throws std::invalid_argument for a motion that there is not.
[[nodiscard]] WorkPrecision study_work_precision(const std::vector<std::string>& wanted,
                                                 const std::vector<std::string>& contenders,
                                                 const std::function<void(double)>& progress);

}  // namespace paperproof::compare
