// Symptom: a start 2 m inside a block goes out after 5.31 m to the side, where 2.99 m upwards are free, beside a crate
// that stands in the block; and a start in a gear of 200 teeth is reported as stuck beside a free way. Cause: of a way
// out only feet of perpendiculars and crossings of facets were looked at, never the edge of what a crate hides; and
// only the 96 facets nearest to the start, which in a gear are flanks that other teeth cover. Remedy: every facet is
// cut by all obstacles and by the shadows of those that may not be passed.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace paperproof {
namespace {

using compare::box;

/// The way out, which is found at once.
Vec2d way_out_of(std::vector<ColliderDef> colliders, const Vec2d& from) {
  stepping::Stepper stepper(std::move(colliders));
  stepper.gravity = {0, 0};
  EXPECT_EQ(stepper.at(from.x(), from.y()).step(), StepStatus::moved);
  return stepper.state.position - from;
}

TEST(Regression, a_way_out_passes_beside_a_crate) {
  const Vec2d way = way_out_of({box(-5, -10, 5, 0), box(-0.1, -0.9, 0.1, -0.8)}, {0, -2});
  // Seen by the position, the crate is larger by the octagon: the lower corners beside it are (0.1 + 5 px, -0.9 - 20
  // px) and (0.1 + 10 px, -0.9 - 10 px). The steepest way past both ends 20 px above the block.
  const double px = 1.0 / 32;
  const double slope = std::max((0.1 + 5 * px) / (2 - 0.9 - 20 * px), (0.1 + 10 * px) / (2 - 0.9 - 10 * px));
  EXPECT_NEAR(way.y(), 2 + 20 * px, 1e-6);
  EXPECT_NEAR(std::abs(way.x()), slope * (2 + 20 * px), 3e-6);
  EXPECT_NEAR(way.norm(), 2.99, 0.01);
}

TEST(Regression, a_way_out_of_a_gear_is_found_however_many_teeth_it_has) {
  const double inner = 4;
  const double outer = 5;
  for (const int teeth : {10, 50, 100, 200, 350, 500}) {
    ColliderDef gear;
    for (int k = 0; k < 2 * teeth; ++k) {
      const double angle = std::numbers::pi * k / teeth;
      gear.points.push_back(Vec2d{std::cos(angle), std::sin(angle)} * (k % 2 == 0 ? inner : outer));
    }
    const Vec2d way = way_out_of({gear}, {0, 0});
    // The octagon is half as wide as high, so that it goes out to a side: at most onto the tips of the teeth there.
    EXPECT_GE(way.norm(), inner + 10.0 / 32 - 0.1) << teeth << " teeth";
    EXPECT_LE(way.norm(), outer + 10.0 / 32 + 1e-6) << teeth << " teeth";
  }
}

}  // namespace
}  // namespace paperproof
