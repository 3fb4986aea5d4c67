/// Stepper: what happens where two meet.
#pragma once

#include "crowd/stepper_ways.hpp"

namespace paperproof::crowd {

template <class Scalar>
bool Stepper<Scalar>::gives_way_to(std::size_t i, std::size_t other) const noexcept {
  const auto& company = walkers_[i].company;
  return std::find(company.begin(), company.end(), other) != company.end();
}

template <class Scalar>
Meeting<Scalar> Stepper<Scalar>::meeting(std::size_t i, std::size_t j) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  if (!walkers_[i].box.overlaps(walkers_[j].box)) return {};
  // Who gives way comes as near as the technique lets it.
  const Scalar least = gives_way_to(i, j) || gives_way_to(j, i) ? tolerances.certain : tolerances.hit;
  return first_meeting(space_, way_of(walkers_[i].plan), way_of(walkers_[j].plan), time_, least);
}

/// Those who are nearer than they should be when the step begins: the technique restores their gap, as from solids.
template <class Scalar>
void Stepper<Scalar>::keep_company_from_the_start() noexcept {
  for (std::size_t i = 0; i < walkers_.size(); ++i) {
    Walker<Scalar>& walker = walkers_[i];
    for (std::size_t j = 0; j < walkers_.size(); ++j) {
      if (j == i || !walker.box.overlaps(walkers_[j].box)) continue;
      if (space_.separation(walker.now.state.position, walkers_[j].now.state.position) < Tolerances<Scalar>{}.hit)
        walker.company.push_back(static_cast<CharacterIndex>(j));
    }
    if (!walker.company.empty()) plan(i);
  }
}

/// Every impact changes the way of somebody who does not stay, and after so many changes it does; two that stay do not
/// meet. So it ends.
template <class Scalar>
void Stepper<Scalar>::solve() noexcept {
  keep_company_from_the_start();
  const auto when = [this](std::size_t i, std::size_t j) { return meeting(i, j); };
  timetable_.find_all(when);
  while (const std::optional<NextMeeting<Scalar>> next = timetable_.earliest()) {
    const auto& [i, j, found] = *next;
    time_ = std::max(time_, found.time);
    note_impact(*next, report_);
    if (found.at_once)
      meet_at_once(i, j, found);
    else
      meet(i, j, found);
    timetable_.find_again(i, when);
    timetable_.find_again(j, when);
  }
}

/// What carries it [m/s].
template <class Scalar>
[[nodiscard]] Vec2<Scalar> velocity_of(const Ride<Scalar>& ride) noexcept {
  return ride.ground != Ride<Scalar>::none ? ride.velocity : Vec2<Scalar>(Vec2<Scalar>::Zero());
}

/// What carries both alike [m/s]: seen from there they go as they would on ground that stands.
template <class Scalar>
Vec2<Scalar> Stepper<Scalar>::common_ride(std::size_t i, std::size_t j) const noexcept {
  const V ride = velocity_of(walkers_[i].plan.ride);
  return ride == velocity_of(walkers_[j].plan.ride) ? ride : V(V::Zero());
}

template <class Scalar>
void Stepper<Scalar>::meet(std::size_t i, std::size_t j, const Meeting<Scalar>& meeting) noexcept {
  const V ride = common_ride(i, j);
  const V& normal = meeting.normal;
  const V first_rate = meeting.first_rate - ride * dt_;
  const V second_rate = meeting.second_rate - ride * dt_;
  const MovesIn moves = who_moves_in(first_rate, second_rate, normal);
  if (!moves.second || walkers_[j].stays) return one_gives_way(i, j);
  if (!moves.first || walkers_[i].stays) return one_gives_way(j, i);
  go_on_to(i, time_);
  go_on_to(j, time_);
  const Scalar away = dot(ride, normal);
  slow_down(i, normal, std::max(Scalar(0), -dot(second_rate, normal)) / dt_ - away);
  slow_down(j, V(-normal), std::max(Scalar(0), dot(first_rate, normal)) / dt_ + away);
  const auto [upper, lower] = is_above(i, j) ? std::pair(i, j) : std::pair(j, i);
  // The upper one stands still as an obstacle first. Otherwise the ground would deflect the lower one's motion into it
  // and push it. A lower one that a mover pushes does push it on.
  stand_still(upper, velocity_of(walkers_[lower].plan.ride));
  if (!give_way(lower, upper).free()) take_back(lower, upper);
  one_gives_way(upper, lower);
}

/// Seen from what is carried like that [m/s], until it has a new way.
template <class Scalar>
void Stepper<Scalar>::stand_still(std::size_t i, const V& ride) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  const Moment<Scalar>& now = walker.now;
  walker.plan.path.clear();
  walker.plan.path.push_back({now.state.position, now.time});
  walker.plan.path.push_back({now.state.position + ride * (dt_ * (1 - now.time)), 1});
}

/// Of two at one height the left one: who gives way does not depend on the order in which they are given.
template <class Scalar>
bool Stepper<Scalar>::is_above(std::size_t i, std::size_t j) const noexcept {
  const V& a = walkers_[i].start.state.position;
  const V& b = walkers_[j].start.state.position;
  return a.y() > b.y() || (a.y() == b.y() && a.x() <= b.x());
}

/// What it wants itself: no faster than `limit` against the normal, in the world [m/s].
template <class Scalar>
void Stepper<Scalar>::slow_down(std::size_t i, const V& normal, Scalar limit) noexcept {
  Moment<Scalar>& now = walkers_[i].now;
  const V ride = velocity_of(now.state.ride);
  now.own = slowed(V(now.own + ride), normal, limit, walkable_cosine_) - ride;
}

/// There is no giving way within a part that takes no time. Following the ground down is left out instead; a way out,
/// or to the right gap, when the step begins is looked for anew, and then not taken.
template <class Scalar>
void Stepper<Scalar>::meet_at_once(std::size_t i, std::size_t j, const Meeting<Scalar>& meeting) noexcept {
  const std::size_t who = meeting.first_rate == V::Zero() ? j : i;
  const std::size_t whom = who == i ? j : i;
  Walker<Scalar>& walker = walkers_[who];
  if (time_ > walker.now.time && !walker.no_snap) {
    walker.no_snap = true;
    plan(who);
  } else if (!gives_way_to(who, whom) && may_go_on(who)) {
    give_way(who, whom);
  } else {
    go_on_to(who, time_);
    stay(who);
  }
}

/// False where it met so many that it stays now. Before that it gives up what it wants itself.
template <class Scalar>
bool Stepper<Scalar>::may_go_on(std::size_t i) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  go_on_to(i, time_);
  if (++walker.changes == most_changes_) {
    walker.dropped = true;
    walker.now.own = walker.now.state.grounded ? V(gravity_ * dt_) : V(V::Zero());
  }
  if (walker.changes < 2 * most_changes_) return true;
  stay(i);
  return false;
}

/// A new way for one, to which the other is an obstacle.
template <class Scalar>
typename Stepper<Scalar>::Outcome Stepper<Scalar>::give_way(std::size_t i, std::size_t other) noexcept {
  go_on_to(i, time_);
  if (gives_way_to(i, other) || walkers_[i].company.push_back(static_cast<CharacterIndex>(other))) return plan(i);
  stay(i);
  return {};
}

/// As before it gave way.
template <class Scalar>
void Stepper<Scalar>::take_back(std::size_t i, std::size_t other) noexcept {
  Walker<Scalar>& walker = walkers_[i];
  if (walker.stays) return;
  const Company company = walker.company;
  walker.company.clear();
  for (const CharacterIndex each : company)
    if (each != other) walker.company.push_back(each);
  plan(i);
}

/// First `i` gives way. If it is pushed and has no room, `other` gives way. If neither has room, `i` is squeezed: it
/// then heeds only `other`, so that whatever pushed `i` must heed `i`.
template <class Scalar>
void Stepper<Scalar>::one_gives_way(std::size_t i, std::size_t other) noexcept {
  if (!may_go_on(i)) return;
  const Outcome first = give_way(i, other);
  if (first.free()) return;
  if (!walkers_[other].stays) {
    take_back(i, other);
    const Outcome second = give_way(other, i);
    if (second.free()) return;
    take_back(other, i);
    if (first.run_over && !second.run_over) {
      give_way(other, i);
      return;
    }
  }
  if (!first.run_over && !give_way(i, other).run_over) return;
  walkers_[i].company.clear();
  if (give_way(i, other).run_over) stay(i);
}

}  // namespace paperproof::crowd
