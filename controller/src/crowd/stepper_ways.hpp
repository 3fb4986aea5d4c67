/// Stepper: the way of one character, part by part.
#pragma once

#include "crowd/parts.hpp"
#include "crowd/stepper.hpp"
#include "step_parts.hpp"

namespace paperproof::crowd {

/// Where a place is that nobody takes [m]: out of reach of everything.
inline constexpr double nowhere = 1e9;

/// @param after of several places at one moment the last one; else the first.
template <class Scalar, class Path>
[[nodiscard]] Vec2<Scalar> place_on(const Path& path, Scalar time, bool after) noexcept {
  std::size_t k = 0;
  while (k + 1 < path.size() && (after ? path[k + 1].fraction <= time : path[k + 1].fraction < time)) ++k;
  if (k + 1 == path.size() || path[k].fraction >= time) return path[k].position;
  const PathPoint<Scalar>& from = path[k];
  const PathPoint<Scalar>& to = path[k + 1];
  if (to.fraction <= time) return to.position;
  return from.position + (to.position - from.position) * ((time - from.fraction) / (to.fraction - from.fraction));
}

template <class Scalar>
[[nodiscard]] Way<Scalar> way_of(const MoveResult<Scalar>& move) noexcept {
  return {{move.path.begin(), move.path.size()}, 0, 1};
}

template <class Scalar>
[[nodiscard]] bool names(const MoveResult<Scalar>& move, ColliderIndex collider) noexcept {
  return std::find(move.crushed.begin(), move.crushed.end(), collider) != move.crushed.end();
}

/// Where somebody is at a moment of the step, on the way made or the way planned.
template <class Scalar>
Vec2<Scalar> Stepper<Scalar>::place(std::size_t i, Scalar time, bool after) noexcept {
  const Walker<Scalar>& walker = walkers_[i];
  const bool made = time < walker.now.time || (time == walker.now.time && !after);
  const auto& path = made && walker.now.time > 0 ? member(i).step.move.path : walker.plan.path;
  return place_on<Scalar>(path, time, after);
}

/// The next moment at which somebody to whom it gives way changes course, or the end of the step.
template <class Scalar>
Scalar Stepper<Scalar>::next_corner(const Walker<Scalar>& walker, Scalar time) noexcept {
  Scalar next = 1;
  const auto look_at = [&](const auto& path) {
    for (const PathPoint<Scalar>& corner : path)
      if (corner.fraction > time && corner.fraction < next) next = corner.fraction;
  };
  for (const CharacterIndex other : walker.company) {
    if (walkers_[other].now.time > time) look_at(member(other).step.move.path);
    look_at(walkers_[other].plan.path);
  }
  return next;
}

template <class Scalar>
void Stepper<Scalar>::set_motions(const Company& company, Scalar begin, Scalar end) noexcept {
  std::vector<MoverMotion<Scalar>>& motions = memory_.motions;
  for (std::size_t k = 0; k < movers_.size(); ++k)
    motions[k] = {begin > 0 ? movers_[k].at(begin) : movers_[k].from, movers_[k].at(end)};
  for (std::size_t k = 0; k < most_company; ++k) {
    MoverMotion<Scalar>& motion = motions[movers_.size() + k];
    if (k < company.size())
      motion = {place(company[k], begin, true), place(company[k], end, false)};
    else
      motion.from = motion.to = V::Constant(static_cast<Scalar>(nowhere));
  }
}

template <class Scalar>
MoveRequest<Scalar> Stepper<Scalar>::request_at(const Walker<Scalar>& walker, const Moment<Scalar>& at,
                                                Scalar end) noexcept {
  const Scalar duration = dt_ * (end - at.time);
  return {.position = at.state.position,
          .displacement = at.own * duration,
          .velocity = at.own,
          .steered = at.steered,
          .last_free = at.state.last_free,
          .has_last_free = at.state.has_last_free,
          .grounded = walker.walks && !walker.no_snap && end == 1,
          .crushed = at.state.crushed,
          .drop = walker.drops,
          .crushers = {at.state.crushers.begin(), at.state.crushers.end()},
          .movers = memory_.motions,
          .dt = duration,
          .ride = at.state.ride};
}

/// The way from a moment on, in parts during which everybody it gives way to goes straight. False where it would leave
/// the range, or takes no time.
/// @param at becomes the moment in which the way ends.
template <class Scalar>
bool Stepper<Scalar>::ask(std::size_t i, Scalar until, MoveResult<Scalar>& way, Moment<Scalar>& at) noexcept {
  const Walker<Scalar>& walker = walkers_[i];
  way.clear();
  while (at.time < until) {
    const Scalar end = std::min(until, next_corner(walker, at.time));
    set_motions(walker.company, at.time, end);
    const MoveRequest<Scalar> request = request_at(walker, at, end);
    if (!(request.dt > 0)) return false;
    sweep_.move_part(at.time > 0 ? Part::rest : Part::whole, request, scratch_, memory_.part);
    if (memory_.part.status == MoveStatus::out_of_range) return false;
    append(memory_.part, at.time, end, way);
    pass_on(memory_.part, end, at);
  }
  return !way.path.overflowed() && !way.path.empty();
}

template <class Scalar>
void Stepper<Scalar>::append(const MoveResult<Scalar>& part, Scalar begin, Scalar end,
                             MoveResult<Scalar>& way) const noexcept {
  const Way<Scalar> when{{part.path.begin(), part.path.size()}, begin, end};
  for (const PathPoint<Scalar>& corner : part.path) add_corner(way, {corner.position, when.time_of(corner.fraction)});
  if (part.path.overflowed())
    while (!way.path.overflowed()) way.path.push_back(part.path.back());
  for (Contact<Scalar> contact : part.contacts) {
    contact.fraction = when.time_of(contact.fraction);
    add_contact(way, contact);
  }
  for (const ColliderIndex collider : part.crushed)
    if (!names(way, collider)) way.crushed.push_back(collider);
  const bool dropped = way.status == MoveStatus::dropped && part.status == MoveStatus::moved;
  if (!way.crushed.empty())
    way.status = MoveStatus::crushed;
  else if (!dropped)
    way.status = part.status;
  take_end(part, way);
}

template <class Scalar>
void Stepper<Scalar>::pass_on(const MoveResult<Scalar>& part, Scalar end, Moment<Scalar>& at) const noexcept {
  CharacterState<Scalar>& state = at.state;
  at.time = end;
  state.position = part.position;
  state.grounded = part.grounded;
  state.ride = part.ride;
  const Scalar fall = at.own.y();
  at.own = part.velocity;
  if (!part.contacts.empty()) at.steered = 0;  // from here on it is momentum
  if (state.ride.ground != Ride<Scalar>::none) at.own -= state.ride.velocity;
  // What held it took its weight, which goes on for the rest of the step.
  if (part.grounded || (fall < 0 && at.own.y() > fall / 2)) at.own += gravity_ * dt_;
  step_parts::note_freedom(part, state);
  if (state.crushed)
    remember(part.crushers, state);
  else
    state.crushers.clear();
}

/// Places for company are taken by others in the next step.
template <class Scalar>
void Stepper<Scalar>::remember(const Crushers<Scalar>& crushers, CharacterState<Scalar>& state) const noexcept {
  state.crushers.clear();
  for (const Crusher<Scalar>& crusher : crushers)
    if (!is_companion(crusher.collider)) state.crushers.push_back(crusher);
}

template <class Scalar>
typename Stepper<Scalar>::Outcome Stepper<Scalar>::outcome_of(std::size_t i, const MoveResult<Scalar>& way) noexcept {
  Outcome outcome;
  for (const ColliderIndex collider : way.crushed) {
    if (is_companion(collider))
      outcome.run_over = true;
    else if (!names(walkers_[i].plan, collider) && !names(member(i).step.move, collider))
      outcome.pressed = true;
  }
  return outcome;
}

/// A new way for the rest of the step.
template <class Scalar>
typename Stepper<Scalar>::Outcome Stepper<Scalar>::plan(std::size_t i) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  Outcome outcome;
  if (walker.now.time < 1) {
    MoveResult<Scalar>& way = memory_.way;
    Moment<Scalar> end = walker.now;
    if (!ask(i, 1, way, end)) {
      stay(i);
      return outcome;
    }
    outcome = outcome_of(i, way);
    walker.plan = way;
    walker.end = end;
    walker.box = box_along(space_, walker.plan.path);
  } else {
    stay(i);
  }
  return outcome;
}

template <class Scalar>
void Stepper<Scalar>::ask_to_stay(std::size_t i) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  const Moment<Scalar>& from = walker.now;
  MoveResult<Scalar>& way = walker.plan;
  way.clear();
  walker.end = from;
  if (from.time < 1) {
    set_motions({}, from.time, 1);
    MoveRequest<Scalar> request = request_at(walker, from, 1);
    request.displacement = request.velocity = V::Zero();
    request.ride = {};
    sweep_.move_part(Part::stay, request, scratch_, memory_.part);
    append(memory_.part, from.time, 1, way);
    pass_on(memory_.part, 1, walker.end);
  } else {
    way.path.push_back({from.state.position, 1});
  }
  way.position = from.state.position;
  way.velocity = V::Zero();
}

/// For the rest of the step, in the world.
template <class Scalar>
void Stepper<Scalar>::stay(std::size_t i) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  walker.stays = walker.dropped = true;
  ask_to_stay(i);
  walker.box = box_along(space_, walker.plan.path);
}

/// Adds a part of the way to what was made.
template <class Scalar>
void Stepper<Scalar>::make(std::size_t i, const MoveResult<Scalar>& way) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  MoveResult<Scalar>& made = member(i).step.move;
  for (const PathPoint<Scalar>& corner : way.path) add_corner(made, corner);
  for (const Contact<Scalar>& contact : way.contacts) {
    if (!is_companion(contact.collider)) {
      add_contact(made, contact);
      continue;
    }
    const CharacterIndex other = walker.company[contact.collider - surrounded_.first_companion];
    note_meeting(member(i), other, contact.normal, contact.fraction);
    note_meeting(member(other), i, V(-contact.normal), contact.fraction);
  }
  for (const ColliderIndex collider : way.crushed)
    if (!is_companion(collider) && !names(made, collider)) made.crushed.push_back(collider, memory_.crushed[i]);
  walker.dropped = walker.dropped || way.status == MoveStatus::dropped;
  made.status = way.status;
  take_end(way, made);
}

/// Makes the planned way up to a time: the technique is asked again, with less to go.
template <class Scalar>
void Stepper<Scalar>::go_on_to(std::size_t i, Scalar time) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  if (!(time > walker.now.time)) return;
  const V there = place(i, time, false);
  Moment<Scalar> at = walker.now;
  const bool answered = ask(i, time, memory_.way, at);
  if (answered && (at.state.position - there).cwiseAbs().maxCoeff() <= Tolerances<Scalar>{}.certain) {
    walker.now = at;
  } else {
    if (answered) walker.now = at;
    cut_plan(i, time, there);
  }
  make(i, memory_.way);
}

/// With less to go the technique would take another way, as where it gives way to what comes later: the one that was
/// planned is made as it is.
template <class Scalar>
void Stepper<Scalar>::cut_plan(std::size_t i, Scalar time, const V& there) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  const MoveResult<Scalar>& plan = walker.plan;
  MoveResult<Scalar>& way = memory_.way;
  way.clear();
  for (const PathPoint<Scalar>& corner : plan.path)
    if (corner.fraction < time) add_corner(way, corner);
  add_corner(way, {there, time});
  for (const Contact<Scalar>& contact : plan.contacts)
    if (contact.fraction <= time) add_contact(way, contact);
  way.crushed = plan.crushed;
  way.status = plan.status;
  way.position = there;
  walker.now.time = time;
  walker.now.state.position = there;
  walker.now.state.crushed = walker.now.state.crushed || !plan.crushed.empty();
}

}  // namespace paperproof::crowd
