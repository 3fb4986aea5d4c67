/// States of characters: one in the middle of things, whether two steps came to the same, and what memory those of
/// several take.
#pragma once

#include "controller/stepping.hpp"
#include "support/allocations.hpp"

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

/// Where twelve begin that press each other in a row.
[[nodiscard]] inline std::vector<Vec2d> a_dozen() {
  std::vector<Vec2d> at;
  for (int i = 0; i < 12; ++i) at.emplace_back(i * 0.7, half_height + 0.2 * (i % 3));
  return at;
}

/// They walk and jump 200 steps, twice from the same states: in the first walk memory comes to know what there is.
/// @param count called after each step. @return allocations of the second walk.
[[nodiscard]] std::size_t allocations_once_known(auto& all, const auto& count) {
  all.gravity = {0, -30};
  all.dt = 1.0 / 60;
  const auto states = all.states;
  const auto movers = all.movers;
  std::size_t before = 0;
  for (int walk = 0; walk < 2; ++walk) {
    all.states = states;
    all.movers = movers;
    before = tests::allocations();
    for (int step = 0; step < 200; ++step) {
      for (std::size_t i = 0; i < all.inputs.size(); ++i)
        all.inputs[i] = {.move = (step / 20 + static_cast<int>(i)) % 3 - 1, .jump = step % 40 == static_cast<int>(i)};
      for (MoverMotion& motion : all.movers) motion = {motion.to, motion.to + Vec2d(0.02, 0.02)};
      all.step();
      count();
    }
  }
  return tests::allocations() - before;
}

}  // namespace paperproof::stepping
