/// What the runs of several kinds draw alike.
#pragma once

#include "campaign/random.hpp"
#include "campaign/random_run.hpp"
#include "campaign/shapes.hpp"
#include "scenes/step_times.hpp"

#include <cmath>
#include <numbers>
#include <string>

namespace paperproof::compare {

/// A coordinate far from the origin, either side of it [m].
[[nodiscard]] inline double far(Random& random) { return random.either_sign_log_between(1, 9.9e5); }

[[nodiscard]] inline Vec2d round_to_pixels(const Vec2d& p) {
  return {std::round(p.x() * 32) / 32, std::round(p.y() * 32) / 32};
}

/// Any direction [radians]; now and then along an axis or a diagonal.
[[nodiscard]] inline double any_direction(Random& random) {
  return random.chance(0.3) ? random.integer(0, 7) * std::numbers::pi / 4 : random.angle();
}

/// Now and then with a snap, or with another limit for climbs.
inline void draw_rules(Random& random, CharacterDef& character) {
  if (random.chance(0.3)) character.snap = 0.5;
  if (random.chance(0.2)) character.max_climb_degrees = random.between(0, 89);
}

/// Keys to walk and to jump, pressed and released now and then.
inline void press_keys(Random& random, Input& input) {
  if (random.chance(0.1)) input.move = random.integer(-1, 1);
  if (random.chance(0.1)) input.jump = !input.jump;
}

/// Adds a mover that is at `offset_at(step)` when each step begins.
template <class OffsetAt>
MoverDef& add_sampled_mover(Scene& scene, const OffsetAt& offset_at) {
  const StepTimes times(scene);
  MoverDef& mover = scene.movers.emplace_back();
  mover.id = std::to_string(scene.movers.size());
  for (int step = 0; step <= scene.steps; ++step) mover.path.push_back({times.begin(step), offset_at(step)});
  return mover;
}

/// Adds a launch; before the first step it is what the character begins with.
inline void add_launch(RandomRun& run, const Launch& launch) {
  if (launch.step > 0)
    run.launches.push_back(launch);
  else if (launch.character == 0)
    run.scene.start.velocity = launch.velocity;
  else
    run.scene.others[launch.character - 1].start.velocity = launch.velocity;
}

/// Adds two sensors to one run of four, about where it begins: the second is on a mover if there is any. They change no
/// motion, and no other draw.
inline void add_sensors(RandomRun& run, std::uint64_t seed) {
  Random random(~seed);
  if (!random.chance(0.25)) return;
  const auto movers = static_cast<int>(run.scene.movers.size());
  const MoverIndex any = movers > 0 ? static_cast<MoverIndex>(random.below(movers)) : no_mover;
  for (const MoverIndex mover : {no_mover, any}) {
    Vec2d at = run.scene.start.position + random.point(2);
    if (mover != no_mover) at -= run.scene.movers[mover].path.front().at;
    const Vec2d half{random.between(0.1, 2), random.between(0.1, 2)};
    ColliderDef sensor = box(at.x() - half.x(), at.y() - half.y(), at.x() + half.x(), at.y() + half.y(), mover);
    sensor.sensor = true;
    run.scene.scenery.colliders.push_back(sensor);
  }
}

}  // namespace paperproof::compare
