/// Exact ties on a lattice, where two implementations must agree which one-way chains a character is above. What comes
/// of it the campaign judges: static/one_way, static/one_way_solids, lines, presses/ledges.
#include "one_way_surfaces.hpp"
#include "campaign/shapes.hpp"
#include "oracle/exact.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::test {
namespace {

using compare::ExactScenery;
using compare::Place;

Vec2d whole(Random& random, int reach) { return Vec2d{random.integer(-reach, reach), random.integer(-reach, reach)}; }

/// One to six chains, all with one direction.
SceneryDef random_chains(Random& random) {
  const std::array<Vec2d, 6> ways{Vec2d{0, 1}, Vec2d{0, -3}, Vec2d{1, 0}, Vec2d{1, 2}, Vec2d{-1, 1}, Vec2d{3, -1}};
  const Vec2d one_way = ways[static_cast<std::size_t>(random.below(6))];
  SceneryDef def;
  for (int chains = random.integer(1, 6); chains > 0; --chains) {
    std::vector<Vec2d> points{whole(random, 4)};
    for (std::size_t count = random.chance(0.6) ? 2 : 4; points.size() < count;)
      if (const Vec2d next = whole(random, 4); next != points.back()) points.push_back(next);
    def.colliders.push_back(compare::chain(points));
    def.colliders.back().one_way = one_way;
  }
  return def;
}

TEST(OneWaySurfaces, controller_and_oracle_agree_on_a_lattice_of_ties) {
  const CharacterShape shape(
      std::vector<Vec2d>{{-1, -2}, {1, -2}, {2, -1}, {2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}});
  int above = 0;
  int asked = 0;
  for (std::uint64_t seed = 1; seed <= sampled(400U); ++seed) {
    Random random(seed);
    const SceneryDef def = random_chains(random);
    const Scenery scenery(def);
    const OneWaySurfaces surfaces(scenery, shape);
    const ExactScenery oracle(def, {shape.hull().begin(), shape.hull().end()});
    const std::size_t pieces = scenery.pieces().size();
    for (int place = 0; place < 20; ++place) {
      const Vec2d at = whole(random, 8);
      std::vector<bool> is_above(pieces);
      for (PieceIndex piece = 0; piece < pieces; ++piece) is_above[piece] = surfaces.is_above(surfaces.of(piece), at);
      for (PieceIndex piece = 0; piece < pieces; ++piece) {
        const ColliderIndex collider = scenery.pieces()[piece].collider;
        bool one_answer = true;
        for (PieceIndex other = 0; other < pieces; ++other)
          one_answer &= scenery.pieces()[other].collider != collider || is_above[other] == is_above[piece];
        if (!one_answer) continue;
        // The oracle says what is met on a way: on one that ends across a segment it is, if the way begins above.
        const auto ends = scenery.vertices_of(piece);
        ASSERT_EQ(is_above[piece], oracle.meets(Place(at), Place(Vec2d((ends[0] + ends[1]) / 2)), collider))
            << "seed " << seed << " at " << at.transpose() << ", from " << ends[0].transpose() << " to "
            << ends[1].transpose();
        ++asked;
        above += is_above[piece];
      }
    }
  }
  EXPECT_GE(above, asked / 10);
  EXPECT_LE(above, asked * 9 / 10);
}

}  // namespace
}  // namespace paperproof::test
