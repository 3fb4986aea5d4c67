#include "solid_union.hpp"

#include "levels.hpp"

#include <cmath>
#include <numbers>

namespace paperproof::box2d::test {
namespace {

double enclosed_area(const std::vector<Ring>& loops) {
  double area = 0;
  for (const Ring& loop : loops) area += twice_area(loop) / 2;
  return area;
}

std::vector<Ring> union_of(std::vector<ColliderDef> colliders) {
  return solid_union(rounded(SceneryDef{std::move(colliders)}));
}

TEST(SolidUnion, flush_tiles_become_one_loop_of_four_corners) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 20; ++i) tiles.push_back(box(i, -1, i + 1, 0));
  const std::vector<Ring> loops = union_of(tiles);
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].size(), 4U);
}

TEST(SolidUnion, outer_loops_are_counter_clockwise_and_holes_clockwise_for_either_winding_of_the_input) {
  for (const bool reversed : {false, true}) {
    ColliderDef outer = box(0, 0, 10, 10);
    ColliderDef hole = box(3, 3, 7, 7);
    std::ranges::reverse(reversed ? outer.points : hole.points);
    const std::vector<Ring> loops = union_of({with_hole(outer, hole)});
    ASSERT_EQ(loops.size(), 2U);
    EXPECT_EQ(enclosed_area(loops), 10.0 * 10 - 4 * 4);
    EXPECT_LT(twice_area(loops[0]) * twice_area(loops[1]), 0);
    const std::vector<Ring> filled = union_of({with_hole(outer, hole), hole});
    ASSERT_EQ(filled.size(), 1U) << "a hole that another collider fills";
    EXPECT_EQ(enclosed_area(filled), 100.0);
  }
}

/// Up to 3,600 paths.
TEST(SolidUnion, the_area_of_random_tile_maps_is_the_sum_of_the_tiles) {
  Random random(7);
  for (int map = 0; map < 50; ++map) {
    const double tile = std::ldexp(1.0, random.below(8) - 5);
    const int width = map == 0 ? 80 : 30;
    std::vector<ColliderDef> tiles;
    double expected = 0;
    for (int x = 0; x < width; ++x) {
      for (int y = 0; y < width / 2; ++y) {
        if (random.below(4) == 0) continue;
        const bool hollow = (x + y) % 2 == 0;
        const auto square = [&](double from, double to) {
          return box((x + from) * tile, (y + from) * tile, (x + to) * tile, (y + to) * tile);
        };
        tiles.push_back(hollow ? with_hole(square(0, 1), square(0.25, 0.75)) : square(0, 1));
        expected += (hollow ? 0.75 : 1) * tile * tile;
      }
    }
    EXPECT_EQ(enclosed_area(union_of(tiles)), expected) << "map " << map << " of seed 7";
  }
}

TEST(SolidUnion, crossing_polygons_are_united_to_a_micrometre_twenty_kilometres_out) {
  const double far = 20000;
  const std::vector<Ring> loops = union_of({box(far, far, far + 4, far + 1), box(far + 1, far - 1, far + 2, far + 2)});
  ASSERT_EQ(loops.size(), 1U);
  EXPECT_EQ(loops[0].size(), 12U);
  // Every coordinate is a whole number, so that float holds it exactly there; the two bars share 1 m².
  EXPECT_NEAR(enclosed_area(loops), 4 + 3 - 1, 1e-6);
}

TEST(SolidUnion, paper_thinner_than_floats_resolve_is_named_as_flat) {
  // At 100 m floats are 7.6e-6 m apart.
  const SceneryDef scenery = rounded(SceneryDef{{box(0, 100, 8, 100 + 1e-6), box(0, 100, 8, 100 + 1e-3)}});
  EXPECT_EQ(flat_polygons(scenery), std::vector<ColliderIndex>{0});
  EXPECT_EQ(solid_union(scenery).size(), 1U);
}

TEST(Spaced, a_loop_keeps_its_winding_and_its_vertices_come_far_enough_apart_for_box2d) {
  Random random(3);
  int shortened = 0;
  for (int i = 0; i < 200; ++i) {
    const double radius = random.between(0.02, 2);
    const int corners = random.integer(3, 2002);
    Ring loop;
    for (int k = 0; k < corners; ++k)
      loop.push_back(rounded(Vec2d(radius * towards(2 * std::numbers::pi * k / corners))));
    const Ring kept = spaced(loop);
    ASSERT_GE(kept.size(), 3U);
    shortened += kept.size() < loop.size();
    for (std::size_t k = 0; k < kept.size(); ++k)
      EXPECT_GT(b2DistanceSquared(kept[k], kept[(k + 1) % kept.size()]), b2_linearSlop * b2_linearSlop);
    // A chord of at most two spacings (or one edge) cuts off at most its height over the circle.
    const double chord = std::min(2 * radius, std::max(2.0 * static_cast<double>(chain_spacing), 7 * radius / corners));
    const double height = radius - std::sqrt(radius * radius - chord * chord / 4);
    EXPECT_GT(twice_area(kept), twice_area(loop) - 2 * 2 * std::numbers::pi * radius * height);
  }
  EXPECT_GT(shortened, 60) << "seed 3";
  EXPECT_LT(shortened, 195) << "seed 3";
}

TEST(Spaced, paper_thinner_than_the_spacing_has_no_loop) {
  const std::vector<Ring> thin = union_of({box(0, 0, 8, 0.004)});
  ASSERT_EQ(thin.size(), 1U);
  EXPECT_TRUE(spaced(thin[0]).empty());
  EXPECT_EQ(spaced(union_of({box(0, 0, 8, 0.006)})[0]).size(), 4U);
}

}  // namespace
}  // namespace paperproof::box2d::test
