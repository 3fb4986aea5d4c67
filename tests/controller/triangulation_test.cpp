#include "geometry/triangulation.hpp"

#include <gtest/gtest.h>

#include "geometry/exact.hpp"
#include "random_polygons.hpp"

namespace paperproof {
namespace {

void append(test::Points ring, int winding, geometry::DirectedRings& rings) {
  if (geometry::winding(ring) != winding) std::reverse(ring.begin(), ring.end());
  rings.first_vertex.push_back(static_cast<std::uint32_t>(rings.vertices.size()));
  rings.vertices.insert(rings.vertices.end(), ring.begin(), ring.end());
}

// A flat corner, a bridge, or a diagonal through other vertices could leave a triangle without area, which merging
// would hide.
TEST(Triangulation, every_triangle_has_an_area_where_corners_holes_bridges_and_diagonals_are_in_line) {
  for (test::Polygon (*const make)(test::Random&) : {test::comb, test::rooms, test::holed}) {
    for (unsigned seed = 0; seed < 1000; ++seed) {
      test::Random random(seed);
      const test::Polygon polygon = make(random);
      geometry::DirectedRings rings;
      append(polygon.outer, 1, rings);
      for (const test::Points& hole : polygon.holes) append(hole, -1, rings);
      const std::vector<geometry::Triangle> triangles = geometry::triangulate(rings);
      ASSERT_EQ(triangles.size(), rings.vertices.size() - 2 + 2 * polygon.holes.size()) << "seed " << seed;
      for (const auto& [a, b, c] : triangles)
        ASSERT_GT(geometry::orientation_sign(rings.vertices[a], rings.vertices[b], rings.vertices[c]), 0)
            << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace paperproof
