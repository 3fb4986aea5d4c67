// Symptom: a start inside a solid was reported as stuck with fresh scratch memory, and resolved with scratch memory
// that an earlier step had used: the same input gave other bits. Cause: the way out was looked for among the pieces
// that were at hand. A step before may have collected more of them. And where all pieces within 8 character sizes were
// covered on all sides by others of the same polygon, the search ended although the polygon had open sides further
// away. Remedy: the search begins with what it asks for itself, and ends when the whole of the solids has been looked
// at.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <array>

namespace paperproof::stepping {
namespace {

TEST(Regression, a_way_out_does_not_depend_on_earlier_steps) {
  // The arms of this cross widen outwards. Its middle is a convex piece of its own, with an arm on each side.
  ColliderDef cross;
  std::array corners{Vec2d(20, 20), Vec2d(22, 60), Vec2d(-22, 60)};
  for (int quarter = 0; quarter < 4; ++quarter) {
    cross.points.insert(cross.points.end(), corners.begin(), corners.end());
    for (Vec2d& corner : corners) corner = Vec2d(-corner.y(), corner.x());
  }
  const auto from_the_middle = [](Stepper& stepper) {
    stepper.state = {};
    EXPECT_EQ(stepper.at(0.2, 0.3).fly(0, 0).status, StepStatus::moved);
    return stepper.state.position;
  };
  Stepper fresh({cross});
  const Vec2d out = from_the_middle(fresh);
  EXPECT_GT(out.cwiseAbs().minCoeff(), 20) << "out in the notch between two arms, the nearest place there is";
  EXPECT_LT(out.cwiseAbs().maxCoeff(), 20 + 2) << out.transpose();

  // A long flight past the cross, in whose bounding box the middle lies.
  Stepper used({cross});
  ASSERT_TRUE(used.at(-200, -12).fly(212, 212).contacts.empty());
  EXPECT_EQ(from_the_middle(used), out);
}

}  // namespace
}  // namespace paperproof::stepping
