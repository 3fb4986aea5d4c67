/// The built-in scenes by theme, and what they are made from. The registry, the
/// motions of work-precision and the tests include this.
#pragma once

#include "scenes/load.hpp"

#include <string_view>
#include <vector>

namespace paperproof::compare {

[[nodiscard]] std::vector<BuiltInScene> paper_scenes();    ///< Thin things, hit fast.
[[nodiscard]] std::vector<BuiltInScene> angle_scenes();    ///< Grazing, rotated, corners and wedges.
[[nodiscard]] std::vector<BuiltInScene> ground_scenes();   ///< Tiles, slopes, shafts, rest.
[[nodiscard]] std::vector<BuiltInScene> article_scenes();  ///< Where the article's points and rules show.
[[nodiscard]] std::vector<BuiltInScene> claim_scenes();    ///< What the article says of one technique.
[[nodiscard]] std::vector<BuiltInScene> limit_scenes();    ///< Climb limit, dt, many tiles, sensors.
[[nodiscard]] std::vector<BuiltInScene> one_way_scenes();  ///< One-way chains, standing, moving, dropped through.
[[nodiscard]] std::vector<BuiltInScene> moving_scenes();   ///< Lifts, conveyors, papers, a ceiling.
[[nodiscard]] std::vector<BuiltInScene> body_scenes();     ///< Stacks and crates that Box2D moves.
[[nodiscard]] std::vector<BuiltInScene> crowd_scenes();    ///< Several characters.
[[nodiscard]] std::vector<BuiltInScene> play_scenes();     ///< Ledges, gaps, ramps, kerbs, exact fits.
[[nodiscard]] std::vector<BuiltInScene> extreme_scenes();  ///< Overlapping starts, far origins, other scales.

[[nodiscard]] std::vector<SceneFamily> paper_families();    ///< Bullets and paper.
[[nodiscard]] std::vector<SceneFamily> limit_families();    ///< Lengths of steps, perturbed starts.
[[nodiscard]] std::vector<SceneFamily> ground_families();   ///< Tiles, shafts, slopes.
[[nodiscard]] std::vector<SceneFamily> extreme_families();  ///< Far origins, other scales and gravities.
[[nodiscard]] std::vector<SceneFamily> body_families();     ///< Stacks, a plank on springs.
[[nodiscard]] std::vector<SceneFamily> angle_families();    ///< Wedges.
[[nodiscard]] std::vector<SceneFamily> tight_families();    ///< Spikes, corners, what closes in.
[[nodiscard]] std::vector<SceneFamily> moving_families();   ///< Paper that comes.
[[nodiscard]] std::vector<SceneFamily> play_families();     ///< Slopes.
[[nodiscard]] std::vector<SceneFamily> crowd_families();    ///< Crowds, and long play.

/// Half the width, and the height below and above the position, of the article's character: 20 x 40 px at 32 px/m [m].
inline constexpr double half_width = 10.0 / 32;
inline constexpr double half_height = 20.0 / 32;
inline constexpr double pixel = 1.0 / 32;  ///< [m]
inline constexpr double foot = 5 * pixel;  ///< From the middle to each foot [m].
inline constexpr double pi = 3.14159265358979;
inline constexpr double tan_30 = 0.57735026918962576;  ///< Of 30 degrees.

/// Of a member of a family: one parameter that is set.
[[nodiscard]] inline std::vector<ParameterSetting> with(std::string key, double value) {
  return {{std::move(key), value}};
}

/// From a step on it walks with `move`.
[[nodiscard]] inline InputEvent steer(int step, double move) {
  return {.step = step, .move = move, .jump = std::nullopt};
}
/// The jump button goes down, comes up.
[[nodiscard]] inline InputEvent press(int step) { return {.step = step, .move = std::nullopt, .jump = true}; }
[[nodiscard]] inline InputEvent release(int step) { return {.step = step, .move = std::nullopt, .jump = false}; }

/// A scene without input: a body that flies. @param gravity downwards [m/s²].
[[nodiscard]] Scene flight(double x, double y, double velocity_x, double velocity_y, int steps, double gravity = 0);
/// A scene in which the character walks with `move` from the first step on.
[[nodiscard]] Scene walk(double x, double y, double move, int steps, double gravity = 10);

// Each returns the collider that it adds.
ColliderDef& add_polygon(Scene& scene, std::string id, std::vector<Vec2d> points);
ColliderDef& add_box(Scene& scene, std::string id, double left, double bottom, double right, double top);
ColliderDef& add_chain(Scene& scene, std::string id, std::vector<Vec2d> points);
ColliderDef& add_circle(Scene& scene, std::string id, const Vec2d& centre, double radius);
/// A chain that blocks from above alone.
ColliderDef& add_ledge(Scene& scene, std::string id, std::vector<Vec2d> points);
/// The last collider goes along a path.
void move_last(Scene& scene, std::vector<MoverDef::Waypoint> path, MoverDef::Loop loop = MoverDef::Loop::once);
/// The last collider is a body that Box2D moves.
void let_box2d_move_last(Scene& scene, const Body& body);
/// The jump button is down from one step to before another; input is given in the order of the steps.
void hold_jump(Scene& scene, int from, int to);
/// The same for dropping through one-way chains.
void hold_drop(Scene& scene, int from, int to);

// What answers are derived from: design §4, in steps of the scene's own length.

/// How far a body falls in n steps from rest [m].
[[nodiscard]] double fallen(const Scene& scene, int steps);
/// How high a jump is after n steps [m].
[[nodiscard]] double risen(const Scene& scene, int steps);
/// In how many steps a body falls so far. @param way [m]. @param speed downwards at the start [m/s].
[[nodiscard]] double steps_to_fall(const Scene& scene, double way, double speed = 0);
/// How far the character walks from rest in n steps of `move` 1 [m].
[[nodiscard]] double walked(const Scene& scene, int steps);
/// In how many steps it walks so far [m].
[[nodiscard]] double steps_to_walk(const Scene& scene, double way);
/// The place of a one-digit step in the numbers around `x` [m].
[[nodiscard]] double ulp(double x);

/// Ends at a place, at rest against what is there.
void ends_at(Scene& scene, double x, double y);
/// Stands on a mover from a step on, and goes where that goes. @param rounding of the larger coordinate [m].
void carried_by(Scene& scene, const std::string& mover, int steps, double rounding);
/// Neither moves nor changes `grounded` after so many steps.
void rests_after(Scene& scene, int steps);

}  // namespace paperproof::compare
