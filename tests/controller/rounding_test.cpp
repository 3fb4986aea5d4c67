/// The rounding of random separations, in rational numbers, beside the bound that bounds/separation.gappa proves.
#include "campaign/random.hpp"
#include "step/configuration_space.hpp"
#include "support/exact_points.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::test {

TEST(Rounding, of_separations_beside_a_mover_is_less_than_the_bound_and_more_than_a_fiftieth) {
  constexpr double far = 1e6;
  constexpr double bound = 2.5e-9;
  Rational largest = 0;
  compare::Random random(2026);
  const int cases = sampled(500);
  for (int i = 0; i < cases; ++i) {
    const auto triangle = [&] { return std::vector{random.point(far), random.point(far), random.point(far)}; };
    const CharacterShape shape(triangle());
    const Scenery scenery({.colliders = {{.points = triangle()}}});
    const PieceFinder finder(scenery, PieceFinder::Kind::solids, shape.box(), PieceSearch::none);
    octagon_sweep::ConfigurationSpace space(shape, finder);
    std::vector<PieceIndex> piece{0};
    space.prepare(piece, no_mover, 0);
    const Vec2d at = random.point(far);
    const MoverMotion mover{random.point(far), random.point(far)};
    const double time = random.unit();
    for (std::size_t axis = 0; axis < space.axis_count(0); ++axis) {
      const Vec2d n = space.normal(0, axis);
      if (n == Vec2d::Zero()) continue;  // an unused lane
      const auto along = [&](const Vec2d& p) { return Rational(n.x()) * p.x() + Rational(n.y()) * p.y(); };
      Rational exact = 1e8;  // more than any
      for (const Vec2d& v : space.vertices_of(0))
        for (const Vec2d& o : shape.hull()) exact = std::min<Rational>(exact, along(at) - along(v) + along(o));
      exact -= along(mover.from) + (along(mover.to) - along(mover.from)) * time;
      largest = std::max<Rational>(largest, abs(exact - space.separation(0, axis, at - mover.at(time))));
    }
  }
  std::cout << "the largest error is " << static_cast<double>(largest) << " m, the bound " << bound << " m\n";
  EXPECT_TRUE(largest <= bound && largest >= bound / 50);
}

}  // namespace paperproof::test
