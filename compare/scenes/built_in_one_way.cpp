/// What holds from one side only, as a truth table: scene 31.
#include "scenes/built_in.hpp"

namespace paperproof::compare {

namespace {

/// A character that stands on a floor, below a ledge.
Scene below_a_ledge(double ledge_y, int steps) {
  Scene scene = walk(0, half_height + 0.02, 0, steps, 30);
  add_box(scene, "floor", -20, -1, 20, 0);
  add_ledge(scene, "ledge", {{-4, ledge_y}, {4, ledge_y}});
  return scene;
}

/// A character that stands on a ledge 2 m above a floor.
Scene on_a_ledge(int steps) {
  Scene scene = below_a_ledge(2, steps);
  scene.start.position.y() += 2;
  return scene;
}

/// Jumps through a ledge and lands on it.
Scene one_way_from_below() {
  Scene scene = below_a_ledge(2, 180);
  hold_jump(scene, 30, 40);
  // It is met once: on the way down.
  int step = 30;
  while (risen(scene, step - 29) < 2 || risen(scene, step - 29) > risen(scene, step - 30)) ++step;
  while (risen(scene, step - 29) > 2) ++step;
  const double high = risen(scene, step - 30);
  const double approach = high - risen(scene, step - 29);
  scene.answers = {contact(step + (high - 2) / approach, approach).to("ledge")};
  ends_at(scene, 0, 2 + half_height);
  return scene;
}

/// The same through a platform of half a metre, of which only the top blocks.
Scene one_way_solid() {
  Scene scene = one_way_from_below();
  scene.scenery.colliders.back() = {.points = {{-4, 1.5}, {4, 1.5}, {4, 2}, {-4, 2}}, .one_way = Vec2d(0, 1)};
  return scene;
}

Scene one_way_from_above() {
  Scene scene = flight(0, 2 + half_height, 0, -50, 120, 30);
  add_box(scene, "floor", -4, -4, 4, -3);
  add_ledge(scene, "ledge", {{-2, 0}, {2, 0}});
  scene.answers = {contact(steps_to_fall(scene, 2, 50), 50 * scene.dt).to("ledge")};
  ends_at(scene, 0, half_height);
  return scene;
}

/// Flies level through the tip of a ledge at the height of its arms.
Scene one_way_from_the_side() {
  Scene scene = flight(-3, 0, 6, 0, 60);
  add_ledge(scene, "ledge", {{0, 0}, {2, 0}});
  scene.answers = {count(Answer::Of::contacts, 0), is(Answer::Of::speed, 6, {1, 0})};
  ends_at(scene, 3, 0);
  return scene;
}

/// Begins in the middle of a ledge: it is not wholly above, so the ledge does not hold it.
Scene one_way_from_within() {
  Scene scene = flight(0, 0, 0, 0, 90, 30);
  add_box(scene, "floor", -4, -4, 4, -3);
  add_ledge(scene, "ledge", {{-2, 0}, {2, 0}});
  scene.answers = {count(Answer::Of::contacts, 0).to("ledge"),
                   contact(steps_to_fall(scene, 3 - half_height), 10 * scene.dt).to("floor")};
  ends_at(scene, 0, -3 + half_height);
  return scene;
}

Scene one_way_at_rest() {
  Scene scene = on_a_ledge(600);
  ends_at(scene, 0, 2 + half_height);
  rests_after(scene, 60);
  return scene;
}

/// Drops for 5 steps: 5 · 6 / 2 g h² = 0.125 m, more than Box2D's rest gap and less than to the next ledge.
Scene one_way_drop() {
  Scene scene = on_a_ledge(180);
  add_ledge(scene, "lower", {{-4, 0.5}, {4, 0.5}});
  hold_drop(scene, 60, 65);
  scene.answers = {contact(60 + steps_to_fall(scene, 1.5), 9 * scene.dt).to("lower")};
  ends_at(scene, 0, 0.5 + half_height);
  return scene;
}

/// Holds the button all the way down: nothing but the floor holds it.
Scene one_way_drop_held() {
  Scene scene = on_a_ledge(180);
  add_ledge(scene, "lower", {{-4, 0.5}, {4, 0.5}});
  hold_drop(scene, 60, 120);
  scene.answers = {contact(60 + steps_to_fall(scene, 2), 10 * scene.dt).to("floor"),
                   count(Answer::Of::contacts, 0).to("lower")};
  ends_at(scene, 0, half_height);
  return scene;
}

/// Stands on a ledge that goes 3 m there and back.
Scene one_way_lift_by(const Vec2d& way) {
  Scene scene = flight(0, 4 + half_height + 0.02, 0, 0, 480, 30);
  add_box(scene, "floor", -20, -1, 20, 0);
  add_ledge(scene, "ledge", {{-2, 4}, {2, 4}});
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 0.5, .at = {0, 0}}, {.time = 2, .at = way}},
            MoverDef::Loop::ping_pong);
  return scene;
}

Scene one_way_ride(const Vec2d& way) {
  Scene scene = one_way_lift_by(way);
  carried_by(scene, "ledge", 10, ulp(7.7));
  scene.answers.push_back(x_is(way.x()).after(120));
  scene.answers.push_back(y_is(4 + way.y() + half_height).after(120));
  return scene;
}

/// Drops off a ledge that rises at 2 m/s, and takes that speed along: it comes down on the floor.
Scene one_way_lift_drop() {
  Scene scene = one_way_lift_by({0, 3});
  hold_drop(scene, 60, 66);
  // It rises at 2 m/s; gravity takes a sixtieth of itself off that in each step.
  scene.answers = {is(Answer::Of::speed, 2 + scene.gravity.y() * scene.dt, {0, 1}).after(61)};
  ends_at(scene, 0, half_height);
  return scene;
}

/// Jumps through a ledge that goes to the right and up at 0.5 m/s each, and lands on it.
Scene one_way_lift_from_below() {
  Scene scene = below_a_ledge(1.5, 180);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 10, .at = {5, 5}}});
  hold_jump(scene, 20, 40);
  scene.answers = {y_is(half_height + 1.5).to("ledge"), is(Answer::Of::speed, 0.5, {1, 0}),
                   is(Answer::Of::speed, 0.5, {0, 1})};
  return scene;
}

/// A ledge comes down to the character's middle and goes up again: its motion turns while the two overlap.
Scene one_way_turns_within() {
  Scene scene = below_a_ledge(2, 120);
  move_last(scene,
            {{.time = 0, .at = {0, 0}}, {.time = 0.75, .at = {0, half_height - 2}}, {.time = 1.5, .at = {0, 0}}});
  scene.answers = {count(Answer::Of::contacts, 0).to("ledge")};
  ends_at(scene, 0, half_height);
  return scene;
}

/// A ledge comes down past a character that floats, turns 0.5 m below its feet, and throws it up.
Scene one_way_turns_below() {
  Scene scene = flight(0, 0, 0, 0, 120);
  add_ledge(scene, "ledge", {{-2, 2}, {2, 2}});
  move_last(scene, {{.time = 0, .at = {0, 0}},
                    {.time = 0.75, .at = {0, -2 - half_height - 0.5}},
                    {.time = 1.72, .at = {0, -2 - half_height + 1}}});
  // 0.5 m below the feet it turns, after 45 steps, and rises by 1.5 m in 0.97 s: it is there after a third of that.
  const double speed = 1.5 / 0.97;
  const double met = 45 + 0.97 / 3 / scene.dt;
  scene.answers = {contact(met, speed * scene.dt), is(Answer::Of::speed, speed, {0, 1})};
  ends_at(scene, 0, speed * (scene.steps - met) * scene.dt);
  return scene;
}

}  // namespace

std::vector<BuiltInScene> one_way_scenes() {
  return {
      {"one_way_from_below", "jumps through a one-way ledge and lands on it: met once, from above", one_way_from_below},
      {"one_way_solid", "jumps through a platform of half a metre that is one-way, and lands on its top",
       one_way_solid},
      {"one_way_from_above", "falls onto a one-way ledge at 50 m/s and more: it is never passed", one_way_from_above},
      {"one_way_from_the_side", "flies through the tip of a one-way ledge: no contact, no loss of speed",
       one_way_from_the_side},
      {"one_way_from_within", "begins in the middle of a one-way ledge: falls through it to the floor",
       one_way_from_within},
      {"one_way_at_rest", "stands on a one-way ledge: it holds, and nothing moves", one_way_at_rest},
      {"one_way_drop", "drops through a one-way ledge: the next one holds", one_way_drop},
      {"one_way_drop_held", "drops for as long as it falls: no ledge holds, the floor does", one_way_drop_held},
      {"one_way_lift_up", "stands on a one-way ledge up and down again: carried",
       [] { return one_way_ride(Vec2d(0, 3)); }},
      {"one_way_lift_down", "stands on a one-way ledge down and up again: carried",
       [] { return one_way_ride(Vec2d(0, -3)); }},
      {"one_way_lift_sideways", "stands on a one-way ledge to the side and back: carried",
       [] { return one_way_ride(Vec2d(3, 0)); }},
      {"one_way_lift_drop", "drops off a one-way ledge that rises: passes it, and comes down on the floor",
       one_way_lift_drop},
      {"one_way_lift_from_below", "jumps through a one-way ledge that moves: passes it, and lands on it",
       one_way_lift_from_below},
      {"one_way_turns_within", "a one-way ledge comes down into the character and goes up again: never met",
       one_way_turns_within},
      {"one_way_turns_below", "a one-way ledge comes down past a character and up again: met once, and gives its speed",
       one_way_turns_below},
  };
}

}  // namespace paperproof::compare
