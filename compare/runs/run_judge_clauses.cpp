/// What the judgement of a step breaks, clause by clause, and whether its velocity is what the law makes.
#include "runs/run_judge.hpp"

#include "contains.hpp"
#include "oracle/legs.hpp"
#include "oracle/response_laws.hpp"
#include "oracle/turning.hpp"
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
  const auto check = [&](Clause clause, bool broken, const auto& words) {
    if (broken) note(clause, record, words());
  };
  check(Clause::overlap, !judged.entered.empty() || !judged.company.entered.empty(),
        [&] { return "ends inside " + name(judged.entered); });
  check(Clause::passage, !judged.tunnelled.empty() || !judged.company.passed.empty(),
        [&] { return "passes through " + name(judged.tunnelled); });
  check(Clause::one_way, !judged.one_way_broken.empty(),
        [&] { return "passes " + name(judged.one_way_broken) + " against its normal"; });
  check(Clause::gap, judged.max_contact_gap > guaranteed_gap,
        [&] { return "a contact is " + metres(judged.max_contact_gap) + " away"; });
  check(Clause::normal, judged.normal_error.value_or(0) > rounding_of_normal,
        [&] { return fmt::format("a normal is {:.3g} degrees off", *judged.normal_error); });
  check(Clause::normal,
        std::any_of(record.contacts.begin(), record.contacts.end(),
                    [](const Contact& contact) { return std::abs(contact.normal.norm() - 1) > rounding_of_unit; }),
        [] { return std::string("a normal is no unit vector"); });
  check(Clause::sensor, judged.sensor_events_missing > 0 || judged.sensor_events_extra > 0, [&] {
    return std::string(judged.sensor_events_missing > 0 ? "a sensor's event is missing"
                                                        : "reports a sensor's event that was none");
  });
  check(Clause::sensor, judged.max_sensor_way > guaranteed_gap,
        [&] { return fmt::format("a sensor's event is {:.3g} of the step off", judged.max_sensor_error); });
  check(Clause::sensor,
        !std::is_sorted(record.sensors.begin(), record.sensors.end(),
                        [](const auto& a, const auto& b) { return a.fraction < b.fraction; }),
        [] { return std::string("the events of sensors are not in order of time"); });
  check(Clause::start_inside, judged.stuck_refuted, [] { return std::string("says it is stuck beside a way out"); });
  check(Clause::start_inside, judged.start_mishandled,
        [] { return std::string("begins inside, and neither leaves by the shortest way out nor stays and says so"); });
  check(Clause::velocity, !(judged.way_gained <= 0),
        [&] { return "goes " + metres(judged.way_gained) + " more or less than the law allows"; });
  check(Clause::velocity, !(judged.leg_error <= 0),
        [&] { return "goes another way than the law makes, by " + metres(judged.leg_error); });
  check(Clause::velocity, !(judged.end_error <= 0),
        [&] { return "goes another way than its velocity at the end says, by " + metres(judged.end_error); });
  check(Clause::velocity, !(judged.speed_gained <= 0),
        [&] { return fmt::format("is {:.3g} m/s faster or slower than the law allows", judged.speed_gained); });
  check(Clause::hanging, judged.hangs, [] { return std::string("hangs in the air"); });
  check(Clause::speed_lost, judged.motion_lost > 0,
        [&] { return "loses " + metres(judged.motion_lost) + " of its horizontal way to nothing"; });
  check(Clause::speed_lost, judged.motion_lost == 0 && (judged.speed_lost > 0 || judged.ghost_speed_loss > 0), [&] {
    return judged.speed_lost > 0
               ? fmt::format("loses {:.3g} m/s to nothing", judged.speed_lost)
               : fmt::format("loses {:.3g} % of its horizontal speed to nothing", 100 * judged.ghost_speed_loss);
  });
  check(Clause::ground_invented, judged.ground_refuted, [&] { return no_ground(header_); });
  check(Clause::ground_missed, judged.ground_missed,
        [] { return std::string("stands on ground, and says it does not"); });
  check(Clause::ground_missed, judged.ground_left,
        [] { return std::string("leaves ground that `snap` has it follow"); });
  check(Clause::speed_lost, judged.kerb_missed,
        [] { return std::string("is stopped by what `step_height` has it climb"); });
  check(Clause::crush, !judged.crushed_with_room.empty(),
        [&] { return "is crushed by " + name(judged.crushed_with_room) + " with room to give way"; });
  check(Clause::refusal, record.path.back().position.cwiseAbs().maxCoeff() > range || !(length_of(record, header_) > 0),
        [] { return std::string("takes a step that must be refused"); });
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
  const bool is_bounded_only = std::any_of(surfaces.begin(), surfaces.end(), turns) ||
                               (carrier && there.spread(carrier->collider, carrier->velocity, 1) > 0);
  if (is_bounded_only) return;
  if (const auto fault = velocity_fault(step, surfaces, record.velocity)) note(Clause::velocity, record, *fault);
}

}  // namespace paperproof::compare
