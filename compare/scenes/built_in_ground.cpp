/// Tiles, slopes, shafts: scenes 10, 11 and 14.
#include "scenes/built_in.hpp"

#include <cmath>

namespace paperproof::compare {

namespace {

/// Walks along flush tiles of 1 m at a constant speed. The speed is there from the start, so that any change of it is
/// the seams' doing.
Scene tiles(const ParameterValues& values) {
  const double speed = values["speed"];
  // From a drop: put down 20 mm above the ground, Box2D comes to rest at the far end of its skin and never snags.
  Scene scene = walk(0.5, half_height + 0.3, 1, 300);
  scene.gravity = {0, -10};  // at 30 m/s² Box2D's pieces snag at fewer speeds
  scene.character.walk_speed = speed;
  scene.start.velocity = {speed, 0};
  for (int i = 0; i < 64; ++i) add_box(scene, "tile" + std::to_string(i), i - 1, -1, i, 0);
  scene.answers = {is(Answer::Of::speed, speed, {1, 0})};
  ends_at(scene, 0.5 + speed * scene.dt * scene.steps, half_height);
  return scene;
}

const std::vector<ParameterDef>& tile_parameters() {
  static const std::vector<ParameterDef> all{{"speed", "m_s", 0.1, 12, 7.3, "along the tiles, from the start"}};
  return all;
}

std::vector<ParameterSetting> walked_at(double speed) { return {{"speed", speed}}; }

/// Nothing steers, so speed that is lost at a seam is lost for good.
Scene flush_tiles_slide() {
  const std::vector<ParameterSetting> slow = walked_at(5);
  Scene scene = tiles(ParameterValues(tile_parameters(), slow));
  scene.input.clear();
  return scene;
}

constexpr double tan_10 = 0.17632698070846498;

/// Level ground, up 30 degrees, level, down 30 degrees, level: two convex joints and two concave ones.
Scene slope_joints_with(double snap) {
  Scene scene = walk(-3, half_height + 0.02, 1, 240);
  scene.character.snap = snap;
  constexpr double run = 4;
  add_polygon(
      scene, "hill",
      {{-5, -1}, {26, -1}, {26, 0}, {3 * run, 0}, {2 * run, run * tan_30}, {run, run * tan_30}, {0, 0}, {-5, 0}});
  scene.answers = {x_is(-3 + walked(scene, scene.steps)).law(), y_is(half_height)};
  return scene;
}

/// Half-way down it stands with its left foot on the slope.
Scene slope_joints() {
  Scene scene = slope_joints_with(0.5);
  constexpr int steps = 132;
  const double x = -3 + walked(scene, steps);
  scene.answers.push_back(y_is((12 - (x - foot)) * tan_30 + half_height).after(steps).law());
  return scene;
}

/// Stands on a slope, then walks down its 30 degrees and up another of 10.
Scene skier_with(double snap) {
  constexpr double x = 1;
  constexpr int begin = 30;
  // The left foot stands on it while the slope falls to the right.
  Scene scene = walk(x, half_height - (x - foot) * tan_30 + 0.02, 0, 240);
  scene.input.push_back(steer(begin, 1));
  scene.character.walk_speed = 8;
  scene.character.snap = snap;
  constexpr double run = 10;
  constexpr double low = -run * tan_30;
  add_polygon(scene, "piste", {{0, 0}, {0, -20}, {5 * run, -20}, {5 * run, low + 4 * run * tan_10}, {run, low}});
  const double end = x + walked(scene, scene.steps - begin);
  scene.answers = {x_is(end).law(), y_is(low + (end + foot - run) * tan_10 + half_height).law(),
                   count(Answer::Of::in_the_air, 0).after(120).law()};  // it is on the second slope then
  return scene;
}

/// Walks down the first slope, too, without leaving it.
Scene skier() {
  Scene scene = skier_with(0.5);
  constexpr int steps = 90;
  const double x = 1 + walked(scene, steps - 30);
  scene.answers.push_back(y_is((foot - x) * tan_30 + half_height).after(steps).law());
  scene.answers.push_back(count(Answer::Of::in_the_air, 0).after(30).law());
  return scene;
}

Scene skier_no_snap() {
  Scene scene = skier_with(0);
  scene.answers.push_back(between(Answer::Of::in_the_air, 1, scene.steps).after(30).law());
  return scene;
}

/// Falls down a shaft onto its floor. @param half of the width between the walls [m].
Scene shaft_of(double half) {
  Scene scene = flight(0, 5, 0, 0, 180, 10);
  add_box(scene, "left", -half - 1, -1, -half, 8);
  add_box(scene, "right", half, -1, half + 1, 8);
  add_box(scene, "floor", -half, -1, half, 0);
  scene.answers = {x_is(0), between(Answer::Of::place, half_height, 5, {0, 1})};
  return scene;
}

Scene shaft_wider() {
  constexpr double room = 1e-6;
  Scene scene = shaft_of(half_width + room);
  scene.answers = {x_is(0).within(0), y_is(half_height).beyond(room),
                   contact(steps_to_fall(scene, 5 - half_height), 9 * scene.dt).to("floor").beyond(room)};
  return scene;
}

}  // namespace

std::vector<SceneFamily> ground_families() {
  return {
      {"tiles", "walk along flush tiles of 1 m: speed and height do not change at the seams", tile_parameters(), tiles},
      {"shaft",
       "a fall down a shaft onto its floor",
       {{"clearance", "m", 0, 1, 1e-6, "between the character and each wall"}},
       [](const ParameterValues& values) { return shaft_of(half_width + values["clearance"]); }}};
}

std::vector<BuiltInScene> ground_scenes() {
  return {
      {"flush_tiles", "walk at 7.3 m/s over separate 1 m tiles: speed and height do not change at the seams", "tiles",
       walked_at(7.3)},
      {"flush_tiles_slow", "the same at 1.7 m/s: no change", "tiles", walked_at(1.7)},
      {"flush_tiles_fast", "the same at 11.3 m/s: no change", "tiles", walked_at(11.3)},
      {"flush_tiles_slide", "slide at 5 m/s with nothing to steer: speed and height do not change at the seams",
       flush_tiles_slide},
      {"slope_joints", "walk over a hill of 30 degrees with snap: the path is the hill's offset curve", slope_joints},
      {"slope_joints_no_snap", "the same without snap: a ballistic hop where the ground falls away",
       [] { return slope_joints_with(0); }},
      {"skier", "down 30 degrees, then up 10, with snap: the path is the offset curve", skier},
      {"skier_no_snap", "the same without snap: hops down, follows up", skier_no_snap},
      {"exact_fit_shaft", "a shaft exactly as wide as the character: falls or stays, never overlaps",
       [] { return shaft_of(half_width); }},
      {"shaft_one_ulp_wider", "one ulp of room on each side, which counts as closed: never overlaps",
       [] { return shaft_of(std::nextafter(half_width, 1.0)); }},
      {"shaft_1um_wider", "1 micrometre of room on each side: falls freely, x does not change", shaft_wider},
  };
}

}  // namespace paperproof::compare
