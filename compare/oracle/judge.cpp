#include "oracle/judge.hpp"

#include "contains.hpp"
#include "oracle/claims.hpp"
#include "oracle/contacts.hpp"
#include "oracle/crush.hpp"
#include "oracle/exemptions.hpp"
#include "oracle/hanging.hpp"
#include "oracle/later_parts.hpp"
#include "oracle/legs.hpp"
#include "oracle/met_surfaces.hpp"
#include "oracle/passing.hpp"
#include "oracle/turning.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace paperproof::compare {
namespace {

/// A time of impact is told where what that comes to is no more than this along the normal [m].
constexpr double least_told = 5e-7;
/// Normals of one face differ by no more than this, by rounding.
constexpr double same_normal = 1e-6;
/// A smaller share of the wanted motion is rounding.
constexpr double rounding_of_loss = 1e-5;
/// Who begins inside of what turns is put aside by at most so many times the depth.
constexpr double most_of_depth = 4;

/// Takes back what another that is near may have brought about.
void excuse_beside_another(const TraceStep& step, StepJudgement& judgement) {
  std::erase_if(judgement.contacts, [&step](const ExactContact& exact) {
    return std::ranges::none_of(step.contacts, [&exact](const Contact& contact) {
      return contact.collider == exact.collider && contact.side == exact.side;
    });
  });
  judgement.ghosts.clear();
  judgement.first_impact.reset();
  judgement.first_approach.reset();
  judgement.hangs = judgement.hovers = judgement.ground_refuted = judgement.ground_late = judgement.ground_missed =
      false;
  judgement.ground_left = judgement.kerb_missed = judgement.start_mishandled = judgement.stuck_refuted = false;
  judgement.motion_lost = judgement.ghost_speed_loss = judgement.speed_lost = judgement.speed_gained = 0;
  judgement.way_gained = judgement.leg_error = judgement.end_error = 0;
  judgement.crept.setZero();
}

/// What was requested tells of no contact, and no time, after what turns was met, or in a later part than the first.
void leave_out_what_follows(const TraceStep& step, int parts, StepJudgement& judgement) {
  const auto bends = [](const VertexWay& way) { return way.instants.size() > 2; };
  const bool in_parts = std::ranges::any_of(step.vertex_ways, bends);
  const auto is_reported = [&](const ExactContact& exact) {
    return std::ranges::any_of(step.contacts,
                               [&](const Contact& contact) { return contact.collider == exact.collider; });
  };
  std::erase_if(judgement.contacts, [&](const ExactContact& exact) {
    if (!exact.foreseen || is_reported(exact)) return false;
    const bool later = exact.fraction * parts > 1;
    judgement.in_parts = judgement.in_parts || later;
    return later || (judgement.first_impact && exact.fraction > *judgement.first_impact);
  });
  if (!in_parts) return;
  judgement.first_impact_comparable = false;
  if (!judgement.first_approach || step.contacts.empty()) return;
  // In each part the character waits at first.
  const bool is_told =
      *judgement.first_impact * parts <= 1 && detail::waited_in_part * *judgement.first_approach <= least_told;
  judgement.in_parts = judgement.in_parts || !is_told;
  if (!is_told) judgement.first_approach.reset();
}

/// Adds the reported contacts with the rest that a contact with what turns pushes the octagon against.
/// @param step the exact part of it.
void add_deflected(const ExactScenery& scenery, const TraceStep& step, const detail::TurningJudge& turning,
                   StepJudgement& judgement) {
  const auto is_known = [&](const Contact& contact) {
    return detail::is_exact(judgement, contact) ||
           contains(judgement.deflected, std::pair(contact.collider, contact.side));
  };
  const auto is_pushed = [&](const Contact& contact) {
    return std::ranges::any_of(judgement.contacts, [&](const ExactContact& one) {
      return turning.turns(one.collider) && one.normal.dot(contact.normal) < 0;
    });
  };
  const auto has_face = [&](const Contact& contact) {
    return std::ranges::any_of(step.path, [&](const PathPoint& corner) {
      return detail::any_face(scenery.near_parts({corner, step.movers}, detail::contact_reach),
                              [&](const NearPart& part, const NearFace& face) {
                                return part.collider == contact.collider &&
                                       (face.normal - contact.normal).norm() <= same_normal;
                              });
    });
  };
  for (const Contact& contact : step.contacts)
    if (!is_known(contact) && is_pushed(contact) && has_face(contact))
      judgement.deflected.emplace_back(contact.collider, contact.side);
}

/// How much too far a step goes that begins inside of what turns [m].
double turned_out_too_far(const TraceStep& step, const Wanted& wanted, const detail::TurningJudge& turning) {
  double way = 0;
  for (std::size_t k = 1; k < step.path.size(); ++k) way += (step.path[k].position - step.path[k - 1].position).norm();
  double depth = 0;  // in all of it together
  for (const NearPart& part : turning.near(step, step.path.front(), 0))
    depth += std::max(0.0, -part.faces.front().separation);
  const double most =
      most_of_depth * depth + turning.longest_way(step) + detail::push_beyond_motion + 2 * wanted.displacement.norm();
  return std::max(0.0, way - most);
}

/// Whether something is under a step that says it is grounded.
void judge_ground(const detail::StepView& at, StepJudgement& judgement) {
  const std::size_t end = at.step.path.size() - 1;
  const double rounding = party_of(at.header) == Party::promising ? 0 : ulp_at(at.header, at.step.path[end].position);
  const double within = detail::reach_of(at.header).contact + rounding;
  if (has_support(at, end, within)) return;
  for (std::size_t corner = 0; corner < end && allowed(Exempt::late_ground, at.header) > 0; ++corner)
    judgement.ground_late = judgement.ground_late || has_support(at, corner, within);
  judgement.ground_refuted = !judgement.ground_late;
}

}  // namespace

Judge::Sceneries::Sceneries(const TraceHeader& header)
    : octagon(detail::TurningJudge::exact_part(header), header.points) {}

Judge::Judge(const TraceHeader& header, const Judge* like)
    : header_(header),
      turning_(std::make_unique<detail::TurningJudge>(header_)),
      sceneries_(like != nullptr ? like->sceneries_ : std::make_shared<Sceneries>(header)),
      scenery_(sceneries_->octagon) {
  rim_ = detail::rim_of(header);
  promises_ = party_of(header) == Party::promising;
  for (const ColliderDef& def : header.scenery.colliders) {
    has_sensors_ = has_sensors_ || def.sensor;
    if (def.mover != no_mover) mover_count_ = std::max(mover_count_, std::size_t{def.mover} + 1);
  }
}

Judge::~Judge() = default;

std::vector<ColliderIndex> Judge::overlapped(const TraceStep& step) const {
  std::vector<ColliderIndex> all = scenery_.overlapped({step.path.front(), step.movers});
  const std::vector<ColliderIndex> turning = turning_->overlapped(step);
  all.insert(all.end(), turning.begin(), turning.end());
  std::ranges::sort(all);
  return all;
}

StepJudgement Judge::judge(const TraceStep& step, const Wanted* wanted, bool beside_another) {
  if (!turning_->any()) return judge_step(step, {}, wanted, beside_another);
  const AmongTurning turning{step, turning_->begin(step)};
  return judge_step(turning_->exact_part(step), what_turns(step), wanted, beside_another, &turning);
}

WhatTurns Judge::what_turns(const TraceStep& step) const {
  WhatTurns turns;
  turns.left_free = [this, &step](std::span<const PathPoint> way) { return turning_->left_free(step, way); };
  if (step.path.empty() || turning_->is_alone(step, std::max(detail::reach_of(header_).contact, own_reach(header_))))
    return turns;
  turns.near = [this, &step](const PathPoint& corner, double within) { return turning_->near(step, corner, within); };
  turns.near_at_end = [this, &step](double within) { return turning_->near_at_end(step, within); };
  turns.impacts_at_end = [this, &step](const Vec2d& displacement) {
    return turning_->impacts_at_end(step, displacement);
  };
  turns.runs_into = [this, &step](const PathPoint& corner, const Vec2d& way, double within) {
    return turning_->runs_into(step, corner, way, within);
  };
  turns.longest_way = turning_->longest_way(step);
  return turns;
}

StepJudgement Judge::judge_step(const TraceStep& step, const WhatTurns& turns, const Wanted* wanted,
                                bool beside_another, const AmongTurning* turning) {
  if (step.movers.size() < mover_count_) throw std::invalid_argument("a step needs the motion of every mover");
  if (!turns.near && !beside_another && repeats(step, wanted)) return last_->judgement;
  dt_ = length_of(step, header_);
  StepJudgement judgement;
  judgement.beside_another = beside_another;
  const Path path = path_of(step);
  if (path.empty()) return judgement;
  const bool goes_on = continues(step, path.front());
  if (!goes_on || header_.bodies > 0) begin_episodes(path.front(), goes_on);
  const bool begins_in_turning = turning != nullptr && turning->begins_inside;
  const bool starts_free = inside_.empty() && !begins_in_turning;
  if (!step.respawn && !promises_) judgement.remainder_made = step.remainder.x() - remainder_before_.x();
  // Before the way is judged: from which side it came into what it is inside of is known where the step begins.
  if (step.stuck && !starts_free)
    judgement.stuck_refuted = is_stuck_refuted(path.front(), turns, turning, begins_in_turning);
  leaving_ = promises_ && !starts_free ? leaving_of(path, turns, begins_in_turning) : Leaving{};
  const detail::StepView at{header_, scenery_, step, turns};
  if (!starts_free || !step.contacts.empty() || !step.crushed.empty() || turns.runs_into || !alone(path, step)) {
    judgement.end_overlap = scenery_.overlapped(path.back());
    judge_way(path, step, turns, judgement);
    leave_bodies_out(judgement);
    const ExactScenery* grown = promises_ ? &scenery_for(detail::least_clearance) : nullptr;
    judge_contacts(at, grown, starts_free, judgement);
  } else {
    measure_motion(at, starts_free, judgement);
  }
  if (turning != nullptr) {
    const int parts = wanted != nullptr ? std::max(wanted->parts / header_.substeps, 1) : 1;
    turning_->judge(turning->step, scenery_, parts, judgement);
    if (header_.path_exact) leave_out_what_follows(turning->step, parts, judgement);
    add_deflected(scenery_, step, *turning_, judgement);
    judgement.turning_sensor = turning_->meets_sensor(turning->step);
    // Events of sensors that turn are judged only where the character meets none: there each is invented.
    if (!judgement.turning_sensor)
      judgement.sensor_events_extra += static_cast<int>(turning->step.sensors.size() - step.sensors.size());
  }
  if (has_sensors_) judge_sensors(path, step, judgement);
  if (step.stuck && starts_free) {
    const bool ends_in_turning = std::ranges::any_of(
        judgement.end_overlap, [this](ColliderIndex collider) { return turning_->turns(collider); });
    judgement.stuck_refuted =
        judgement.end_overlap.empty() || is_stuck_refuted(path.back(), turns, turning, ends_in_turning);
  }
  judge_progress(at, wanted, starts_free, judgement);
  if (beside_another) excuse_beside_another(step, judgement);
  last_end_.emplace(path.back());
  last_.reset();
  if (path.size() == 1 && inside_.empty() && !beside_another && step.remainder == remainder_before_)
    last_.emplace(Last{step, wanted != nullptr ? std::optional(*wanted) : std::nullopt, judgement});
  remainder_before_ = step.remainder;
  return judgement;
}

/// Corners where nothing moves are left out; a way that ends early waits where it is while the movers go on.
Judge::Path Judge::path_of(const TraceStep& step) const {
  Path path;
  for (const PathPoint& corner : step.path) {
    const bool still = !path.empty() && path.back().position == corner.position;
    if (still && (mover_count_ == 0 || path.back().fraction == corner.fraction)) continue;
    path.emplace_back(corner, step.movers);
  }
  if (mover_count_ > 0 && !path.empty() && path.back().fraction < 1) {
    path.emplace_back(path.back().position, step.movers, 1);
  }
  return path;
}

bool Judge::alone(const Path& path, const TraceStep& step) const {
  Box2 reach = Box2::nowhere();
  for (const Place& corner : path) reach = reach.with(corner.position).with(corner.position + step.requested);
  // What is requested is looked at from every corner, for as long as a whole step.
  return scenery_.near(Place(reach.lower, step.movers, 0), Place(reach.upper, step.movers, 2), box2d_skin).empty();
}

bool Judge::repeats(const TraceStep& step, const Wanted* wanted) const {
  if (!last_ || step.respawn || last_->wanted.has_value() != (wanted != nullptr)) return false;
  const TraceStep& last = last_->step;
  const auto same_corner = [](const PathPoint& a, const PathPoint& b) {
    return a.position == b.position && a.fraction == b.fraction;
  };
  const auto same_contact = [](const Contact& a, const Contact& b) {
    return a.collider == b.collider && a.side == b.side && a.normal == b.normal && a.point == b.point &&
           a.fraction == b.fraction && a.separation == b.separation;
  };
  const auto same_ride = [](const TraceRide& a, const TraceRide& b) {
    return a.collider == b.collider && a.velocity == b.velocity;
  };
  const bool same_state = step.velocity == last.velocity && step.grounded == last.grounded &&
                          step.remainder == last.remainder && step.stuck == last.stuck && step.capped == last.capped &&
                          step.dropped == last.dropped && step.ride.has_value() == last.ride.has_value() &&
                          (!step.ride || same_ride(*step.ride, *last.ride));
  return same_state && length_of(step, header_) == length_of(last, header_) &&
         up_in(step, header_) == up_in(last, header_) && gravity_in(step, header_) == gravity_in(last, header_) &&
         step.requested == last.requested && step.steered == last.steered &&
         (wanted == nullptr || *wanted == *last_->wanted) && step.crushed == last.crushed &&
         step.dropped_through == last.dropped_through && step.sensors.empty() && last.sensors.empty() &&
         std::ranges::equal(step.movers, last.movers, same_motion) &&
         std::ranges::equal(step.path, last.path, same_corner) &&
         std::ranges::equal(step.contacts, last.contacts, same_contact);
}

bool Judge::continues(const TraceStep& step, const Place& start) const {
  const auto goes_on = [](const MoverMotion& now, const MoverMotion& before) { return now.from == before.to; };
  const auto bodies = static_cast<std::ptrdiff_t>(header_.bodies);
  return !step.respawn && last_end_ && last_end_->position == start.position &&
         std::equal(step.movers.begin(), step.movers.end() - bodies, last_end_->movers.begin(),
                    last_end_->movers.end() - bodies, goes_on);
}

/// Whether characters overlap or pass each other is asked of their places: see `CompanyJudge`.
void Judge::leave_bodies_out(StepJudgement& judgement) const {
  const auto is_body = [this](ColliderIndex collider) { return header_.is_body(collider); };
  for (std::vector<ColliderIndex>* found : {&judgement.entered, &judgement.rounded, &judgement.pressed,
                                            &judgement.drawn, &judgement.tunnelled, &judgement.clipped})
    std::erase_if(*found, is_body);
  std::erase_if(judgement.passings, [&](const Passing& passing) { return is_body(passing.collider); });
}

const ExactScenery& Judge::scenery_for(double larger) {
  std::unique_ptr<ExactScenery>& scenery = sceneries_->larger[larger];
  if (!scenery) scenery = std::make_unique<ExactScenery>(scenery_.scenery(), detail::grown(header_.points, larger));
  return *scenery;
}

void Judge::judge_progress(const detail::StepView& at, const Wanted* wanted, bool starts_free,
                           StepJudgement& judgement) {
  const TraceStep& step = at.step;
  const WhatTurns& turns = at.turns;
  const detail::LaterParts later =
      wanted != nullptr ? detail::later_parts(header_, step, *wanted) : detail::LaterParts{};
  std::optional<TraceStep> whole;
  if (later.any()) whole.emplace(step).requested += later.way;
  const bool promised = promises_ && wanted != nullptr;
  const Wanted* const walk = promised && begins_as_walk(header_, step, *wanted) ? wanted : nullptr;
  const detail::StepView all{header_, scenery_, whole ? *whole : step, turns};
  if (promised) {
    detail::judge_end(at, all, scenery_for(detail::contact_reach), *wanted, later, starts_free, judgement);
    // What turns is no part of the scenery that was asked.
    const double probed = header_.character.snap + header_.character.step_height + detail::extent_of(header_.points);
    if ((judgement.ground_left || judgement.kerb_missed) && !turning_->is_alone(step, probed))
      judgement.ground_left = judgement.kerb_missed = false;
    judge_legs(at, *wanted, later, judgement);
  } else if (step.grounded) {
    judge_ground(all, judgement);
  }
  excuse_by_turning(step, later, turns, judgement);
  const bool breaks_crush = !judgement.crushed_with_room.empty() && contains(header_.guarantees, Clause::crush);
  // What a crush stops is not stopped by nothing, and one breach is said once.
  if (breaks_crush) judgement.motion_lost = judgement.ghost_speed_loss = judgement.speed_lost = 0;
  if (breaks_crush || !judgement.crushed.empty()) return;
  const Vec2d before = step.respawn ? step.remainder : remainder_before_;
  Vec2d made = step.path.back().position - step.path.front().position;
  if (!promises_) made += step.remainder - before;  // a grid's
  const detail::Reach own = detail::reach_of(header_);
  judgement.hangs = hangs(all, walk, made, own);
  judgement.unsure =
      judgement.unsure || (turns.runs_into && !judgement.hangs && hangs(all, walk, made, own, detail::Bounds::nominal));
  judgement.hovers = judgement.hovers || (own.contact > detail::exact_reach.contact && !judgement.hangs &&
                                          hangs(all, walk, made, detail::exact_reach));
}

/// How far and how fast the step goes at most, and whether it leaves what it begins inside of as it must.
void Judge::judge_legs(const detail::StepView& at, const Wanted& wanted, const detail::LaterParts& later,
                       StepJudgement& judgement) const {
  const TraceStep& step = at.step;
  const bool held = leaving_.inside && !leaving_.free && (!leaving_.turning || step.stuck);
  const bool says_so = step.stuck || !judgement.crushed.empty() || !judgement.crushed_with_room.empty();
  const bool as_law = !leaving_.inside && !says_so && judgement.end_overlap.empty();
  const std::size_t begin = leaving_.inside && leaving_.at_once ? 1 : 0;
  const detail::LegFaults faults = leg_faults(at, wanted, later, held, begin, as_law);
  judgement.unsure = judgement.unsure || !faults.knows_speeds;
  const bool stays = held && !judgement.end_overlap.empty();
  judgement.start_mishandled =
      leaving_.longer || (stays && !says_so) || (held && (faults.way_gained > 0 || faults.speed_gained > 0));
  if (held) return;
  judgement.way_gained = leaving_.turning ? turned_out_too_far(step, wanted, *turning_) : faults.way_gained;
  judgement.speed_gained = faults.speed_gained;
  judgement.leg_error = faults.leg_error;
  judgement.end_error = faults.end_error;
  judgement.crept = faults.crept;
}

/// Takes back what all parts of the step together did not want, or what something that turns may have taken.
void Judge::excuse_by_turning(const TraceStep& step, const detail::LaterParts& later, const WhatTurns& turns,
                              StepJudgement& judgement) const {
  const auto any_lost = [&] { return judgement.motion_lost > 0 || judgement.ghost_speed_loss > 0; };
  if (!any_lost() || !(later.any() || turns.runs_into)) return;
  const Vec2d up = up_in(step, header_);
  const Vec2d right = right_of(up);
  const double wanted = step.requested.dot(right);
  const double ahead = std::copysign(1.0, wanted);
  const auto slowed = [&](const Vec2d& by, double steered) { return std::max(0.0, steered - ahead * by.dot(right)); };
  const double steered = ahead > 0 ? -later.slower : later.faster;
  const double carried = turns.runs_into ? turning_->carries_otherwise(step) : 0;
  judgement.motion_lost -= slowed(later.way, later.steered_way(steered)) + carried;
  judgement.ghost_speed_loss -= (slowed(later.velocity, steered) * dt_ + carried) / std::abs(wanted);
  if (!(judgement.motion_lost > rounding_of_loss * std::abs(wanted))) judgement.motion_lost = 0;
  if (!(judgement.ghost_speed_loss > rounding_of_loss)) judgement.ghost_speed_loss = 0;
  if (!turns.runs_into || !any_lost()) return;
  using Opposition = detail::TurningJudge::Opposition;
  const double beyond = ahead * (promises_ ? detail::contact_reach : own_reach(header_));
  const double rise = (step.path.back().position - step.path.front().position).dot(up);
  double unsure = 0;
  bool may_oppose = false;
  for (const PathPoint& corner : step.path) {
    for (const double height : {step.requested.dot(up), rise}) {
      const Opposition how = turning_->opposes(step, corner, (wanted + beyond) * right + height * up);
      may_oppose = may_oppose || how == Opposition::unsure;
      if (how == Opposition::met) judgement.motion_lost = judgement.ghost_speed_loss = 0;
      if (how == Opposition::met) return;
    }
    for (const NearPart& part : turning_->near(step, corner, own_reach(header_)))
      unsure = std::max(unsure, part.unsure);
  }
  const double lost = std::max(judgement.motion_lost, judgement.ghost_speed_loss * std::abs(wanted));
  if (!may_oppose && lost > unsure) return;
  judgement.unsure = true;
  judgement.motion_lost = judgement.ghost_speed_loss = 0;
}

void Judge::judge_sensors(const Path& path, const TraceStep& step, StepJudgement& judgement) const {
  judgement.sensor_events = scenery_.sensor_events(path);
  std::erase_if(judgement.sensor_events, [this](const auto& event) { return turning_->turns(event.sensor); });
  std::vector<bool> taken(step.sensors.size());
  const auto is_report_of = [&](const ExactSensorEvent& event, std::size_t i) {
    const SensorEvent& reported = step.sensors[i];
    return !taken[i] && reported.sensor == event.sensor && reported.change == event.change &&
           std::isfinite(reported.fraction);
  };
  for (const ExactSensorEvent& event : judgement.sensor_events) {
    std::size_t i = 0;
    while (i < taken.size() && !is_report_of(event, i)) ++i;
    if (i == taken.size()) {
      ++judgement.sensor_events_missing;
      continue;
    }
    taken[i] = true;
    const double error = std::abs(static_cast<double>(event.fraction - step.sensors[i].fraction));
    judgement.max_sensor_error = std::max(judgement.max_sensor_error, error);
    judgement.max_sensor_way = std::max(judgement.max_sensor_way, error * way_past(path, event.sensor));
  }
  judgement.sensor_events_extra += static_cast<int>(std::ranges::count(taken, false));
}

}  // namespace paperproof::compare
