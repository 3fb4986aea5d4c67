/// What moves: scenes 15 to 19.
#include "scenes/built_in.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

namespace {

/// Stands on a lift that goes there and back.
Scene lift_by(const Vec2d& way) {
  Scene scene = flight(0, half_height + 0.02, 0, 0, 600, 30);
  add_box(scene, "lift", -2, -0.25, 2, 0);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 0.5, .at = {0, 0}}, {.time = 2.5, .at = way}},
            MoverDef::Loop::ping_pong);
  add_box(scene, "ground", -10, -10, 10, -9);
  carried_by(scene, "lift", 10, ulp(4));
  scene.answers.push_back(x_is(way.x()).after(150));
  scene.answers.push_back(y_is(way.y() + half_height).after(150));
  return scene;
}

Scene conveyor() {
  Scene scene = flight(0, half_height + 0.02, 0, 0, 120, 30);
  add_box(scene, "belt", -4, -1, 20, 0).surface_speed = 2;
  const double landed = steps_to_fall(scene, 0.02);
  scene.answers = {x_is(2 * scene.dt * (scene.steps - landed)).law(), y_is(half_height),
                   is(Answer::Of::speed, 2, {1, 0})};
  return scene;
}

/// A ceiling comes down onto a character that stands: it has `gap` metres to go to the head, at `speed`.
Scene closing_ceiling() {
  constexpr double gap = 1.07;
  constexpr double speed = 3;
  Scene scene = flight(0, half_height + 5e-7, 0, 0, 60, 30);
  add_box(scene, "floor", -4, -1, 4, 0);
  const double head = 2 * half_height;
  add_box(scene, "ceiling", -4, head + gap, 4, head + gap + 1);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 1, .at = {0, -speed}}});
  scene.answers = {count(Answer::Of::crush, static_cast<int>(gap / (speed * scene.dt))).law(),
                   count(Answer::Of::crushers, 1).law(), farthest({0, 1}, half_height),
                   farthest({0, -1}, -half_height)};
  return scene;
}

/// A thin upright paper comes to a character that stands, 1.9 m from its left arm and a share of a step's way more. It
/// goes 10 m, or four steps where these are longer, and stops.
Scene moving_paper(const ParameterValues& values) {
  const double speed = values["closing"];
  const double thickness = values["thickness"];
  Scene scene = flight(0, half_height + 0.02, 0, 0, 0, 30);
  const double step_x = speed * scene.dt;
  const double way = std::max(10.0, 4 * step_x);
  const double lasts = way / speed;
  scene.steps = static_cast<int>(std::ceil((lasts + 1) / scene.dt));
  add_box(scene, "floor", -40, -1, std::max(40.0, way + 1.1 * speed), 0);
  const double gap = 1.9 + values["phase"] * step_x;
  const double start = -half_width - gap;
  add_box(scene, "paper", start - thickness, 0.1, start, 4);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = lasts, .at = {way, 0}}});
  // It takes the paper's speed along, and leaves it where it stops.
  scene.answers = {contact(gap / step_x, step_x).to("paper"), is(Answer::Of::speed, speed, {1, 0}),
                   farthest({-1, 0}, 0)};
  ends_at(scene, start + way + half_width + speed * (scene.dt * scene.steps - lasts), half_height);
  return scene;
}

/// A character flies at 30 m/s against a paper that comes at 18 m/s; 2 m are between them.
Scene head_on() {
  Scene scene = flight(0, 0, 30, 0, 30);
  add_chain(scene, "paper", {{half_width + 2, -2}, {half_width + 2, 2}});
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 0.5, .at = {-9, 0}}});
  const double step_x = (30 + 18) * scene.dt;
  scene.answers = {contact(2 / step_x, step_x), is(Answer::Of::speed, -18, {1, 0})};
  ends_at(scene, 2 - 9, 0);
  return scene;
}

/// Two papers pass each other 3 m above and below a character that flies between them and meets neither.
Scene papers_swap() {
  Scene scene = flight(0, 0, 2, 0, 60);
  add_box(scene, "upper", 2, 1, 2.01, 3);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 1, .at = {-4, 0}}});
  add_box(scene, "lower", -2.01, -3, -2, -1);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 1, .at = {4, 0}}});
  scene.answers = {count(Answer::Of::contacts, 0)};
  ends_at(scene, 2, 0);
  return scene;
}

/// A paper turns about its middle beside a character that stands.
Scene rotating_paper() {
  Scene scene = flight(0, half_height + 0.02, 0, 0, 120, 30);
  add_box(scene, "floor", -4, -1, 4, 0);
  add_box(scene, "paper", -1, -0.005, 1, 0.005);
  move_last(scene, {{.time = 0, .at = {1.2, 1.2}}});
  scene.movers.back().turns = {{.time = 0, .at = 0}, {.time = 2, .at = pi}};
  // The tip that comes down on its left meets the line from head to arm. With the normal (2, 1) / √5 that line is
  // `line` from the middle of the paper, or less by what a character that is still 0.02 m up has more.
  const auto met = [&scene](double up) {
    const double line = (2 * 1.2 + 1.2 - (2 * half_width + half_height + half_width + up)) / std::sqrt(5.0);
    const double tip = std::hypot(1, 0.005);
    const double angle = std::atan2(1, 2) - std::atan2(0.005, 1) - std::acos(line / tip);
    return angle / (pi / 2 * scene.dt);
  };
  scene.answers = {between(Answer::Of::contact, met(0.02), met(0)).to("paper").gaps(1 / (0.4 * pi / 2 * scene.dt))};
  return scene;
}

/// An arm of one metre and no thickness turns about its end, by a radian per second. A character that floats has its
/// feet 0.8 m above that end and its middle 0.6 m beside it, so the tip meets the feet at the angle asin 0.8. On which
/// straight ways the tip goes within that step is for each contender to say.
Scene turning_arm() {
  Scene scene = flight(0.6, 0.8 + half_height, 0, 0, 90);
  add_chain(scene, "arm", {{0, 0}, {1, 0}});
  move_last(scene, {{.time = 0, .at = {0, 0}}});
  scene.movers.back().turns = {{.time = 0, .at = 0}, {.time = 2, .at = 2}};
  const double step = std::floor(std::asin(0.8) / scene.dt);
  scene.answers = {// the tip comes at cos(asin 0.8) m/s
                   between(Answer::Of::contact, step, step + 1).gaps(1 / (0.6 * scene.dt))};
  return scene;
}

}  // namespace

std::vector<SceneFamily> moving_families() {
  return {{"moving_paper",
           "a paper comes to a character that stands: met, then pushed along",
           {{"closing", "m_s", 0.1, 1e5, 20, "speed of the paper"},
            {"thickness", "m", 1e-6, 1, 0.01, "of the paper"},
            {"phase", "", 0, 1, 0, "share of a step's way by which it begins farther away"}},
           moving_paper}};
}

std::vector<BuiltInScene> moving_scenes() {
  return {
      {"lift_up", "stands on a lift up and down again: carried without a lag, one contact begins",
       [] { return lift_by(Vec2d(0, 3)); }},
      {"lift_down", "stands on a lift down and up again: carried without a lag, one contact begins",
       [] { return lift_by(Vec2d(0, -3)); }},
      {"lift_sideways", "stands on a lift to the side and back: carried without a lag",
       [] { return lift_by(Vec2d(4, 0)); }},
      {"conveyor", "stands on a belt of 2 m/s: carried at that speed", conveyor},
      {"closing_ceiling",
       "a ceiling 1.07 m above its head comes down at 3 m/s: crushed in step 21, where gap / (v h) = 21.4 falls",
       closing_ceiling},
      {"sweeping_paper", "a paper 1.9 m away comes at 20 m/s: met after 0.095 s, then pushed along, side kept",
       "moving_paper"},
      {"head_on", "30 m/s against a paper at 18 m/s, 2 m away: t = d / (v1 + v2), in step 2 at t = 0.5", head_on},
      {"papers_swap", "two papers pass each other around a character: neither is met", papers_swap},
      {"rotating_paper", "a paper turns beside a character: only who can turn what moves may run it", rotating_paper},
      {"turning_arm", "an arm turns at 1 rad/s under a character: met after asin 0.8 s, in step 55", turning_arm},
  };
}

}  // namespace paperproof::compare
