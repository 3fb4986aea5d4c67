/// Where the article's points, rules, knobs, iterations and grid show.
#include "scenes/built_in.hpp"

#include <array>
#include <cmath>

namespace paperproof::compare {

namespace {

/// Falls onto a spike that is narrower everywhere than the distance between the two foot points.
Scene spike_between_feet() {
  Scene scene = flight(0, 4, 0, 0, 120, 30);
  add_box(scene, "floor", -4, -1, 4, 0);
  constexpr double half_base = 3 * pixel;  // the feet are 5 px from the middle
  add_polygon(scene, "spike", {{-half_base, 0}, {half_base, 0}, {0, 2}});
  ends_at(scene, 0, 2 + half_height);
  return scene;
}

/// Walks at 20 m/s from level ground up a thin ramp; a lower floor catches a character that passes it.
Scene sloped_paper_walk() {
  Scene scene = walk(-3, half_height + 0.02, 1, 90, 30);
  scene.character.walk_speed = 20;
  scene.start.velocity = {20, 0};
  constexpr double thickness = 0.01;
  constexpr double run = 24;
  add_box(scene, "ground", -6, -thickness, 0, 0);
  add_polygon(scene, "paper", {{0, -thickness}, {run, run * tan_30 - thickness}, {run, run * tan_30}, {0, 0}});
  add_box(scene, "cellar", -6, -4, 40, -3);
  constexpr int steps = 80;  // before it comes to the paper's end
  const double x = -3 + 20 * scene.dt * steps;
  scene.answers = {farthest({0, -1}, -half_height), x_is(x).after(steps).law(),
                   y_is((x + foot) * tan_30 + half_height).after(steps).law()};
  return scene;
}

/// A room's floor and a character that has the article's two jumping rules.
Scene jumper(double x, int steps) {
  Scene scene = walk(x, half_height + 0.02, 1, steps, 30);
  scene.jump_rules = {.no_jump_toward_wall = true, .side_hit_ends_rise = true};
  add_box(scene, "floor", -6, -1, 8, 0);
  return scene;
}

Scene jump_into_wall() {
  Scene scene = jumper(-1, 180);
  add_box(scene, "wall", 3, 0, 4, 8);
  // The first jump meets the wall while rising; the second is pressed beside the wall, toward it.
  hold_jump(scene, 28, 40);
  hold_jump(scene, 110, 120);
  const double met = steps_to_walk(scene, 4 - half_width);
  const int rising = static_cast<int>(met) - 28;  // whole steps before the wall is met; in the next one it is
  scene.answers = {
      contact(met, scene.character.walk_speed * scene.dt).to("wall"),
      between(Answer::Of::farthest, half_height + risen(scene, rising), half_height + risen(scene, rising + 1), {0, 1}),
      count(Answer::Of::in_the_air, 0).after(100).law()};
  ends_at(scene, 3 - half_width, half_height);
  return scene;
}

/// Stands idle half a pixel beside a wall; then jump and direction are pressed in the same step.
Scene jump_beside_wall() {
  Scene scene = jumper(3 - half_width - pixel / 2, 120);
  add_box(scene, "wall", 3, 0, 4, 8);
  scene.input = {{.step = 60, .move = 1, .jump = true}, release(70)};
  scene.answers = {farthest({0, 1}, scene.start.position.y()), count(Answer::Of::in_the_air, 0).after(30).law()};
  ends_at(scene, 3 - half_width, half_height);
  return scene;
}

/// The overhang leans by 14 degrees, less than the flank from arm to head (27): the arm meets it, and is pushed back as
/// long as the character rises. The rules are left to contender and knob.
Scene jump_into_overhang() {
  Scene scene = jumper(-2, 90);
  scene.jump_rules = {};
  constexpr double back_per_rise = 0.25;
  add_polygon(scene, "overhang", {{1, 1.5}, {3, 1.5}, {3, 5.5}, {0, 5.5}});
  hold_jump(scene, 20, 30);
  const auto room = [&scene](int steps) {
    const double arm = half_height + risen(scene, steps - 20) + 10 * pixel;
    return 1 - back_per_rise * (arm - 1.5) - (-2 + walked(scene, steps) + half_width);
  };
  int step = 20;
  while (room(step + 1) > 0) ++step;
  const double approach = room(step) - room(step + 1);
  const double along_normal = approach / std::hypot(1, back_per_rise);
  scene.answers = {contact(step + room(step) / approach, along_normal).to("overhang")};
  return scene;
}

Scene jump_into_corner() {
  Scene scene = jumper(0, 180);
  add_box(scene, "wall", 3, 0, 4, 8);
  add_box(scene, "ceiling", -6, 2.5, 3, 3.5);
  scene.answers = {contact(steps_to_walk(scene, 3 - half_width), scene.character.walk_speed * scene.dt).to("wall"),
                   farthest({0, 1}, 2.5 - half_height)};
  ends_at(scene, 3 - half_width, half_height);
  hold_jump(scene, 20, 30);
  hold_jump(scene, 100, 110);
  return scene;
}

/// Stands with its middle 7 px beyond the edge: both feet are over the edge, the corner of the bounding box is not.
Scene ledge_hang() {
  Scene scene = flight(7 * pixel, half_height + 0.02, 0, 0, 120, 30);
  add_box(scene, "ledge", -4, -1, 0, 0);
  add_box(scene, "ground", -4, -6, 4, -5);
  scene.answers = {y_is(-5 + half_height).after(60)};  // it slips off, and slides on along the ground
  return scene;
}

/// Jumps beside a block whose corner comes into the bounding box at the top of the jump, but not into the octagon.
Scene false_ceiling() {
  Scene scene = walk(0, half_height + 0.02, 0, 150);
  scene.character.jump_speed = 5;
  add_box(scene, "floor", -4, -1, 4, 0);
  constexpr double apex = half_height + 1.25 - 5.0 / 120;  // v²/2g - v dt/2 above the floor
  add_box(scene, "block", 8 * pixel, apex + 18 * pixel, 3, apex + 1.5);
  hold_jump(scene, 30, 40);
  scene.answers = {count(Answer::Of::contacts, 0).to("block"), farthest({0, 1}, apex)};
  ends_at(scene, 0, half_height);
  return scene;
}

/// Rises out of a floor that its feet are in. They do not face the movement: tested all the same, they end it. Who
/// first puts the start right rises from the floor, anybody else from where it began.
Scene stuck_points() {
  constexpr double depth = 6 * pixel;
  Scene scene = flight(0, half_height - depth, 0, 5, 120, 10);
  scene.start.resolve_overlap = true;
  add_box(scene, "floor", -4, -1, 4, 0);
  scene.character.jump_speed = scene.start.velocity.y();
  const double apex = half_height + risen(scene, 30);  // v/g = 0.5 s
  scene.answers = {between(Answer::Of::farthest, apex - depth, apex, {0, 1})};
  ends_at(scene, 0, half_height);
  return scene;
}

/// Walks down a slope of 45 degrees, y = -x, into a wall that leans over it: the wall pushes the walker back into the
/// slope, the slope up into the wall again.
Scene walk_down_to_wall(double lean) {
  Scene scene = walk(-1, 1 + foot + half_height + 0.05, 1, 300, 30);
  add_polygon(scene, "slope", {{-8, 8}, {-8, -8}, {8, -8}});
  add_polygon(scene, "wall", {{2, -2}, {9, -2}, {9, 8}, {2 - 10 * lean, 8}});
  // The left foot stands on the slope, the right upper arm is at the wall.
  constexpr double arm = 10 * pixel;
  const double x = (2 - half_width - lean * (2 + half_height + foot + arm)) / (1 - lean);
  scene.answers = {x_is(x).gaps(4), y_is(half_height + foot - x).gaps(4)};
  return scene;
}

Scene leaning_valley() {
  constexpr double tan_20 = 0.36397023426620234;
  return walk_down_to_wall(tan_20);
}

/// A character of one square, 3.4 squares along a passage that is two squares high, and a jump against its ceiling.
Scene one_square() {
  constexpr int released = 34;
  Scene scene = walk(0.5, 0.5, 1, 150);
  const std::array corners{Vec2d{0, 0}, Vec2d{32, 0}, Vec2d{0, 32}, Vec2d{32, 32}};
  scene.character.shape = CharacterShape::from_pixels(corners, scene.pixels_per_metre);
  add_box(scene, "floor", -4, -1, 8, 0);
  add_box(scene, "ceiling", -4, 2, 8, 3);
  scene.input.push_back(steer(released, 0));
  hold_jump(scene, 90, 100);
  // Braking takes as long as speeding up did: every step with the key counts once at full speed.
  ends_at(scene, 0.5 + released * scene.character.walk_speed * scene.dt, 0.5);
  scene.answers.push_back(farthest({0, 1}, 1.5));
  return scene;
}

}  // namespace

std::vector<BuiltInScene> article_scenes() {
  return {
      {"spike_between_feet", "falls onto a spike between its feet: the octagon stands on the tip, eight points miss it",
       spike_between_feet},
      {"sloped_paper_walk",
       "20 m/s up a thin ramp: eight points with the component rule pass it sideways, the octagon not",
       sloped_paper_walk},
      {"jump_into_wall", "jumps into a wall: the rise ends there, and no jump while beside the wall, toward it",
       jump_into_wall},
      {"jump_beside_wall", "jump and direction at once beside a wall that nothing has touched: no jump",
       jump_beside_wall},
      {"jump_into_overhang",
       "jumps into a steep overhang: springs back while rising, unless the rule ends the rise (jump_rules=on)",
       jump_into_overhang},
      {"jump_into_corner", "jumps into the corner of wall and ceiling: both are met, neither is entered",
       jump_into_corner},
      {"ledge_hang", "7 px beyond an edge: the eight points and the octagon let it fall or slip, four corners hold it",
       ledge_hang},
      {"false_ceiling",
       "jumps beside a block: four corners hit a ceiling that is none, eight points and octagon do not", false_ceiling},
      {"stuck_points", "rises with its feet in a floor: with pairs=all they hold it there, by direction it rises 1 m",
       stuck_points},
      {"valley", "45 degrees down to a wall: one iteration ends inside the slope, two do not",
       [] { return walk_down_to_wall(0); }},
      {"leaning_valley", "the same, the wall leans over by 20 degrees: every iteration leaves less", leaning_valley},
      {"one_square", "a character of one square: the grid tests all of it, and draws it in a square when it stops",
       one_square},
  };
}

}  // namespace paperproof::compare
