/// Several characters, which take turns: none gets past another.
#include "scenes/built_in.hpp"

#include <limits>

namespace paperproof::compare {

namespace {

void add_character(Scene& scene, double x, double y, double velocity_x, std::vector<InputEvent> input = {}) {
  scene.others.push_back({{.position = {x, y}, .velocity = {velocity_x, 0}}, std::move(input)});
}

/// Scene 18 with a character in the paper's place: 2 m are between two that fly against each other. After whole steps
/// of both less is left than they go in one. The second does not come to where the first begins: it goes all its way in
/// its turn, and the first the rest.
Scene characters_head_on() {
  Scene scene = flight(0, 0, 30, 0, 30);
  add_box(scene, "below", -4, -3, 8, -2);
  add_character(scene, 2 * half_width + 2, 0, -18);
  const double step_x = 30 * scene.dt;
  const double both = step_x + 18 * scene.dt;
  const int before = static_cast<int>(2 / both);
  const double rest = 2 - before * both - 18 * scene.dt;
  const double met = before * step_x + rest;
  scene.answers = {contact(before + rest / step_x, step_x).law(), x_is(met).law(),
                   x_is(met + 2 * half_width).of_character(1).law()};
  return scene;
}

/// The first meets the second, which meets the third: so they go from the last to the first. The second meets the third
/// after half a step and stops. To the first it goes this way evenly in the whole step.
Scene three_in_a_row() {
  Scene scene = flight(0, 0, 24, 0, 30);
  add_box(scene, "below", -4, -3, 8, -2);
  add_character(scene, 2 * half_width + 0.25, 0, 6);
  add_character(scene, 4 * half_width + 0.25 + 0.05, 0, 0);
  const double gaps = 0.25 + 0.05;
  const double approach = 24 * scene.dt - 0.05;
  scene.answers = {contact(0.25 / approach, approach).law(),
                   contact(0.05 / (6 * scene.dt), 6 * scene.dt).of_character(1), x_is(gaps).law(),
                   x_is(2 * half_width + gaps).of_character(1).law(),
                   x_is(4 * half_width + gaps).of_character(2).law()};
  return scene;
}

/// The second jumps onto the head of the first, which walks off after three seconds and takes it along. At 4.5 m/s and
/// 1 m/s more or less in each step the second comes 1.8 m far.
Scene jump_onto_a_head() {
  Scene scene = walk(0, half_height + 0.02, 0, 300, 30);
  scene.input.push_back(steer(180, 1));
  add_box(scene, "floor", -8, -1, 40, 0);
  add_character(scene, -2, half_height + 0.02, 0,
                {steer(0, 0), {.step = 30, .move = 0.75, .jump = true}, {.step = 54, .move = 0, .jump = false}});
  scene.answers = {
      x_is(walked(scene, 120)), y_is(half_height), y_is(3 * half_height).of_character(1).after(150).gaps(2),
      x_is(-2 + 1.8 + walked(scene, 120)).of_character(1).law(), y_is(3 * half_height).of_character(1).gaps(2).law()};
  return scene;
}

/// Up to sixteen in a room as wide as ten of them and as high as three, each walking and jumping at random by itself.
Scene crowd(const ParameterValues& values) {
  const int count = static_cast<int>(values["characters"]);
  constexpr int steps = 600;
  constexpr double width = 20 * half_width;
  constexpr double height = 6 * half_height;
  Scene scene = flight(0, 0, 0, 0, steps, 30);
  add_box(scene, "floor", -1, -1, width + 1, 0);
  add_box(scene, "ceiling", -1, height, width + 1, height + 1);
  add_box(scene, "left", -1, 0, 0, height);
  add_box(scene, "right", width, 0, width + 1, height);
  for (int k = 0; k < count; ++k) {
    const double x = (2 * (k % 8) + 1) * width / 16;
    const double y = half_height + 0.02 + (k / 8) * 1.5;
    std::vector<InputEvent> input = random_input(static_cast<std::uint64_t>(k) + 1, steps);
    if (k > 0) {
      add_character(scene, x, y, 0, std::move(input));
      continue;
    }
    scene.start.position = {x, y};
    scene.input = std::move(input);
  }
  const double none = std::numeric_limits<double>::infinity();
  const auto none_beyond = [none](const Vec2d& along, double place) {
    return between(Answer::Of::farthest, -none, place, along).of_character(Answer::all);
  };
  scene.answers = {none_beyond({1, 0}, width - half_width), none_beyond({-1, 0}, -half_width),
                   none_beyond({0, 1}, height - half_height), none_beyond({0, -1}, -half_height)};
  return scene;
}

/// Two stand on a lift that goes up and to the side, and back; after a second the right one walks against the left one.
Scene two_on_a_lift() {
  Scene scene = flight(0, half_height + 5e-7, 0, 0, 480, 30);
  add_box(scene, "lift", -2, -0.25, 3, 0);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 0.5, .at = {0, 0}}, {.time = 3.5, .at = {2, 4.5}}},
            MoverDef::Loop::ping_pong);
  add_box(scene, "ground", -10, -10, 10, -9);
  add_character(scene, 2 * half_width + 1, half_height + 5e-7, 0, {steer(0, 0), steer(60, -0.5)});
  scene.input.push_back(steer(0, 0));
  scene.answers = {is(Answer::Of::drift, 0).to("lift").within(ulp(5.2)), count(Answer::Of::in_the_air, 0),
                   x_is(2 * half_width).of_character(1).to("lift"), y_is(half_height).of_character(1).to("lift")};
  return scene;
}

/// A press comes along a low passage, pushes one character into another, and both against a wall.
Scene pressed_in_a_row() {
  constexpr double face = -1;
  constexpr double wall = 2.3;
  constexpr double speed = 2.4;
  Scene scene = flight(0, half_height + 5e-7, 0, 0, 60, 30);
  add_box(scene, "floor", -20, -1, 20, 0);
  add_box(scene, "roof", -20, 1.3, 20, 2);
  add_box(scene, "wall", wall, 0, wall + 1, 1.3);
  add_box(scene, "press", face - 1, 0.01, face, 1.29);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 2, .at = {2 * speed, 0}}});
  add_character(scene, 1.5, half_height + 5e-7, 0);
  const double room = wall - face - 4 * half_width;
  scene.answers = {count(Answer::Of::crush, static_cast<int>(room / (speed * scene.dt))).law(),
                   count(Answer::Of::crush, scene.steps).of_character(1).law(),
                   x_is(wall - half_width).of_character(1).law()};
  return scene;
}

/// Walks and jumps at random for as long as it is asked to: over a slope, a steep slope, kerbs, a ledge, a needle and a
/// pit, between walls that no character leaves.
Scene playground(const ParameterValues& values) {
  Scene scene = flight(0, half_height + 0.02, 0, 0, static_cast<int>(values["steps"]), 30);
  add_box(scene, "floor", -21, -3, 16, 0);
  add_box(scene, "pit", 16, -3, 18, -2);
  add_box(scene, "left", -21, 0, -20, 12);
  add_box(scene, "right", 18, -3, 19, 12);
  add_box(scene, "roof", -21, 12, 19, 13);
  add_polygon(scene, "slope", {{-16, 0}, {-10, 0}, {-12, 2}});
  add_polygon(scene, "steep", {{-20, 0}, {-18, 0}, {-20, 4}});
  for (int k = 0; k < 4; ++k) add_box(scene, "kerb" + std::to_string(k), 4 + k, 0, 5 + k, 0.1 * (k + 1));
  add_polygon(scene, "needle", {{11, 0}, {11.2, 0}, {11.1, 1}});
  add_ledge(scene, "ledge", {{-6, 1.5}, {-2, 1.5}});
  scene.input = random_input(static_cast<std::uint64_t>(values["seed"]), scene.steps);
  const double none = std::numeric_limits<double>::infinity();
  scene.answers = {between(Answer::Of::farthest, -none, 18 - half_width, {1, 0}),
                   between(Answer::Of::farthest, -none, 20 - half_width, {-1, 0}),
                   between(Answer::Of::farthest, -none, 12 - half_height, {0, 1}),
                   between(Answer::Of::farthest, -none, 2 - half_height, {0, -1})};
  return scene;
}

}  // namespace

std::vector<SceneFamily> crowd_families() {
  return {{"crowd",
           "several in a tight room, each at random by itself: none gets past another or into a wall",
           {{"characters", "", 2, 16, 4, "in the room"}},
           crowd},
          {"playground",
           "walks and jumps at random between walls: never inside, never out",
           {{"steps", "", 100, 1e8, 3600, "that it lasts; a day of play are 5,184,000"},
            {"seed", "", 1, 1e9, 1, "of the input"}},
           playground}};
}

std::vector<BuiltInScene> crowd_scenes() {
  return {
      {"characters_head_on",
       "30 m/s against a character at 18 m/s, 2 m away: of the 0.4 m that are left in step 2 that one goes 0.3 m, so "
       "t = 0.1 / 0.5",
       characters_head_on},
      {"three_in_a_row",
       "the last two meet at t = 0.5 and stand; to the first the second goes 0.05 m in its step, so they meet at "
       "t = 0.25 / (0.4 - 0.05)",
       three_in_a_row},
      {"jump_onto_a_head", "stands on another's head, 1.25 m up, and is taken along when that walks off",
       jump_onto_a_head},
      {"crowd_of_16", "sixteen in a tight room, each at random by itself: none gets past another or into a wall",
       "crowd", with("characters", 16)},
      {"two_on_a_lift", "two are carried without a lag, also where one walks against the other on the way",
       two_on_a_lift},
      {"pressed_in_a_row",
       "a press pushes one into another, and both against a wall: the first is crushed in step 51, where "
       "(3.3 - 4 half widths) / (v h) = 51.25 falls, the other never",
       pressed_in_a_row},
  };
}

}  // namespace paperproof::compare
