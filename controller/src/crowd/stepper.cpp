#include "crowd/stepper.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::crowd {
namespace {

template <class Scalar>
Scalar dot(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  return a.x() * b.x() + a.y() * b.y();
}

template <class Scalar>
bool touches(const MoveResult<Scalar>& move, Side side) noexcept {
  return std::any_of(move.contacts.begin(), move.contacts.end(),
                     [side](const Contact<Scalar>& contact) { return contact.side == side; });
}

/// One contact per collider and side, the earliest, as a technique reports them.
template <class Scalar>
void add_contact(MoveResult<Scalar>& move, const Contact<Scalar>& contact) noexcept {
  const bool known = std::any_of(move.contacts.begin(), move.contacts.end(), [&](const Contact<Scalar>& other) {
    return other.collider == contact.collider && other.side == contact.side;
  });
  if (!known) move.contacts.push_back(contact);
}

template <class Scalar>
void add_corner(MoveResult<Scalar>& move, const PathPoint<Scalar>& corner) noexcept {
  const bool known = !move.path.empty() && move.path.back().position == corner.position &&
                     move.path.back().fraction == corner.fraction;
  if (!known) move.path.push_back(corner);
}

template <class Scalar>
void clear(StepReport<Scalar>& report) noexcept {
  report.status = StepStatus::moved;
  report.move.clear();
  report.sensors.clear();
  report.dropped_through.clear();
}

/// Nothing but staying at a place.
template <class Scalar>
void report_stay(const Vec2<Scalar>& position, StepReport<Scalar>& report) noexcept {
  clear(report);
  report.move.path.push_back({position, 0});
  report.move.path.push_back({position, 1});
}

template <class Scalar>
void clear(CrowdMember<Scalar>& member) noexcept {
  clear(member.step);
  member.met.clear();
  member.started_overlapping.clear();
  member.stayed = false;
}

/// Bound of the rounding of a component of these rates along a normal.
template <class Scalar>
Scalar noise_of(const Vec2<Scalar>& a, const Vec2<Scalar>& b) noexcept {
  const Scalar largest = std::max({std::abs(a.x()), std::abs(a.y()), std::abs(b.x()), std::abs(b.y())});
  return std::numeric_limits<Scalar>::epsilon() * 64 * largest;
}

template <class Scalar, class Path>
Box2<Scalar> box_along(const PairSpace<Scalar>& space, const Path& path) noexcept {
  Box2<Scalar> box{path[0].position, path[0].position};
  for (const PathPoint<Scalar>& corner : path) box = box.merged({corner.position, corner.position});
  return Box2<Scalar>{box.lower + space.box().lower, box.upper + space.box().upper}.inflated(
      Tolerances<Scalar>{}.touch);
}

}  // namespace

template <class Scalar>
StepStatus Stepper<Scalar>::begin(std::span<const CharacterState<Scalar>> states,
                                  std::span<const Input> inputs) noexcept {
  report_.impacts = 0;
  for (std::size_t i = 0; i < runners_.size(); ++i) {
    Runner<Scalar>& runner = runners_[i];
    runner.state = states[i];
    runner.state.velocity = desired_velocity(controller_.character(), gravity_, inputs[i], dt_, runner.state);
    runner.jump_held = runner.state.jump_held;
    runner.jump_pending = runner.state.jump_pending;
    runner.begin = 0;
    runner.impacts = 0;
    runner.halted = runner.no_snap = runner.stands = runner.dropped = runner.stuck = false;
    clear(member(i));
    runner.walks = runner.state.grounded;
    runner.drops = inputs[i].drop;
    runner.held.clear();
    const StepStatus status = move(runner, dt_, true, runner.after, runner.plan);
    if (refused(status)) return status;
    member(i).step.requested = runner.plan.requested;
    find_box(runner);
  }
  note_overlaps(states);
  return StepStatus::moved;
}

/// The intent is in the velocity already; of the input only whether to drop is left.
template <class Scalar>
StepStatus Stepper<Scalar>::move(const Runner<Scalar>& runner, Scalar duration, bool follow_down,
                                 CharacterState<Scalar>& state, StepReport<Scalar>& report) noexcept {
  state = runner.state;
  state.grounded = runner.walks && follow_down && !runner.no_snap;
  const Input input{.move = std::nullopt, .jump = false, .drop = runner.drops};
  return controller_.step(state, input, V::Zero(), duration, memory_.technique, report);
}

/// A new way for the rest of the step.
template <class Scalar>
void Stepper<Scalar>::plan(std::size_t i) noexcept {
  Runner<Scalar>& runner = runners_[i];
  const Scalar duration = dt_ * (1 - runner.begin);
  if (!(duration > 0)) return stay(i);
  const bool usable = !refused(move(runner, duration, true, runner.after, runner.plan));
  const auto& made = member(i).step.move.path;
  if (!usable || made.size() + runner.plan.move.path.size() > made.capacity()) {
    runner.dropped = true;
    return halt(i);
  }
  find_box(runner);
}

template <class Scalar>
void Stepper<Scalar>::stay(std::size_t i) noexcept {
  Runner<Scalar>& runner = runners_[i];
  runner.after = runner.state;
  report_stay(runner.state.position, runner.plan);
  find_box(runner);
}

template <class Scalar>
void Stepper<Scalar>::halt(std::size_t i) noexcept {
  runners_[i].halted = true;
  runners_[i].state.velocity = V::Zero();
  stay(i);
}

template <class Scalar>
void Stepper<Scalar>::find_box(Runner<Scalar>& runner) noexcept {
  runner.box = box_along(rules_.space, runner.plan.move.path);
}

/// Adds a part of the way, up to the fraction `end` of the step, to what was made.
template <class Scalar>
void Stepper<Scalar>::commit(std::size_t i, const StepReport<Scalar>& part, Scalar end) noexcept {
  CrowdMember<Scalar>& made = member(i);
  const Way<Scalar> way{{part.move.path.begin(), part.move.path.size()}, runners_[i].begin, end};
  for (const PathPoint<Scalar>& corner : part.move.path)
    add_corner(made.step.move, {corner.position, way.time_of(corner.fraction)});
  for (Contact<Scalar> contact : part.move.contacts) {
    contact.fraction = way.time_of(contact.fraction);
    add_contact(made.step.move, contact);
  }
  for (SensorEvent<Scalar> event : part.sensors) {
    event.fraction = way.time_of(event.fraction);
    made.step.sensors.push_back(event);
  }
  for (const ColliderIndex chain : part.dropped_through) {
    const auto& known = made.step.dropped_through;
    if (std::find(known.begin(), known.end(), chain) == known.end()) made.step.dropped_through.push_back(chain);
  }
  runners_[i].stuck = part.status == StepStatus::stuck;
  runners_[i].dropped = runners_[i].dropped || part.status == StepStatus::dropped;
}

/// Makes the planned way up to a time: the technique is asked again, with less to go. What it answers is a way with all
/// its guarantees; a point between two corners, rounded, would not be.
template <class Scalar>
void Stepper<Scalar>::go_on_to(std::size_t i, Scalar time) noexcept {
  Runner<Scalar>& runner = runners_[i];
  const Scalar duration = dt_ * (time - runner.begin);
  if (!(duration > 0)) return;
  CharacterState<Scalar> state;
  // The ground is followed at the end of the step only: here it may have been left for a head.
  if (refused(move(runner, duration, false, state, memory_.part))) {
    runner.dropped = true;
    return;
  }
  commit(i, memory_.part, time);
  const V way = state.position - runner.state.position;
  if (std::max(std::abs(way.x()), std::abs(way.y())) > Tolerances<Scalar>{}.touch) runner.held.clear();
  runner.state = state;
  runner.begin = time;
  // The ground took its weight, which holds it to the ground for the rest as well.
  if (state.grounded) runner.state.velocity += gravity_ * dt_;
}

template <class Scalar>
Meeting<Scalar> Stepper<Scalar>::meeting(std::size_t i, std::size_t j) const noexcept {
  const Runner<Scalar>& first = runners_[i];
  const Runner<Scalar>& second = runners_[j];
  if (!first.box.overlaps(second.box)) return {};
  const auto way_of = [](const Runner<Scalar>& runner) {
    return Way<Scalar>{{runner.plan.move.path.begin(), runner.plan.move.path.size()}, runner.begin, 1};
  };
  return first_meeting(rules_.space, way_of(first), way_of(second), now_, Tolerances<Scalar>{}.hit);
}

template <class Scalar>
void Stepper<Scalar>::find_row(std::size_t i) noexcept {
  RowBest<Scalar>& best = rows_[i];
  best = {};
  for (std::size_t j = i + 1; j < runners_.size(); ++j) {
    const Meeting<Scalar> found = meeting(i, j);
    if (found.meets && (!best.meeting.meets || found.time < best.meeting.time))
      best = {found, static_cast<CharacterIndex>(j)};
  }
}

/// One character has a new way: its own row, and what other rows know about it.
template <class Scalar>
void Stepper<Scalar>::find_again(std::size_t changed) noexcept {
  find_row(changed);
  for (std::size_t i = 0; i < changed; ++i) {
    RowBest<Scalar>& best = rows_[i];
    if (best.meeting.meets && best.other == changed) {
      find_row(i);
      continue;
    }
    const Meeting<Scalar> found = meeting(i, changed);
    if (!found.meets) continue;
    const bool earlier = !best.meeting.meets || found.time < best.meeting.time ||
                         (found.time == best.meeting.time && changed < best.other);
    if (earlier) best = {found, static_cast<CharacterIndex>(changed)};
  }
}

/// Of equal times the lowest index; the number of rows where nobody meets.
template <class Scalar>
std::size_t Stepper<Scalar>::earliest_row() const noexcept {
  std::size_t earliest = rows_.size();
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!rows_[i].meeting.meets) continue;
    if (earliest == rows_.size() || rows_[i].meeting.time < rows_[earliest].meeting.time) earliest = i;
  }
  return earliest;
}

/// Every impact halts somebody or counts for somebody who is halted after `most_impacts`; two that are halted do not
/// meet. So it ends.
template <class Scalar>
void Stepper<Scalar>::solve() noexcept {
  for (std::size_t i = 0; i < runners_.size(); ++i) find_row(i);
  while (true) {
    const std::size_t i = earliest_row();
    if (i == rows_.size()) return;
    const std::size_t j = rows_[i].other;
    const Meeting<Scalar> meeting = rows_[i].meeting;
    now_ = std::max(now_, meeting.time);
    ++report_.impacts;
    const Scalar first_toward = -dot(meeting.first_rate, meeting.normal);
    const Scalar second_toward = dot(meeting.second_rate, meeting.normal);
    const Scalar first_limit = std::max(Scalar(0), -second_toward);
    const Scalar second_limit = std::max(Scalar(0), -first_toward);
    // Who goes along the other has a rate towards it that is nothing but rounding: it must not be halted for that.
    const Scalar noise = noise_of(meeting.first_rate, meeting.second_rate);
    const bool first_moves_in = first_toward > first_limit + noise;
    const bool second_moves_in = second_toward > second_limit + noise;
    // Where rounding hides who comes nearer both stop.
    const bool nobody = !first_moves_in && !second_moves_in;
    const bool first_changes = nobody || first_moves_in;
    const bool second_changes = nobody || second_moves_in;
    note(i, j, meeting, meeting.normal);
    note(j, i, meeting, -meeting.normal);
    if (first_changes) respond(i, meeting, meeting.normal, first_limit);
    if (second_changes) respond(j, meeting, -meeting.normal, second_limit);
    if (first_changes) find_again(i);
    if (second_changes) find_again(j);
  }
}

/// @param normal from the other towards this one.
/// @param limit how fast it may go towards where the other is [m per step].
template <class Scalar>
void Stepper<Scalar>::respond(std::size_t i, const Meeting<Scalar>& meeting, const V& normal, Scalar limit) noexcept {
  Runner<Scalar>& runner = runners_[i];
  if (++runner.impacts > rules_.most_impacts) {
    runner.dropped = true;
    go_on_to(i, meeting.time);
    return halt(i);
  }
  if (meeting.at_once) {
    // There is no halting within a part that takes no time. Following the ground down is left out instead; a way out
    // at the beginning is not taken.
    if (!(meeting.time > runner.begin) || runner.no_snap) return halt(i);
    runner.no_snap = true;
    return plan(i);
  }
  if (!(meeting.time > runner.begin)) note_touched_scenery(i, meeting.impact);
  go_on_to(i, meeting.time);
  if (normal.y() >= rules_.walkable_cosine) runner.stands = true;
  runner.held.push_back({normal, limit / dt_});
  V& velocity = runner.state.velocity;
  const Scalar excess = -dot(velocity, normal) - limit / dt_;
  // Scenery turns it into the other: it is between the two.
  if (!(excess > 0)) return halt_between(i);
  velocity += normal * excess;
  if (is_held(runner)) return halt_between(i);
  plan(i);
}

/// Whether its velocity goes into somebody it touches, by more than rounding.
template <class Scalar>
bool Stepper<Scalar>::is_held(const Runner<Scalar>& runner) const noexcept {
  const V& velocity = runner.state.velocity;
  const Scalar noise = noise_of<Scalar>(velocity, V::Zero());
  return runner.held.overflowed() ||
         std::any_of(runner.held.begin(), runner.held.end(),
                     [&](const HeldBy<Scalar>& other) { return -dot(velocity, other.normal) > other.limit + noise; });
}

/// What holds a fall from two sides is stood on.
template <class Scalar>
void Stepper<Scalar>::halt_between(std::size_t i) noexcept {
  Runner<Scalar>& runner = runners_[i];
  runner.stands = runner.stands || std::any_of(runner.held.begin(), runner.held.end(),
                                               [](const HeldBy<Scalar>& other) { return other.normal.y() > 0; });
  halt(i);
}

/// Of a way that ends where it begins nothing is committed: the scenery that was touched there, and turned it into the
/// other, is a contact all the same.
template <class Scalar>
void Stepper<Scalar>::note_touched_scenery(std::size_t i, Scalar impact) noexcept {
  const Runner<Scalar>& runner = runners_[i];
  const MoveResult<Scalar>& planned = runner.plan.move;
  const Way<Scalar> way{{planned.path.begin(), planned.path.size()}, runner.begin, 1};
  const V& wanted = runner.plan.requested;
  for (Contact<Scalar> contact : planned.contacts) {
    const bool touched = contact.fraction * -dot(wanted, contact.normal) <= Tolerances<Scalar>{}.touch;
    contact.fraction = way.time_of(contact.fraction);
    if (touched && contact.fraction <= impact) add_contact(member(i).step.move, contact);
  }
}

template <class Scalar>
void Stepper<Scalar>::note(std::size_t i, std::size_t other, const Meeting<Scalar>& meeting, const V& normal) noexcept {
  auto& met = member(i).met;
  const CrowdContact<Scalar> contact{static_cast<CharacterIndex>(other), normal, meeting.impact,
                                     side_of_normal(normal.x(), normal.y())};
  const bool known = std::any_of(met.begin(), met.end(), [&](const CrowdContact<Scalar>& earlier) {
    return earlier.other == contact.other && earlier.side == contact.side;
  });
  if (!known) met.push_back(contact);
}

/// Those that overlap by more than rounding.
template <class Scalar>
void Stepper<Scalar>::note_overlaps(std::span<const CharacterState<Scalar>> states) noexcept {
  for (std::size_t i = 0; i < states.size(); ++i) {
    for (std::size_t j = i + 1; j < states.size(); ++j) {
      if (!runners_[i].box.overlaps(runners_[j].box)) continue;
      const Scalar apart = rules_.space.separation(states[i].position, states[j].position);
      if (apart >= -Tolerances<Scalar>{}.certain) continue;
      member(i).started_overlapping.push_back(static_cast<CharacterIndex>(j));
      member(j).started_overlapping.push_back(static_cast<CharacterIndex>(i));
    }
  }
}

template <class Scalar>
void Stepper<Scalar>::finish(std::span<CharacterState<Scalar>> states) noexcept {
  for (std::size_t i = 0; i < runners_.size(); ++i) {
    commit(i, runners_[i].plan, 1);
    runners_[i].state = runners_[i].after;
    runners_[i].box = box_along(rules_.space, member(i).step.move.path);
  }
  keep_back_what_is_not_clear(states);
  for (std::size_t i = 0; i < runners_.size(); ++i) hand_out(i, states[i]);
}

template <class Scalar>
Way<Scalar> Stepper<Scalar>::way_made(std::size_t i) noexcept {
  const auto& path = member(i).step.move.path;
  return {{path.begin(), path.size()}, 0, 1};
}

/// The parts of a way were made one by one, and each may be a little off what was planned. All pairs are looked at once
/// more; whoever comes too near stays where the step began, which is free; and so on with those who go through there.
template <class Scalar>
void Stepper<Scalar>::keep_back_what_is_not_clear(std::span<const CharacterState<Scalar>> states) noexcept {
  for (std::size_t i = 0; i < runners_.size(); ++i)
    if (member(i).step.move.path.overflowed()) keep_back(i, states[i]);
  bool changed = true;
  while (changed) {
    changed = false;
    for (std::size_t i = 0; i < runners_.size(); ++i) {
      for (std::size_t j = i + 1; j < runners_.size(); ++j) {
        if (member(i).stayed && member(j).stayed) continue;
        if (!runners_[i].box.overlaps(runners_[j].box)) continue;
        constexpr Scalar least = Tolerances<Scalar>{}.certain;
        if (!first_meeting(rules_.space, way_made(i), way_made(j), Scalar(0), least).meets) continue;
        keep_back(i, states[i]);
        keep_back(j, states[j]);
        changed = true;
      }
    }
  }
}

template <class Scalar>
void Stepper<Scalar>::keep_back(std::size_t i, const CharacterState<Scalar>& start) noexcept {
  CrowdMember<Scalar>& made = member(i);
  made.stayed = true;
  report_stay(start.position, made.step);
  Runner<Scalar>& runner = runners_[i];
  runner.state = start;
  runner.state.velocity = V::Zero();
  runner.stands = false;
  runner.dropped = true;
  runner.box = box_along(rules_.space, made.step.move.path);
}

template <class Scalar>
StepStatus Stepper<Scalar>::status_of(std::size_t i) noexcept {
  if (runners_[i].stuck) return StepStatus::stuck;
  return runners_[i].dropped ? StepStatus::dropped : StepStatus::moved;
}

template <class Scalar>
void Stepper<Scalar>::hand_out(std::size_t i, CharacterState<Scalar>& state) noexcept {
  Runner<Scalar>& runner = runners_[i];
  StepReport<Scalar>& report = member(i).step;
  CharacterState<Scalar> next = runner.state;
  next.jump_held = runner.jump_held;
  next.jump_pending = runner.jump_pending;
  if (runner.stands) {
    next.grounded = true;
    next.jumping = false;
  }
  next.wall_left = touches(report.move, Side::left);
  next.wall_right = touches(report.move, Side::right);
  report.status = status_of(i);
  const int stuck_steps = runner.stuck ? std::min(state.stuck_steps + 1, 255) : 0;
  next.stuck_steps = static_cast<std::uint8_t>(stuck_steps);
  report.move.status = runner.stuck ? MoveStatus::stuck : runner.dropped ? MoveStatus::dropped : MoveStatus::moved;
  report.move.position = next.position;
  report.move.velocity = next.velocity;
  report.move.grounded = next.grounded;
  state = next;
}

template class Stepper<float>;
template class Stepper<double>;

}  // namespace paperproof::crowd
