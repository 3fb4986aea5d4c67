/// The beginning and the end of every step, for one character or several.
#pragma once

#include "geometry/vectors.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

namespace paperproof::step_parts {

/// Tests all given numbers together: x - x is zero for a finite number and NaN for any other. So one branch replaces a
/// branch for each number (a twentieth of a step).
class FiniteCheck {
 public:
  FiniteCheck& add(const Vec2d& v) {
    zero_ += v - v;
    return *this;
  }
  [[nodiscard]] bool passed() const { return zero_.x() == 0 && zero_.y() == 0; }

 private:
  Vec2d zero_{Vec2d::Zero()};
};

using geometry::in_range;

/// Whether movers stay within the range of positions and have finite speeds, which they hand on to the characters that
/// they carry. One that has an angle stays within 1e6: what is proved of its vertices allows for rounding there.
[[nodiscard]] inline bool finite(std::span<const MoverMotion> movers, double dt) {
  const auto may_have_angle = [](const MoverMotion& mover) {
    const double furthest = std::max({std::abs(mover.from_angle), std::abs(mover.to_angle),
                                      mover.from.cwiseAbs().maxCoeff(), mover.to.cwiseAbs().maxCoeff()});
    return furthest <= 1e6 && !std::isnan(mover.from_angle) && !std::isnan(mover.to_angle);
  };
  return std::ranges::all_of(movers, [&](const MoverMotion& mover) {
    return in_range(mover.from) && in_range(mover.to) && FiniteCheck().add((mover.to - mover.from) / dt).passed() &&
           (!mover.has_angle() || may_have_angle(mover));
  });
}

[[nodiscard]] inline bool any_angle(std::span<const MoverMotion> movers) {
  // Most levels have no movers: then nothing counts them.
  return !movers.empty() && std::ranges::any_of(movers, [](const MoverMotion& mover) { return mover.has_angle(); });
}

/// Whether a step can begin with these numbers.
/// @param dt greater than zero.
[[nodiscard]] inline bool finite(const CharacterState& state, const Input& input, const Vec2d& gravity, double dt,
                                 std::span<const MoverMotion> movers) {
  FiniteCheck check;
  check.add(state.position).add(state.velocity).add(state.technique_memory).add(gravity);
  check.add(state.ride.place).add(state.ride.velocity).add({state.coyote_left, state.pending_left});
  check.add({dt, input.move.value_or(0)});
  if (state.has_last_free) check.add(state.last_free);
  for (const Crusher& crusher : state.crushers) check.add(crusher.last_free).add(crusher.displacement);
  return check.passed() && (movers.empty() || finite(movers, dt));
}

/// Whether `maker` made the memory that is marked so.
template <class Maker>
[[nodiscard]] bool is_made_by(const std::shared_ptr<Maker>& maker, const std::weak_ptr<const void>& mark) {
  return !mark.owner_before(maker) && !maker.owner_before(mark);
}

/// Reports a move that is refused: the character stays where it is.
inline void refuse(StepStatus why, const Vec2d& position, const Vec2d& velocity, const Ride& ride, MoveResult& move) {
  move.status = why;
  move.position = position;
  move.velocity = velocity;
  move.ride = ride;
  move.path.push_back({position, 0});
  move.path.push_back({position, 1});
}

/// Whether a step has to know of a wall ahead: see `CharacterDef::no_jump_toward_wall`.
[[nodiscard]] inline bool asks_for_wall(const CharacterDef& character, const Input& input,
                                        const CharacterState& state) {
  const bool may_press = input.jump || state.jump_pending;
  return character.no_jump_toward_wall && may_press && state.grounded && input.move.value_or(0) != 0;
}

[[nodiscard]] inline bool touches(const MoveResult& move, Side side) {
  return std::ranges::any_of(move.contacts, [side](const Contact& contact) { return contact.side == side; });
}

/// Notes whether a solid still overlaps the character after a move. If none does, the position is its last free one.
inline void note_freedom(const MoveResult& move, CharacterState& state) {
  state.crushed = move.status == StepStatus::crushed || (state.crushed && move.status == StepStatus::stuck);
  if (state.crushed || move.status == StepStatus::stuck) return;
  state.last_free = move.position;
  state.has_last_free = true;
}

/// Writes the result of the move into the state for the next step.
inline void adopt(const CharacterDef& character, const Vec2d& up, const MoveResult& move, CharacterState& state) {
  // Zeros have no sign: states are compared as bytes.
  state.position = move.position.array() + 0.0;
  state.velocity = move.velocity.array() + 0.0;
  state.technique_memory = move.technique_memory;
  state.grounded = move.grounded;
  state.ride = move.ride;
  if (move.ground.state != GroundState::air)
    state.ground = move.ground;
  else if (state.ground.state != GroundState::air)
    state.ground = {};
  note_freedom(move, state);
  state.crushers.clear();
  if (state.crushed) state.crushers = move.crushers;
  if (move.grounded) state.jumping = false;
  state.wall_left = state.wall_right = false;
  for (const Contact& contact : move.contacts) {
    state.wall_left = state.wall_left || contact.side == Side::left;
    state.wall_right = state.wall_right || contact.side == Side::right;
  }
  if (character.side_hit_ends_rise && (state.wall_left || state.wall_right)) {
    const UpFrame frame = up;
    const double rise = frame.up_of(state.velocity);
    if (rise > 0) state.velocity = frame.in_world({frame.across_of(state.velocity), 0});
  }
  const int stuck_steps = move.status == StepStatus::stuck ? std::min(state.stuck_steps + 1, 255) : 0;
  state.stuck_steps = static_cast<std::uint8_t>(stuck_steps);
}

}  // namespace paperproof::step_parts
