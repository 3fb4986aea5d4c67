/// Tight places as families: the tip of a spike, a corner that is just met, walls and a lift that close in.
#include "scenes/built_in.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

namespace {

constexpr double fall_speed = 20;  ///< [m/s]
constexpr double way = 1;          ///< Before the first contact [m].

/// Flies down onto the tip of a spike that stands between its feet.
Scene spike(const ParameterValues& values) {
  const double half_base = std::tan(values["angle"] / 2 * pi / 180);
  const double tip = values["offset"];
  Scene scene = flight(0, way + half_height, 0, -fall_speed, 60);
  add_polygon(scene, "spike", {{tip - half_base, -1}, {tip + half_base, -1}, {tip, 0}});
  const double way_of_step = fall_speed * scene.dt;
  scene.answers = {contact(way / way_of_step, way_of_step).to("spike")};
  return scene;
}

/// Flies to the right; the corner of a block is met by the slanted edge between foot and arm, which has a slope of 2.
Scene corner(const ParameterValues& values) {
  const double overlap = values["overlap"];
  Scene scene = flight(0, half_height - overlap, fall_speed, 0, 60);
  const double left = way + foot + overlap / 2;
  add_box(scene, "block", left, -2, left + 4, 0);
  const double way_of_step = fall_speed * scene.dt;
  scene.answers = {contact(way / way_of_step, way_of_step * 2 / std::sqrt(5.0)).to("block")};
  return scene;
}

/// When something that closes in at a speed has come so far, it leaves no room. At the very end of a step either step
/// may say so.
Answer crushed_after(const Scene& scene, double distance, double speed) {
  const double steps = distance / (speed * scene.dt);
  constexpr double rounding = 1e-6;
  return between(Answer::Of::crush, std::floor(steps - rounding), std::floor(steps + rounding)).gaps(0).law();
}

/// Long enough for the way and a second more.
int steps_for(const Scene& scene, double distance, double speed) {
  return static_cast<int>(std::ceil(distance / speed / scene.dt)) + 60;
}

/// Openings with a clearance below 2e-7 m count as closed: those have no answer.
bool is_open(double clearance) { return clearance >= 1e-6; }

/// Stands right of the middle between two walls that come together.
Scene closing_walls(const ParameterValues& values) {
  constexpr double begin = 1.5;  // of each wall, from the middle [m]
  constexpr double aside = 0.3;
  const double clearance = values["clearance"];
  const double speed = values["closing"];
  const double thickness = values["thickness"];
  const double distance = begin - half_width - clearance;
  Scene scene = flight(aside, half_height + 0.01, 0, 0, 0, 10);
  scene.steps = steps_for(scene, distance, speed);
  add_box(scene, "floor", -4, -1, 4, 0);
  for (const double side : {-1.0, 1.0}) {
    const double face = side * begin;
    const double back = face + side * thickness;
    add_box(scene, side < 0 ? "left" : "right", std::min(face, back), 0.05, std::max(face, back), 3);
    move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = distance / speed, .at = {-side * distance, 0}}});
  }
  // A character that is pushed keeps the speed of the wall, and slides on as far as the other one.
  if (is_open(clearance))
    scene.answers = {between(Answer::Of::place, -clearance, std::min(aside, clearance), {1, 0}), y_is(half_height)};
  if (clearance < 0) scene.answers = {crushed_after(scene, begin - half_width, speed)};
  return scene;
}

/// Rides a lift up to a ceiling.
Scene closing_lift(const ParameterValues& values) {
  constexpr double rise = 3;
  const double clearance = values["clearance"];
  const double speed = values["closing"];
  const double thickness = values["thickness"];
  Scene scene = flight(0, half_height, 0, 0, 0, 10);
  scene.steps = steps_for(scene, rise, speed);
  const double ceiling = 2 * half_height + rise + clearance;
  add_box(scene, "ceiling", -4, ceiling, 4, ceiling + thickness);
  add_box(scene, "lift", -2, -thickness, 2, 0);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = rise / speed, .at = {0, rise}}});
  if (is_open(clearance)) scene.answers = {y_is(rise + half_height)};
  if (clearance < 0) scene.answers = {crushed_after(scene, rise + clearance, speed)};
  return scene;
}

std::vector<ParameterDef> closing_parameters() {
  return {{"clearance", "m", -0.2, 1, 0.1, "left at the end; less than 0: the character is crushed"},
          {"closing", "m_s", 0.1, 1e5, 3, "speed of what closes in"},
          {"thickness", "m", 1e-6, 1, 0.1, "of what closes in"}};
}

}  // namespace

std::vector<SceneFamily> tight_families() {
  return {
      {"spike",
       "a flight at 20 m/s onto the tip of a spike between the feet: met after 1 m",
       {{"angle", "deg", 0.1, 60, 10, "of the tip"}, {"offset", "m", -0.15, 0.15, 0.05, "of the tip from the middle"}},
       spike},
      {"corner",
       "a flight at 20 m/s past the corner of a block that is just met, after 1 m",
       {{"overlap", "m", 1e-6, 0.3, 0.01, "of the feet and the block in height"}},
       corner},
      {"closing_walls", "stands between two walls that come together", closing_parameters(), closing_walls},
      {"closing_lift", "rides a lift up to a ceiling", closing_parameters(), closing_lift}};
}

}  // namespace paperproof::compare
