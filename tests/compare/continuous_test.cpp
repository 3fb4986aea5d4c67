#include "campaign/random.hpp"
#include "campaign/shapes.hpp"
#include "continuous/course.hpp"
#include "continuous/roots.hpp"
#include "scenes/parameters.hpp"
#include "scenes/scene.hpp"
#include "support/refusal.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/techniques.hpp>

#include <boost/math/statistics/linear_regression.hpp>
#include <boost/math/statistics/univariate_statistics.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace paperproof::compare::continuous {
namespace {

void add(Scene& scene, const ColliderDef& solid) { scene.scenery.colliders.push_back(solid); }

/// The scene with steps that are 2^halvings times shorter.
Scene refined(Scene scene, double halvings) {
  turn(scene, {.key = "dt", .value = scene.dt / std::exp2(halvings)});
  return scene;
}

/// The largest distance between octagon_sweep's positions at the ends of steps and the course [m].
double error_of(const Scene& scene, const Course<Real>& course) {
  const Scenery scenery(scene.scenery);
  const Controller controller(scenery, scene.character);
  Scratch scratch = controller.make_scratch();
  StepReport report;
  CharacterState state;
  state.position = scene.start.position;
  state.velocity = scene.start.velocity;
  double largest = 0;
  Input input;
  auto next = scene.input.begin();
  for (int step = 0; step < scene.steps; ++step) {
    for (; next != scene.input.end() && next->step == step; ++next) apply(*next, input);
    controller.step(state, input, {scene.gravity, scene.dt}, scratch, report);
    largest = std::max(largest, (state.position - course.place_at((step + 1) * scene.dt).cast<double>()).norm());
  }
  return largest;
}

/// Ground of slopes of any steepness and of kerbs, from one wall to another; each part is a solid of its own.
void add_random_ground(Scene& scene, Random& random) {
  double x = -12;
  double y = 0;
  add(scene, polygon({{-14, -20}, {-12, -20}, {-12, 20}, {-14, 20}}));
  while (x < 12) {
    const double width = random.between(0.5, 3);
    const bool steep = random.chance(0.3);
    const double degrees = steep ? random.between(52, 75) : random.between(0, 48);
    const bool up = y < -1 || (y <= 1 && random.chance(0.5));
    const double sign = up ? 1 : -1;
    const double share = steep ? 0.4 : 1;
    const double next = random.chance(0.3) ? y : y + sign * share * width * std::tan(degrees * std::numbers::pi / 180);
    add(scene, polygon({{x, -20}, {x + share * width, -20}, {x + share * width, next}, {x, y}}));
    x += share * width;
    y = next;
    if (random.chance(0.15)) y += random.between(-1, 0.5);
  }
  add(scene, polygon({{x, -20}, {x + 2, -20}, {x + 2, 20}, {x, 20}}));
}

/// Convex solids that hang over the ground: their lower sides are ceilings.
void add_random_blocks(Scene& scene, Random& random) {
  for (int count = random.integer(0, 5); count > 0; --count) {
    const Vec2d middle{random.between(-10, 10), random.between(2, 6)};
    const double radius = random.between(0.3, 1.2);
    const double turn = random.angle();
    std::vector<Vec2d> points;
    const int corners = random.integer(3, 6);
    for (int k = 0; k < corners; ++k)
      points.emplace_back(middle + radius * towards(turn + 2 * std::numbers::pi * k / corners));
    add(scene, polygon(points));
  }
}

/// Falls from above the ground, and walks, stands and jumps at random for three seconds. Steps are 1/32 s.
Scene random_scene(std::uint64_t seed) {
  Random random(seed);
  Scene scene;
  scene.name = "random_" + std::to_string(seed);
  scene.gravity = {0, -random.between(8, 30)};
  scene.dt = 1.0 / 32;
  scene.steps = 96;
  scene.character.walk_speed = random.between(2, 8);
  scene.character.acceleration = random.between(10, 60);
  scene.character.jump_speed = random.between(4, 11);
  if (random.chance(0.3)) scene.character.max_fall_speed = random.between(5, 15);
  add_random_ground(scene, random);
  add_random_blocks(scene, random);
  scene.start.position = {random.between(-8, 8), 10};
  scene.start.velocity = {random.between(-6, 6), random.between(-15, 0)};
  for (int step = 0; step < scene.steps; step += random.integer(4, 24)) {
    InputEvent event{.step = step, .move = random.integer(-1, 1), .jump = random.chance(0.4)};
    if (random.chance(0.2)) event.move = random.between(-1, 1);
    scene.input.push_back(event);
  }
  return scene;
}

const Real tight("1e-40");

Scene empty_scene(double gravity) {
  Scene scene;
  scene.gravity = {0, -gravity};
  scene.dt = 1.0 / 64;
  scene.steps = 128;
  return scene;
}

Course<Real> run(const Scene& scene, Law law = Law::octagon_sweep, Time time = Time::continuous) {
  return course_of(scene, scene.input, law, time);
}

void expect_at(const Course<Real>& course, const Real& time, const Real& x, const Real& y, const char* when) {
  const Point place = course.place_at(time);
  EXPECT_LE(abs(place.x() - x), tight) << when << " at t = " << time << ": x " << place.x() << ", by formula " << x;
  EXPECT_LE(abs(place.y() - y), tight) << when << " at t = " << time << ": y " << place.y() << ", by formula " << y;
}

TEST(FallsThroughZero, is_the_root_where_the_parabola_comes_down) {
  EXPECT_EQ(*falls_through_zero(2, 0, -4), 1);   // 2 - 2 t²
  EXPECT_EQ(*falls_through_zero(-1, 4, -6), 1);  // -1 + 4 t - 3 t², up at 1/3, down at 1
  EXPECT_EQ(*falls_through_zero(3, -4, 2), 1);   // 3 - 4 t + t², up again at 3
  EXPECT_EQ(*falls_through_zero(0, 3, -2), 3);   // from the line and back
  EXPECT_EQ(*falls_through_zero(6, -2, 0), 3);
  EXPECT_FALSE(falls_through_zero(1, 0, 1));
  EXPECT_FALSE(falls_through_zero(-1, -1, -1));
  EXPECT_FALSE(falls_through_zero(0, -1, -1));
  EXPECT_FALSE(falls_through_zero(5, -2, 1));  // never as low as zero
  // Where the common formula would lose 30 digits: 1e-30 - t - t²/2 falls through zero at 1e-30 - 1e-60 / 2 + 1e-90
  // / 2.
  const Real small("1e-30");
  EXPECT_LE(abs(*falls_through_zero(small, -1, -1) - (small - small * small / 2)), Real("1e-78"));
}

/// A body without friction that brakes on a slope of 1/2 (with 12 m/s², against the slope's 4): after braking it stays.
TEST(Course, stays_at_the_wanted_speed_where_steering_is_stronger_than_the_slope) {
  Scene scene = empty_scene(10);
  scene.start.position = {-5.0 / 32, 0.625};  // the right foot, at (5, -20) px, is on the slope at (0, 0)
  scene.steps = 64;
  add(scene, polygon({{-16, -8}, {16, -8}, {16, 8}}));
  scene.start.velocity = {4, 2};
  scene.character.acceleration = 12;
  scene.input = {InputEvent{.step = 0, .move = 0, .jump = {}}};
  // Its climb slows with its walk, so the surface takes nothing of the 12 m/s², and gravity adds 4: it stands after 1/4
  // s.
  const Real braking = 12 + 4;
  const Real way = 8 / braking;
  expect_at(run(scene, Law::frictionless), 1, Real(-5) / 32 + way, Real(0.625) + way / 2, "braked");
}

/// Stands on a lift that rises at 1.5 m/s, turns after 1 s, and goes back; walks on it as on the ground.
TEST(Course, rides_a_lift_however_suddenly_it_turns) {
  Scene scene = empty_scene(10);
  scene.start.position = {0, 0.625};
  scene.character.walk_speed = 1;
  scene.character.acceleration = 4;
  scene.input = {InputEvent{.step = 64, .move = 1, .jump = {}}};
  add(scene, box(-4, -1, 4, 0));
  scene.scenery.colliders.back().mover = 0;
  scene.movers.push_back({.id = "lift",
                          .path = {{.time = 0, .at = {0, 0}}, {.time = 1, .at = {0.5, 1.5}}},
                          .loop = MoverDef::Loop::ping_pong});
  expect_at(run(scene), 1, 0.5, Real(0.625) + Real(3) / 2, "up");
  expect_at(run(scene), Real(3) / 2, Real(1) / 4 + Real(1) / 8 + Real(1) / 4, Real(0.625) + Real(3) / 4, "down");
}

/// It would rise to 5 m, and a ceiling ends the rise 0.1 m sooner. Without the ceiling the arc begins and ends 5 m
/// below its top and lower: a box around its two ends has no ceiling in it.
TEST(Course, meets_a_ceiling_just_below_the_top_of_its_rise) {
  Scene scene = empty_scene(10);
  scene.start.velocity = {0, 10};
  add(scene, box(-1, 4.9 + 0.625, 1, 8));
  const Real falls = sqrt(2 * (5 - Real(4.9)) / 10);  // so long before the top
  expect_at(run(scene), 2, 0, Real(4.9) - 5 * (1 + falls) * (1 + falls), "after the fall from the ceiling");
}

/// Without friction and steering nothing adds to the energy: it is constant on every arc and falls at impacts alone.
TEST(Course, keeps_its_energy_on_every_arc_and_loses_some_at_impacts) {
  int sliding = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Scene scene = random_scene(seed);
    scene.input.clear();
    scene.character.max_fall_speed.reset();
    const Course<Real> course = run(scene, Law::frictionless);
    const auto energy = [&](const Point& place, const Point& velocity) -> Real {
      return velocity.squaredNorm() / 2 - Real(scene.gravity.y()) * place.y();
    };
    for (std::size_t i = 0; i + 1 < course.arcs.size(); ++i) {
      const Arc<Real>& arc = course.arcs[i];
      const Arc<Real>& next = course.arcs[i + 1];
      const Real t = next.begin - arc.begin;
      const Real begin = energy(arc.place, arc.velocity);
      const Real end = energy(next.place, arc.velocity + arc.acceleration * t);
      EXPECT_LE(abs(end - begin), tight * 100) << "seed " << seed << ", arc " << i;
      EXPECT_LE(energy(next.place, next.velocity), end + tight * 100) << "seed " << seed << ", arc " << i;
      sliding += arc.acceleration.x() != 0 && arc.velocity.norm() > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(sliding, 40);
}

void add_moving_wall(Scene& scene, double way) {
  add(scene, box(1, 0, 2, 3));
  scene.scenery.colliders.back().mover = 0;
  scene.movers.push_back({.id = "wall", .path = {{.time = 0, .at = {0, 0}}, {.time = 1, .at = {way, 0}}}, .loop = {}});
}

TEST(Course, refuses_in_words_where_it_has_no_law) {
  using Change = void (*)(Scene&);
  for (const auto& [change, says] : std::vector<std::pair<Change, const char*>>{
           {[](Scene& scene) { scene.gravity.x() = 1; }, "straight down"},
           {[](Scene& scene) { scene.character.snap = 0.1; }, "snap"},
           {[](Scene& scene) { scene.others.push_back({}); }, "several characters"},
           {[](Scene& scene) { scene.scenery.colliders[0].surface_speed = 1; }, "conveyors"},
           {[](Scene& scene) { add_moving_wall(scene, 9); }, "nothing"},
           {[](Scene& scene) { add_moving_wall(scene, -9); }, "mover"}}) {
    Scene scene = empty_scene(10);
    add(scene, box(-4, -1, 4, 0));
    scene.start.position = {0, 1};
    change(scene);
    const std::string refusal = paperproof::test::refusal_by<NotCovered>([&] { (void)run(scene); }, "nothing");
    EXPECT_THAT(refusal, testing::HasSubstr(says));
  }
}

/// Steps from 1/64 s to 1/4096 s. Below, the motion of one step towards a surface, g dt² or a dt² (6e-7 m here at
/// least), falls below 4e-7 m, which lie between where octagon_sweep stops and where it hits: then the gap decides.
const std::vector<double> halvings{1, 2, 3, 4, 5, 6, 7};

/// Of their logarithms to the base 2, by least squares.
double slope_of_errors(std::vector<double> errors) {
  for (double& error : errors) error = -std::log2(error);
  return boost::math::statistics::simple_ordinary_least_squares(halvings, errors).second;
}

/// Semi-implicit Euler is of order one. A scene's own errors scatter about that line, because an impact falls anywhere
/// into a step, and a long step may miss a ledge, or land too late for a jump, and go another way altogether: that is
/// what the share is for. All scenes together have slope 1; and no scene stays away from its reference.
TEST(ContinuousReference, octagon_sweep_comes_to_it_with_the_first_power_of_the_step) {
  constexpr int scenes = 200;
  std::vector<std::vector<double>> all(halvings.size());
  int of_order_one = 0;
  int elsewhere = 0;
  int impacts = 0;
  int as_law = 0;
  for (int seed = 0; seed < scenes; ++seed) {
    const Scene scene = random_scene(static_cast<std::uint64_t>(seed));
    const Course<Real> course = course_of(scene, scene.input, Law::octagon_sweep);
    impacts += course.impacts;
    std::vector<double> errors;
    for (std::size_t k = 0; k < halvings.size(); ++k) {
      errors.push_back(error_of(refined(scene, halvings[k]), course));
      all[k].push_back(errors[k]);
    }
    // A contact shifts what follows by its gap, of 1e-6 m, times the change of the velocity over its part into the
    // surface: 1 / cos 50° on ground, and 1 + 1 / sin 50° on what is steeper.
    const Scene fine = refined(scene, 1);
    const Course<Real> law = run(fine, Law::octagon_sweep, Time::in_steps);
    as_law += error_of(fine, law) <= 2.31e-6 * (1 + law.impacts) ? 1 : 0;
    const double slope = slope_of_errors(errors);
    of_order_one += slope >= 0.8 && slope <= 1.2 ? 1 : 0;
    elsewhere += *std::min_element(errors.end() - 3, errors.end()) > 0.1 ? 1 : 0;
  }
  std::vector<double> medians;
  for (std::vector<double>& errors : all) medians.push_back(boost::math::statistics::median(errors));
  EXPECT_NEAR(slope_of_errors(medians), 1, 0.05);
  EXPECT_GE(of_order_one, scenes * 85 / 100);
  EXPECT_EQ(elsewhere, 0);
  EXPECT_GE(as_law, scenes * 99 / 100) << "where an edge is met as a step ends, the gap decides";
  EXPECT_GT(impacts, 4 * scenes);
}

}  // namespace
}  // namespace paperproof::compare::continuous
