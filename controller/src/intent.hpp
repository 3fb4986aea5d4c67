/// From the player's intent to the velocity that a character wants in a step.
#pragma once

#include <paperproof/controller.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "inlining.hpp"

namespace paperproof::intent {

PAPERPROOF_INLINE double steered(const CharacterDef& character, const CharacterState& state, double move, double dt) {
  const double acceleration =
      state.grounded ? character.acceleration : character.air_acceleration.value_or(character.acceleration);
  const double target = std::clamp(move, -1.0, 1.0) * character.walk_speed;
  const double change = acceleration * dt;
  return state.velocity.x() + std::clamp(target - state.velocity.x(), -change, change);
}

inline bool may_jump(const CharacterDef& character, const CharacterState& state, const Input& input, bool wall_ahead) {
  if (state.crushed || state.jumping || !(state.grounded || state.coyote_left > 0)) return false;
  if (!character.no_jump_toward_wall) return true;
  const double move = input.move.value_or(0);
  return !wall_ahead && !(move < 0 && state.wall_left) && !(move > 0 && state.wall_right);
}

/// Notes a press of the jump button, and ends one that has been pending for too long.
inline void note_press(const CharacterDef& character, bool pressed, double dt, CharacterState& state) {
  if (pressed && !state.jump_held) {
    state.jump_pending = true;
    if (character.jump_buffer) state.pending_left = *character.jump_buffer;
  } else if (character.jump_buffer) {
    state.pending_left = std::max(state.pending_left - dt, 0.0);
    state.jump_pending = state.jump_pending && state.pending_left > 0;
  } else if (!pressed) {
    state.jump_pending = false;
  }
}

/// The upward speed after the button was pressed or released, or a press is pending. Kept out of most steps.
PAPERPROOF_COLD inline double use_button(const CharacterDef& character, const Input& input, bool wall_ahead, double dt,
                                         CharacterState& state, double upwards) {
  note_press(character, input.jump, dt, state);
  const bool released = state.jump_held && !input.jump;
  if (released && state.jumping && upwards > 0) upwards *= character.jump_cut;
  state.jump_held = input.jump;
  if (state.jump_pending && may_jump(character, state, input, wall_ahead)) {
    upwards = character.jump_speed;
    state.jumping = true;
    state.grounded = state.jump_pending = false;
    state.coyote_left = 0;
    if (!input.jump) upwards *= character.jump_cut;
  }
  return upwards;
}

/// The upward speed of a walker that brakes or turns round on a slope: the climb slows with the walk. The walker would
/// leave the ground with the speed of its climb otherwise. A rise that is steeper than walkable ground is no climb, nor
/// is the speed of ground that moved and is gone.
/// @param walk speed of the walk from now on.
PAPERPROOF_COLD inline double slowed_climb(const CharacterDef& character, const CharacterState& state, double walk) {
  const Vec2d& before = state.velocity;
  const double cosine = character.walkable_cosine();
  const double steepest = std::sqrt(1 - cosine * cosine) / cosine;
  const bool is_left = state.ride.ground == Ride::none && !state.ground.velocity.isZero(0);
  if (is_left || !(before.y() <= std::abs(before.x()) * steepest)) return before.y();
  return before.y() * std::max(walk / before.x(), 0.0);
}

/// Counted from the first step that begins in the air.
inline void count_down_coyote(const CharacterDef& character, double dt, CharacterState& state) {
  if (character.coyote_time > 0)
    state.coyote_left = state.grounded ? character.coyote_time : std::max(state.coyote_left - dt, 0.0);
}

/// The members of a state that the intent changes. They are restored if the step is refused later. (A copy of the whole
/// state costs a tenth of a step.)
PAPERPROOF_INLINE auto intended(CharacterState& state) {
  return std::tie(state.velocity, state.grounded, state.jumping, state.jump_held, state.jump_pending, state.coyote_left,
                  state.pending_left);
}
using Intended = std::tuple<Vec2d, bool, bool, bool, bool, double, double>;

}  // namespace paperproof::intent
