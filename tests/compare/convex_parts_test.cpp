#include "oracle/convex_parts.hpp"

#include "oracle/exact.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace paperproof::compare {
namespace {

using Ring = std::vector<Vec2d>;

Rational twice_area(const Ring& ring) {
  Rational sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d& a = ring[i];
    const Vec2d& b = ring[(i + 1) % ring.size()];
    sum += Rational(a.x()) * Rational(b.y()) - Rational(a.y()) * Rational(b.x());
  }
  return sum;
}

bool is_convex(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2d& a = ring[i];
    const Vec2d& b = ring[(i + 1) % ring.size()];
    const Vec2d& c = ring[(i + 2) % ring.size()];
    const Rational turn = (Rational(b.x()) - Rational(a.x())) * (Rational(c.y()) - Rational(b.y())) -
                          (Rational(b.y()) - Rational(a.y())) * (Rational(c.x()) - Rational(b.x()));
    if (turn < 0) return false;
  }
  return true;
}

/// The parts are convex, use the collider's own vertices, and their areas add up exactly: with no part outside (each
/// has its vertices on the polygon and a positive area) nothing overlaps and nothing is left out.
void expect_partition(const ColliderDef& def, const std::string& which) {
  Rational area = abs(twice_area(def.points));
  Ring own = def.points;
  for (const Ring& hole : def.holes) {
    area -= abs(twice_area(hole));
    own.insert(own.end(), hole.begin(), hole.end());
  }
  Rational sum = 0;
  for (const detail::ConvexPart& part : detail::convex_parts(def)) {
    EXPECT_TRUE(is_convex(part.points)) << which;
    const Rational of_part = twice_area(part.points);
    EXPECT_GT(of_part, 0) << which;
    sum += of_part;
    for (const Vec2d& vertex : part.points) {
      EXPECT_NE(std::find(own.begin(), own.end(), vertex), own.end()) << which;
    }
  }
  EXPECT_EQ(sum, area) << which;
}

Ring star(std::mt19937_64& engine, const Vec2d& centre, double radius, int corners) {
  std::uniform_real_distribution<double> unit(0, 1);
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * (i + 0.8 * unit(engine)) / corners;
    const double r = radius * (0.3 + 0.7 * unit(engine));
    ring.emplace_back(centre.x() + r * std::cos(angle), centre.y() + r * std::sin(angle));
  }
  if (engine() % 2 == 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

TEST(ConvexParts, a_convex_polygon_is_its_own_only_part_and_a_chain_has_its_segments) {
  const Ring square{{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  EXPECT_EQ(detail::convex_parts({.points = square}).size(), 1U);
  EXPECT_EQ(detail::convex_parts({.shape = ColliderDef::Shape::chain, .points = square}).size(), 3U);
}

TEST(ConvexParts, concave_rings_of_either_winding_are_partitioned_exactly) {
  constexpr std::uint64_t seed = 40;
  std::mt19937_64 engine(seed);
  int cut = 0;
  for (int i = 0; i < 300; ++i) {
    const ColliderDef def{.points = star(engine, {0, 0}, 1, 4 + static_cast<int>(engine() % 16))};
    expect_partition(def, "seed " + std::to_string(seed) + " ring " + std::to_string(i));
    cut += detail::convex_parts(def).size() > 1;
  }
  EXPECT_GT(cut, 200);
}

TEST(ConvexParts, holes_are_left_out) {
  constexpr std::uint64_t seed = 41;
  std::mt19937_64 engine(seed);
  for (int i = 0; i < 60; ++i) {
    ColliderDef def{.points = {{-4, -4}, {4, -4}, {4, 4}, {-4, 4}}};
    const int holes = 1 + i % 4;
    for (int h = 0; h < holes; ++h) {
      def.holes.push_back(star(engine, {h % 2 * 4 - 2.0, h / 2 * 4 - 2.0}, 1.9, 3 + static_cast<int>(engine() % 8)));
    }
    expect_partition(def, "seed " + std::to_string(seed) + " polygon " + std::to_string(i));
  }
}

TEST(ConvexParts, tile_rings_with_vertices_in_a_row_are_partitioned) {
  // A staircase of unit steps with every unit of its outline a vertex: many exact alignments.
  Ring stairs;
  for (int i = 0; i <= 6; ++i) stairs.emplace_back(i, 0);
  for (int i = 6; i > 0; --i) {
    stairs.emplace_back(i, 7 - i);
    stairs.emplace_back(i - 1, 7 - i);
  }
  stairs.pop_back();
  for (int i = 6; i > 0; --i) stairs.emplace_back(0, i);
  expect_partition({.points = stairs}, "stairs");
  ColliderDef framed{.points = {{-1, -1}, {0, -1}, {7, -1}, {7, 8}, {0, 8}, {-1, 8}, {-1, 0}}};
  Ring hole;
  for (const Vec2d& v : stairs) hole.push_back(v + Vec2d(0.5, 0.5));
  framed.points = {{-1, -1}, {0.5, -1}, {8, -1}, {8, 9}, {0.5, 9}, {-1, 9}, {-1, 0.5}};
  framed.holes = {hole};
  expect_partition(framed, "stairs in a frame");
}

}  // namespace
}  // namespace paperproof::compare
