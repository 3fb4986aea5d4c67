/// Where the article's points, its rules and its knobs show: scenes 20, 36, 37, 39 and 40.
#include "scenes/built_in.hpp"

namespace paperproof::compare {

namespace {

InputEvent steer(int step, double move) { return {.step = step, .move = move, .jump = std::nullopt}; }

/// Falls onto a spike that is narrower everywhere than the distance between the two foot points.
Scene spike_between_feet() {
  Scene scene = flight(0, 4, 0, 0, 120);
  scene.gravity = {0, -30};
  add_box(scene, "floor", -4, -1, 4, 0);
  constexpr double half_base = 3 * pixel;  // the feet are 5 px from the middle
  add_polygon(scene, "spike", {{-half_base, 0}, {half_base, 0}, {0, 2}});
  ends_at(scene, 0, 2 + half_height);
  return scene;
}

/// Walks at 20 m/s from level ground up a thin ramp; a lower floor catches whoever passes it.
Scene sloped_paper_walk() {
  Scene scene = walk(-3, half_height + 0.02, 1, 90);
  scene.gravity = {0, -30};
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
  Scene scene = walk(x, half_height + 0.02, 1, steps);
  scene.gravity = {0, -30};
  scene.jump_rules = {.no_jump_toward_wall = true, .side_hit_ends_rise = true};
  add_box(scene, "floor", -6, -1, 8, 0);
  return scene;
}

Scene jump_into_wall() {
  Scene scene = jumper(-1, 180);
  add_box(scene, "wall", 3, 0, 4, 8);
  // The first jump meets the wall while rising; the second is pressed beside the wall, toward it.
  for (const InputEvent& event : {press(28), release(40), press(110), release(120)}) scene.input.push_back(event);
  const double met = steps_to_walk(scene, 4 - half_width);
  const int rising = static_cast<int>(met) - 28;  // whole steps before the wall is met; in the next one it is
  scene.answers = {
      contact(met, scene.character.walk_speed * scene.dt).to("wall"),
      between(Answer::Of::farthest, half_height + risen(scene, rising), half_height + risen(scene, rising + 1), {0, 1}),
      count(Answer::Of::in_the_air, 0).after(100).law()};
  ends_at(scene, 3 - half_width, half_height);
  return scene;
}

Scene jump_into_overhang() {
  Scene scene = jumper(-2, 180);
  add_polygon(scene, "overhang", {{0, 3}, {5, 1.5}, {5, 4}, {0, 4}});
  for (const InputEvent& event : {press(20), release(30), press(100), release(110)}) scene.input.push_back(event);
  // The right of its head meets y = 3 - 0.3 x.
  const auto below = [&scene](int steps) {
    const double head = half_height + risen(scene, steps - 20) + half_height;
    return 3 - 0.3 * (-2 + walked(scene, steps) + foot) - head;
  };
  int step = 20;
  while (below(step + 1) > 0) ++step;
  const double approach = below(step) - below(step + 1);
  scene.answers = {contact(step + below(step) / approach, approach).to("overhang"), is(Answer::Of::setback, 0, {1, 0})};
  return scene;
}

Scene jump_into_corner() {
  Scene scene = jumper(0, 180);
  add_box(scene, "wall", 3, 0, 4, 8);
  add_box(scene, "ceiling", -6, 2.5, 3, 3.5);
  scene.answers = {contact(steps_to_walk(scene, 3 - half_width), scene.character.walk_speed * scene.dt).to("wall"),
                   farthest({0, 1}, 2.5 - half_height)};
  ends_at(scene, 3 - half_width, half_height);
  for (const InputEvent& event : {press(20), release(30), press(100), release(110)}) scene.input.push_back(event);
  return scene;
}

/// Stands with its middle 7 px beyond the edge: both feet are over the edge, the corner of the bounding box is not.
Scene ledge_hang() {
  Scene scene = flight(7 * pixel, half_height + 0.02, 0, 0, 120);
  scene.gravity = {0, -30};
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
  for (const InputEvent& event : {press(30), release(40)}) scene.input.push_back(event);
  scene.answers = {count(Answer::Of::contacts, 0).to("block"), farthest({0, 1}, apex)};
  ends_at(scene, 0, half_height);
  return scene;
}

/// Walks left into a wall, then away from it, then jumps.
Scene stuck_points() {
  Scene scene = walk(0, half_height + 0.02, -1, 200);
  add_box(scene, "floor", -4, -1, 20, 0);
  add_box(scene, "wall", -2, 0, -1, 4);
  for (const InputEvent& event : {steer(60, 1), press(120), release(130)}) scene.input.push_back(event);
  scene.answers = {contact(steps_to_walk(scene, 1 - half_width), 4 * scene.dt).to("wall")};
  ends_at(scene, -1 + half_width + walked(scene, 140), half_height + risen(scene, 80));
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
      {"jump_into_overhang", "jumps into a sloping overhang: is not thrown back while rising", jump_into_overhang},
      {"jump_into_corner", "jumps into the corner of wall and ceiling: both are met, neither is entered",
       jump_into_corner},
      {"ledge_hang", "7 px beyond an edge: the eight points and the octagon let it fall or slip, four corners hold it",
       ledge_hang},
      {"false_ceiling",
       "jumps beside a block: four corners hit a ceiling that is none, eight points and octagon do not", false_ceiling},
      {"stuck_points",
       "into a wall, away, a jump: testing all points at once sticks to the wall, by direction does not", stuck_points},
  };
}

}  // namespace paperproof::compare
