/// One result: a (scene, contender, scalar, mode) and its numbers. A metric that does not apply is absent.
#pragma once

#include <cstdint>
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

/// Events of one kind and cause on which a contender and Box2D differ.
struct Disagreements {
  int count = 0;
  int first_step = 0;
  std::string first;  ///< What each side says there.
};

/// What is counted as bad where many rows stand together.
enum class Bad : std::uint8_t {
  does_not_hold,  ///< A verdict other than `holds`.
  tunnels,        ///< A solid was passed.
};

/// The sweep that a row is a case of: a cell of a heat map stands for it.
struct SweptIn {
  std::string question;           ///< Of a study that asks several; may be empty.
  std::vector<std::string> axes;  ///< Keys in `parameters`.
  Bad bad = Bad::does_not_hold;
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

  std::string case_id;  ///< Of a run that is a Case: see records/case.hpp.
  std::string command;  ///< That runs it alone; of a border, the case at the upper end of the bracket.
  std::optional<SweptIn> swept;
  std::string source;                                      ///< Of the scene: see `Scene::source`.
  std::vector<std::pair<std::string, double>> parameters;  ///< Of scene, input and knobs, by keys that end in units.
  std::optional<std::string> border;                       ///< Key of the parameter that was bisected.

  // The numbers: records/metric.cpp says what each means. A number that does not apply is absent.
  std::optional<bool> finite;
  std::optional<bool> penetration_ok;
  std::optional<bool> drift_ok;
  std::optional<bool> energy_ok;
  std::optional<bool> hanging_ok;
  std::optional<bool> events_ok;
  std::optional<double> border_low;
  std::optional<double> border_high;
  std::optional<int> characters;
  std::optional<int> tunnels;
  std::optional<int> corner_cuts;
  std::optional<int> steps_ending_inside;
  std::optional<int> one_way_violations;
  std::optional<double> max_penetration_m;
  std::optional<double> max_contact_gap_m;
  std::optional<int> first_contact_step;
  std::optional<double> first_contact_fraction;
  std::optional<int> exact_first_impact_step;
  std::optional<double> exact_first_impact_fraction;
  std::optional<double> contact_precision;
  std::optional<double> contact_recall;
  std::optional<double> contact_precision_box2d;
  std::optional<double> contact_recall_box2d;
  std::optional<double> contact_agreement_box2d;
  std::optional<int> contact_steps;
  std::optional<int> colliders_touched;
  std::optional<int> respawns;
  std::optional<int> crushes;
  std::optional<int> crushes_refuted;
  std::optional<int> body_tunnels;
  std::optional<int> body_steps_inside;
  std::optional<double> body_max_penetration_m;
  std::optional<double> body_energy_gained_j;
  std::optional<double> body_energy_bound_j;
  std::optional<int> sensor_events;
  std::optional<int> sensor_errors;
  std::optional<double> max_sensor_error;
  std::optional<int> steps_inside_after_crush;
  std::optional<int> undecided_steps;
  std::optional<int> hanging_steps;
  std::optional<int> stuck_steps;
  std::optional<int> stuck_refuted;
  std::optional<int> ground_refuted;
  std::optional<int> ground_missed;
  std::optional<double> arc_error_max_m;
  std::optional<int> dropped_steps;
  std::optional<double> answer_error;
  std::optional<bool> answer_ok;
  std::optional<double> wanted_motion_lost;
  std::optional<double> distance_m;
  std::optional<int> contact_band;
  std::optional<int> rounding;
  std::optional<double> normal_error_max_deg;
  std::optional<double> toi_error_max;
  std::optional<double> ghost_speed_loss;
  std::optional<double> energy_gained_j_kg;
  std::optional<double> energy_bound_j_kg;
  std::optional<int> events;
  std::optional<double> rest_peak_to_peak_m;
  std::optional<double> rest_rms_m;
  std::optional<double> contact_toggles;
  std::optional<double> rest_sign_changes;
  std::optional<double> rest_upper_band;
  std::optional<double> log_dimensionless_jerk;
  std::optional<double> seam_hop_share;
  std::optional<double> seam_hop_m;
  std::optional<double> max_position_difference_box2d_m;
  std::optional<int> first_difference_box2d_step;
  std::optional<double> error_max_m;
  std::optional<double> error_rms_m;
  std::optional<double> slope;
  std::optional<bool> on_front;
  std::optional<double> ns_per_step;
  std::optional<double> ns_per_step_median;
  std::optional<double> ns_per_step_max;
  std::optional<double> ns_per_step_bare;
  std::optional<std::size_t> memory_bytes;

  std::optional<FirstTunnel> first_tunnel;
  std::map<std::string, int>
      broken;  ///< Steps that broke a clause, promised or not, by its name: see records/clause.hpp.
  std::map<std::string, int> exempted;  ///< What was not held against it, how often: see oracle/exemptions.hpp.
  /// Where a ledger was kept, by `cause.kind`: the events on which it and the Box2D twin differ. See `Ledger`.
  std::map<std::string, Disagreements> disagreements;
  std::string exact_first_impact;  ///< Collider of the exact first impact; empty where there is none, or only a seam.
  std::string answer;              ///< The answer that is missed most, in words; empty where all are met.
  std::string first_difference_box2d;  ///< The first difference to the twin in words, and which side is right.
  std::string event_sequence;          ///< Which events there were: see metrics/events.hpp.
  std::string curve;                   ///< Key of the parameter that a curve of several runs is over.
  std::vector<std::string> findings;   ///< Sentences: where the run began, what was not compared.
};

/// Whether a run was made and judged: neither `failed` nor `not_applicable`.
[[nodiscard]] bool was_judged(const Row& row) noexcept;

/// See `is_guaranteed`.
[[nodiscard]] inline bool is_guaranteed(const Row& row) noexcept { return is_guaranteed(row.contender, row.scalar); }

/// One of its `parameters`; nothing where it has none of that key.
[[nodiscard]] std::optional<double> parameter_of(const Row& row, std::string_view key);

/// The contender in words, with the number type where it could be another: Box2D's is always float.
[[nodiscard]] std::string called(const Row& row);

}  // namespace paperproof::compare
