/// Where a rule begins to hold: the climb limit, the length of a step and of each step, numbers of tiles, sensors,
/// perturbed replicas: scenes 13, 26, 27, 32, 34 and 35.
#include "scenes/built_in.hpp"

#include <cmath>
#include <random>

namespace paperproof::compare {

namespace {

/// Walks from level ground against a ramp 3 m long that rises by `tangent`.
Scene ramp_of(double tangent) {
  Scene scene = walk(-2, half_height + 0.02, 1, 90, 30);
  scene.character.max_climb_degrees = 50;
  add_polygon(scene, "ground", {{-6, -1}, {9, -1}, {9, 3 * tangent}, {3, 3 * tangent}, {0, 0}, {-6, 0}});
  return scene;
}

/// Ends on the plateau.
Scene climbed(double tangent) {
  Scene scene = ramp_of(tangent);
  scene.answers = {x_is(-2 + walked(scene, scene.steps)).law(), y_is(3 * tangent + half_height).law()};
  return scene;
}

/// Ends with its right foot where the ramp begins.
Scene not_climbed(double tangent) {
  Scene scene = ramp_of(tangent);
  scene.answers = {x_is(-foot).gaps(std::hypot(1, tangent) / tangent + 1).law(), y_is(half_height).law(),
                   farthest({0, 1}, half_height + 0.02).law()};
  return scene;
}

/// Falls for one second through empty air.
Scene fall(const ParameterValues& values) {
  const double dt = values["dt"];
  const int steps = static_cast<int>(std::lround(1 / dt));
  Scene scene = flight(0, 0, 0, 0, steps, 10);
  scene.dt = dt;
  add_box(scene, "floor", -4, -30, 4, -29);
  scene.answers = {x_is(0).within(0), y_is(-fallen(scene, steps)).within(1e-11 * steps)};
  return scene;
}

/// 64 lengths from 1/1024 to 31/1024 s in no order: each and the next make 32/1024 s, so all of them 1 s, exactly.
std::vector<double> uneven_steps() {
  std::vector<double> lengths;
  for (int pair = 0; pair < 32; ++pair) {
    const int first = (11 * pair + 5) % 31 + 1;
    for (const int part : {first, 32 - first}) lengths.push_back(part / 1024.0);
  }
  return lengths;
}

/// Flies for two seconds at a constant velocity, none of whose steps a double holds.
Scene even_flight() {
  Scene scene = flight(0.1, 0.2, 3.7, -1.3, 128);
  scene.dt = 1.0 / 64;
  add_box(scene, "floor", -4, -30, 4, -29);
  // The way of a step and the position after it are rounded once each.
  const double rounding = 128 * ulp(7.5);
  scene.answers = {x_is(0.1 + 2 * 3.7).within(rounding), y_is(0.2 - 2 * 1.3).within(rounding)};
  return scene;
}

Scene uneven_flight() {
  Scene scene = even_flight();
  scene.dt_list = uneven_steps();
  return scene;
}

/// Drops, walks and meets a wall in steps of any length, which are drawn at random: as often from one decade as from
/// another.
Scene random_steps(const ParameterValues& values) {
  constexpr double shortest = 1e-4;  // [s]
  constexpr double time = 8;         // [s]
  Scene scene = walk(0, half_height + 0.02, 1, 1, 30);
  std::mt19937_64 random(static_cast<std::uint64_t>(values["seed"]));
  double sum = 0;
  for (scene.steps = 0; sum < time; ++scene.steps) {
    const double share = static_cast<double>(random() >> 11U) * 0x1p-53;
    scene.dt_list.push_back(shortest * std::pow(values["longest"] / shortest, share));
    sum += scene.dt_list.back();
  }
  scene.dt = sum / scene.steps;
  add_box(scene, "floor", -4, -1, 30, 0);
  add_box(scene, "wall", 14, 0, 15, 6);
  ends_at(scene, 14 - half_width, half_height);
  return scene;
}

/// Stands on a lift that goes up and down while the steps differ.
Scene uneven_lift() {
  Scene scene = flight(0, half_height + 0.02, 0, 0, 512, 30);
  scene.dt_list = uneven_steps();
  add_box(scene, "lift", -2, -0.25, 2, 0);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 0.5, .at = {0, 0}}, {.time = 2.5, .at = {1, 3}}},
            MoverDef::Loop::ping_pong);
  add_box(scene, "ground", -10, -10, 10, -9);
  // After 8 s it is on its way down again for half a second.
  scene.answers = {x_is(0.75), y_is(2.25 + half_height), is(Answer::Of::drift, 0).to("lift").after(30).within(ulp(3.7)),
                   count(Answer::Of::in_the_air, 0).after(30)};
  return scene;
}

/// Walks over `count` tiles of 1 m in rows of 1,000, the uppermost of which is walked on.
Scene tiles_of(int count) {
  Scene scene = walk(0.5, half_height + 0.02, 1, 300);
  for (int i = 0; i < count; ++i) {
    const int column = i % 1000;
    const int row = i / 1000;
    add_box(scene, "tile" + std::to_string(i), column, -row - 1, column + 1, -row);
  }
  scene.answers = {contact(steps_to_fall(scene, 0.02), fallen(scene, 1))};
  ends_at(scene, 0.5 + walked(scene, scene.steps), half_height);
  return scene;
}

/// Flies at 6,000 m/s, 100 m in a step, through a sensor of 1 cm and one of no thickness at all.
Scene thin_sensor() {
  Scene scene = flight(0, 0, 6000, 0, 3);
  add_box(scene, "gate", 20, -2, 20.01, 2).sensor = true;
  add_chain(scene, "line", {{40, -2}, {40, 2}}).sensor = true;
  add_box(scene, "wall", 150, -2, 151, 2);
  constexpr double step_x = 100;
  const auto after = [](Answer::Of of, double way) { return is(of, way / step_x).gaps(1 / step_x).within(1e-12); };
  scene.answers = {
      after(Answer::Of::enter, 20 - half_width).to("gate"), after(Answer::Of::leave, 20.01 + half_width).to("gate"),
      after(Answer::Of::enter, 40 - half_width).to("line"), after(Answer::Of::leave, 40 + half_width).to("line"),
      contact((150 - half_width) / step_x, step_x).to("wall")};
  ends_at(scene, 150 - half_width, 0);
  return scene;
}

/// Flies at 6 m/s through a sensor that is no whole square, and into a wall.
Scene sensor_gate() {
  Scene scene = flight(0.5, half_height, 6, 0, 120);
  add_box(scene, "gate", 4, -1, 4.5, 3).sensor = true;
  add_box(scene, "wall", 8, -1, 9, 3);
  constexpr double step_x = 0.1;
  scene.answers = {is(Answer::Of::enter, (3.5 - half_width) / step_x).gaps(1 / step_x).within(1e-9).to("gate"),
                   is(Answer::Of::leave, (4 + half_width) / step_x).gaps(1 / step_x).within(1e-9).to("gate"),
                   contact((7.5 - half_width) / step_x, step_x).to("wall"), count(Answer::Of::contacts, 0).to("gate")};
  ends_at(scene, 8 - half_width, half_height);
  return scene;
}

/// Walks, jumps onto a block, meets a wall. Every margin is far beyond a millimetre: of the jump over the block's
/// corner, of the steps on which something is met.
Scene replica(const ParameterValues& values) {
  const double distance = values["aside"];
  Scene scene = walk(distance, half_height + 0.02 + distance, 1, 240, 30);
  add_box(scene, "floor", -4, -1, 30, 0);
  add_box(scene, "block", 6, 0, 9, 1);
  add_box(scene, "wall", 14, 0, 15, 6);
  hold_jump(scene, 40, 60);
  scene.answers = {contact(steps_to_fall(scene, 0.02 + distance), 2 * fallen(scene, 1)).to("floor"),
                   contact(steps_to_walk(scene, 14 - half_width - distance), 0.1).to("wall"),
                   farthest({0, 1}, half_height + risen(scene, 24))};  // 12 m/s less 0.5 m/s a step
  ends_at(scene, 14 - half_width, half_height);
  rests_after(scene, 200);
  return scene;
}

}  // namespace

std::vector<SceneFamily> limit_families() {
  return {
      {"fall", "a fall of one second through empty air", {{"dt", "s", 1e-6, 1, 1.0 / 60, "length of a step"}}, fall},
      {"replica_of",
       "walk, jump, wall, begun a little aside: the same sequence of events",
       {{"aside", "m", 0, 0.01, 0, "of where the walk begins, to the right and up"}},
       replica},
      {"random_steps",
       "walk and wall in steps of random lengths: ends at the wall",
       {{"longest", "s", 1e-3, 1, 0.1, "step; the shortest is 1e-4 s"}, {"seed", "", 1, 1e9, 1, "of the lengths"}},
       random_steps}};
}

std::vector<BuiltInScene> limit_scenes() {
  return {
      // Their tangents are those of 50 degrees and the angle in the name.
      {"climb_limit_-1e-6", "against a ramp of 50° - 1e-6 rad with a limit of 50°: is walked up",
       [] { return climbed(1.1917511723204688); }},
      {"climb_limit_+1e-6", "against a ramp of 50° + 1e-6 rad with a limit of 50°: is not",
       [] { return not_climbed(1.19175601287372); }},
      {"climb_limit_-0.05", "against a ramp of 50° - 0.05 rad with a limit of 50°: is walked up",
       [] { return climbed(1.0774552687432373); }},
      {"climb_limit_+0.05", "against a ramp of 50° + 0.05 rad with a limit of 50°: is not",
       [] { return not_climbed(1.3205494158674156); }},
      {"fall_dt_1", "a fall of one second in 1 step: g h² n (n + 1) / 2 = 10 m", "fall", with("dt", 1)},
      {"fall_dt_1e-1", "the same in 10 steps: 5.5 m", "fall", with("dt", 0.1)},
      {"fall_dt_1e-2", "the same in 100 steps: 5.05 m", "fall", with("dt", 0.01)},
      {"fall_dt_1e-3", "the same in 1,000 steps: 5.005 m", "fall", with("dt", 0.001)},
      {"fall_dt_1e-4", "the same in 10,000 steps: 5.0005 m", "fall", with("dt", 0.0001)},
      {"even_flight", "two seconds at a constant velocity in 128 steps of 1/64 s", even_flight},
      {"uneven_flight", "the same in 128 steps of 1/1024 to 31/1024 s: the same end, to an ulp per step",
       uneven_flight},
      {"uneven_lift", "stands on a lift while the steps differ: carried without a lag, (p - m) within an ulp",
       uneven_lift},
      {"tiles_1e2", "walks over 100 tiles: what more tiles around it must not change", [] { return tiles_of(100); }},
      {"tiles_1e3", "walks over 1,000 tiles: the same", [] { return tiles_of(1000); }},
      {"tiles_1e4", "walks over 10,000 tiles: the same", [] { return tiles_of(10'000); }},
      {"thin_sensor", "100 m in a step through a sensor of 1 cm and one of none: one enter and one exit each",
       thin_sensor},
      {"sensor_gate", "through a sensor in steps 31 to 43, into a wall in step 71: the sensor stops no character",
       sensor_gate},
      {"replica", "walk, jump, wall: the sequence of events that perturbed replicas share", "replica_of",
       with("aside", 0)},
      {"replica_1e-12", "the same begun 1e-12 m aside: the same sequence of events", "replica_of",
       with("aside", 1e-12)},
      {"replica_1e-9", "the same begun 1e-9 m aside: the same sequence of events", "replica_of", with("aside", 1e-9)},
      {"replica_1e-6", "the same begun 1e-6 m aside: the same sequence of events", "replica_of", with("aside", 1e-6)},
      {"replica_1e-3", "the same begun 1e-3 m aside: the same sequence of events", "replica_of", with("aside", 1e-3)},
  };
}

}  // namespace paperproof::compare
