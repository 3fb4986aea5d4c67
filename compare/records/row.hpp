/// One result: a (scene, contender, scalar, mode) and its numbers. A metric that does not apply is absent.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace paperproof::compare {

enum class Verdict { holds, tunnels, violates, not_applicable, flagged, failed };
[[nodiscard]] std::string_view name_of(Verdict verdict) noexcept;

/// A result is looked at along these, and none hides another.
enum class Axis {
  safety,    ///< Passes nothing, ends inside nothing.
  progress,  ///< Gets where it can.
  answer,    ///< Meets the scene's exact answer.
  validity,  ///< The run is within the contender's limits.
};
[[nodiscard]] std::string_view name_of(Axis axis) noexcept;

/// Whether the guarantee of the README covers this contender: octagon_sweep in double.
[[nodiscard]] constexpr bool is_guaranteed(std::string_view contender, std::string_view scalar) noexcept {
  return contender == "octagon_sweep" && scalar == "double";
}

/// Where a run fell short: see records/verdict.hpp.
struct AxisFault {
  Axis axis = Axis::safety;
  Verdict verdict = Verdict::flagged;
  std::string words;
};

/// The first passage through a solid, or through another character: then it has words alone.
struct FirstTunnel {
  int step = 0;
  std::string collider;  ///< Empty for a character.
  double speed_m_s = 0;
  double thickness_m = 0;  ///< At the crossing.
  double angle_deg = 0;    ///< Of the way to the face: 90 is head-on.
  std::string words;
};

struct Row {
  std::string scene;
  std::string contender;
  std::string scalar = "double";
  std::string mode = "free";
  std::string knob;  ///< Settings that are not the usual ones, as `name=value`, with spaces between; empty for none.
  int steps = 0;     ///< that ran
  Verdict verdict = Verdict::holds;
  std::string reason;  ///< empty for `holds` only
  std::vector<AxisFault> faults;

  std::string case_id;                                     ///< Of a run that is a Case: see records/case.hpp.
  std::string command;                                     ///< That runs it alone.
  std::string source;                                      ///< The file of the scene, or `builtin:NAME`.
  std::vector<std::pair<std::string, double>> parameters;  ///< Of scene, input and knobs, by keys that end in units.
  std::optional<std::string> border;  ///< Key of the parameter that was bisected to where the contender ceases to hold,
  std::optional<double> border_low;   ///< the largest value known to hold below that,
  std::optional<double> border_high;  ///< and the smallest known not to. One is absent where there is no border.

  std::optional<bool> finite;     ///< Every position and velocity was a number.
  std::optional<int> characters;  ///< that the run had; absent for one
  std::optional<int> tunnels;     ///< steps that passed through a solid
  std::optional<FirstTunnel> first_tunnel;
  std::optional<int> corner_cuts;  ///< passes shallower than the slop, counted apart
  std::optional<int> steps_ending_inside;
  std::optional<int> one_way_violations;
  std::optional<double> max_penetration_m;
  std::optional<double> max_contact_gap_m;
  std::optional<int> first_contact_step;
  std::optional<double> first_contact_fraction;
  /// The first impact of the motion that was wanted, as exact arithmetic has it, reported or not.
  std::optional<int> exact_first_impact_step;
  std::optional<double> exact_first_impact_fraction;
  std::string exact_first_impact;           ///< With what; empty where there is none, or only a seam.
  std::optional<double> contact_precision;  ///< against exact
  std::optional<double> contact_recall;     ///< against exact
  std::optional<double> contact_precision_box2d;
  std::optional<double> contact_recall_box2d;
  std::optional<double> contact_agreement_box2d;  ///< share of steps with the same sides of contact
  std::optional<int> contact_steps;               ///< steps with any contact
  std::optional<int> colliders_touched;
  std::optional<int> respawns;
  std::optional<int> crushes;            ///< steps on which movers left no room, verified; absent where nothing moves
  std::optional<int> crushes_refuted;    ///< steps on which a crush was reported and there was room
  std::optional<int> body_tunnels;       ///< steps on which a body that Box2D moves passed a solid; in its own rows
  std::optional<int> body_steps_inside;  ///< steps on which one ended inside something
  std::optional<double> body_max_penetration_m;
  std::optional<int> sensor_events;             ///< that there were, exactly; absent where there are no sensors
  std::optional<int> sensor_errors;             ///< events missed, and events that there were not
  std::optional<double> max_sensor_error;       ///< of the fraction of the step
  std::optional<int> steps_inside_after_crush;  ///< inside nothing but what a verified crush brought on
  std::optional<int> hanging_steps;             ///< steps that could have fallen, and did not
  std::optional<int> stuck_refuted;             ///< steps on which it said so, and exact arithmetic has a way out
  std::optional<double> distance_m;             ///< length of its ways
  std::optional<double> wanted_motion_lost;     ///< share of the wanted horizontal motion, to nothing exact
  std::optional<double> normal_error_max_deg;   ///< of reported contacts that are exact
  std::optional<int> contact_band;              ///< contacts where the guarantee lets hit and hold be either
  std::optional<int> rounding;                  ///< steps ending inside by no more than rounding
  std::map<std::string, int> exempted;          ///< what was not held against it, how often: oracle/exemptions.hpp
  std::optional<int> stuck_steps;               ///< steps on which it said that it is stuck inside something
  std::optional<int> dropped_steps;             ///< steps with displacement dropped after the iterations
  std::optional<double> answer_error;   ///< of the scene's answer that is missed most, in its unit: see `AnswerCheck`
  std::optional<bool> answer_ok;        ///< all of the scene's answers are met
  std::string answer;                   ///< the one that is missed most, in words; empty where all are met
  std::optional<double> toi_error_max;  ///< in fractions of a step, first contact of each step
  std::optional<double>
      ghost_speed_loss;  ///< largest share of the wanted horizontal speed lost in a step to nothing exact
  std::optional<double> rest_peak_to_peak_m;
  std::optional<double> rest_rms_m;
  std::optional<double> contact_toggles;         ///< per 1,000 resting steps
  std::optional<double> rest_sign_changes;       ///< of the velocity at rest, per 1,000 steps
  std::optional<double> rest_upper_band;         ///< share of power in the upper half of the band, at rest
  std::optional<double> log_dimensionless_jerk;  ///< of the last positions; larger is smoother
  std::optional<double> seam_hop_share;          ///< largest change of speed on level ground, of the wanted one
  std::optional<double> seam_hop_m;              ///< largest change of height there
  std::optional<double> max_position_difference_box2d_m;
  /// the first step on which it and the Box2D twin differ: see `Agreement::first_difference`
  std::optional<int> first_difference_box2d_step;
  std::string first_difference_box2d;  ///< that step in words, and which side is right
  std::optional<double> error_max_m;   ///< From continuous motion: see studies/work_precision.hpp.
  std::optional<double> error_rms_m;
  std::string curve;                         ///< Key of the parameter that a curve of several runs is over,
  std::optional<double> slope;               ///< and the slope of log error over its logarithm.
  std::optional<bool> on_front;              ///< No other run has less error in less time.
  std::optional<double> ns_per_step;         ///< minimum
  std::optional<double> ns_per_step_median;  ///< of the repeats: on a busy machine the slowest says little
  std::optional<double> ns_per_step_max;     ///< the spread: the slowest of the repeats
  std::optional<double> ns_per_step_bare;    ///< Box2D's: minimum of the world alone, with nothing recorded
  std::optional<std::size_t> memory_bytes;   ///< of a contender's own picture of the level
  std::vector<std::string> findings;         ///< sentences: where the run began, what was not compared
};

/// The contender in words, with the number type where it could be another: Box2D's is always float.
[[nodiscard]] std::string called(const Row& row);

/// Calls `visit(key, optional)` for every number of a row, by the key it has in files, in the order in which it stands
/// there. Written files and the report's page both take their numbers from here.
template <class Visit>
void for_each_metric(const Row& row, const Visit& visit) {
  visit("finite", row.finite);
  visit("border_low", row.border_low);
  visit("border_high", row.border_high);
  visit("characters", row.characters);
  visit("tunnels", row.tunnels);
  visit("corner_cuts", row.corner_cuts);
  visit("steps_ending_inside", row.steps_ending_inside);
  visit("one_way_violations", row.one_way_violations);
  visit("max_penetration_m", row.max_penetration_m);
  visit("max_contact_gap_m", row.max_contact_gap_m);
  visit("first_contact_step", row.first_contact_step);
  visit("first_contact_fraction", row.first_contact_fraction);
  visit("exact_first_impact_step", row.exact_first_impact_step);
  visit("exact_first_impact_fraction", row.exact_first_impact_fraction);
  visit("contact_precision", row.contact_precision);
  visit("contact_recall", row.contact_recall);
  visit("contact_precision_box2d", row.contact_precision_box2d);
  visit("contact_recall_box2d", row.contact_recall_box2d);
  visit("contact_agreement_box2d", row.contact_agreement_box2d);
  visit("contact_steps", row.contact_steps);
  visit("colliders_touched", row.colliders_touched);
  visit("respawns", row.respawns);
  visit("crushes", row.crushes);
  visit("crushes_refuted", row.crushes_refuted);
  visit("body_tunnels", row.body_tunnels);
  visit("body_steps_inside", row.body_steps_inside);
  visit("body_max_penetration_m", row.body_max_penetration_m);
  visit("sensor_events", row.sensor_events);
  visit("sensor_errors", row.sensor_errors);
  visit("max_sensor_error", row.max_sensor_error);
  visit("steps_inside_after_crush", row.steps_inside_after_crush);
  visit("hanging_steps", row.hanging_steps);
  visit("stuck_steps", row.stuck_steps);
  visit("stuck_refuted", row.stuck_refuted);
  visit("dropped_steps", row.dropped_steps);
  visit("answer_error", row.answer_error);
  visit("answer_ok", row.answer_ok);
  visit("wanted_motion_lost", row.wanted_motion_lost);
  visit("distance_m", row.distance_m);
  visit("contact_band", row.contact_band);
  visit("rounding", row.rounding);
  visit("normal_error_max_deg", row.normal_error_max_deg);
  visit("toi_error_max", row.toi_error_max);
  visit("ghost_speed_loss", row.ghost_speed_loss);
  visit("rest_peak_to_peak_m", row.rest_peak_to_peak_m);
  visit("rest_rms_m", row.rest_rms_m);
  visit("contact_toggles", row.contact_toggles);
  visit("rest_sign_changes", row.rest_sign_changes);
  visit("rest_upper_band", row.rest_upper_band);
  visit("log_dimensionless_jerk", row.log_dimensionless_jerk);
  visit("seam_hop_share", row.seam_hop_share);
  visit("seam_hop_m", row.seam_hop_m);
  visit("max_position_difference_box2d_m", row.max_position_difference_box2d_m);
  visit("first_difference_box2d_step", row.first_difference_box2d_step);
  visit("error_max_m", row.error_max_m);
  visit("error_rms_m", row.error_rms_m);
  visit("slope", row.slope);
  visit("on_front", row.on_front);
  visit("ns_per_step", row.ns_per_step);
  visit("ns_per_step_median", row.ns_per_step_median);
  visit("ns_per_step_max", row.ns_per_step_max);
  visit("ns_per_step_bare", row.ns_per_step_bare);
  visit("memory_bytes", row.memory_bytes);
}

}  // namespace paperproof::compare
