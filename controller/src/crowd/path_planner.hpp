/// Plans the path of one character past obstacles that move on paths of their own.
#pragma once

#include "crowd/member.hpp"
#include "step_parts.hpp"

namespace paperproof::crowd {

/// Where a slot of the scenery is that no character takes [m]: out of reach of everything.
inline constexpr double nowhere = 1e9;

[[nodiscard]] inline bool contains(const auto& colliders, ColliderIndex collider) noexcept {
  return std::find(colliders.begin(), colliders.end(), collider) != colliders.end();
}

/// Unless it is there already.
inline void add_corner(MoveResult& move, const PathPoint& corner) noexcept {
  const bool known = !move.path.empty() && move.path.back().position == corner.position &&
                     move.path.back().fraction == corner.fraction;
  if (!known) move.path.push_back(corner);
}

/// Unless there is an earlier one with the same collider and normal.
inline void add_contact(MoveResult& move, const Contact& contact) noexcept {
  const bool known = std::any_of(move.contacts.begin(), move.contacts.end(), [&](const Contact& other) {
    return other.collider == contact.collider && other.normal == contact.normal;
  });
  if (!known) move.contacts.push_back(contact);
}

[[nodiscard]] inline bool is_too_long(const MoveResult& move) noexcept {
  return move.path.size() > MoveResult::max_corners;
}

/// Appends the path of `next` to that of `move`, which then ends as `next` does.
inline void append_path(const MoveResult& next, MoveResult& move) noexcept {
  for (const PathPoint& corner : next.path) add_corner(move, corner);
  move.position = next.position;
  move.velocity = next.velocity;
  move.grounded = next.grounded;
  move.ground = next.ground;
  move.ride = next.ride;
}

/// Forgets the slots among the crushers: other characters may take them in the next step.
inline void set_crushers(const auto& crushers, const SweepRules& rules, CharacterState& state) noexcept {
  state.crushers.clear();
  for (const Crusher& crusher : crushers)
    if (!rules.is_character(crusher.collider)) state.crushers.push_back(crusher);
}

/// Plans paths in parts: `octagon_sweep` moves every obstacle straight, so each corner of an obstacle begins a new
/// part.
class PathPlanner {
 public:
  explicit PathPlanner(CrowdStep& step) noexcept : step_(step), around_{{step.memory.motions}, step.filter, step.up} {}

  /// Plans the path of a character from a moment on.
  /// @param at where the path begins; becomes the moment in which it ends.
  /// @return false where the path takes no time, has too many corners, or would leave the range.
  [[nodiscard]] bool plan_until(CharacterIndex i, double until, MoveResult& path, Moment& at) noexcept {
    const Member& member = step_.members[i];
    path.clear();
    while (at.time < until) {  // for each corner of an obstacle's path once, at most
      const double end = std::min(until, next_corner(member, at.time));
      set_motions(member.obstacles, at.time, end);
      if (!plan_part(member, end, path, at)) return false;
    }
    return !is_too_long(path) && !path.path.empty();
  }

  /// The same until the end of the step, past obstacles that move straight.
  /// @param legs when the leg of each obstacle's path begins that counts, made longer to the whole time.
  [[nodiscard]] bool plan_past(CharacterIndex i, std::span<const double> legs, MoveResult& path, Moment& at) noexcept {
    const Member& member = step_.members[i];
    path.clear();
    if (!(at.time < 1)) return false;
    set_motions(member.obstacles, at.time, 1);
    for (std::size_t k = 0; k < legs.size(); ++k)
      step_.memory.motions[step_.movers.size() + k] = leg_of(member.obstacles[k], legs[k], at.time);
    return plan_part(member, 1, path, at) && !is_too_long(path);
  }

  /// The same for a character that keeps its position in the world.
  void plan_to_hold_position(const Member& member, double until, MoveResult& path, Moment& at) noexcept {
    path.clear();
    set_motions({}, at.time, until);
    Moment standing = at;
    standing.own_velocity.setZero();
    standing.state.ride = {};
    const octagon_sweep::StepRequest request = request_at(member, standing, until);
    move_part(octagon_sweep::Part::stay, request);
    take_part(until, path, at);
  }

  /// The corner of the path of a character that it passes last up to a time of the step, as a fraction of the step.
  [[nodiscard]] double last_corner(CharacterIndex i, double time) const noexcept {
    double last = 0;
    for_each_corner(i, [&](double corner) {
      if (corner <= time) last = std::max(last, corner);
    });
    return last;
  }

  /// Where a character is at a time of the step, on the path that it made or the one that it plans [m].
  /// @param after after the legs that take no time then; else before them.
  [[nodiscard]] Vec2d position(CharacterIndex i, double time, bool after) noexcept {
    const Moment& now = step_.members[i].now;
    const bool is_made = now.time > 0 && (time < now.time || (time == now.time && !after));
    const Path path = is_made ? step_.made(i).path : step_.members[i].plan.path;
    std::size_t k = 0;
    while (k + 1 < path.size() && (after ? path[k + 1].fraction <= time : path[k + 1].fraction < time)) ++k;
    return position_on_leg(path, k, time);
  }

 private:
  template <class Visit>
  void for_each_corner(CharacterIndex i, const Visit& visit) const noexcept {
    for (const PathPoint& corner : step_.made(i).path) visit(corner.fraction);
    for (const PathPoint& corner : step_.members[i].plan.path) visit(corner.fraction);
  }

  /// The next corner of the path of a character after a time of the step, or the end of the step.
  [[nodiscard]] double next_corner(CharacterIndex i, double time) const noexcept {
    double next = 1;
    for_each_corner(i, [&](double corner) {
      if (corner > time) next = std::min(next, corner);
    });
    return next;
  }
  /// The next time at which an obstacle changes its course, or the end of the step.
  [[nodiscard]] double next_corner(const Member& member, double time) const noexcept {
    double next = 1;
    for (const CharacterIndex other : member.obstacles) next = std::min(next, next_corner(other, time));
    return next;
  }

  /// One leg of a path, made longer to [time, 1].
  [[nodiscard]] MoverMotion leg_of(CharacterIndex i, double begin, double time) noexcept {
    const double end = next_corner(i, begin);
    const Vec2d from = position(i, begin, true);
    const Vec2d rate = (position(i, end, false) - from) / (end - begin);
    return {from + rate * (time - begin), from + rate * (1 - begin)};
  }

  void set_motions(const Obstacles& obstacles, double begin, double end) noexcept {
    const std::span<MoverMotion> motions(step_.memory.motions);
    for (std::size_t k = 0; k < step_.movers.size(); ++k)
      motions[k] = {begin > 0 ? step_.movers[k].at(begin) : step_.movers[k].from, step_.movers[k].at(end)};
    const std::span<MoverMotion> slots = motions.subspan(step_.movers.size());
    for (std::size_t k = 0; k < slots.size(); ++k) {
      if (k < obstacles.size())
        slots[k] = {position(obstacles[k], begin, true), position(obstacles[k], end, false)};
      else
        slots[k].from = slots[k].to = Vec2d::Constant(static_cast<double>(nowhere));
    }
  }

  [[nodiscard]] octagon_sweep::StepRequest request_at(const Member& member, const Moment& at, double end) noexcept {
    const double duration = step_.dt * (end - at.time);
    return {.state = at.state,
            .displacement = at.own_velocity * duration,
            .velocity = at.own_velocity,
            .dt = duration,
            .around = around_,
            .steered = at.steered,
            .drop = member.drops,
            .next_dt = member.next_dt,
            .grounded = member.follows_ground && !member.ground_taken && end == 1};
  }

  [[nodiscard]] bool plan_part(const Member& member, double end, MoveResult& path, Moment& at) noexcept {
    const octagon_sweep::StepRequest request = request_at(member, at, end);
    if (!(request.dt > 0)) return false;
    move_part(at.time > 0 ? octagon_sweep::Part::rest : octagon_sweep::Part::whole, request);
    if (step_.memory.part.status == StepStatus::out_of_range) return false;
    take_part(end, path, at);
    return true;
  }

  void move_part(octagon_sweep::Part part, const octagon_sweep::StepRequest& request) noexcept {
    step_.rules.sweep->move_part(part, request, step_.memory.scratch, step_.memory.part);
  }

  /// Appends the part that was moved last to a path.
  /// @param end when the part ends, as a fraction of the step. @param at when it began; becomes the moment in which it
  ///   ends.
  void take_part(double end, MoveResult& path, Moment& at) noexcept {
    MoveResult& part = step_.memory.part;
    const auto time_of = [begin = at.time, end](double fraction) {
      return fraction == 1 ? end : begin + fraction * (end - begin);
    };
    for (PathPoint& corner : part.path) corner.fraction = time_of(corner.fraction);
    append_path(part, path);
    for (Contact& contact : part.contacts) {
      contact.fraction = time_of(contact.fraction);
      add_contact(path, contact);
    }
    for (const ColliderIndex collider : part.crushed)
      if (!contains(path.crushed, collider)) path.crushed.push_back(collider);
    const bool was_dropped = path.status == StepStatus::dropped && part.status == StepStatus::moved;
    if (!path.crushed.empty())
      path.status = StepStatus::crushed;
    else if (!was_dropped)
      path.status = part.status;
    finish_part(part, end, at);
  }

  void finish_part(const MoveResult& part, double end, Moment& at) const noexcept {
    CharacterState& state = at.state;
    at.time = end;
    state.position = part.position;
    state.grounded = part.grounded;
    state.ride = part.ride;
    const double fall = step_.up.up_of(at.own_velocity);
    at.own_velocity = part.velocity;
    if (!part.contacts.empty()) at.steered = 0;  // from here on it is momentum
    if (state.ride.ground != Ride::none) at.own_velocity -= state.ride.velocity;
    // An obstacle that held the character took its weight, which goes on for the rest of the step.
    if (part.grounded || (fall < 0 && step_.up.up_of(at.own_velocity) > fall / 2))
      at.own_velocity += step_.gravity * step_.dt;
    step_parts::note_freedom(part, state);
    if (!part.crushed.empty()) at.crushed_at = std::min(at.crushed_at, end);
    if (state.crushed)
      set_crushers(part.crushers, step_.rules, state);
    else
      state.crushers.clear();
  }

  CrowdStep& step_;
  octagon_sweep::Around around_;
};

}  // namespace paperproof::crowd
