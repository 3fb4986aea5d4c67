#include "continuous/course.hpp"
#include "continuous/roots.hpp"
#include "continuous_scenes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace paperproof::compare::continuous {
namespace {

using Real = Number<50>;
const Real tight("1e-40");

Scene empty_scene(double gravity) {
  Scene scene;
  scene.gravity = {0, -gravity};
  scene.dt = 1.0 / 64;
  scene.steps = 128;
  return scene;
}

void add_box(Scene& scene, double left, double bottom, double right, double top) {
  add_solid(scene, {{left, bottom}, {right, bottom}, {right, top}, {left, top}});
}

Course<Real> run(const Scene& scene, Law law = Law::octagon_sweep) { return course_of<Real>(scene, scene.input, law); }

InputEvent from(int step, std::optional<double> move, std::optional<bool> jump = std::nullopt) {
  return {.step = step, .move = move, .jump = jump};
}

void expect_at(const Course<Real>& course, const Real& time, const Real& x, const Real& y, const char* when) {
  const Point<Real> place = course.place_at(time);
  EXPECT_LE(abs(place.x - x), tight) << when << " at t = " << time << ": x " << place.x << ", by formula " << x;
  EXPECT_LE(abs(place.y - y), tight) << when << " at t = " << time << ": y " << place.y << ", by formula " << y;
}

TEST(FallsThroughZero, is_the_root_where_the_parabola_comes_down) {
  EXPECT_EQ(*falls_through_zero<Real>(2, 0, -4), 1);   // 2 - 2 t²
  EXPECT_EQ(*falls_through_zero<Real>(-1, 4, -6), 1);  // -1 + 4 t - 3 t², up at 1/3, down at 1
  EXPECT_EQ(*falls_through_zero<Real>(3, -4, 2), 1);   // 3 - 4 t + t², up again at 3
  EXPECT_EQ(*falls_through_zero<Real>(0, 3, -2), 3);   // from the line and back
  EXPECT_EQ(*falls_through_zero<Real>(6, -2, 0), 3);
  EXPECT_FALSE(falls_through_zero<Real>(1, 0, 1));
  EXPECT_FALSE(falls_through_zero<Real>(-1, -1, -1));
  EXPECT_FALSE(falls_through_zero<Real>(0, -1, -1));
  EXPECT_FALSE(falls_through_zero<Real>(5, -2, 1));  // never as low as zero
  // Where the common formula would lose 30 digits: 1e-30 - t - t²/2 falls through zero at 1e-30 - 1e-60 / 2 + 1e-90
  // / 2.
  const Real small("1e-30");
  EXPECT_LE(abs(*falls_through_zero<Real>(small, -1, -1) - (small - small * small / 2)), Real("1e-78"));
}

TEST(Course, flies_on_a_parabola_and_steers_in_it) {
  Scene scene = empty_scene(10);
  scene.start.velocity = {3, 8};
  expect_at(run(scene), Real(3) / 2, Real(9) / 2, Real(3) / 4, "thrown");
  scene.character.walk_speed = 5;
  scene.character.acceleration = 4;
  scene.input = {from(0, -1)};  // -5 m/s after 2 s
  expect_at(run(scene), Real(3) / 2, 3 * Real(3) / 2 - 2 * Real(9) / 4, Real(3) / 4, "against the throw");
  scene.character.max_fall_speed = 2;  // after 1 s
  expect_at(run(scene), 2, 3 * 2 - 2 * 4, 3 - 2, "at the greatest speed of falling");
}

/// The left foot, at (-5, -20) px, or the right one is on a slope of `rise` over run, at (0, 0).
Scene on_slope(double rise, double gravity) {
  Scene scene = empty_scene(gravity);
  const double foot = rise < 0 ? -5.0 / 32 : 5.0 / 32;
  scene.start.position = {-foot, 0.625};  // the foot at (0, 0)
  scene.steps = 64;
  const Vec2d below = rise < 0 ? Vec2d(-16, 16 * rise) : Vec2d(16, -16 * rise);
  add_solid(scene, {{-16, -16 * rise}, below, {16, 16 * rise}});
  return scene;
}

/// Without friction, and steered uphill or not at all: g n.y n.x along x, down by the slope.
TEST(Course, slides_down_a_steep_slope_whatever_is_steered) {
  const Real x = Real(10) / 2 * 2 / 5;  // the normal is (2, 1) / sqrt(5)
  for (const std::optional<double> move : {std::optional<double>(), std::optional(-1.0), std::optional(0.0)}) {
    Scene scene = on_slope(-2, 10);
    if (move) scene.input = {from(0, move)};
    expect_at(run(scene), 1, Real(5) / 32 + x, Real(0.625) - 2 * x, "sliding");
    if (!move) expect_at(run(scene, Law::frictionless), 1, Real(5) / 32 + x, Real(0.625) - 2 * x, "without friction");
  }
}

/// A body without friction that brakes on a slope of 1/2 (with 12 m/s², against the slope's 4): after braking it stays.
TEST(Course, stays_at_the_wanted_speed_where_steering_is_stronger_than_the_slope) {
  Scene scene = on_slope(0.5, 10);
  scene.start.velocity = {4, 2};
  scene.character.acceleration = 12;
  scene.input = {from(0, 0)};
  // Its climb slows with its walk, so the surface takes nothing of the 12 m/s², and gravity adds 4: it stands after 1/4
  // s.
  const Real braking = 12 + 4;
  const Real way = 8 / braking;
  expect_at(run(scene, Law::frictionless), 1, Real(-5) / 32 + way, Real(0.625) + way / 2, "braked");
  scene.character.acceleration = 2;  // weaker than the slope: it comes back down
  const Real up = 2 + 4;
  const Real down = 4 - 2 * Real(4) / 5;
  const Real turn = 4 / up;
  const Real back = 8 / up - down * (1 - turn) * (1 - turn) / 2;
  expect_at(run(scene, Law::frictionless), 1, Real(-5) / 32 + back, Real(0.625) + back / 2, "coming back");
}

TEST(Course, accelerates_walks_and_brakes_on_the_ground) {
  Scene scene = empty_scene(10);
  scene.character.walk_speed = 6;
  scene.character.acceleration = 12;
  scene.character.air_acceleration = 1;
  scene.start.position = {0, 0.625};
  add_box(scene, -8, -1, 30, 0);
  scene.input = {from(0, 1), from(64, 0)};
  expect_at(run(scene), 1, Real(3) / 2 + 3, 0.625, "after half a second to 6 m/s");
  expect_at(run(scene), 2, Real(9) / 2 + Real(3) / 2, 0.625, "braked");
}

/// 12 m/s² downhill on a slope of 1/2 need 6 m/s² of falling: with g = 5 it leaves the ground, with 10 it does not.
TEST(Course, leaves_the_ground_where_it_speeds_up_faster_than_gravity_follows) {
  for (const double gravity : {5.0, 10.0}) {
    Scene scene = on_slope(-0.5, gravity);
    scene.character.acceleration = 12;
    scene.character.walk_speed = 60;
    scene.input = {from(0, 1)};
    const Real down = gravity == 5 ? Real(5) / 2 : Real(3);
    expect_at(run(scene), 1, Real(5) / 32 + 6, Real(0.625) - down, "speeding up downhill");
  }
}

TEST(Course, flies_into_walls_stops_in_corners_and_bumps_its_head) {
  Scene scene = empty_scene(0);
  scene.start.velocity = {6, 2};
  add_box(scene, 2.3125, -10, 3, 20);
  expect_at(run(scene), Real(3) / 2, 2, 3, "along a wall");
  add_box(scene, -4, 1.625, 4, 2);  // a ceiling, met after 1/2 s
  expect_at(run(scene), Real(3) / 2, 2, 1, "in a corner");
  Scene falling = empty_scene(10);
  falling.start.velocity = {0, 6};
  add_box(falling, -4, 1.625, 4, 2);  // met at y = 1 after 1/5 s, 1 = 6 t - 5 t²
  expect_at(run(falling), 1, 0, 1 - 5 * Real(16) / 25, "after a bump");
}

/// At 45 degrees: a rise at 8 m/s becomes (4, 4), by both laws.
TEST(Course, slides_along_an_overhang_that_a_rise_meets) {
  Scene scene = empty_scene(0);
  scene.start.velocity = {0, 8};
  // From (0, 1) upwards to the right, the solid left of it; the head's left corner is at (-5, 20) px, the arm's at
  // (-10, 10) px: the plane's normal (1, -1) has the head's corner first.
  add_solid(scene, {{-10, -9}, {10, 11}, {-10, 11}});
  const Real free = (1 - Real(5) / 32) - Real(20) / 32;
  for (const Law law : {Law::octagon_sweep, Law::frictionless})
    expect_at(run(scene, law), Real(1) / 2, 4 * (Real(1) / 2 - free / 8), free + 4 * (Real(1) / 2 - free / 8),
              "overhang");
}

TEST(Course, jumps_where_the_button_is_pressed_and_where_it_lands_with_it_held) {
  Scene scene = empty_scene(10);
  scene.start.position = {0, 0.625};
  scene.character.jump_speed = 5;
  add_box(scene, -8, -1, 8, 0);
  scene.input = {from(16, std::nullopt, true), from(17, std::nullopt, false), from(32, std::nullopt, true)};
  const Course<Real> course = run(scene);  // up at 1/4 s, down at 5/4 s with the button held since 1/2 s, down at 9/4 s
  expect_at(course, Real(3) / 4, 0, Real(0.625) + Real(5) / 4, "at the top");
  expect_at(course, Real(7) / 4, 0, Real(0.625) + Real(5) / 4, "at the top of the second");
}

/// Stands on a lift that rises at 1.5 m/s, turns after 1 s, and goes back; walks on it as on the ground.
TEST(Course, rides_a_lift_however_suddenly_it_turns) {
  Scene scene = empty_scene(10);
  scene.start.position = {0, 0.625};
  scene.character.walk_speed = 1;
  scene.character.acceleration = 4;
  scene.input = {from(64, 1)};
  add_box(scene, -4, -1, 4, 0);
  scene.scenery.colliders.back().mover = 0;
  scene.movers.push_back({.id = "lift",
                          .path = {{.time = 0, .at = {0, 0}}, {.time = 1, .at = {0.5, 1.5}}},
                          .loop = MoverDef::Loop::ping_pong});
  expect_at(run(scene), 1, 0.5, Real(0.625) + Real(3) / 2, "up");
  expect_at(run(scene), Real(3) / 2, Real(1) / 4 + Real(1) / 8 + Real(1) / 4, Real(0.625) + Real(3) / 4, "down");
}

/// A wedge of two steep slopes holds a fall; its lowest place is known.
TEST(Course, ends_between_two_steep_slopes) {
  Scene scene = empty_scene(10);
  scene.start.position = {0.5, 6};
  add_solid(scene, {{-8, 16}, {-8, -1}, {0, -1}, {0, 0}});
  add_solid(scene, {{8, 16}, {0, 0}, {0, -1}, {8, -1}});
  scene.steps = 192;
  const Course<Real> course = run(scene);
  // Slopes of 2: the arms at (±10, 10) px are on them, at height 20 / 32 of the wedge.
  expect_at(course, 3, 0, Real(20) / 32 + Real(10) / 32, "wedged");
  EXPECT_TRUE(course.arcs.back().stands);
}

/// Distance between two courses of different numbers, at a hundred times.
template <class A, class B>
Number<70> distance(const Course<A>& a, const Course<B>& b, double duration) {
  Number<70> largest = 0;
  for (int k = 0; k <= 100; ++k) {
    const double time = duration * k / 100;
    const Point<A> p = a.place_at(A(time));
    const Point<B> q = b.place_at(B(time));
    largest = std::max(
        largest,
        Number<70>(length_of(Point<Number<70>>{Number<70>(p.x) - Number<70>(q.x), Number<70>(p.y) - Number<70>(q.y)})));
  }
  return largest;
}

/// The reference's own convergence: the same run with more digits is the same to more digits.
TEST(Course, agrees_with_itself_to_more_digits_the_more_it_has) {
  int impacts = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Scene scene = random_scene(seed);
    for (const Law law : {Law::octagon_sweep, Law::frictionless}) {
      const auto low = course_of<Number<30>>(scene, scene.input, law);
      const auto middle = course_of<Number<50>>(scene, scene.input, law);
      const auto high = course_of<Number<70>>(scene, scene.input, law);
      EXPECT_LE(distance(low, high, 3), Number<70>("1e-21")) << "seed " << seed;
      EXPECT_LE(distance(middle, high, 3), Number<70>("1e-36")) << "seed " << seed;
      impacts += static_cast<int>(high.impacts.size());
    }
  }
  EXPECT_GT(impacts, 200);
}

/// Without friction and steering nothing adds to the energy: it is constant on every arc and falls at impacts alone.
TEST(Course, keeps_its_energy_on_every_arc_and_loses_some_at_impacts) {
  int sliding = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Scene scene = random_scene(seed);
    scene.input.clear();
    scene.character.max_fall_speed.reset();
    const Course<Real> course = run(scene, Law::frictionless);
    const auto energy = [&](const Point<Real>& place, const Point<Real>& velocity) -> Real {
      return dot(velocity, velocity) / 2 - Real(scene.gravity.y()) * place.y;
    };
    for (std::size_t i = 0; i + 1 < course.arcs.size(); ++i) {
      const Arc<Real>& arc = course.arcs[i];
      const Arc<Real>& next = course.arcs[i + 1];
      const Real t = next.begin - arc.begin;
      const Real begin = energy(arc.place, arc.velocity);
      const Real end = energy(next.place, arc.velocity + arc.acceleration * t);
      EXPECT_LE(abs(end - begin), tight * 100) << "seed " << seed << ", arc " << i;
      EXPECT_LE(energy(next.place, next.velocity), end + tight * 100) << "seed " << seed << ", arc " << i;
      sliding += arc.acceleration.x != 0 && length_of(arc.velocity) > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(sliding, 40);
}

void add_moving_wall(Scene& scene, const Vec2d& way) {
  add_box(scene, 1, 0, 2, 3);
  scene.scenery.colliders.back().mover = 0;
  scene.movers.push_back({.id = "wall", .path = {{.time = 0, .at = {0, 0}}, {.time = 1, .at = way}}, .loop = {}});
}

TEST(Course, refuses_in_words_where_it_has_no_law) {
  using Change = void (*)(Scene&);
  for (const auto& [change, says] : std::vector<std::pair<Change, const char*>>{
           {[](Scene& scene) {
              scene.gravity = {1, -10};
            },
            "straight down"},
           {[](Scene& scene) { scene.character.snap = 0.1; }, "snap"},
           {[](Scene& scene) { scene.others.push_back({}); }, "several characters"},
           {[](Scene& scene) { scene.scenery.colliders[0].surface_speed = 1; }, "conveyors"},
           {[](Scene& scene) {
              add_moving_wall(scene, {9, 0});
            },
            "nothing"},
           {[](Scene& scene) {
              add_moving_wall(scene, {-9, 0});
            },
            "mover"}}) {
    Scene scene = empty_scene(10);
    add_box(scene, -4, -1, 4, 0);
    scene.start.position = {0, 1};
    change(scene);
    std::string refusal = "nothing";
    try {
      (void)run(scene);
    } catch (const NotCovered& reason) {
      refusal = reason.what();
    }
    EXPECT_THAT(refusal, testing::HasSubstr(says));
  }
}

}  // namespace
}  // namespace paperproof::compare::continuous
