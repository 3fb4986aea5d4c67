/// One result: a (scene, contender, scalar, mode) and its numbers. A metric that does not apply is absent.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

enum class Verdict { holds, tunnels, violates, not_applicable, flagged, failed };
[[nodiscard]] std::string_view name_of(Verdict verdict) noexcept;

struct Row {
  std::string scene;
  std::string contender;
  std::string scalar = "double";
  std::string mode = "free";
  std::string knob;  ///< Settings that differ from row to row, as `name=value`; empty where none does.
  int steps = 0;     ///< that ran
  Verdict verdict = Verdict::holds;
  std::string reason;  ///< empty for `holds` only

  std::optional<int> tunnels;      ///< steps that passed through a solid
  std::optional<int> corner_cuts;  ///< passes shallower than the slop, counted apart
  std::optional<int> steps_ending_inside;
  std::optional<int> one_way_violations;
  std::optional<double> max_penetration_m;
  std::optional<double> max_contact_gap_m;
  std::optional<int> first_contact_step;
  std::optional<double> first_contact_fraction;
  std::optional<double> contact_precision;  ///< against exact
  std::optional<double> contact_recall;     ///< against exact
  std::optional<double> contact_precision_box2d;
  std::optional<double> contact_recall_box2d;
  std::optional<double> contact_agreement_box2d;  ///< share of steps with the same sides of contact
  std::optional<int> contact_steps;               ///< steps with any contact
  std::optional<int> colliders_touched;
  std::optional<int> respawns;
  std::optional<int> crushes;              ///< steps on which movers left no room, verified; absent where nothing moves
  std::optional<int> crushes_with_room;    ///< steps on which a crush was reported and there was room
  std::optional<int> sensor_events;        ///< that there were, exactly; absent where there are no sensors
  std::optional<int> sensor_errors;        ///< events missed, and events that there were not
  std::optional<double> max_sensor_error;  ///< of the fraction of the step
  std::optional<int> dropped_steps;        ///< steps with displacement dropped after the iterations
  std::optional<double> toi_error_max;     ///< in fractions of a step, first contact of each step
  std::optional<double>
      ghost_speed_loss;  ///< largest share of the wanted horizontal speed lost in a step to nothing exact
  std::optional<double> rest_peak_to_peak_m;
  std::optional<double> rest_rms_m;
  std::optional<double> contact_toggles;  ///< per 1,000 resting steps
  std::optional<double> max_position_difference_box2d_m;
  /// the first step on which it and the Box2D twin differ: see `Agreement::first_difference`
  std::optional<int> first_difference_box2d_step;
  std::string first_difference_box2d;        ///< the same in words, with who is right
  std::optional<double> ns_per_step;         ///< minimum
  std::optional<double> ns_per_step_median;  ///< of the repeats: on a busy machine the slowest says little
  std::optional<double> ns_per_step_max;     ///< the spread: the slowest of the repeats
  std::optional<std::size_t> memory_bytes;   ///< of a contender's own picture of the level
  std::vector<std::string> findings;         ///< sentences: first tunnel with speed and thickness, caps, labels
};

}  // namespace paperproof::compare
