/// Work and precision: how far contenders are from continuous motion, against what a step costs.
#pragma once

#include "records/row.hpp"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// A motion whose continuous course is known in closed form.
struct KnownMotion {
  std::string_view name;
  std::string_view description;  ///< With the formula.
};
[[nodiscard]] std::span<const KnownMotion> known_motions();

/// What a study of work and precision found.
struct WorkPrecision {
  std::vector<Row> points;             ///< One for each contender and value of its knob; failures with their reason.
  std::vector<Row> curves;             ///< One for each motion, contender and knob: `slope`.
  std::vector<std::string> sentences;  ///< Who is on the front of which motion, and where octagon_sweep is not.
};

/// Each contender over the length of a step, and over its own knob at 1/60 s: unit, pixels per metre. Errors are
/// measured first, against the closed form, at the end of every step; costs in a phase of their own, the contenders of
/// one length of a step taking turns, minimum of nine runs after a warm-up.
/// - `error_max_m`, `error_rms_m`: distance from the continuous motion. Box2D's includes its skin of 15 mm.
/// - `slope`: of log error over log knob, least squares over the points whose error is above 1e-9 m; two at least.
/// - `on_front`: no other point of the motion has less error for less time per second of motion.
/// @param motions,contenders those asked for; empty: all.
/// @throws std::invalid_argument for a motion that there is not.
[[nodiscard]] WorkPrecision study_work_precision(const std::vector<std::string>& motions,
                                                 const std::vector<std::string>& contenders,
                                                 const std::function<void(double)>& progress);

/// Least squares. Nothing for less than two points with different `x`.
[[nodiscard]] std::optional<double> slope_of(std::span<const std::pair<double, double>> log_points);

}  // namespace paperproof::compare
