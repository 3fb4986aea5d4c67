/// Walls at an angle, corners, wedges and teeth: scenes 4 to 9 and 33.
///
/// Angles are written as their sines and tangents: the library's functions give other bits on other machines.
#include "scenes/built_in.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace paperproof::compare {

namespace {

struct Angle {
  double sin;
  double cos;
};
constexpr Angle degrees_0_001{.sin = 1.7453292519057202e-5, .cos = 0.99999999984769129};
constexpr Angle degrees_0_1{.sin = 1.7453283658983089e-3, .cos = 0.99999847691328765};
constexpr Angle degrees_10{.sin = 0.17364817766693036, .cos = 0.98480775301220802};
constexpr Angle degrees_30{.sin = 0.5, .cos = 0.86602540378443865};
constexpr Angle degrees_45{.sin = 0.70710678118654752, .cos = 0.70710678118654752};
constexpr Angle degrees_80{.sin = 0.98480775301220802, .cos = 0.17364817766693036};

/// Flies along a wall and into it at a small angle, from `distance` metres.
Scene grazing_at(const Angle& angle, double speed, double distance, int steps) {
  Scene scene = flight(0, 0, speed * angle.sin, speed * angle.cos, steps);
  add_box(scene, "wall", half_width + distance, -10, half_width + distance + 1, 1000);
  const double approach = speed * angle.sin * scene.dt;
  scene.answers = {contact(distance / approach, approach), x_is(distance),
                   y_is(speed * angle.cos * scene.dt * steps).law()};
  return scene;
}

Scene parallel_at(double clearance) {
  Scene scene = flight(0, 0, 0, 10, 120);
  add_box(scene, "wall", half_width + clearance, -10, half_width + clearance + 1, 100);
  scene.answers = {
      clearance > 0 ? count(Answer::Of::contacts, 0).beyond(clearance) : count(Answer::Of::contacts, 0).law(),
      is(Answer::Of::speed, 10, {0, 1})};
  ends_at(scene, 0, 20);
  return scene;
}

/// Flies to the right at 50 m/s into a wall of 1 cm whose normal is turned from the horizontal by `angle`.
Scene rotated_by(const Angle& angle) {
  Scene scene = flight(0, 0, 50, 0, 60);
  constexpr double distance = 1.5;
  constexpr double thickness = 0.01;
  constexpr double half_length = 12;
  const auto at = [&](double along_normal, double along_wall) {
    return Vec2d{along_normal * angle.cos - along_wall * angle.sin, along_normal * angle.sin + along_wall * angle.cos};
  };
  add_polygon(scene, "wall",
              {at(distance, -half_length), at(distance + thickness, -half_length),
               at(distance + thickness, half_length), at(distance, half_length)});
  const Vec2d normal{angle.cos, angle.sin};
  double support = 0;
  for (const Vec2d& point : scene.character.shape.hull()) support = std::max(support, point.dot(normal));
  const double approach = 50 * angle.cos * scene.dt;
  scene.answers = {contact((distance - support) / approach, approach), farthest(normal, distance - support)};
  return scene;
}

/// Flies down to the right, so that the left foot point (-5, -20) px meets the upper right corner of a box, or just
/// not: x + y of the character stays 0, of that point -25 px, and of the box's corner too.
Scene corner_at(double top) {
  Scene scene = flight(-2, 2, 30, -30, 60);
  constexpr double right = -0.25;
  add_box(scene, "box", right - 2, top - 2, right, top);
  return scene;
}

/// Where the two only touch, give or take an ulp, to be stopped is as right as to pass.
Scene corner_touched_at(double top) {
  Scene scene = corner_at(top);
  scene.answers = {x_is(-0.5).after(3), y_is(0.5).after(3), between(Answer::Of::place, -28, top + half_height, {0, 1})};
  return scene;
}
constexpr double corner_top = -25.0 / 32 + 0.25;

/// A contender that keeps no gap meets the box; all others may.
Scene corner_plus_ulp() {
  Scene scene = corner_touched_at(std::nextafter(corner_top, 0.0));
  scene.answers.push_back(contact((2 - half_height - corner_top) / 0.5, 0.5).beyond(1e-9));
  return scene;
}

/// The foot comes onto the box, and the way goes on along it.
Scene corner_hit() {
  constexpr double top = corner_top + pixel;
  Scene scene = corner_at(top);
  scene.answers = {contact((2 - half_height - top) / 0.5, 0.5)};
  ends_at(scene, 28, top + half_height);
  return scene;
}

/// Falls from `height` into a V whose apex is the origin. @param tangent of half the angle. @param rim [m] above the
/// apex.
Scene wedge_of(double tangent, double rim, double height, int steps) {
  Scene scene = flight(0, height, 0, 0, steps, 30);
  const double half = rim * tangent;
  add_polygon(scene, "wedge",
              {{0, 0}, {half, rim}, {half + 1, rim}, {half + 1, -1}, {-half - 1, -1}, {-half - 1, rim}, {-half, rim}});
  const double arms = 10 * pixel * (1 / tangent + 1);
  const double feet = pixel * (5 / tangent + 20);
  scene.answers = {x_is(0), y_is(std::max(arms, feet)).gaps(std::hypot(1, tangent) / tangent)};
  rests_after(scene, steps * 2 / 3);
  return scene;
}

Scene concave_corner() {
  Scene scene = flight(0, 3, 40, -40, 60, 10);
  add_box(scene, "floor", -4, -1, 4, 0);
  add_box(scene, "wall", 3, 0, 4, 5);
  const double step_x = 40 * scene.dt;
  scene.answers = {contact(steps_to_fall(scene, 3 - half_height, 40), step_x).to("floor"),
                   contact((3 - half_width) / step_x, step_x).to("wall").law()};
  ends_at(scene, 3 - half_width, half_height);
  rests_after(scene, 30);
  return scene;
}

/// Flies 200 m in its only step, between teeth 30 degrees steep that stand half a metre apart, on the floor and under
/// the ceiling in turn: the right foot meets each tooth of the floor and is led up, the right of the head each of the
/// ceiling and is led down.
Scene sawtooth_of(int teeth) {
  Scene scene = flight(0, 0, 12'000, 0, 1);
  Vec2d place{0, 0};
  double slope = 0;
  double share = 1;  // of the speed that is left along x
  double spent = 0;  // of the 200 m
  for (int k = 0; k < teeth; ++k) {
    const double up = k % 2 == 0 ? 1 : -1;
    place += Vec2d(0.5, 0.5 * slope);
    const Vec2d along{degrees_30.cos, up * degrees_30.sin};
    const Vec2d met = place + Vec2d(foot, -up * half_height);
    add_polygon(scene, "tooth" + std::to_string(k), {met - 0.05 * along, met + 0.2 * along, met + Vec2d(0.05, -up)});
    slope = up * tan_30;
    // A tooth of the floor keeps what is horizontal: it is ground. One of the ceiling halves it: from (1, tan 30) it
    // takes the part into its normal (-1/2, -cos 30), which is 1 long, and leaves (1/2, -tan(30)/2).
    spent += 0.5 / share;
    if (up < 0) share /= 2;
    Answer time = contact(spent / 200, 200 * degrees_30.sin).to(scene.ids.back());
    // Each is stopped at up to 2 gaps early, and what that shifts grows with the shares that follow.
    scene.answers.push_back(k == 0 ? std::move(time) : std::move(time).within(1e-6).law());
  }
  return scene;
}

/// Falls onto the top of a ball, and stands there.
Scene land_on_circle() {
  Scene scene = flight(0, half_height + 1, 0, 0, 120, 30);
  add_circle(scene, "ball", {0, -2}, 2);
  const double landed = steps_to_fall(scene, 1);
  scene.answers = {contact(landed, fallen(scene, 1) * landed)};
  ends_at(scene, 0, half_height);
  rests_after(scene, 80);
  return scene;
}

/// Flies at 600 m/s, 10 m in a step, against a ball of 5 mm.
Scene bullet_at_circle() {
  Scene scene = flight(-24, 0, 600, 0, 30);
  add_circle(scene, "ball", {0, 0}, 0.005);
  scene.answers = {contact((24 - half_width - 0.005) / 10, 10)};
  ends_at(scene, -half_width - 0.005, 0);
  return scene;
}

/// Falls between two balls of 1 m, 2.4 m apart: the slanted sides between its feet and its arms rest on both. Of such a
/// side the normal is (2, -1) / √5, and the line through the foot (5, y - 20) px is 1 m from (1.2, 0).
Scene between_circles() {
  Scene scene = flight(0, 3, 0, 0, 180, 30);
  add_circle(scene, "left", {-1.2, 0}, 1);
  add_circle(scene, "right", {1.2, 0}, 1);
  scene.answers = {x_is(0), y_is(std::sqrt(5.0) - 2 * (1.2 - foot) + half_height).gaps(std::sqrt(5.0))};
  rests_after(scene, 120);
  return scene;
}

}  // namespace

std::vector<SceneFamily> angle_families() {
  return {{"wedge",
           "a fall into a V: rests between its walls",
           {{"angle", "deg", 0.5, 120, 60, "of the V"}},
           [](const ParameterValues& values) {
             const double tangent = std::tan(values["angle"] / 2 * pi / 180);
             const double height = std::max(10 * pixel * (1 / tangent + 1), pixel * (5 / tangent + 20)) + 1;
             return wedge_of(tangent, height + 2, height, 180);
           }}};
}

std::vector<BuiltInScene> angle_scenes() {
  return {
      {"grazing_wall", "into a wall at 10 degrees: t = d / (v sin 10°) = 0.25 / 1.736 s, in step 8",
       [] { return grazing_at(degrees_10, 10, 0.25, 60); }},
      {"grazing_wall_0.1", "into a wall at 0.1 degrees: t = 0.05 / 0.1047 s, in step 28",
       [] { return grazing_at(degrees_0_1, 60, 0.05, 120); }},
      {"grazing_wall_0.001", "into a wall at 0.001 degrees: t = 0.004 / 0.001745 s, in step 137",
       [] { return grazing_at(degrees_0_001, 100, 0.004, 240); }},
      {"parallel_pass", "past a wall with 5 mm of clearance: no contact", [] { return parallel_at(0.005); }},
      {"parallel_pass_30mm", "past a wall with 30 mm of clearance: no contact", [] { return parallel_at(0.03); }},
      {"parallel_pass_0", "along a wall that is touched: no motion into it, no overlap, no loss of speed",
       [] { return parallel_at(0); }},
      {"rotated_wall", "thin wall at 45 degrees, 50 m/s: t = d / (v·n), never passed",
       [] { return rotated_by(degrees_45); }},
      {"rotated_wall_10", "thin wall at 10 degrees, 50 m/s: t = d / (v·n), never passed",
       [] { return rotated_by(degrees_10); }},
      {"rotated_wall_30", "thin wall at 30 degrees, 50 m/s: t = d / (v·n), never passed",
       [] { return rotated_by(degrees_30); }},
      {"rotated_wall_80", "thin wall at 80 degrees, 50 m/s: t = d / (v·n), never passed",
       [] { return rotated_by(degrees_80); }},
      {"corner_to_corner", "a corner passes a corner at distance 0: touches, overlaps nowhere",
       [] { return corner_touched_at(corner_top); }},
      {"corner_to_corner_plus_ulp", "the same, one ulp closer: the swept octagon meets the box", corner_plus_ulp},
      {"corner_to_corner_minus_ulp", "the same, one ulp away: passes",
       [] { return corner_touched_at(std::nextafter(corner_top, -1.0)); }},
      {"corner_to_corner_hit", "the same, 1 px closer: hits", corner_hit},
      {"wedge_60", "falls into a V of 60 degrees: rests on both sides, centre 28.66 px above the apex, v = 0",
       [] { return wedge_of(0.57735026918962576, 4, 2.5, 120); }},
      {"wedge_5", "falls into a V of 5 degrees: rests on both sides, centre 239.0 px above the apex, v = 0",
       [] { return wedge_of(0.043660942908512058, 12, 9, 180); }},
      {"wedge_1", "falls into a V of 1 degree: rests on both sides, centre 1,155.9 px above the apex, v = 0",
       [] { return wedge_of(0.0087268677907587893, 50, 40, 300); }},
      {"concave_corner", "into a right-angled corner at 57 m/s: contacts with floor and wall, v = 0", concave_corner},
      {"land_on_circle", "falls onto the top of a ball of 2 m: stands there", land_on_circle},
      {"bullet_at_circle", "600 m/s against a ball of 5 mm: t = d / v, in step 2", bullet_at_circle},
      {"between_circles", "falls between two balls: the slanted sides rest on both, 0.774 m above their middles",
       between_circles},
      {"sawtooth_1", "200 m in a step past one tooth: one impact", [] { return sawtooth_of(1); }},
      {"sawtooth_4", "the same between 4 teeth: 4 impacts in the step, at the times of the formula",
       [] { return sawtooth_of(4); }},
      {"sawtooth_11", "the same between 11 teeth: 11 impacts in the step", [] { return sawtooth_of(11); }},
  };
}

}  // namespace paperproof::compare
