/// States of characters: one in the middle of things, and whether two steps came to the same.
#pragma once

#include "controller/stepping.hpp"

#include <algorithm>

namespace paperproof::stepping {

/// Every field differs from its default.
template <class Scalar>
CharacterState<Scalar> busy() {
  using Vector = Vec2<Scalar>;
  CharacterState<Scalar> state{.position = Vector(1, 2),
                               .velocity = Vector(3, -4),
                               .last_free = Vector(1, 2.5),
                               .technique_memory = Vector(5, 6),
                               .has_last_free = true,
                               .grounded = true,
                               .jumping = true,
                               .jump_held = true,
                               .jump_pending = true,
                               .coyote_left = Scalar(0.25),
                               .pending_left = Scalar(0.125),
                               .wall_left = true,
                               .wall_right = true,
                               .crushed = true,
                               .stuck_steps = 3,
                               .ride = {.ground = 4, .place = Vector(1, 1.5), .velocity = Vector(0.5, 0.75)},
                               .ground = {GroundState::wedge, 8, Vector(0.5, 0.25), Vector(7, 8)}};
  for (const ColliderIndex i : {0U, 1U, 2U}) state.crushers.push_back({i, Vector(9, 10), Vector(11, 12), i == 1});
  return state;
}

/// To the last bit.
template <class Scalar>
bool same_step(const CharacterState<Scalar>& a, const StepReport<Scalar>& one, const CharacterState<Scalar>& b,
               const StepReport<Scalar>& two) {
  const auto same_corner = [](const PathPoint<Scalar>& p, const PathPoint<Scalar>& q) {
    return same_bits(p.position, q.position) && same_bits(p.fraction, q.fraction);
  };
  const auto same_contact = [](const Contact<Scalar>& p, const Contact<Scalar>& q) {
    return p.collider == q.collider && p.side == q.side && same_bits(p.point, q.point) &&
           same_bits(p.normal, q.normal) && same_bits(p.fraction, q.fraction) && same_bits(p.separation, q.separation);
  };
  const auto same_event = [](const SensorEvent<Scalar>& p, const SensorEvent<Scalar>& q) {
    return p.sensor == q.sensor && p.change == q.change && same_bits(p.fraction, q.fraction);
  };
  if (!same_bits(a, b) || a != b || one.status != two.status) return false;
  return one.status == StepStatus::invalid_input ||
         (same_bits(one.requested, two.requested) && std::ranges::equal(one.move.path, two.move.path, same_corner) &&
          std::ranges::equal(one.move.contacts, two.move.contacts, same_contact) &&
          std::ranges::equal(one.move.crushed, two.move.crushed) &&
          std::ranges::equal(one.sensors, two.sensors, same_event));
}

}  // namespace paperproof::stepping
