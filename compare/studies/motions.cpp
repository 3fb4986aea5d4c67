#include "studies/motions.hpp"

#include "scenes/built_in.hpp"

#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

constexpr double root_3 = 1.7320508075688772;
constexpr double start_gap = 1e-6;

Scene still(const Vec2d& position, const Vec2d& velocity, double gravity) {
  Scene scene;
  scene.gravity = {0, -gravity};
  scene.jump_rules = {.no_jump_toward_wall = false, .side_hit_ends_rise = false};  // the law of all is the same
  scene.start.position = position;
  scene.start.velocity = velocity;
  return scene;
}

Scene thrown() {
  Scene scene = still({0, 0}, {3, 8}, 10);
  add_box(scene, "floor", -5, -31, 5, -30);
  return scene;
}

Scene rest() {
  Scene scene = still({0, 2 + half_height}, {0, 0}, 10);
  add_box(scene, "floor", -4, -1, 4, 0);
  return scene;
}

/// The left foot, at (-5, -20) px, is on a slope of 60 degrees downwards to the right.
Scene slide() {
  constexpr double support = half_height / 4 * root_3 / 2 + half_height / 2;  // of the surface, along its normal
  Scene scene = still(Vec2d(root_3 / 2, 0.5) * (support + start_gap), {0, 0}, 10);
  add_polygon(scene, "slope", {{-10, 10 * root_3}, {-10, -10 * root_3}, {10, -10 * root_3}});
  return scene;
}

/// The right foot, at (5, -20) px, is on a slope of 30 degrees upwards to the right.
Scene on_30_degrees() {
  constexpr double support = 5.0 / 32;
  Scene scene = still({0, half_height + support / root_3 + start_gap}, {4, 4 / root_3}, 10);
  scene.character.walk_speed = 4;
  add_polygon(scene, "slope", {{-10, -10 / root_3}, {10, -10 / root_3}, {10, 10 / root_3}});
  return scene;
}

Scene walked_up() {
  Scene scene = on_30_degrees();
  scene.input = {{.step = 0, .move = 1, .jump = std::nullopt}};
  return scene;
}

Scene corridor() {
  Scene scene = still({0, 0}, {6, 2}, 0);
  add_box(scene, "wall", 2 + half_width, -10, 3 + half_width, 20);
  add_box(scene, "other_wall", -4, -10, -3, 20);
  return scene;
}

Scene bullet() {
  Scene scene = still({0, 10 + half_height}, {0, -93.75}, 0);
  add_box(scene, "plate", -4, -0.05, 4, 0);
  return scene;
}

Scene lift() {
  Scene scene = still({0, half_height + start_gap / 2}, {0, 0}, 10);
  add_box(scene, "lift", -2, -0.5, 2, 0);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 4, .at = {0, 6}}});
  return scene;
}

/// Tiles of 1 m: `#` is solid, `/` and `\` are slopes of 45 degrees.
constexpr std::array<std::string_view, 11> level_map{
    "#......................................#",     //
    "#......................................#",     //
    "#......................................#",     //
    "#...........................##.........#",     //
    "#......................##..............#",     //
    "#..............###...............##....#",     //
    "#.......##...............##............#",     //
    "#.....................................##",     //
    "#.../\\........../##\\...........##.....###",  //
    "########################################",     //
    "########################################",
};

void add_tile(Scene& scene, char tile, double x, double y) {
  std::string id = "tile_" + std::to_string(scene.ids.size());
  if (tile == '#') add_box(scene, std::move(id), x, y, x + 1, y + 1);
  if (tile == '/') add_polygon(scene, std::move(id), {{x, y}, {x + 1, y}, {x + 1, y + 1}});
  if (tile == '\\') add_polygon(scene, std::move(id), {{x, y}, {x + 1, y}, {x, y + 1}});
}

/// Keys as `random_input` of a seed has them at 60 steps per second, at the next longest step before. The start is 3 mm
/// off the grid of tiles: else a fall of steps of 1/60 s would meet a crest exactly, and the gap would decide.
Scene level() {
  Scene scene = still({2.003, 5}, {0, 0}, 30);
  for (std::size_t row = 0; row < level_map.size(); ++row)
    for (std::size_t column = 0; column < level_map[row].size(); ++column)
      add_tile(scene, level_map[row][column], static_cast<double>(column),
               static_cast<double>(level_map.size() - 1 - row));
  scene.input = random_input(15, 720);
  for (InputEvent& event : scene.input) event.step /= 4;
  return scene;
}

}  // namespace

const std::vector<Motion>& motions() {
  static const std::vector<Motion> all{
      {"flight", "thrown at (3, 8) m/s under 10 m/s²: x = 3 t, y = 8 t - 5 t²", 1.5, thrown},
      {"rest", "falls 2 m under 10 m/s² and rests: y = max(2 - 5 t², 0) above the floor", 1.2, rest},
      {"slide", "slides down 60 degrees without friction from rest: 5 sin(60) t² along the slope", 1, slide},
      {"corridor", "flies at (6, 2) m/s without gravity into a wall 2 m away and along it: x = min(6 t, 2), y = 2 t",
       1.5, corridor},
      {"bullet", "flies down at the article's 93.75 m/s onto a plate of 5 cm 10 m below: stops there", 0.3, bullet},
      {"lift", "stands on a lift that rises at 1.5 m/s: y = 1.5 t", 1.5, lift},
      {"walk", "walks at 4 m/s up 30 degrees: x = 4 t, y = x tan(30)", 1, walked_up},
      {"uphill", "goes up 30 degrees at 4 m/s across, and nothing steers: x = 4 t", 1, on_30_degrees,
       "a body without friction slows down, x = 4 t - 5 sin(30) cos(30) t², and comes back"},
      {"level", "12 s of keys, as recorded, through a level of 122 tiles with slopes, kerbs and platforms", 12, level,
       "a body without friction slides down the slopes of 45 degrees where it stands"},
  };
  return all;
}

Scene scene_of(const Motion& motion, double dt) {
  Scene scene = motion.make();
  scene.name = motion.name;
  scene.dt = dt;
  scene.steps = static_cast<int>(std::lround(motion.duration / dt));
  const int shorter = static_cast<int>(std::lround(longest_step / dt));
  for (InputEvent& event : scene.input) event.step *= shorter;
  return scene;
}

}  // namespace paperproof::compare
