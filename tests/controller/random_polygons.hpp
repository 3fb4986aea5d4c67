/// Families of random polygons for tests, each hard in its own way.
#pragma once

#include "campaign/random.hpp"

#include <paperproof/scenery.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace paperproof::test {

using Points = std::vector<Vec2d>;

class Random : public compare::Random {
 public:
  using compare::Random::Random;
  /// In [0, size).
  std::size_t index(std::size_t size) { return static_cast<std::size_t>(below(static_cast<int>(size))); }
};

/// Seen from its centre, every vertex is in plain sight.
inline Points star_ring(Random& random, std::size_t size, const Vec2d& centre, double least, double most) {
  Points ring;
  for (std::size_t i = 0; i < size; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(size);
    const double radius = random.between(least, most);
    ring.push_back(centre + radius * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

inline ColliderDef star(Random& random) { return {.points = star_ring(random, 5 + random.index(30), {0, 0}, 0.2, 2)}; }

/// Whole coordinates: many vertices on one line, many sides parallel; some rings touch themselves.
inline ColliderDef star_on_grid(Random& random) {
  ColliderDef polygon = star(random);
  for (Vec2d& vertex : polygon.points) vertex = Vec2d(std::round(4 * vertex.x()), std::round(4 * vertex.y()));
  return polygon;
}

/// Teeth on a bar; the gaps' corners are all on one line.
inline ColliderDef comb(Random& random) {
  ColliderDef polygon;
  const std::size_t teeth = 2 + random.index(10);
  for (std::size_t i = 0; i < teeth; ++i) {
    const double x = 3 * static_cast<double>(i);
    const double tip = random.between(1, 20);
    polygon.points.insert(polygon.points.end(), {{x, 0}, {x, tip}, {x + random.between(1, 2), tip}, {x + 2, 0}});
  }
  polygon.points.push_back({3 * static_cast<double>(teeth), -1});
  polygon.points.push_back({0, -1});
  return polygon;
}

/// Star-shaped holes in the cells of a grid, some cells left out.
inline ColliderDef holed(Random& random) {
  ColliderDef polygon;
  const std::size_t columns = 1 + random.index(4);
  const std::size_t rows = 1 + random.index(4);
  const double width = 4 * static_cast<double>(columns);
  const double height = 4 * static_cast<double>(rows);
  polygon.points = {{-2, -2}, {width - 2, -2}, {width - 2, height - 2}, {-2, height - 2}};
  for (std::size_t i = 0; i < columns * rows; ++i) {
    if (random.index(4) == 0) continue;
    const Vec2d centre(4 * static_cast<double>(i % columns), 4 * static_cast<double>(i / columns));
    polygon.holes.push_back(star_ring(random, 3 + random.index(8), centre, 0.3, 1.9));
  }
  return polygon;
}

/// Square holes with whole coordinates, side by side and above one another: their sides and corners are in line with
/// each other, with the outline's, and with the bridges between them.
inline ColliderDef rooms(Random& random) {
  ColliderDef polygon{.points = {{-1, -1}, {15, -1}, {15, 3}, {19, 3}, {19, 15}, {-1, 15}, {-1, 7}}};
  for (std::size_t i = 0; i < 25; ++i) {
    if (random.index(3) == 0) continue;
    const Vec2d at(3 * static_cast<double>(i % 5), 3 * static_cast<double>(i / 5));
    const double size = 1 + static_cast<double>(random.index(2));
    Points room{at, at + Vec2d(size, 0), at + Vec2d(size, size), at + Vec2d(0, size)};
    if (random.index(2) == 0) room.insert(room.begin() + 1, at + Vec2d(size / 2, 0));
    polygon.holes.push_back(room);
  }
  return polygon;
}

/// So far from the origin that rounding puts vertices on a coarse lattice: nearly straight corners, thin slivers.
inline ColliderDef far_away(Random& random) {
  const Vec2d centre = random.point(1e6);
  return {.points = star_ring(random, 5 + random.index(40), centre, 1e-9, 4e-9)};
}

}  // namespace paperproof::test
