/// octagon_sweep: what no situation of tests/situations can say. In `float`, with few iterations, what its report calls
/// the ground, what bits a scale keeps, and starts inside a solid.
#include "controller/stepping_in_float.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::stepping {
namespace {

TEST(Float, meets_the_scenes_within_its_own_tolerances) {
  Stepper bullet = in_float({rectangle(-100 * px, -5 * px, 100 * px, 0)}, of_shape(single_pixel()));
  const MoveResult& move = bullet.at(0, 30.5 * px).fly(0, -50 * px);
  ASSERT_EQ(move.contacts.size(), 1U);
  EXPECT_NEAR(move.contacts[0].fraction, 0.6, 4 * std::numeric_limits<float>::epsilon());
  EXPECT_GT(move.position.y(), 0.5 * px);
  EXPECT_LE(move.position.y(), 0.5 * px + tolerances_in_float.touch);

  int met = 0;
  for (int tenths = 0; tenths <= 900; ++tenths) {
    const double angle = tenths * 0.1 * degree;
    const Vec2d n{std::cos(angle), std::sin(angle)};
    const auto at = [&n](double along_normal, double along_wall) {
      return Vec2d{along_normal * n.x() - along_wall * n.y(), along_normal * n.y() + along_wall * n.x()};
    };
    const double face = std::max(n.dot(Vec2d{10, 10}), n.dot(Vec2d{5, 20})) * px + 1.5;
    Stepper flyer = in_float({polygon({at(face, -9), at(face + 0.01, -9), at(face + 0.01, 9), at(face, 9)})});
    const MoveResult& into = flyer.at(0, 0).fly(n.x() * 3, n.y() * 3);
    if (into.contacts.empty()) continue;
    ++met;
    // Vertices up to 9.3 m away are rounded by half of 2^-20 m, which the face turns into as much; then a few ulp.
    EXPECT_NEAR(into.contacts[0].fraction, 0.5, 4e-6 / 3) << tenths;
    EXPECT_LT(into.position.dot(n), 1.5) << tenths;
  }
  EXPECT_EQ(met, 901) << "of 901 walls in float";
}

TEST(FewIterations, let_no_velocity_grow_into_what_stops_it) {
  for (const int iterations : {1, 2, 3}) {
    Stepper faller({rectangle(-4, -1, 4, 0)}, {}, {.sweep_iterations = iterations});
    faller.gravity = {0, -30};
    faller.at(0, 2).steps(200);
    EXPECT_EQ(faller.state.velocity.y(), 0) << iterations;
    EXPECT_TRUE(faller.state.grounded) << iterations;
  }
}

/// Two floors, and a step down to a third one.
TEST(Ground, names_the_collider_that_is_stood_on) {
  Stepper walker({rectangle(-4, -1, 0, 0), rectangle(0, -1, 2, 0), rectangle(2, -1, 9, -0.05)}, {.snap = 0.5});
  walker.at(-1, half_height + 0.01).steps(20);
  std::vector<ColliderIndex> grounds;
  for (int step = 0; step < 50; ++step) {
    walker.step({.move = 1});
    ASSERT_TRUE(walker.state.grounded) << step;
    if (grounds.empty() || grounds.back() != walker.report.move.ground.collider)
      grounds.push_back(walker.report.move.ground.collider);
  }
  EXPECT_EQ(grounds, (std::vector<ColliderIndex>{0, 1, 2}));
  walker.step({.move = {}, .jump = true});
  EXPECT_EQ(walker.report.move.ground.state, GroundState::air);
}

TEST(Ground, is_air_walkable_or_steep) {
  // A slope of 60 degrees that ends on a floor.
  const double rise = 4 * std::tan(60 * degree);
  Stepper faller({rectangle(-1, -1, 20, 0), rectangle(-1, 0, 0, rise), polygon({{0, rise}, {0, 0}, {4, 0}})});
  faller.gravity = {0, -30};
  faller.at(2, rise).step();
  EXPECT_EQ(faller.report.move.ground.state, GroundState::air);
  int slides = 0;
  for (int step = 0; step < 200 && !faller.state.grounded; ++step) {
    faller.step();
    if (faller.report.move.ground.state != GroundState::steep) continue;
    ++slides;
    ASSERT_EQ(faller.report.move.ground.collider, ColliderIndex{2});
    ASSERT_NEAR(faller.report.move.ground.normal.y(), 0.5, 1e-12);
  }
  EXPECT_GT(slides, 5);
  EXPECT_EQ(faller.report.move.ground.state, GroundState::walkable);
  EXPECT_EQ(faller.report.move.ground.normal, Vec2d(0, 1));
  EXPECT_EQ(faller.report.move.ground.velocity, Vec2d(0, 0));
}

TEST(Ground, is_a_wedge_between_two_steep_faces) {
  Stepper faller({polygon({{0, 0}, {2, 5}, {3, 5}, {3, -1}, {-3, -1}, {-3, 5}, {-2, 5}})});
  faller.at(0.01, 3).steps(240);
  EXPECT_TRUE(faller.state.grounded);
  EXPECT_EQ(faller.report.move.ground.state, GroundState::wedge);
  EXPECT_EQ(faller.report.move.ground.collider, ColliderIndex{0});
}

/// The fraction of a flight to a slanted wall, everything multiplied by `scale`.
double fraction_at(double scale) {
  std::vector<Vec2d> points;
  const CharacterShape article = CharacterShape::article();
  for (const Vec2d& point : article.points()) points.push_back(point * scale);
  const auto at = [scale](double x, double y) { return Vec2d{x * scale, y * scale}; };
  Stepper flyer({polygon({at(2, -5), at(3, -5), at(5, 6), at(4, 6)})}, of_shape(CharacterShape(points)));
  const MoveResult& move = flyer.at(0.3 * scale, 0.2 * scale).fly(7.7 * scale, -1.3 * scale);
  EXPECT_FALSE(move.contacts.empty()) << scale;
  return move.contacts.empty() ? -1 : move.contacts[0].fraction;
}

TEST(Scale, by_a_power_of_two_gives_the_same_bits_of_the_time_of_impact) {
  const double expected = fraction_at(1);
  // The wall's left edge goes from (2, -5) to (4, 6): n = (11, -2) / sqrt(125) towards it; the arm (10, -10) px is the
  // octagon's furthest point along it.
  const Vec2d n = Vec2d{11, -2} / std::sqrt(125.0);
  const double distance = n.dot(Vec2d{2, -5} - Vec2d{0.3, 0.2} - Vec2d{10 * px, -10 * px});
  EXPECT_NEAR(expected, distance / n.dot(Vec2d{7.7, -1.3}), 1e-14);
  for (int k = -13; k <= 13; ++k) EXPECT_TRUE(same_bits(fraction_at(std::ldexp(1.0, k)), expected)) << "2^" << k;
}

TEST(StartInside, of_hundreds_of_solids_at_once_does_not_allocate) {
  std::vector<ColliderDef> colliders;
  for (int k = 0; k < 300; ++k)
    colliders.push_back(rectangle(-1 - k * 0.01, -1 - k * 0.01, 1 + k * 0.01, 1 + k * 0.01));
  Stepper stepper(colliders);
  stepper.gravity = {-30, 0};  // back to them: the step touches something, too
  stepper.at(0.1, 0.3);
  stepper.sweep().reserve({{-5, -5}, {5, 5}}, stepper.scratch);
  stepper.report.reserve(400);
  const std::size_t before = tests::allocations();
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_FALSE(stepper.report.move.contacts.empty());
  EXPECT_NEAR(stepper.state.position.x(), 3.99 + half_width, 1e-6);
}

TEST(StartInside, without_a_way_out_counts_the_steps_as_far_as_a_byte_goes) {
  Stepper stepper({rectangle(-2, -2, 2, 2), rectangle(-3, -3, -2.5, 3), rectangle(2.5, -3, 3, 3),
                   rectangle(-2.5, -3, 2.5, -2.5), rectangle(-2.5, 2.5, 2.5, 3)});
  stepper.at(0.5, 1);
  for (int n = 1; n <= 300; ++n) {
    ASSERT_EQ(stepper.step({.move = 1}), StepStatus::stuck);
    ASSERT_EQ(stepper.state.stuck_steps, std::min(n, 255));
  }
}

}  // namespace
}  // namespace paperproof::stepping
