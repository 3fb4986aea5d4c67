/// What a player meets, and what it comes to: ledges, gaps, steep ramps, slopes into walls, kerbs, ramps at the limit,
/// one-way hills, exact fits, papers in a niche, ways out: scenes 41 to 51.
#include "scenes/built_in.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

namespace {

/// Under the usual gravity; what moves begins to walk with `move` at `step`.
Scene play(double x, double y, int steps, double move = 0, int step = 0) {
  Scene scene = flight(x, y, 0, 0, steps, 30);
  if (move != 0) scene.input = {steer(step, move)};
  return scene;
}

/// The same to the left.
Scene mirrored(Scene scene) {
  const auto turn = [](Vec2d& v) { v.x() = -v.x(); };
  turn(scene.start.position);
  for (ColliderDef& collider : scene.scenery.colliders)
    for (Vec2d& point : collider.points) turn(point);
  for (InputEvent& event : scene.input)
    if (event.move) event.move = -*event.move;
  for (Answer& answer : scene.answers) turn(answer.along);
  return scene;
}

/// Begins with its lower right side at the corner of a ledge, and holds the key towards it.
Scene ledge_corner() {
  Scene scene = play(-0.25, 0.45, 90, 1);
  add_box(scene, "ledge", 0, -6, 4, 0);
  add_box(scene, "floor", -4, -6, 0, -5);
  // Never faster than in free fall, never slower than down the whole of a slope as steep as its side: sin² is 4/5.
  const double way = 0.45 + 5 - half_height;
  Scene slower = scene;
  slower.gravity *= 0.8;
  scene.answers = {between(Answer::Of::contact, steps_to_fall(scene, way), steps_to_fall(slower, way))
                       .gaps(1 / fallen(scene, 1))
                       .to("floor")};
  ends_at(scene, -half_width, -5 + half_height);
  return scene;
}

/// Two platforms, a gap between them, and a pit below it.
Scene gap_of(double width, double far_side, int steps) {
  Scene scene = play(-2, half_height + 5e-7, steps, 1);
  add_box(scene, "near", -6, -4, 0, 0);
  add_box(scene, "far", width, -4, 30, far_side);
  add_box(scene, "pit", 0, -5, width, -4);
  return scene;
}

/// 0.39 m are between the last hold of the left foot and the first of the right one: 4 steps, in which it falls
/// 0.08 m.
Scene gap_crossed() {
  Scene scene = gap_of(0.7, -0.1, 120);
  ends_at(scene, -2 + walked(scene, scene.steps), -0.1 + half_height);
  return scene;
}

/// On the way it falls too far.
Scene gap_fallen() {
  Scene scene = gap_of(1, 0, 180);
  ends_at(scene, 1 - half_width, -4 + half_height);
  rests_after(scene, 150);
  return scene;
}

Scene gap_higher() {
  Scene scene = gap_of(1.5, 0.25, 180);
  ends_at(scene, 1.5 - half_width, -4 + half_height);
  rests_after(scene, 150);
  return scene;
}

Scene gap_jumped() {
  Scene scene = gap_of(3, 0.25, 120);
  hold_jump(scene, 20, 30);
  ends_at(scene, -2 + walked(scene, scene.steps), 0.25 + half_height);
  return scene;
}

/// Touches a ramp that is too steep to walk on, 12 m above its foot. Whether it steers uphill or not at all, it slides
/// as gravity alone would have it: g sin² downwards.
Scene steep_ramp(double degrees, double move) {
  const double sin = std::sin(degrees * pi / 180);
  const double cos = std::cos(degrees * pi / 180);
  constexpr double high = 12;
  constexpr int steps = 45;
  Scene scene = play(0, 0, steps, move);
  const double x = high * cos / sin;
  add_polygon(scene, "ramp", {{0, 0}, {2 * x, 0}, {2 * x, 2 * high}});
  double support = 0;
  for (const Vec2d& point : scene.character.shape.hull()) support = std::max(support, point.dot(Vec2d(sin, -cos)));
  scene.start.position = Vec2d(x, high) + (support + 5e-7) * Vec2d(-sin, cos);
  const double top = scene.start.position.y();
  const double slid = top - sin * sin * fallen(scene, steps);
  if (move < 0)
    scene.answers = {between(Answer::Of::place, top - fallen(scene, steps), slid, {0, 1}).law()};
  else
    scene.answers = {y_is(slid).law(), x_is(scene.start.position.x() - sin * cos * fallen(scene, steps)).law()};
  return scene;
}

/// The same on any slope: up to the climb limit it stands.
Scene begun_on_slope(double degrees, double move) {
  Scene scene = steep_ramp(degrees, move);
  if (degrees <= scene.character.max_climb_degrees) scene.answers.clear();
  return scene;
}

/// Up 45 degrees into a wall: it stands with its right side at the wall and its right foot on the slope.
Scene slope_wall_hop() {
  Scene scene = play(-3, -2, 300, 1, 30);
  add_polygon(scene, "slope", {{-10, -12}, {0, -12}, {0, 0}, {-10, -10}});
  add_box(scene, "wall", 0, -12, 1, 20);
  scene.answers = {x_is(-half_width).law(), y_is(foot - half_width + half_height).gaps(2.5).law(),
                   between(Answer::Of::settled, 0, 150).law(), count(Answer::Of::in_the_air, 0).after(150).law()};
  return scene;
}

/// Up 30 degrees under a level ceiling 2 m above the foot of the slope.
Scene slope_into_ceiling() {
  Scene scene = play(-2, half_height + 0.02, 180, 1);
  add_polygon(scene, "slope", {{-6, -1}, {9, -1}, {9, 9 * tan_30}, {0, 0}, {-6, 0}});
  add_box(scene, "ceiling", -6, 2, 9, 3);
  scene.answers = {y_is(2 - half_height).law(), x_is((2 - 2 * half_height) / tan_30 - foot).gaps(5).law(),
                   between(Answer::Of::settled, 0, 120).law(), count(Answer::Of::in_the_air, 0).after(120).law()};
  return scene;
}

/// Up 30 degrees to where the slope becomes 60 degrees: the right foot stands where the two meet.
Scene slope_into_steep() {
  Scene scene = play(-3, -3 * tan_30 + half_height + 0.2, 300, 1, 30);
  add_polygon(scene, "slope", {{-8, -8 * tan_30}, {-8, -9}, {3, -9}, {3, 3 / tan_30}, {0, 0}});
  scene.answers = {x_is(-foot).gaps(4).law(), y_is(half_height).gaps(4).law(),
                   between(Answer::Of::settled, 0, 150).law(), count(Answer::Of::in_the_air, 0).after(150).law()};
  return scene;
}

/// Against a slope of exactly its limit of 45 degrees, `size` metres high and begun at `x`.
Scene climb_45(double size, double x) {
  Scene scene = play(x - 2, half_height + 0.075, 120, 1, 10);
  scene.character.max_climb_degrees = 45;
  add_polygon(scene, "ground", {{x - 10, -1}, {x + 20, -1}, {x + 20, size}, {x + size, size}, {x, 0}, {x - 10, 0}});
  scene.answers = {x_is(x - 2 + walked(scene, 110)).law(), y_is(size + half_height).law()};
  return scene;
}

/// A kerb 1 m away: without a step height the side of its foot stays at the kerb's edge.
Scene kerb_of(double height) {
  Scene scene = play(0, half_height + 0.005, 60, 1, 10);
  add_box(scene, "floor", -10, -1, 10, 0);
  add_box(scene, "step", 1, 0, 4, height);
  scene.answers = {x_is(1 - foot - height / 2).gaps(2).law(), y_is(half_height).law(),  // the side goes out 1 px in 2
                   between(Answer::Of::settled, 0, 45).law()};
  return scene;
}

/// Dropped onto a one-way hill, then over it, and off its end onto the floor.
Scene oneway_hill() {
  Scene scene = play(-1.5, 1.5, 120, 1, 20);
  add_ledge(scene, "hill", {{-4, 0}, {0, 1}, {4, 0}});
  add_box(scene, "floor", -9, -4, 9, -3);
  const double way = 1.5 - half_height - (1 - (1.5 - foot) / 4);  // of the right foot, to the hill
  constexpr int steps = 70;
  const double x = -1.5 + walked(scene, steps - 20);
  const double on_it = 1 - (x - foot) / 4 + half_height;
  // On the way down it flies, never higher than what a fall at the slope's end takes back: v² tan² / 2g.
  scene.answers = {contact(steps_to_fall(scene, way), 4 * scene.dt).to("hill"), x_is(x).after(steps).law(),
                   between(Answer::Of::place, on_it, on_it + 36.0 / 16 / 60, {0, 1}).after(steps).law()};
  scene.answers.push_back(x_is(-1.5 + walked(scene, 100)).law());
  scene.answers.push_back(y_is(-3 + half_height));
  return scene;
}

/// Dropped onto the peak of a roof of 1 in 4, feet astride: it stands on the peak.
Scene oneway_peak() {
  Scene scene = play(0, half_height + 0.4, 90);
  add_ledge(scene, "roof", {{-3, -0.75}, {0, 0}, {3, -0.75}});
  scene.answers = {contact(steps_to_fall(scene, 0.4), 4 * scene.dt).to("roof"),
                   count(Answer::Of::in_the_air, 0).after(30).law()};
  ends_at(scene, 0, half_height);
  rests_after(scene, 60);
  return scene;
}

/// Over a platform that is level but for noise of 1e-6 m, and off its end, which is level, onto the floor.
Scene oneway_noise() {
  constexpr double noise = 1e-6;
  constexpr int begin = 15;
  constexpr double width = 4;
  Scene scene = play(-width + 1, half_height + 0.1, 120, 1, begin);
  std::vector<Vec2d> line;
  for (int i = 0; i <= 32; ++i) line.emplace_back(-width + i * width / 16, (i * i + i / 5) % 3 * noise);
  add_ledge(scene, "platform", std::move(line));
  add_box(scene, "floor", width, -3, 30, -2);
  const auto x_after = [&](int steps) { return -width + 1 + walked(scene, steps - begin); };
  const double leaves = begin + steps_to_walk(scene, 2 * width - 1 + foot);  // the platform, with its left foot
  const double falls = steps_to_fall(scene, 2);
  // It begins to fall in the step in which it leaves the platform, or in the next one.
  scene.answers = {is(Answer::Of::contact, steps_to_fall(scene, 0.1)).gaps(3 / (2 * scene.dt)).to("platform"),
                   between(Answer::Of::contact, std::floor(leaves) + falls, std::ceil(leaves) + falls)
                       .gaps(3 / (10 * scene.dt))
                       .to("floor")
                       .law()};
  for (const int steps : {35, 60, 85}) {
    scene.answers.push_back(x_is(x_after(steps)).after(steps).law());
    scene.answers.push_back(
        between(Answer::Of::place, half_height, half_height + 2 * noise, {0, 1}).after(steps).law());
  }
  ends_at(scene, x_after(scene.steps), -2 + half_height);
  return scene;
}

/// How high a line leads a character whose feet are on both sides of x: up to its highest point between them.
double height_over(const std::vector<Vec2d>& line, double x) {
  double highest = -HUGE_VAL;
  const auto rise_to = [&](double y) { highest = std::max(highest, y); };
  for (std::size_t i = 1; i < line.size(); ++i) {
    const Vec2d& from = line[i - 1];
    const Vec2d& to = line[i];
    for (const double at : {x - foot, x + foot})
      if (from.x() <= at && at <= to.x())
        rise_to(from.y() + (to.y() - from.y()) * (at - from.x()) / (to.x() - from.x()));
    if (std::abs(to.x() - x) <= foot) rise_to(to.y());
  }
  return highest;
}

/// Over an arch of 60 segments of a circle, from 40 degrees on its left to 40 degrees on its right, following the
/// ground, and off its end onto the floor.
Scene oneway_arch() {
  constexpr double radius = 6;
  constexpr int segments = 60;
  constexpr int begin = 30;
  std::vector<Vec2d> line;
  for (int i = 0; i <= segments; ++i) {
    const double angle = (-40 + 80.0 * i / segments) * pi / 180;
    line.emplace_back(radius * std::sin(angle), radius * (std::cos(angle) - 1));
  }
  Scene scene = play(-3, height_over(line, -3) + half_height + 0.2, 150, 1, begin);
  scene.character.snap = 0.3;
  add_ledge(scene, "arch", line);
  add_box(scene, "floor", -9, -5, 15, -4);
  const auto x_after = [&](int steps) { return -3 + walked(scene, steps - begin); };
  const int half = begin + static_cast<int>(steps_to_walk(scene, 3));  // at the top
  const int last = begin + static_cast<int>(steps_to_walk(scene, 3 + line.back().x()));
  scene.answers = {contact(steps_to_fall(scene, 0.2), 3 * scene.dt).to("arch"), x_is(x_after(half)).after(half).law(),
                   y_is(height_over(line, x_after(half)) + half_height).after(half).law(),
                   y_is(height_over(line, x_after(last)) + half_height).gaps(2).after(last).law()};
  ends_at(scene, x_after(scene.steps), -4 + half_height);
  return scene;
}

/// A cabin as wide inside as the character, with a floor at y = 0.
void add_cabin(Scene& scene, std::vector<MoverDef::Waypoint> path) {
  add_polygon(
      scene, "cabin",
      {{-1, -1}, {1, -1}, {1, 2}, {half_width, 2}, {half_width, 0}, {-half_width, 0}, {-half_width, 2}, {-1, 2}});
  move_last(scene, std::move(path));
}

/// It is never crushed.
void is_spared(Scene& scene) { scene.answers.push_back(count(Answer::Of::crush, scene.steps).law()); }

/// Stands on a floor; a plate that touches its head comes down 3 m in one step, past the floor, too.
Scene exact_fit_lift_down() {
  Scene scene = play(0, half_height, 30);
  add_box(scene, "floor", -4, -1, 4, 0);
  add_box(scene, "plate", -2, 2 * half_height, 2, 2 * half_height + 0.25);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = scene.dt, .at = {0, -3}}});
  scene.answers = {count(Answer::Of::crush, 0).to("plate").law(), count(Answer::Of::crushers, 1).law(), x_is(0).law(),
                   y_is(half_height).law()};
  return scene;
}

/// Falls towards the floor of a cabin, which comes up 5 m in each of 3 steps.
Scene exact_fit_cabin_up() {
  Scene scene = play(0, half_height + 0.375, 3);
  add_cabin(scene, {{.time = 0, .at = {0, 0}}, {.time = 3 * scene.dt, .at = {0, 15}}});
  scene.answers = {contact(0.375 / (5 + fallen(scene, 1)), 5).to("cabin").law(), x_is(0).law(),
                   y_is(half_height).to("cabin").law(), count(Answer::Of::in_the_air, 0).after(0).law()};
  is_spared(scene);
  return scene;
}

/// Jumps against a lift that touches its head and never moves.
Scene exact_fit_under_lift() {
  Scene scene = play(0, half_height, 30);
  constexpr int jumps = 5;
  hold_jump(scene, jumps, scene.steps);
  add_box(scene, "floor", -4, -1, 4, 0);
  add_box(scene, "lift", -2, 2 * half_height, 2, 2 * half_height + 0.25);
  move_last(scene, {{}});
  scene.answers = {contact(jumps, scene.character.jump_speed * scene.dt).to("lift").law(),
                   farthest({0, 1}, half_height).law(), farthest({0, -1}, -half_height).law(),
                   count(Answer::Of::in_the_air, 0).law()};
  is_spared(scene);
  return scene;
}

/// Falls to the floor of a cabin that never moves.
Scene exact_fit_cabin_still() {
  Scene scene = play(0, half_height + 0.375, 60);
  add_cabin(scene, {{}});
  scene.answers = {contact(steps_to_fall(scene, 0.375), 4 * scene.dt).to("cabin").law(), x_is(0).law(),
                   y_is(half_height).law(), between(Answer::Of::settled, 0, 20).law(),
                   count(Answer::Of::in_the_air, 0).after(20).law()};
  is_spared(scene);
  return scene;
}

/// Stands in a niche; 70 papers, each by itself, come down from above its head into the floor in one step.
Scene crush70() {
  constexpr int papers = 70;
  constexpr double thickness = 0.001;
  Scene scene = play(0, half_height + 0.05, 1);
  scene.dt = 1;
  add_box(scene, "floor", -4, -9, 4, 0);
  add_box(scene, "left", -4, 0, -0.4, 2);
  add_box(scene, "right", 0.4, 0, 4, 2);
  for (int i = 0; i < papers; ++i) {
    const double bottom = 3 + 0.01 * i;
    add_box(scene, "paper " + std::to_string(i), -0.36, bottom, 0.36, bottom + thickness);
    move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = scene.dt, .at = {0, -6}}});
  }
  scene.answers = {count(Answer::Of::crush, 0).law(), count(Answer::Of::crushers, papers).law(),
                   y_is(half_height).law()};
  return scene;
}

/// Begins 2 m inside a block, below a crate in it. The shortest straight way out passes the crate's lower corner with
/// the side of its head: its slope is that from the corner of the crate, grown by the octagon, to the start.
Scene escape_not_shortest() {
  Scene scene = flight(0, -2, 0, 0, 1);
  scene.start.resolve_overlap = true;
  add_box(scene, "block", -5, -10, 5, 0);
  add_box(scene, "crate", -0.1, -0.9, 0.1, -0.8);
  const double aside = (0.1 + foot) / (-0.9 - half_height + 2) * (2 + half_height);
  scene.answers = {y_is(half_height).law(), between(Answer::Of::place, -aside, aside, {1, 0}).gaps(4).law()};
  return scene;
}

}  // namespace

std::vector<SceneFamily> play_families() {
  return {{"ramp",
           "begins on a slope: stands up to the climb limit of 50 degrees, slides down beyond it",
           {{"angle", "deg", 1, 89.9, 60, "of the slope"},
            {"move", "", -1, 1, 0, "what is steered; the slope rises to the right"}},
           [](const ParameterValues& values) { return begun_on_slope(values["angle"], values["move"]); }}};
}

std::vector<BuiltInScene> play_scenes() {
  return {
      {"ledge_corner", "key held into the corner of a ledge: falls at once, as without the key", ledge_corner},
      {"gap_crossed", "0.7 m to a platform 0.1 m lower, key held: crossed", gap_crossed},
      {"gap_crossed_left", "the same to the left: the mirror image", [] { return mirrored(gap_crossed()); }},
      {"gap_fallen", "1 m to a level platform, key held: falls down the far side, to the ground", gap_fallen},
      {"gap_fallen_left", "the same to the left: the mirror image", [] { return mirrored(gap_fallen()); }},
      {"gap_higher", "1.5 m to a platform 0.25 m higher, key held: falls down the far side", gap_higher},
      {"gap_higher_left", "the same to the left: the mirror image", [] { return mirrored(gap_higher()); }},
      {"gap_jumped", "3 m to a platform 0.25 m higher, with a jump: crossed", gap_jumped},
      {"gap_jumped_left", "the same to the left: the mirror image", [] { return mirrored(gap_jumped()); }},
      {"steep_ramp_51", "down a ramp of 51° with a limit of 50°: slides by g sin² t² / 2",
       [] { return steep_ramp(51, 0); }},
      {"steep_ramp_51_up", "the same with the key held uphill: the same y(t)", [] { return steep_ramp(51, 1); }},
      {"steep_ramp_51_down", "the same with the key held downhill: never slower", [] { return steep_ramp(51, -1); }},
      {"steep_ramp_70", "down a ramp of 70°: slides by g sin² t² / 2", [] { return steep_ramp(70, 0); }},
      {"steep_ramp_70_up", "the same with the key held uphill: the same y(t)", [] { return steep_ramp(70, 1); }},
      {"steep_ramp_70_down", "the same with the key held downhill: never slower", [] { return steep_ramp(70, -1); }},
      {"steep_ramp_89", "down a ramp of 89°: slides by g sin² t² / 2", [] { return steep_ramp(89, 0); }},
      {"steep_ramp_89_up", "the same with the key held uphill: the same y(t)", [] { return steep_ramp(89, 1); }},
      {"steep_ramp_89_down", "the same with the key held downhill: never slower", [] { return steep_ramp(89, -1); }},
      {"slope_wall_hop", "up 45° into a wall, key held: comes to rest in the corner, grounded", slope_wall_hop},
      {"slope_into_ceiling", "up 30° under a level ceiling, key held: comes to rest between the two, grounded",
       slope_into_ceiling},
      {"slope_into_steep", "up 30° to where it becomes 60°, key held: comes to rest there, grounded", slope_into_steep},
      {"climb45_3m", "a slope of 45°, 3 m high, with a limit of 45°: is walked up", [] { return climb_45(3, 0); }},
      {"climb45_5m", "the same 5 m high: is walked up, too", [] { return climb_45(5, 0); }},
      {"climb45_far", "the same 1.7 m high, 1,000.1 m from the origin: is walked up, too",
       [] { return climb_45(1.7, 1000.1); }},
      {"kerb_1mm", "a kerb of 1 mm, without a step height: stops at its edge", [] { return kerb_of(0.001); }},
      {"kerb_10cm", "a kerb of 10 cm: stops at its edge", [] { return kerb_of(0.1); }},
      {"low_step", "a step of 30 cm: stops at its edge", [] { return kerb_of(0.3); }},
      {"oneway_hill", "over a one-way hill: it holds everywhere, to its end", oneway_hill},
      {"oneway_peak", "dropped onto the peak of a one-way roof: stands on it", oneway_peak},
      {"oneway_noise", "over a one-way platform that is level but for 1e-6 m: it holds, to its end", oneway_noise},
      {"oneway_arch", "over a one-way arch of 60 segments: it holds everywhere, to its end", oneway_arch},
      {"exact_fit_lift_down", "a plate comes down on its head, without room: crushed by the plate alone, never passed",
       exact_fit_lift_down},
      {"exact_fit_cabin_up", "a cabin as wide as the character rises: carried up on its floor", exact_fit_cabin_up},
      {"exact_fit_under_lift", "jumps under a lift that touches its head and rests: bumps its head, and stands",
       exact_fit_under_lift},
      {"exact_fit_cabin_still", "falls in a cabin as wide as the character that rests: stands on its floor",
       exact_fit_cabin_still},
      {"crush70", "70 papers come down on it in a niche, in one step: all 70 crush it, none passes", crush70},
      {"escape_not_shortest", "begins 2 m inside a block below a crate: comes out after 2.98 m, straight",
       escape_not_shortest},
  };
}

}  // namespace paperproof::compare
