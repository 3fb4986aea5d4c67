/// Stairs of many sizes under octagon_sweep: `CharacterDef::step_height` and `snap`.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

namespace paperproof::stepping {
namespace {

std::vector<ColliderDef> stairs(double rise, double tread, int count) {
  std::vector<ColliderDef> colliders{rectangle(-10, -1, 3, 0)};
  for (int i = 0; i < count; ++i) {
    const double left = 3 + tread * i;
    colliders.push_back(rectangle(left, -1, i + 1 == count ? 60 : left + tread, rise * (i + 1)));
  }
  return colliders;
}

/// On most of these the foot is wider than a tread, or a flank meets the next corner before the foot is on the stair.
TEST(StepHeight, stairs_of_any_tread_are_climbed_and_descended) {
  const CharacterDef eight{.snap = 0.5, .step_height = 0.4};
  CharacterDef four = eight;
  four.shape = CharacterShape(rectangle(-0.3, -0.625, 0.3, 0.625).points);
  for (const CharacterDef& character : {eight, four}) {
    for (const double rise : {0.05, 0.1, 0.15, 0.2, 0.25}) {
      for (const double tread : {0.15, 0.2, 0.25, 0.3, 0.4}) {
        for (const double speed : {1.0, 3.0, 6.0}) {
          for (const double dt : {1.0 / 240, 1.0 / 60}) {
            SCOPED_TRACE(testing::Message() << character.shape.points().size() << " corners, rise " << rise
                                            << ", tread " << tread << ", " << speed << " m/s, dt " << dt);
            Stepper walker(stairs(rise, tread, 8), character);
            walker.gravity = {0, -30};
            walker.dt = dt;
            walker.at(0, half_height + 1e-6);
            const int most = static_cast<int>((8 * tread + 8) / speed / dt) + 60;
            int steps = 0;
            while (walker.state.position.x() < 4 + 8 * tread && ++steps < most) walker.step({.move = speed / 6});
            ASSERT_LT(steps, most) << "it stops at " << walker.state.position.transpose();
            int in_air = 0;
            for (steps = 0; walker.state.position.x() > 0 && ++steps < most;) {
              walker.step({.move = -speed / 6});
              in_air += !walker.state.grounded;
            }
            ASSERT_LT(steps, most) << "it stops at " << walker.state.position.transpose();
            if (rise / tread < 1.2) {
              ASSERT_EQ(in_air, 0);
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace paperproof::stepping
