// Symptom: a start deep inside a large solid comes out inside another one: from (1, 2) in a block that reaches to y =
// 100, octagon_sweep went to y = 100.625 although a beam from 100.3 to 101 is there. Cause: the way out was looked for
// among the pieces within 8 character sizes (10 m), but a facet of a large solid can be further away than that, and
// nothing near that facet was looked at. Remedy: a way out that is further away than what was looked at is asked for
// again with all that is as near as it.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

namespace paperproof::stepping {
namespace {

TEST(Regression, a_way_out_further_than_ten_metres_does_not_end_in_another_solid) {
  const double block = 100;  // half its side
  const double beam = 50;    // half its length
  Stepper stepper({rectangle(-block, -block, block, block), rectangle(-beam, block + 0.3, beam, block + 1)});
  stepper.gravity = {0, 0};
  ASSERT_EQ(stepper.at(1, 2).step(), StepStatus::moved);
  const Vec2d p = stepper.state.position.cwiseAbs();
  EXPECT_TRUE(p.x() >= block + half_width || p.y() >= block + half_height) << "out of the block, at " << p.transpose();
  EXPECT_TRUE(p.x() >= beam + half_width || stepper.state.position.y() < block)
      << "beside the beam, at " << p.transpose();
}

}  // namespace
}  // namespace paperproof::stepping
