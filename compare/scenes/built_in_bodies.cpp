/// What Box2D moves: scene 28, a crate that falls, a plank on springs.
#include "scenes/built_in.hpp"

#include <cmath>

namespace paperproof::compare {

namespace {

constexpr double rest_gap = 0.015;  ///< That Box2D leaves between polygons [m].

/// Stands on four boxes of 1 kg and a fifth of `mass` [kg] on top of them.
Scene stack(const ParameterValues& values) {
  const double mass = values["mass_ratio"];
  constexpr int boxes = 5;
  constexpr double height = 0.5;
  Scene scene = flight(0, 0, 0, 0, 600, 10);
  add_box(scene, "floor", -5, -1, 5, 0);
  double top = 0;
  for (int i = 1; i <= boxes; ++i) {
    const double bottom = top + rest_gap;
    top = bottom + height;
    add_box(scene, "box_" + std::to_string(i), -1, bottom, 1, top);
    let_box2d_move_last(scene, {.mass = i == boxes ? mass : 1});
  }
  scene.start.position = {0, top + half_height + 5e-7};
  // Where the boxes go is for Box2D to say; the character goes with the uppermost one, whatever that does.
  scene.answers = {count(Answer::Of::in_the_air, 0), x_is(0)};
  if (mass <= 100) scene.answers.push_back(y_is(top + half_height).to("box_5"));  // heavier ones sink away
  return scene;
}

/// How far a mass on a spring is from where the spring is slack, after n steps from rest there [m]: the implicit Euler
/// method, which is what Box2D's soft constraint is for one spring.
double sunk(const Scene& scene, double mass, double stiffness, double damping) {
  const double h = scene.dt;
  double speed = 0;
  double way = 0;
  for (int step = 0; step < scene.steps; ++step) {
    speed = (speed + h * scene.gravity.y() - h * stiffness / mass * way) /
            (1 + h * damping / mass + h * h * stiffness / mass);
    way += h * speed;
  }
  return way;
}

/// Stands on a plank that goes up and down on two springs, between rails.
Scene plank_on_springs(const ParameterValues& values) {
  constexpr double mass = 20;
  constexpr double length = 2;
  constexpr double height = 0.25;
  constexpr double time = 4;  // [s]
  Scene scene = flight(0, length + height + half_height + 5e-7, 0, 0, 1, 10);
  scene.dt = values["dt"];
  scene.steps = static_cast<int>(std::ceil(time / scene.dt));
  add_box(scene, "floor", -5, -1, 5, 0);
  add_box(scene, "plank", -2, length, 2, length + height);
  let_box2d_move_last(scene, {.mass = mass});
  for (const double x : {-1.5, 1.5})
    scene.joints.push_back({.id = x < 0 ? "left" : "right",
                            .point = {x, length},
                            .end = {x, 0},
                            .length = length,
                            .stiffness = values["stiffness"] / 2,
                            .damping = values["damping"] / 2});
  scene.joints.push_back({.id = "rails", .kind = Joint::Kind::prismatic, .axis = {0, 1}});
  constexpr double box2ds_float = 1e-3;
  const double way = sunk(scene, mass, values["stiffness"], values["damping"]);
  scene.answers = {is(Answer::Of::drift, 0).to("plank").within(ulp(length + height + half_height)),
                   count(Answer::Of::in_the_air, 0), y_is(scene.start.position.y() + way).gaps(1).within(box2ds_float)};
  return scene;
}

/// A crate falls onto the head of a character that stands there, from `way` metres above it.
Scene falling_crate() {
  constexpr double way = 2;
  Scene scene = flight(0, half_height + 5e-7, 0, 0, 90, 10);
  add_box(scene, "floor", -5, -1, 5, 0);
  constexpr double bottom = 2 * half_height + way;
  add_box(scene, "crate", -0.5, bottom, 0.5, bottom + 1);
  let_box2d_move_last(scene, {.mass = 20});
  scene.answers = {count(Answer::Of::crush, static_cast<int>(steps_to_fall(scene, way))).law(),
                   farthest({0, -1}, -half_height)};
  return scene;
}

}  // namespace

std::vector<SceneFamily> body_families() {
  return {{"stack",
           "stands on a heavy box on four light ones, all of them Box2D's",
           {{"mass_ratio", "", 0.01, 1e6, 1, "of the heavy box to a light one of 1 kg"}},
           stack},
          {"plank_on_springs",
           "stands on a plank of 20 kg that two springs carry: never off it, wherever it goes",
           {{"stiffness", "N_m", 250, 1e9, 2000, "of both springs together"},
            {"damping", "N_s_m", 0, 1e9, 0, "the same"},
            {"dt", "s", 1e-4, 0.1, 1.0 / 60, "length of a step"}},
           plank_on_springs}};
}

std::vector<BuiltInScene> body_scenes() {
  return {
      {"stack_1", "stands on a stack of five boxes of the same mass: never inside, grounded without a toggle", "stack",
       with("mass_ratio", 1)},
      {"stack_10", "the same with 10 times the mass in the uppermost box", "stack", with("mass_ratio", 10)},
      {"stack_100", "the same with 100 times the mass: Box2D's stack gives way", "stack", with("mass_ratio", 100)},
      {"stack_1000", "the same with 1,000 times the mass: the heavy box sinks through others", "stack",
       with("mass_ratio", 1000)},
      {"stack_10000", "the same with 10,000 times the mass: light boxes are pressed through the floor", "stack",
       with("mass_ratio", 10000)},
      {"falling_crate",
       "a crate 2 m above its head falls: crushed in step 37, the first n with g h² (n + 1) (n + 2) / 2 > 2 m",
       falling_crate},
  };
}

}  // namespace paperproof::compare
