#include "records/metric.hpp"

#include <algorithm>
#include <array>

namespace paperproof::compare {
namespace {

using Group = Metric::Group;
using Of = Metric::Of;

constexpr std::array all{
    Metric{"finite", "Finite", "", Group::study, Of::one, "Whether every position and velocity is a number",
           &Row::finite},
    Metric{"penetration_ok", "No penetration", "", Group::study, Of::one,
           "Whether the character passes nothing, and ends no step inside anything by more than an ulp, and bodies by "
           "at most 5 mm",
           &Row::penetration_ok},
    Metric{"drift_ok", "No drift", "", Group::study, Of::one,
           "Whether at rest it stays within 1e-6 m (octagon_sweep in double) or 1e-4 m (others), or two ulp of its "
           "place if that is more; not asked in a crowd, nor of Box2D on slopes",
           &Row::drift_ok},
    Metric{"energy_ok", "No energy gained", "", Group::study, Of::one,
           "Whether the energy never rises, where nothing is put in, by more than gravity times the contender's reach "
           "(1e-6 m; Box2D's skin, 20 mm) and rounding; of bodies by more than 1 % of what moves and the weight of "
           "loose ones times 20 mm",
           &Row::energy_ok},
    Metric{"hanging_ok", "No hanging", "", Group::study, Of::one,
           "Whether no step that could fall hangs, and none is stuck beside a way out", &Row::hanging_ok},
    Metric{"events_ok", "Same events", "", Group::study, Of::one,
           "Whether it has the sequence of events of the case that it is a replica of: the same contacts and supports "
           "in order",
           &Row::events_ok},
    Metric{"border_low", "Holds up to", "", Group::study, Of::one,
           "Largest value of the bisected parameter that is known to hold; absent where none does", &Row::border_low},
    Metric{"border_high", "Fails from", "", Group::study, Of::one,
           "Smallest value of the bisected parameter that is known not to hold; absent where all hold",
           &Row::border_high},
    Metric{"characters", "Characters", "", Group::progress, Of::sum,
           "Characters in the run; absent for one; counts are sums over them", &Row::characters},
    Metric{"tunnels", "Tunnels", "steps", Group::safety, Of::sum, "Steps whose way crosses a solid and ends free of it",
           &Row::tunnels},
    Metric{"corner_cuts", "Corner cuts", "steps", Group::safety, Of::sum,
           "Crossings no deeper than the slop, counted apart", &Row::corner_cuts},
    Metric{"steps_ending_inside", "Ending inside", "steps", Group::safety, Of::sum,
           "Steps that end overlapping a solid, in exact arithmetic", &Row::steps_ending_inside},
    Metric{"one_way_violations", "One-way broken", "steps", Group::safety, Of::sum,
           "Steps that pass a one-way chain against its normal, not on purpose", &Row::one_way_violations},
    Metric{"max_penetration_m", "Max penetration", "m", Group::safety, Of::most,
           "Largest exact depth at the end of a step", &Row::max_penetration_m},
    Metric{"max_contact_gap_m", "Max contact gap", "m", Group::safety, Of::most,
           "Largest exact separation at which a reported contact stopped the character", &Row::max_contact_gap_m},
    Metric{"first_contact_step", "First contact", "step", Group::contacts, Of::first,
           "First step with a reported contact", &Row::first_contact_step},
    Metric{"first_contact_fraction", "First contact", "of a step", Group::contacts, Of::first,
           "Time of impact of that contact as a fraction of the step", &Row::first_contact_fraction},
    Metric{"exact_first_impact_step", "First impact, exact", "step", Group::contacts, Of::first,
           "Step of the first impact of the wanted motion in exact arithmetic, reported or not",
           &Row::exact_first_impact_step},
    Metric{"exact_first_impact_fraction", "First impact, exact", "of a step", Group::contacts, Of::first,
           "Time of that impact as a fraction of the step", &Row::exact_first_impact_fraction},
    Metric{"contact_precision", "Precision", "share", Group::contacts, Of::share,
           "Share of the reported contacts that are exact, or that an exact contact deflected the motion into; "
           "contacts in reach "
           "do not count",
           &Row::contact_precision},
    Metric{"contact_recall", "Recall", "share", Group::contacts, Of::share,
           "Share of the exact contacts that were reported", &Row::contact_recall},
    Metric{"contact_precision_box2d", "Precision, Box2D", "share", Group::contacts, Of::share,
           "Share of the reported contacts that the Box2D twin reports, too", &Row::contact_precision_box2d},
    Metric{"contact_recall_box2d", "Recall, Box2D", "share", Group::contacts, Of::share,
           "Share of the contacts of the Box2D twin that were reported", &Row::contact_recall_box2d},
    Metric{"contact_agreement_box2d", "Same sides as Box2D", "share", Group::contacts, Of::share,
           "Share of the steps with the same sides of contact as the Box2D twin", &Row::contact_agreement_box2d},
    Metric{"contact_steps", "With contact", "steps", Group::contacts, Of::sum, "Steps with any reported contact",
           &Row::contact_steps},
    Metric{"colliders_touched", "Colliders touched", "", Group::contacts, Of::sum,
           "Different colliders with a reported contact", &Row::colliders_touched},
    Metric{"respawns", "Respawns", "", Group::contacts, Of::sum, "Times the character was put back at the start",
           &Row::respawns},
    Metric{"crushes", "Crushed", "steps", Group::progress, Of::sum,
           "Steps on which movers left no room, verified by exact arithmetic; absent where nothing moves",
           &Row::crushes},
    Metric{"crushes_refuted", "Crushed with room", "steps", Group::progress, Of::sum,
           "Steps on which a crush was reported and there was room", &Row::crushes_refuted},
    Metric{"body_tunnels", "Bodies through", "steps", Group::progress, Of::sum,
           "Steps on which a body that Box2D moves passed a solid; in rows of Box2D", &Row::body_tunnels},
    Metric{"body_steps_inside", "Bodies inside", "steps", Group::progress, Of::sum,
           "Steps on which such a body ended inside something", &Row::body_steps_inside},
    Metric{"body_max_penetration_m", "Depth of bodies", "m", Group::progress, Of::most,
           "Largest exact depth of such a body", &Row::body_max_penetration_m},
    Metric{"body_energy_gained_j", "Energy gained by bodies", "J", Group::progress, Of::most,
           "Largest rise of the energy of bodies and springs above its least value before", &Row::body_energy_gained_j},
    Metric{"body_energy_bound_j", "Energy bound of bodies", "J", Group::progress, Of::most,
           "What of that rise is rounding and skin", &Row::body_energy_bound_j},
    Metric{"sensor_events", "Sensor events", "", Group::progress, Of::sum,
           "Entries and exits that happened, in exact arithmetic; absent where there are no sensors",
           &Row::sensor_events},
    Metric{"sensor_errors", "Sensor errors", "", Group::progress, Of::sum,
           "Events that were missed, and reported events that did not happen", &Row::sensor_errors},
    Metric{"max_sensor_error", "Sensor time error", "of a step", Group::progress, Of::most,
           "Largest error of the reported fraction of an event", &Row::max_sensor_error},
    Metric{"steps_inside_after_crush", "Inside after a crush", "steps", Group::progress, Of::sum,
           "Steps that overlap nothing but what a verified crush brought on", &Row::steps_inside_after_crush},
    Metric{"undecided_steps", "Undecided", "steps", Group::progress, Of::sum,
           "Steps that came so near to what turns that halving the time did not tell whether they met it",
           &Row::undecided_steps},
    Metric{"hanging_steps", "Hanging", "steps", Group::progress, Of::sum, "Steps that could have fallen, and did not",
           &Row::hanging_steps},
    Metric{"stuck_steps", "Stuck", "steps", Group::progress, Of::sum,
           "Steps on which the contender said that it is stuck inside something", &Row::stuck_steps},
    Metric{"stuck_refuted", "Stuck, refuted", "steps", Group::progress, Of::sum,
           "Steps of these on which exact arithmetic has a straight way out", &Row::stuck_refuted},
    Metric{"ground_refuted", "Ground, refuted", "steps", Group::progress, Of::sum,
           "Steps on which the contender said that it stands, and exact arithmetic has nothing under it",
           &Row::ground_refuted},
    Metric{
        "ground_missed", "Ground, missed", "steps", Group::progress, Of::sum,
        "Steps on which it touches ground and does not leave it, and says that it does not stand; only where that is "
        "guaranteed",
        &Row::ground_missed},
    Metric{"arc_error_max_m", "Off the arc", "m", Group::progress, Of::most,
           "Largest distance of what turns from its true arc at the same instant; absent where nothing turns",
           &Row::arc_error_max_m},
    Metric{"dropped_steps", "Displacement left over", "steps", Group::progress, Of::sum,
           "Steps on which a part of the displacement was left when the iterations ran out", &Row::dropped_steps},
    Metric{"answer_error", "Error of the answer", "", Group::progress, Of::most,
           "Error of the exact answer that is missed most, in the unit of that answer", &Row::answer_error},
    Metric{"answer_ok", "Answers met", "", Group::progress, Of::one, "Whether all of the scene's exact answers are met",
           &Row::answer_ok},
    Metric{"wanted_motion_lost", "Motion lost", "share", Group::progress, Of::share,
           "Share of the wanted horizontal motion lost to nothing exact", &Row::wanted_motion_lost},
    Metric{"distance_m", "Distance", "m", Group::progress, Of::sum, "Length of the way that was travelled",
           &Row::distance_m},
    Metric{"contact_band", "In the band", "", Group::contacts, Of::sum,
           "Contacts between 1e-7 and 7e-7 m, where the guarantee lets hit and hold be either", &Row::contact_band},
    Metric{"rounding", "Rounding", "steps", Group::progress, Of::sum,
           "Steps that end inside by no more than an ulp of the largest coordinate", &Row::rounding},
    Metric{"normal_error_max_deg", "Normal error", "degrees", Group::contacts, Of::most,
           "Largest angle between a reported normal and the exact one", &Row::normal_error_max_deg},
    Metric{"toi_error_max", "Impact time error", "of a step", Group::safety, Of::most,
           "Largest error of the first time of impact of a step", &Row::toi_error_max},
    Metric{"ghost_speed_loss", "Snag", "share", Group::jitter, Of::most,
           "Largest share of the wanted horizontal speed lost in one step to nothing exact", &Row::ghost_speed_loss},
    Metric{"energy_gained_j_kg", "Energy gained", "J/kg", Group::progress, Of::most,
           "Largest rise of the characters' energy while nothing puts any in", &Row::energy_gained_j_kg},
    Metric{"energy_bound_j_kg", "Energy bound", "J/kg", Group::progress, Of::most,
           "What of that rise is rounding, and reach in the field of gravity", &Row::energy_bound_j_kg},
    Metric{"events", "Events", "steps", Group::contacts, Of::one,
           "Steps that end with other contacts or another support than the step before", &Row::events},
    Metric{"rest_peak_to_peak_m", "Rest jitter", "m, peak to peak", Group::jitter, Of::most,
           "Larger of the ranges of x and y at rest", &Row::rest_peak_to_peak_m},
    Metric{"rest_rms_m", "Rest jitter", "m, RMS", Group::jitter, Of::most,
           "Root mean square distance from the mean position at rest", &Row::rest_rms_m},
    Metric{"contact_toggles", "Contact toggles", "per 1000 steps", Group::jitter, Of::most,
           "Contacts that come and go at rest", &Row::contact_toggles},
    Metric{"rest_sign_changes", "Sign changes", "per 1000 steps", Group::jitter, Of::most,
           "Sign changes of the velocity at rest; a tremble has one in each step", &Row::rest_sign_changes},
    Metric{"rest_upper_band", "Upper half band", "share", Group::jitter, Of::most,
           "Share of the power at rest above half of the highest frequency, trend removed; 1 is a flutter from step to "
           "step",
           &Row::rest_upper_band},
    Metric{"log_dimensionless_jerk", "Smoothness", "", Group::jitter, Of::most,
           "Logarithm of the dimensionless jerk of the last positions; larger is smoother",
           &Row::log_dimensionless_jerk},
    Metric{"seam_hop_share", "Seam hop", "share of speed", Group::jitter, Of::most,
           "Largest change of speed between two steps on level ground", &Row::seam_hop_share},
    Metric{"seam_hop_m", "Seam hop", "m", Group::jitter, Of::most,
           "Largest change of height between two steps on level ground", &Row::seam_hop_m},
    Metric{"max_position_difference_box2d_m", "Distance to Box2D", "m", Group::contacts, Of::most,
           "Largest distance to the Box2D twin at the end of a step", &Row::max_position_difference_box2d_m},
    Metric{"first_difference_box2d_step", "First difference to Box2D", "step", Group::contacts, Of::first,
           "First step with other sides of contact than the Box2D twin, or further from it than its skin",
           &Row::first_difference_box2d_step},
    Metric{"error_max_m", "Error", "m", Group::study, Of::most, "Largest distance from the continuous motion",
           &Row::error_max_m},
    Metric{"error_rms_m", "Error, RMS", "m", Group::study, Of::most,
           "Root mean square distance from the continuous motion", &Row::error_rms_m},
    Metric{"slope", "Slope", "", Group::study, Of::one,
           "Slope of log error over the logarithm of the parameter named in `curve`", &Row::slope},
    Metric{"on_front", "On the front", "", Group::study, Of::one, "Whether no other run has less error in less time",
           &Row::on_front},
    Metric{"ns_per_step", "Cost", "ns per step", Group::cost, Of::most, "Minimum of the repeats", &Row::ns_per_step},
    Metric{"ns_per_step_median", "Cost, median", "ns per step", Group::cost, Of::most, "Median of the repeats",
           &Row::ns_per_step_median},
    Metric{"ns_per_step_max", "Cost, slowest", "ns per step", Group::cost, Of::most, "Maximum of the repeats",
           &Row::ns_per_step_max},
    Metric{"ns_per_step_bare", "Cost, bare", "ns per step", Group::cost, Of::most,
           "Box2D alone, given its velocities, with nothing recorded; minimum of the repeats", &Row::ns_per_step_bare},
    Metric{"memory_bytes", "Memory", "bytes", Group::cost, Of::most, "Size of a contender's own picture of the level",
           &Row::memory_bytes},
};

}  // namespace

std::string_view name_of(Metric::Group group) noexcept {
  constexpr std::array<std::string_view, 6> names{"safety", "progress", "contacts", "jitter", "cost", "study"};
  return names[static_cast<std::size_t>(group)];
}

std::string_view name_of(Metric::Of of) noexcept {
  constexpr std::array<std::string_view, 5> names{"sum", "largest", "first", "share", "single"};
  return names[static_cast<std::size_t>(of)];
}

std::span<const Metric> metrics() noexcept { return all; }

const Metric* find_metric(std::string_view key) noexcept {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Metric& each) { return each.key == key; });
  return found == all.end() ? nullptr : &*found;
}

bool is_cost(std::string_view key) noexcept {
  const Metric* metric = find_metric(key);
  return key == "on_front" || (metric != nullptr && metric->group == Group::cost && key != "memory_bytes");
}

std::optional<double> value_of(const Metric& metric, const Row& row) {
  return std::visit(
      [&](const auto field) { return row.*field ? std::optional(static_cast<double>(*(row.*field))) : std::nullopt; },
      metric.field);
}

}  // namespace paperproof::compare
