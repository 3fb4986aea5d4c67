#include "oracle/convex_parts.hpp"

#include "compare/exact_shapes.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using paperproof::test::twice_area;
using Ring = std::vector<Vec2d>;

/// The parts are convex, use the collider's own vertices, and their areas add up exactly: with no part outside (each
/// has its vertices on the polygon and a positive area) nothing overlaps and nothing is left out.
void expect_partition(const ColliderDef& def) {
  Ring own = def.points;
  for (const Ring& hole : def.holes) own.insert(own.end(), hole.begin(), hole.end());
  Exact sum = 0;
  for (const detail::ConvexPart& part : detail::convex_parts(def)) {
    const std::size_t n = part.points.size();
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_NE(std::find(own.begin(), own.end(), part.points[i]), own.end());
      EXPECT_GE(cross(exact(part.points[i]), exact(part.points[(i + 1) % n]), exact(part.points[(i + 2) % n])), 0);
    }
    EXPECT_GT(twice_area(part.points), 0);
    sum += twice_area(part.points);
  }
  EXPECT_EQ(sum, twice_area(def));
}

TEST(ConvexParts, a_convex_polygon_is_its_own_only_part_and_a_chain_has_its_segments) {
  EXPECT_EQ(detail::convex_parts(polygon(square(1))).size(), 1U);
  EXPECT_EQ(detail::convex_parts(chain(square(1))).size(), 3U);
}

TEST(ConvexParts, concave_rings_of_either_winding_are_partitioned_exactly_without_their_holes) {
  constexpr std::uint64_t seed = 40;
  Random random(seed);
  const auto ring = [&random](const Vec2d& centre, double radius, int corners) {
    Ring made = star(random, centre, radius, corners);
    if (random.chance(0.5)) std::reverse(made.begin(), made.end());
    return made;
  };
  int cut = 0;
  for (int i = 0; i < 300; ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed) + " round " + std::to_string(i));
    const ColliderDef concave = polygon(ring({0, 0}, 1, 4 + random.below(16)));
    expect_partition(concave);
    cut += detail::convex_parts(concave).size() > 1;
    if (i % 5 != 0) continue;
    ColliderDef framed = polygon(square(4));
    for (int h = 0; h <= i / 5 % 4; ++h)
      framed.holes.push_back(ring({h % 2 * 4 - 2.0, h / 2 * 4 - 2.0}, 1.9, 3 + random.below(8)));
    expect_partition(framed);
  }
  EXPECT_GT(cut, 200);
}

TEST(ConvexParts, tile_rings_with_vertices_in_a_row_are_partitioned) {
  // A staircase of unit steps with every unit of its outline a vertex: many exact alignments; and in a frame.
  Ring stairs;
  for (int i = 0; i <= 6; ++i) stairs.emplace_back(i, 0);
  for (int i = 6; i > 0; --i) stairs.insert(stairs.end(), {{i, 7.0 - i}, {i - 1, 7.0 - i}});
  stairs.pop_back();
  for (int i = 6; i > 0; --i) stairs.emplace_back(0, i);
  expect_partition(polygon(stairs));
  for (Vec2d& v : stairs) v += Vec2d(0.5, 0.5);
  ColliderDef framed = polygon({{-1, -1}, {0.5, -1}, {8, -1}, {8, 9}, {0.5, 9}, {-1, 9}, {-1, 0.5}});
  framed.holes = {stairs};
  expect_partition(framed);
}

}  // namespace
}  // namespace paperproof::compare
