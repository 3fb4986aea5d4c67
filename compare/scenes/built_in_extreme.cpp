/// Slivers, starts inside solids, far origins, other scales and other gravities: scenes 21 to 25.
#include "scenes/built_in.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

namespace {

Scene sliver_drop() {
  Scene scene = flight(0, 3, 0, -30, 90, 30);
  add_polygon(scene, "sliver", {{-2, 0}, {2, -0.0005}, {2, 0.0005}});
  constexpr double slope = 0.0005 / 4;
  const double way = 3 - half_height - slope * (2 + foot);  // of the right foot, which stands
  scene.answers = {contact(steps_to_fall(scene, way, 30), 30 * scene.dt)};
  ends_at(scene, 0, half_height + slope * (2 + foot));
  return scene;
}

/// Begins this deep in a floor.
Scene start_inside(double y) {
  Scene scene = flight(0, y, 0, 0, 120, 30);
  scene.start.resolve_overlap = true;
  add_box(scene, "floor", -4, -2, 4, 0);
  ends_at(scene, 0, half_height);
  return scene;
}

/// Walks over tiles and into a wall, all of it just below `origin` on the x axis. Everything is a multiple of 1/64 m,
/// so that the scene is the same wherever it is.
Scene far(const ParameterValues& values) {
  const double x = values["origin"] - 16;
  Scene scene = walk(x + 0.5, half_height + 1.0 / 32, 1, 240);
  scene.dt = values["dt"];
  const auto step_at = [&](double time) { return static_cast<int>(std::lround(time / scene.dt)); };
  scene.steps = step_at(4);
  for (int i = 0; i < 14; ++i) add_box(scene, "tile" + std::to_string(i), x + i - 1, -1, x + i, 0);
  add_box(scene, "wall", x + 12, 0, x + 13, 4);
  const int jump = step_at(1.5);
  hold_jump(scene, jump, step_at(5.0 / 3));
  // It jumps over the wall.
  scene.answers = {contact(steps_to_fall(scene, 1.0 / 32), 3 * fallen(scene, 1))};
  ends_at(scene, x + 0.5 + walked(scene, scene.steps), half_height + risen(scene, scene.steps - jump));
  return scene;
}

/// Drops, walks up a ramp, meets a wall, with every length multiplied by a power of two.
Scene scaled(const ParameterValues& values) {
  const double scale = values["scale"];
  Scene scene = walk(0, (half_height + 0.25) * scale, 1, 180);
  scene.gravity *= scale;
  std::vector<Vec2d> points;
  for (const Vec2d& point : scene.character.shape.points()) points.push_back(point * scale);
  scene.character.shape = CharacterShape(points);
  scene.character.walk_speed *= scale;
  scene.character.acceleration *= scale;
  scene.character.jump_speed *= scale;
  const auto at = [&](double x, double y) { return Vec2d{x * scale, y * scale}; };
  add_polygon(scene, "ground", {at(-2, -1), at(14, -1), at(14, 2), at(8, 2), at(4, 0), at(-2, 0)});
  add_polygon(scene, "wall", {at(12, 2), at(13, 2), at(13, 6), at(12, 6)});
  scene.answers = {contact(steps_to_fall(scene, 0.25 * scale), 10 * fallen(scene, 1)).to("ground")};
  ends_at(scene, (12 - half_width) * scale, (2 + half_height) * scale);
  rests_after(scene, 150);
  return scene;
}

Scene drop(const ParameterValues& values) {
  Scene scene = flight(0, half_height + 0.25, 0, 0, 120);
  scene.gravity = {0, -values["gravity"]};
  scene.dt = values["dt"];
  scene.steps = static_cast<int>(std::ceil(std::max(2 / scene.dt, steps_to_fall(scene, 0.25) + 100)));
  add_box(scene, "floor", -4, -1, 4, 0);
  scene.answers = {contact(steps_to_fall(scene, 0.25), fallen(scene, 1))};
  ends_at(scene, 0, half_height);
  rests_after(scene, scene.steps / 2);
  return scene;
}

}  // namespace

std::vector<SceneFamily> extreme_families() {
  return {{"far",
           "walk, wall and jump, far from the origin: the same to a few ulp",
           {{"origin", "m", 16, 1e7, 16, "where on the x axis it is"},
            {"dt", "s", 1e-4, 0.1, 1.0 / 60, "length of a step"}},
           far},
          {"scaled",
           "drop, ramp and wall in another size: the same result times the scale",
           {{"scale", "", 1e-5, 1e5, 1, "of every length"}},
           scaled},
          {"drop",
           "a drop of 0.25 m: rests",
           {{"gravity", "m_s2", 0.1, 1e7, 30, "straight down"}, {"dt", "s", 1e-5, 1, 1.0 / 60, "length of a step"}},
           drop}};
}

std::vector<BuiltInScene> extreme_scenes() {
  return {
      {"sliver_drop", "drops at 30 m/s onto a sliver of 4 m x 1 mm: it is never passed", sliver_drop},
      {"start_overlapping_ulp", "begins one ulp inside a floor: comes out upwards",
       [] { return start_inside(std::nextafter(half_height, 0.0)); }},
      {"start_overlapping_slop", "begins 5 mm inside a floor: comes out upwards",
       [] { return start_inside(half_height - 0.005); }},
      {"start_overlapping_deep", "begins 0.4 m inside a floor: comes out upwards",
       [] { return start_inside(half_height - 0.4); }},
      {"far_origin_0", "walk, wall and jump at the origin: what the far ones are compared with", "far",
       with("origin", 16)},
      {"far_origin_1e3", "the same 1,000 m away: the same to a few ulp", "far", with("origin", 1e3)},
      {"far_origin_1e4", "the same 10,000 m away: the same to a few ulp", "far", with("origin", 1e4)},
      {"far_origin_1e5", "the same 100,000 m away: the same to a few ulp", "far", with("origin", 1e5)},
      {"far_origin_1e6", "the same 1,000,000 m away, the end of the guarantee: the same to a few ulp", "far",
       with("origin", 1e6)},
      {"scaled_1", "drop, ramp and wall: what the scaled ones are compared with", "scaled", with("scale", 1)},
      {"scaled_1e-3", "all lengths divided by 1,024: the same result times the scale, the gap apart", "scaled",
       with("scale", 1.0 / 1024)},
      {"scaled_1e3", "all lengths times 1,024: the same result times the scale, the gap apart", "scaled",
       with("scale", 1024)},
      {"gravity_10", "drops 0.25 m under 10 m/s²: rests", "drop", with("gravity", 10)},
      {"gravity_1e3", "the same under 1,000 m/s²: the same rest gap", "drop", with("gravity", 1e3)},
      {"gravity_1e6", "the same under 1,000,000 m/s²: the same rest gap, nothing is passed", "drop",
       with("gravity", 1e6)},
  };
}

}  // namespace paperproof::compare
