// Symptom: a start inside a solid was reported as stuck with fresh scratch memory, and resolved with scratch memory
// that an earlier step had used: the same input gave other bits. Cause: the way out was looked for among the pieces
// that were at hand. A step before may have collected more of them. And where all pieces within 8 character sizes were
// covered on all sides by others of the same polygon, the search ended although the polygon had open sides further
// away. Remedy: the search begins with what it asks for itself, and ends when the whole of the solids has been looked
// at.
#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

namespace paperproof {
namespace {

/// A cross whose arms widen outwards: its middle is a convex piece of its own, with an arm on each side.
ColliderDef cross(double middle, double widest, double reach) {
  return {.points = {{middle, middle},
                     {widest, reach},
                     {-widest, reach},
                     {-middle, middle},
                     {-reach, widest},
                     {-reach, -widest},
                     {-middle, -middle},
                     {-widest, -reach},
                     {widest, -reach},
                     {middle, -middle},
                     {reach, -widest},
                     {reach, widest}}};
}

TEST(Regression, a_way_out_does_not_depend_on_earlier_steps) {
  const Scenery<double> scenery(SceneryDef{{cross(20, 22, 60)}});
  const Controller<double> controller(scenery, {});
  const auto from_the_middle = [&controller](Scratch<double>& scratch) {
    CharacterState<double> state;
    state.position = {0.2, 0.3};
    StepReport<double> report;
    EXPECT_EQ(controller.step(state, {}, {{0, 0}, 1.0 / 60}, scratch, report), StepStatus::moved);
    return state.position;
  };
  Scratch<double> fresh = controller.make_scratch();
  const Vec2d out = from_the_middle(fresh);
  EXPECT_GT(out.cwiseAbs().minCoeff(), 20) << "out in the notch between two arms, the nearest place there is";
  EXPECT_LT(out.cwiseAbs().maxCoeff(), 20 + 2) << out.transpose();

  // A long flight past the cross, in whose bounding box the middle lies.
  Scratch<double> used = controller.make_scratch();
  CharacterState<double> flyer;
  flyer.position = {-200, -12};
  flyer.velocity = {212, 212};
  StepReport<double> report;
  controller.step(flyer, {}, {{0, 0}, 1}, used, report);
  ASSERT_TRUE(report.move.contacts.empty());
  EXPECT_EQ(from_the_middle(used), out);
}

}  // namespace
}  // namespace paperproof
