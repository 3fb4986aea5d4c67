/// Several characters: none gets past another.
#include "scenes/built_in.hpp"

namespace paperproof::compare {

namespace {

void add_character(Scene& scene, double x, double y, double velocity_x, std::vector<InputEvent> input = {}) {
  scene.others.push_back({{.position = {x, y}, .velocity = {velocity_x, 0}}, std::move(input)});
}

/// Scene 18 with a character in the paper's place: 2 m are between two that fly against each other.
Scene characters_head_on() {
  Scene scene = flight(0, 0, 30, 0, 30);
  add_box(scene, "below", -4, -3, 8, -2);
  add_character(scene, 2 * half_width + 2, 0, -18);
  return scene;
}

/// The second meets the third after half a step and stops, so the first meets the second after three quarters: in the
/// order of their numbers it would be after five sixths.
Scene three_in_a_row() {
  Scene scene = flight(0, 0, 24, 0, 30);
  add_box(scene, "below", -4, -3, 8, -2);
  add_character(scene, 2 * half_width + 0.25, 0, 6);
  add_character(scene, 4 * half_width + 0.25 + 0.05, 0, 0);
  return scene;
}

/// The second jumps onto the head of the first, which walks off after three seconds and lets it fall.
Scene jump_onto_a_head() {
  Scene scene = walk(0, half_height + 0.02, 0, 300);
  scene.gravity = {0, -30};
  scene.input.push_back({.step = 180, .move = 1, .jump = std::nullopt});
  add_box(scene, "floor", -8, -1, 40, 0);
  add_character(scene, -2, half_height + 0.02, 0,
                {{.step = 0, .move = 0, .jump = std::nullopt},
                 {.step = 30, .move = 0.75, .jump = true},
                 {.step = 54, .move = 0, .jump = false}});
  return scene;
}

/// Sixteen in a room as wide as ten of them and as high as three, each walking and jumping at random by itself.
Scene crowd_of_16() {
  constexpr int steps = 600;
  constexpr double width = 20 * half_width;
  constexpr double height = 6 * half_height;
  Scene scene = flight(0, 0, 0, 0, steps);
  scene.gravity = {0, -30};
  add_box(scene, "floor", -1, -1, width + 1, 0);
  add_box(scene, "ceiling", -1, height, width + 1, height + 1);
  add_box(scene, "left", -1, 0, 0, height);
  add_box(scene, "right", width, 0, width + 1, height);
  for (int k = 0; k < 16; ++k) {
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
  return scene;
}

}  // namespace

std::vector<BuiltInScene> crowd_scenes() {
  return {
      {"characters_head_on", "30 m/s against a character at 18 m/s, 2 m away: t = d / (v1 + v2), in step 2 at t = 0.5",
       characters_head_on},
      {"three_in_a_row",
       "the last two meet at t = 0.5 and stand, so the first is there at t = 0.75: in order of impact", three_in_a_row},
      {"jump_onto_a_head", "stands on another's head, 1.25 m up, until that walks off; then on the floor",
       jump_onto_a_head},
      {"crowd_of_16", "sixteen in a tight room, each at random by itself: none gets past another or into a wall",
       crowd_of_16},
  };
}

}  // namespace paperproof::compare
