/// States of characters: one in the middle of things, and whether two steps came to the same.
#pragma once

#include "controller/stepping.hpp"

#include <algorithm>

namespace paperproof::stepping {

/// Every field differs from its default.
inline CharacterState busy() {
  CharacterState state{.position = Vec2d(1, 2),
                       .velocity = Vec2d(3, -4),
                       .last_free = Vec2d(1, 2.5),
                       .technique_memory = Vec2d(5, 6),
                       .has_last_free = true,
                       .grounded = true,
                       .jumping = true,
                       .jump_held = true,
                       .jump_pending = true,
                       .coyote_left = 0.25,
                       .pending_left = 0.125,
                       .wall_left = true,
                       .wall_right = true,
                       .crushed = true,
                       .stuck_steps = 3,
                       .ride = {.ground = 4, .place = Vec2d(1, 1.5), .velocity = Vec2d(0.5, 0.75)},
                       .ground = {GroundState::wedge, 8, Vec2d(0.5, 0.25), Vec2d(7, 8)}};
  for (const ColliderIndex i : {0U, 1U, 2U}) state.crushers.push_back({i, Vec2d(9, 10), Vec2d(11, 12), i == 1});
  return state;
}

/// To the last bit.
inline bool same_step(const CharacterState& a, const StepReport& one, const CharacterState& b, const StepReport& two) {
  if (!same_bits(a, b) || a != b || one.status != two.status) return false;
  return one.status == StepStatus::invalid_input ||
         (same_bits(one.requested, two.requested) && test::all_same_bits(one.move.path, two.move.path) &&
          test::all_same_bits(one.move.contacts, two.move.contacts) &&
          std::ranges::equal(one.move.crushed, two.move.crushed) && test::all_same_bits(one.sensors, two.sensors));
}

}  // namespace paperproof::stepping
