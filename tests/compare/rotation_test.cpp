#include "oracle/rotation.hpp"

#include "compare/exact_shapes.hpp"
#include "oracle/interval.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Kind = RotationTouch::Kind;

constexpr double width = 1e-12;

/// The arm of a clock that is one metre long and lies to the right while its angle is zero.
TurningPiece arm(double from, double to) { return {.points = {{0, 0}, {1, 0}}, .from = from, .to = to}; }

TEST(Rotation, sine_and_cosine_hold_the_library_s_and_are_tight) {
  Random random(61);
  for (int i = 0; i < 20000; ++i) {
    const double angle = random.between(-1, 1) * (i % 2 == 0 ? 10 : 1e6);
    const detail::SineCosine found = detail::sine_cosine(detail::Interval(angle));
    // The library is right to an ulp.
    EXPECT_LE(found.sine.low, one_ulp_up(std::sin(angle)));
    EXPECT_GE(found.sine.high, one_ulp_down(std::sin(angle)));
    EXPECT_LE(found.cosine.low, one_ulp_up(std::cos(angle)));
    EXPECT_GE(found.cosine.high, one_ulp_down(std::cos(angle)));
    EXPECT_LE(found.sine.high - found.sine.low, 4e-15 + std::abs(angle) * 1e-15) << angle;
    const double wide = random.between(0, 0.3);
    const detail::SineCosine range = detail::sine_cosine({angle, angle + wide});
    for (const double share : {0.0, 0.3, 0.7, 1.0}) {
      const double x = angle + share * wide;
      EXPECT_TRUE(range.sine.low <= std::sin(x) && std::sin(x) <= range.sine.high) << angle;
      EXPECT_TRUE(range.cosine.low <= std::cos(x) && std::cos(x) <= range.cosine.high) << angle;
    }
  }
}

TEST(Rotation, the_tip_of_an_arm_meets_the_feet_at_the_root_of_a_sinusoid) {
  // The feet are at height 0.8, above where the tip comes: cos(asin 0.8) = 0.6.
  const std::vector<Vec2d> points = octagon();
  for (const double turn : {0.95, 1.0, 2.0, 6.0, 200.0}) {
    const MovingOctagon still{.points = points, .position = {0.6, 0.8 + 0.625}};
    const RotationTouch touch = first_touch(still, arm(0, turn), width);
    const double root = std::asin(0.8) / turn;
    ASSERT_EQ(touch.kind, Kind::touches) << turn;
    EXPECT_LE(touch.low, root + 1e-15);
    EXPECT_GE(touch.high, root - 1e-15);
    EXPECT_LE(touch.high - touch.low, 4 * width) << turn;
  }
  const MovingOctagon still{.points = points, .position = {0.6, 0.8 + 0.625}};
  EXPECT_EQ(first_touch(still, arm(0, 0.92), width).kind, Kind::none) << "asin 0.8 is 0.927";
}

TEST(Rotation, an_octagon_that_falls_meets_the_rising_tip_where_the_two_heights_agree) {
  const std::vector<Vec2d> points = octagon();
  const MovingOctagon falling{.points = points, .position = {0.6, 1.9 + 0.625}, .displacement = {0, -1.5}};
  const RotationTouch touch = first_touch(falling, arm(0, 1.2), width);
  // sin(1.2 t) = 1.9 - 1.5 t, by bisection in long double.
  long double low = 0;
  long double high = 1;
  for (int i = 0; i < 80; ++i) {
    const long double t = (low + high) / 2;
    (std::sin(1.2L * t) < 1.9L - 1.5L * t ? low : high) = t;
  }
  ASSERT_EQ(touch.kind, Kind::touches);
  EXPECT_LE(touch.low, static_cast<double>(low) + 1e-15);
  EXPECT_GE(touch.high, static_cast<double>(low) - 1e-15);
  EXPECT_LE(touch.high - touch.low, 4 * width);
}

TEST(Rotation, a_paper_that_sweeps_sideways_meets_a_corner_where_its_line_passes_it) {
  // The lower left foot is the first corner that an arm from the right meets: at atan2 of it.
  const std::vector<Vec2d> points = octagon();
  const Vec2d foot(0.3, 0.4);
  const MovingOctagon still{.points = points, .position = foot - points[1]};
  const RotationTouch touch = first_touch(still, arm(-0.5, 1.5), width);
  const double root = (std::atan2(0.4, 0.3) + 0.5) / 2;
  ASSERT_EQ(touch.kind, Kind::touches);
  EXPECT_NEAR(touch.low, root, 2 * width);
  EXPECT_GE(touch.high, root - 1e-15);
}

TEST(Rotation, a_mover_that_turns_and_goes_on_is_met_as_its_way_adds) {
  // Turned by a quarter at once and then only moving: the arm stands upright at x, and comes to the left arm at
  // -0.3125.
  const std::vector<Vec2d> points = octagon();
  TurningPiece piece = arm(std::numbers::pi / 2, std::numbers::pi / 2);
  piece.motion = {{-2, 0}, {0, 0}};
  const RotationTouch touch = first_touch({.points = points}, piece, width);
  ASSERT_EQ(touch.kind, Kind::touches);
  EXPECT_NEAR(touch.low, (2 - 0.3125) / 2, 2 * width);
}

TEST(Rotation, an_overlap_at_the_start_is_a_touch_at_once) {
  const std::vector<Vec2d> points = octagon();
  const RotationTouch touch = first_touch({.points = points}, arm(0, 1), width);
  EXPECT_EQ(touch.kind, Kind::touches);
  EXPECT_EQ(touch.high, 0);
}

TEST(Rotation, sliding_along_is_grazing_and_ends) {
  const std::vector<Vec2d> points = octagon();
  const MovingOctagon sliding{.points = points, .position = {0.3, 0.625}, .displacement = {0.2, 0}};
  EXPECT_EQ(first_touch(sliding, arm(0, 0), width).kind, Kind::grazes);
}

TEST(Rotation, free_before_and_overlapping_after_in_exact_arithmetic) {
  constexpr std::uint64_t seed = 62;
  Random random(seed);
  const std::vector<Vec2d> points = octagon();
  int touched = 0;
  constexpr int rounds = 400;
  for (int i = 0; i < rounds; ++i) {
    TurningPiece piece{.points = {{-0.7, -0.05}, {0.7, -0.05}, {0.7, 0.05}, {-0.7, 0.05}},
                       .pivot = random.point(0.7),
                       .from = random.between(-7, 7),
                       .to = random.between(-7, 7)};
    piece.motion = {random.point(1), random.point(1)};
    const MovingOctagon body{.points = points, .position = random.point(1.6), .displacement = random.point(1)};
    const auto overlaps_at = [&](double t) {
      const double angle = piece.from + t * (piece.to - piece.from);
      const Vec2d place = body.position + t * body.displacement;
      const Vec2d offset = piece.motion.from + t * (piece.motion.to - piece.motion.from);
      std::vector<Vec2d> ring;
      for (const Vec2d& v : piece.points) {
        const Vec2d r = v - piece.pivot;
        ring.push_back(piece.pivot + offset +
                       Vec2d(std::cos(angle) * r.x() - std::sin(angle) * r.y(),
                             std::sin(angle) * r.x() + std::cos(angle) * r.y()));
      }
      return ExactScenery(scenery({polygon(ring)}), points).overlaps(place, 0);
    };
    const RotationTouch touch = first_touch(body, piece, width);
    if (touch.kind == Kind::grazes) continue;
    if (touch.kind == Kind::touches && touch.high == 0) {
      EXPECT_TRUE(overlaps_at(0)) << "seed " << seed << " round " << i;
      continue;
    }
    const double end = touch.kind == Kind::touches ? touch.low : 1;
    for (int k = 0; k < 20; ++k) {
      ASSERT_FALSE(overlaps_at(end * k / 20)) << "seed " << seed << " round " << i << " from " << end;
    }
    if (touch.kind == Kind::none) continue;
    ++touched;
    EXPECT_LE(touch.high - touch.low, 100 * width);
    EXPECT_FALSE(overlaps_at(touch.low - 1e-11)) << "seed " << seed << " round " << i;
    EXPECT_TRUE(overlaps_at(touch.high + 1e-11)) << "seed " << seed << " round " << i;
  }
  EXPECT_GT(touched, rounds * 3 / 10);
  EXPECT_LT(touched, rounds * 9 / 10);
}

TEST(Rotation, a_width_or_an_angle_that_is_no_number_is_refused) {
  const std::vector<Vec2d> points = octagon();
  EXPECT_THROW((void)first_touch({.points = points}, arm(0, 1), 0), std::invalid_argument);
  EXPECT_THROW((void)first_touch({.points = points}, arm(0, 1), std::nan("")), std::invalid_argument);
  EXPECT_THROW((void)first_touch({.points = points}, arm(0, std::nan("")), width), std::invalid_argument);
  EXPECT_THROW((void)first_touch({.points = points}, arm(0, 2e6), width), std::invalid_argument);
}

}  // namespace
}  // namespace paperproof::compare
