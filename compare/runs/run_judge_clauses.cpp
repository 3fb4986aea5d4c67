/// What the judgement of a step breaks, clause by clause, and whether its velocity is what the law makes.
#include "runs/run_judge.hpp"

#include "contains.hpp"
#include "oracle/legs.hpp"
#include "oracle/response_laws.hpp"
#include "oracle/up.hpp"
#include "runs/run_judge_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

using namespace run_judge;
namespace {

/// Normals are computed from rounded vertices [degrees].
constexpr double rounding_of_normal = 1e-3;
constexpr double rounding_of_unit = 1e-6;
/// What turns and touches has one velocity to within this [m/s].
constexpr double hardly_turns = 1e-3;

}  // namespace

void RunJudge::judge_clauses(const TraceStep& record, const StepJudgement& judged) {
  const auto name = [&](const std::vector<ColliderIndex>& colliders) {
    return colliders.empty() ? std::string("another character") : "`" + header_.ids[colliders.front()] + "`";
  };
  const auto broken = [&](Clause clause, const std::string& words) { note(clause, record, words); };
  const auto is_no_unit = [](const Contact& contact) { return std::abs(contact.normal.norm() - 1) > rounding_of_unit; };
  if (!judged.entered.empty() || !judged.company.entered.empty())
    broken(Clause::overlap, "ends inside " + name(judged.entered));
  if (!judged.tunnelled.empty() || !judged.company.passed.empty())
    broken(Clause::passage, "passes through " + name(judged.tunnelled));
  if (!judged.one_way_broken.empty())
    broken(Clause::one_way, "passes " + name(judged.one_way_broken) + " against its normal");
  if (judged.max_contact_gap > guaranteed_gap)
    broken(Clause::gap, "a contact is " + metres(judged.max_contact_gap) + " away");
  if (judged.normal_error.value_or(0) > rounding_of_normal)
    broken(Clause::normal, fmt::format("a normal is {:.3g} degrees off", *judged.normal_error));
  if (std::ranges::any_of(record.contacts, is_no_unit)) broken(Clause::normal, "a normal is no unit vector");
  if (judged.sensor_events_missing > 0)
    broken(Clause::sensor, "a sensor's event is missing");
  else if (judged.sensor_events_extra > 0)
    broken(Clause::sensor, "reports a sensor's event that was none");
  if (judged.max_sensor_way > guaranteed_gap)
    broken(Clause::sensor, fmt::format("a sensor's event is {:.3g} of the step off", judged.max_sensor_error));
  if (!std::ranges::is_sorted(record.sensors, {}, &SensorEvent::fraction))
    broken(Clause::sensor, "the events of sensors are not in order of time");
  if (judged.stuck_refuted) broken(Clause::start_inside, "says it is stuck beside a way out");
  if (judged.start_mishandled)
    broken(Clause::start_inside, "begins inside, and neither leaves by the shortest way out nor stays and says so");
  if (!(judged.way_gained <= 0))
    broken(Clause::velocity, "goes " + metres(judged.way_gained) + " more or less than the law allows");
  if (!(judged.leg_error <= 0))
    broken(Clause::velocity, "goes another way than the law makes, by " + metres(judged.leg_error));
  if (!(judged.end_error <= 0))
    broken(Clause::velocity, "goes another way than its velocity at the end says, by " + metres(judged.end_error));
  if (!(judged.speed_gained <= 0))
    broken(Clause::velocity, fmt::format("is {:.3g} m/s faster or slower than the law allows", judged.speed_gained));
  if (judged.hangs) broken(Clause::hanging, "hangs in the air");
  if (judged.motion_lost > 0)
    broken(Clause::speed_lost, "loses " + metres(judged.motion_lost) + " of its horizontal way to nothing");
  else if (judged.speed_lost > 0)
    broken(Clause::speed_lost, fmt::format("loses {:.3g} m/s to nothing", judged.speed_lost));
  else if (judged.ghost_speed_loss > 0)
    broken(Clause::speed_lost,
           fmt::format("loses {:.3g} % of its horizontal speed to nothing", 100 * judged.ghost_speed_loss));
  if (judged.ground_refuted) broken(Clause::ground_invented, no_ground(header_));
  if (judged.ground_missed) broken(Clause::ground_missed, "stands on ground, and says it does not");
  if (judged.ground_left) broken(Clause::ground_missed, "leaves ground that `snap` has it follow");
  if (judged.kerb_missed) broken(Clause::speed_lost, "is stopped by what `step_height` has it climb");
  if (!judged.crushed_with_room.empty())
    broken(Clause::crush, "is crushed by " + name(judged.crushed_with_room) + " with room to give way");
  if (record.path.back().position.cwiseAbs().maxCoeff() > range || !(length_of(record, header_) > 0))
    broken(Clause::refusal, "takes a step that must be refused");
  judge_places(record, judged);
}

/// Whether the law of response (§4 of the design) makes the velocity at the end of what was wanted, at the contacts
/// that are reported: these are judged for themselves. That law is no law of nature, and asked only of who promises it.
void RunJudge::judge_velocity(const SolidsInStep& there, const StepJudgement& judged, const Follower& follower) {
  const TraceStep& record = there.step();
  const Wanted& wanted = follower.wanted;
  const bool crushed =
      !judged.crushed.empty() || (!judged.crushed_with_room.empty() && contains(header_.guarantees, Clause::crush));
  const bool excused = !record.start_overlap.empty() || !judged.end_overlap.empty() || crushed || record.stuck ||
                       record.dropped || header_.substeps > 1 || wanted.parts > 1 || judged.beside_another;
  if (excused || !contains(header_.guarantees, Clause::velocity)) return;
  const Vec2d up = up_in(record, header_);
  if (stairs_climbed(detail::StepView{header_, scenery(), record}, wanted) > 0) {
    const double changed = (record.velocity - wanted.velocity).dot(right_of(up));
    if (stands(record) && std::abs(changed) > same_speed * (1 + wanted.velocity.norm()))
      note(Clause::velocity, record, fmt::format("climbs a stair, which changes its speed by {:.3g} m/s", changed));
    return;
  }
  ControlledStep step{.wanted = wanted.velocity, .up = up};
  step.unsteered = wanted.velocity - wanted.steered / length_of(record, header_) * right_of(up);
  step.side_hit_ends_rise = header_.character.side_hit_ends_rise;
  step.sides = sides_of(header_, up);
  const std::vector<MetSurface> surfaces = met_surfaces(there, record.contacts, wanted);
  // What turns has no one normal in a step, nor has the ground that is left one velocity: there only its size is
  // judged.
  const auto turns = [](const MetSurface& at) { return at.spread > hardly_turns; };
  const std::optional<TraceRide> carrier = record.from             ? record.from->ride
                                           : follower.last.empty() ? std::nullopt
                                                                   : follower.last.back().ride;
  const bool is_bounded_only =
      std::ranges::any_of(surfaces, turns) || (carrier && there.spread(carrier->collider, carrier->velocity, 1) > 0);
  if (is_bounded_only) return;
  if (const auto fault = velocity_fault(step, surfaces, record.velocity)) note(Clause::velocity, record, *fault);
}

}  // namespace paperproof::compare
