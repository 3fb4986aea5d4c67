// Symptom: a start deep inside a large solid comes out inside another one: from (1, 2) in a block that reaches to y =
// 100, octagon_sweep went to y = 100.625 although a beam from 100.3 to 101 is there. Cause: the way out was looked for
// among the pieces within 8 character sizes (10 m), but a facet of a large solid can be further away than that, and
// nothing near that facet was looked at. Remedy: a way out that is further away than what was looked at is asked for
// again with all that is as near as it.
#include "campaign/shapes.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

namespace paperproof {
namespace {

using compare::box;

TEST(Regression, a_way_out_further_than_ten_metres_does_not_end_in_another_solid) {
  const double block = 100;  // half its side
  const double beam = 50;    // half its length
  const Scenery<double> scenery(
      SceneryDef{{box(-block, -block, block, block), box(-beam, block + 0.3, beam, block + 1)}});
  const Controller<double> controller(scenery, {});
  const Vec2d half = controller.character().shape.box().upper;
  Scratch<double> scratch = controller.make_scratch();
  CharacterState<double> state;
  state.position = {1, 2};
  StepReport<double> report;
  ASSERT_EQ(controller.step(state, {}, {{0, 0}, 1.0 / 60}, scratch, report), StepStatus::moved);
  const Vec2d p = state.position.cwiseAbs();
  EXPECT_TRUE(p.x() >= block + half.x() || p.y() >= block + half.y()) << "out of the block, at " << p.transpose();
  EXPECT_TRUE(p.x() >= beam + half.x() || state.position.y() < block) << "beside the beam, at " << p.transpose();
}

}  // namespace
}  // namespace paperproof
