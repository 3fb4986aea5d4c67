#include "oracle/later_parts.hpp"

#include "oracle/met_surfaces.hpp"
#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// Relative.
constexpr double rounding_of_steering = 1e-9;
/// Sine of the largest tilt of an upright wall.
constexpr double upright = 1e-9;

}  // namespace

LaterParts later_parts(const TraceHeader& header, const TraceStep& step, const Wanted& first) {
  LaterParts later;
  const int parts = first.parts / header.substeps;
  if (parts < 2) return later;
  later.dt = length_of(step, header);
  const double part = later.dt / parts;
  const Vec2d up = up_in(step, header);
  const Vec2d pull = seen(gravity_in(step, header), up) * part;
  const double slowest = header.character.max_fall_speed ? -*header.character.max_fall_speed : -HUGE_VAL;
  const double rise = first.velocity.dot(up);
  Vec2d added = Vec2d::Zero();  // in the part that is looked at
  Vec2d way = Vec2d::Zero();
  for (int k = 1; k < parts; ++k) {
    added.x() += pull.x();
    // Who is carried down faster than it may fall falls no slower for that.
    const double fall = std::max(rise + added.y() + pull.y(), std::min(slowest, rise));
    added.y() = fall - rise;
    way += added * part;
  }
  later.velocity = in_world(added, up);
  later.way = in_world(way, up);
  if (first.pending) later.jump = header.character.jump_speed;
  if (!step.input.move) return later;
  const CharacterDef& character = header.character;
  const double in_air = character.air_acceleration.value_or(character.acceleration);
  const double most = std::max(character.acceleration, in_air) * (later.dt - part);
  later.most_steered = most;
  later.asked = std::clamp(*step.input.move, -1.0, 1.0) * character.walk_speed;
  // Ground that moves, and what slopes, may leave it any speed in any part.
  const auto keeps_speed = [&](const Contact& contact) {
    const ColliderDef& met = header.scenery.colliders[contact.collider];
    const bool is_wall = std::abs(contact.normal.dot(up)) <= upright;
    return met.mover == no_mover && met.surface_speed == 0 && (is_wall || is_walked_on(contact.normal, header, up));
  };
  const bool any_speed = first.ridden || pull.x() != 0 || !std::ranges::all_of(step.contacts, keeps_speed);
  // A wall may have stopped it.
  const double slowest_walk = step.contacts.empty() ? first.walk : std::min(first.walk, 0.0);
  const double fastest_walk = step.contacts.empty() ? first.walk : std::max(first.walk, 0.0);
  const double room = rounding_of_steering * (1 + std::abs(later.asked));
  if (any_speed || later.asked > slowest_walk + room)
    later.faster = any_speed ? most : std::min(most, later.asked - slowest_walk);
  if (any_speed || later.asked < fastest_walk - room)
    later.slower = any_speed ? -most : -std::min(most, fastest_walk - later.asked);
  return later;
}

}  // namespace paperproof::compare::detail
