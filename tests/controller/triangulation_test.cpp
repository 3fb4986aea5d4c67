#include "geometry/triangulation.hpp"

#include <gtest/gtest.h>

#include "exact_reference.hpp"
#include "geometry/exact.hpp"
#include "random_polygons.hpp"

namespace paperproof {
namespace {

using geometry::DirectedRings;
using geometry::Triangle;
using test::Polygon;

void append(test::Points ring, int winding, DirectedRings& rings) {
  if (geometry::winding(ring) != winding) std::reverse(ring.begin(), ring.end());
  rings.first_vertex.push_back(static_cast<std::uint32_t>(rings.vertices.size()));
  rings.vertices.insert(rings.vertices.end(), ring.begin(), ring.end());
}

DirectedRings directed(const Polygon& polygon) {
  DirectedRings rings;
  append(polygon.outer, 1, rings);
  for (const test::Points& hole : polygon.holes) append(hole, -1, rings);
  return rings;
}

/// Every vertex with a flat corner, a bridge, or a diagonal through other vertices could leave a triangle without area,
/// which merging would hide.
void expect_proper_triangles(Polygon (*make)(test::Random&)) {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    test::Random random(seed);
    const DirectedRings rings = directed(make(random));
    const std::vector<Triangle> triangles = geometry::triangulate(rings);
    ASSERT_EQ(triangles.size(), rings.vertices.size() - 2 + 2 * (rings.first_vertex.size() - 1)) << "seed " << seed;
    for (const Triangle& triangle : triangles) {
      ASSERT_GT(geometry::orientation_sign(rings.vertices[triangle[0]], rings.vertices[triangle[1]],
                                           rings.vertices[triangle[2]]),
                0)
          << "seed " << seed;
    }
  }
}

/// Ground under a roof at y = 0, with whole coordinates only: flat stretches, and steps that are in line.
Polygon stairs(test::Random& random) {
  Polygon polygon{{{0, 0}}, {}};
  double x = 0;
  for (std::size_t i = 0; i < 3 + random.index(8); ++i) {
    const double y = static_cast<double>(random.index(4)) - 4;
    for (std::size_t j = 0; j <= random.index(3); ++j) polygon.outer.push_back({x++, y});
  }
  polygon.outer.push_back({x, 0});
  return polygon;
}

TEST(Triangulation, every_triangle_has_an_area_where_corners_and_diagonals_are_in_line) {
  expect_proper_triangles(stairs);
}

TEST(Triangulation, every_triangle_has_an_area_where_holes_and_bridges_are_in_line) {
  expect_proper_triangles(test::rooms);
}

TEST(Triangulation, every_triangle_has_an_area_between_star_shaped_holes) { expect_proper_triangles(test::holed); }

}  // namespace
}  // namespace paperproof
