#include "oracle/later_parts.hpp"

#include "oracle/up.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare::detail {
namespace {

/// A change of speed that is less than the limit by this share is what was asked for.
constexpr double rounding_of_steering = 1e-9;

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
  // What is walked on may be left, or met, in any part: then what was steered so far says nothing of what follows.
  const bool any_way = first.from_ground || !step.contacts.empty() || pull.x() != 0;
  // Who steered less than it could has the speed that it asked for.
  const bool is_there =
      std::abs(first.steered) < std::min(character.acceleration, in_air) * part * later.dt * (1 - rounding_of_steering);
  later.faster = any_way || (first.steered > 0 && !is_there) ? most : 0;
  later.slower = any_way || (first.steered < 0 && !is_there) ? -most : 0;
  return later;
}

}  // namespace paperproof::compare::detail
