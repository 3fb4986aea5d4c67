/// One-way solids under octagon_sweep hold as their tops do, to the last bit.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

namespace paperproof::stepping {
namespace {

/// As `Stepper::fly`, over a solid and over its top as a chain, from a lattice: the same bits.
/// @return how many flights end with a contact.
int expect_flies_as_over_a_chain(const ColliderDef& solid, const ColliderDef& top) {
  int held = 0;
  for (double x = -4; x <= 4; x += 0.25)
    for (double y = -3; y <= 3; y += 0.25)
      for (const Vec2d& way :
           {Vec2d{0, -4}, Vec2d{0, 4}, Vec2d{4, 0}, Vec2d{-4, 0}, Vec2d{3, -3}, Vec2d{-3, 2}, Vec2d{3, -1}}) {
        Stepper<double> over_solid({solid});
        Stepper<double> over_chain({top});
        const MoveResult<double>& a = over_solid.at(x, y).fly(way.x(), way.y());
        const MoveResult<double>& b = over_chain.at(x, y).fly(way.x(), way.y());
        EXPECT_EQ(a.position, b.position) << x << " " << y << " by " << way.transpose();
        EXPECT_EQ(a.contacts.size(), b.contacts.size()) << x << " " << y << " by " << way.transpose();
        EXPECT_EQ(a.grounded, b.grounded) << x << " " << y << " by " << way.transpose();
        held += !a.contacts.empty();
      }
  return held;
}

TEST(OneWaySolid, blocks_as_its_top_does_and_nowhere_else) {
  ColliderDef slab = rectangle(-2, -0.5, 2, 0);
  slab.one_way = Vec2d{0, 1};
  EXPECT_GT(expect_flies_as_over_a_chain(slab, chain({{-2, 0}, {2, 0}}, Vec2d{0, 1})), 200);
}

TEST(OneWaySolid, whose_top_bends_is_one_surface_and_its_hole_is_nothing) {
  ColliderDef roof = polygon({{-3, -2}, {3, -2}, {3, -0.75}, {0, 0}, {-3, -0.75}});
  roof.holes = {{{-1, -1.5}, {1, -1.5}, {1, -1}, {-1, -1}}};
  roof.one_way = Vec2d{0, 1};
  EXPECT_GT(expect_flies_as_over_a_chain(roof, chain({{-3, -0.75}, {0, 0}, {3, -0.75}}, Vec2d{0, 1})), 200);
}

}  // namespace
}  // namespace paperproof::stepping
