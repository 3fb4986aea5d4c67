#include "campaign/terrain.hpp"

#include "campaign/shapes.hpp"

#include <numbers>

namespace paperproof::compare {
namespace {

/// Collects colliders relative to an origin.
class TerrainBuilder {
 public:
  explicit TerrainBuilder(const Vec2d& origin) : origin_(origin) {}

  void polygon(std::initializer_list<Vec2d> points) { def.colliders.push_back(compare::polygon(placed(points))); }
  void box(double x0, double y0, double x1, double y1) { polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}); }
  ColliderDef& chain(std::initializer_list<Vec2d> points) {
    return def.colliders.emplace_back(compare::chain(placed(points)));
  }
  /// A strip of the given thickness along `angle`.
  void strip(const Vec2d& middle, double length, double thickness, double angle) {
    const Vec2d along{std::cos(angle) * length / 2, std::sin(angle) * length / 2};
    const Vec2d up{-std::sin(angle) * thickness / 2, std::cos(angle) * thickness / 2};
    polygon({middle - along - up, middle + along - up, middle + along + up, middle - along + up});
  }
  void circle(const Vec2d& centre, double radius) {
    def.colliders.push_back(compare::circle(origin_ + centre, radius));
  }
  void floor() { box(-8, -3, 8, -2); }

  SceneryDef def;

 private:
  std::vector<Vec2d> placed(std::vector<Vec2d> points) const {
    for (Vec2d& point : points) point += origin_;
    return points;
  }

  Vec2d origin_;
};

/// Balls of every size on ground that is flat, or round itself; some touch each other exactly.
void circles(TerrainBuilder& b, Random& r) {
  if (r.chance(0.5)) {
    b.floor();
  } else {
    const double radius = r.log_between(3, 1e4);
    b.circle({r.between(-1, 1), -2 - radius}, radius);
  }
  for (int i = 0; i < 12; ++i) {
    const Vec2d centre{r.between(-5, 5), r.between(-3, 4)};
    const double radius = r.log_between(1e-3, 1.5);
    b.circle(centre, radius);
    if (r.chance(0.2)) b.circle(centre + Vec2d(2 * radius, 0), radius);
    if (r.chance(0.2)) b.circle(centre + Vec2d(r.between(0.5, 3), 0), radius);
  }
  for (int i = 0; i < 3; ++i) {
    const Vec2d middle{r.between(-4, 4), r.between(-3, 4)};
    const double length = r.between(0.5, 2);
    const double thickness = r.log_between(1e-6, 0.1);
    b.strip(middle, length, thickness, r.angle());
  }
}

void tiles(TerrainBuilder& b, Random& r) {
  const double size = r.chance(0.5) ? 1 : r.between(0.3, 1.4);
  for (int x = -6; x <= 6; ++x)
    for (int y = -5; y <= 5; ++y)
      if (r.chance(y < -1 ? 0.7 : 0.12)) b.box(x * size, y * size, (x + 1) * size, (y + 1) * size);
}

void slopes(TerrainBuilder& b, Random& r) {
  double x = -6;
  double y = -2;
  while (x < 6) {
    const double width = r.between(0.2, 2);
    const double steepness = r.chance(0.2) ? r.between(80, 89.9) : r.between(0, 60);
    const double angle = (r.chance(0.5) ? steepness : -steepness) * degree;
    const double next = std::clamp(y + std::tan(angle) * width, -6.0, 6.0);
    b.polygon({{x, -8}, {x + width, -8}, {x + width, next}, {x, y}});
    x += width;
    y = next;
  }
}

void spikes(TerrainBuilder& b, Random& r) {
  b.floor();
  for (int i = 0; i < 12; ++i) {
    const double x = r.between(-5, 5);
    const double width = r.log_between(1e-4, 0.5);
    b.polygon({{x - width, -2}, {x + width, -2}, {x, -2 + r.between(0.1, 2.5)}});
  }
}

void papers(TerrainBuilder& b, Random& r) {
  for (int i = 0; i < 8; ++i) {
    const Vec2d middle{r.between(-4, 4), r.between(-4, 4)};
    const double length = r.between(0.5, 5);
    const double thickness = r.log_between(1e-6, 0.1);
    b.strip(middle, length, thickness, r.angle());
  }
}

void chains(TerrainBuilder& b, Random& r) {
  for (int i = 0; i < 6; ++i) {
    const Vec2d a{r.between(-4, 4), r.between(-4, 4)};
    const Vec2d d{r.between(-2, 2), r.between(-2, 2)};
    const Vec2d e{r.between(-2, 2), r.between(-2, 2)};
    b.chain({a, a + d, a + d + e});
  }
}

void wedges(TerrainBuilder& b, Random& r) {
  const double half = r.log_between(0.5, 45) * degree;
  const double lean = r.chance(0.5) ? 0 : r.between(-0.3, 0.3);
  // Two plates, 1 m thick, that meet in an edge.
  const auto plate = [&](double angle, double side) {
    const Vec2d along{std::sin(angle) * 8, std::cos(angle) * 8};
    const Vec2d out{side * std::cos(angle), -side * std::sin(angle)};
    const Vec2d apex{0, -2};
    b.polygon({apex, apex + along, apex + along + out, apex + out});
  };
  plate(lean - half, -1);
  plate(lean + half, 1);
}

void stairs(TerrainBuilder& b, Random& r) {
  const double rise = r.log_between(1e-7, 0.7);
  for (int i = -8; i < 8; ++i) b.box(i * 0.6, -8, (i + 1) * 0.6, -2 + i * rise);
}

void ceilings(TerrainBuilder& b, Random& r) {
  slopes(b, r);
  for (int i = 0; i < 5; ++i) {
    const Vec2d middle{r.between(-5, 5), r.between(-1, 3)};
    const double length = r.between(1, 5);
    const double thickness = r.between(0.1, 1);
    b.strip(middle, length, thickness, r.between(-60, 60) * degree);
  }
}

void shafts(TerrainBuilder& b, Random& r) {
  // The article's character is 0.625 m wide.
  const double clearance = r.chance(0.3) ? 0 : r.log_between(1e-9, 1e-2);
  const double left = r.chance(0.5) ? -0.3125 : r.between(-1, 0);
  b.box(left - 1, -6, left, 1);
  b.box(left + 0.625 + clearance, -6, left + 1.625 + clearance, 1);
  if (r.chance(0.5)) b.box(-3, -6.5, 3, -6);
}

void needles(TerrainBuilder& b, Random& r) {
  b.floor();
  for (int i = 0; i < 8; ++i) {
    const Vec2d tip{r.between(-4, 4), r.between(-2, 3)};
    const double angle = r.angle();
    const Vec2d along{std::cos(angle), std::sin(angle)};
    const Vec2d across{-along.y() * r.log_between(1e-6, 1e-2), along.x() * r.log_between(1e-6, 1e-2)};
    b.polygon({tip, tip + along * r.between(0.5, 3) + across, tip + along * r.between(0.5, 3) - across});
  }
}

void concave(TerrainBuilder& b, Random& r) {
  b.floor();
  for (int i = 0; i < 3; ++i) {
    // A star around a point: always simple, hardly ever convex.
    ColliderDef star;
    const Vec2d middle{r.between(-4, 4), r.between(-2, 3)};
    const int corners = r.integer(5, 14);
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * k / corners;
      const double radius = r.between(0.15, 1.2);
      star.points.push_back(middle + Vec2d{std::cos(angle) * radius, std::sin(angle) * radius});
    }
    const Vec2d origin = b.def.colliders.front().points.front() - Vec2d{-8, -3};
    for (Vec2d& p : star.points) p += origin;
    b.def.colliders.push_back(star);
  }
}

void one_way(TerrainBuilder& b, Random& r) {
  b.floor();
  for (int i = 0; i < 7; ++i) {
    const Vec2d a{r.between(-5, 4), r.between(-1.5, 3)};
    const double tilt = r.chance(0.5) ? 0 : r.between(-0.8, 0.8);
    b.chain({a, a + Vec2d{r.between(0.3, 2), tilt}}).one_way = Vec2d{0, 1};
  }
}

void lattice(TerrainBuilder& b, Random& r) {
  // Starts touch: everything lies on multiples of a pixel.
  for (int i = 0; i < 25; ++i) {
    const Vec2d low{r.integer(-120, 120) / 32.0, r.integer(-120, 80) / 32.0};
    const Vec2d high = low + Vec2d{r.integer(1, 64) / 32.0, r.integer(1, 64) / 32.0};
    b.box(low.x(), low.y(), high.x(), high.y());
  }
}

void one_way_solids(TerrainBuilder& b, Random& r) {
  b.floor();
  for (int i = 0; i < 7; ++i) {
    const Vec2d a{r.between(-5, 4), r.between(-1.5, 3)};
    const double width = r.between(0.3, 2);
    const double deep = r.log_between(0.01, 1);
    switch (r.integer(0, 3)) {
      case 0:
        b.box(a.x(), a.y() - deep, a.x() + width, a.y());
        break;
      case 1:
        b.strip(a, width, deep, r.between(-0.8, 0.8));
        break;
      case 2:  // a roof
        b.polygon({a, a + Vec2d{width, 0}, a + Vec2d{width * r.between(0.2, 0.8), deep}});
        break;
      default:  // a bowl
        b.polygon({a + Vec2d{0, -deep}, a + Vec2d{width, -deep}, a + Vec2d{width, 0.3}, a + Vec2d{0.8 * width, 0},
                   a + Vec2d{0.2 * width, 0}, a + Vec2d{0, r.between(0.05, 0.5)}});
    }
    b.def.colliders.back().one_way = r.chance(0.8) ? Vec2d{0, 1} : Vec2d{r.between(-1, 1), r.between(0.1, 1)};
  }
}

}  // namespace

SceneryDef random_terrain(Terrain terrain, Random& random, const Vec2d& origin) {
  constexpr std::array build{&tiles,  &slopes,  &spikes,  &papers,  &chains,  &wedges,         &stairs, &ceilings,
                             &shafts, &needles, &concave, &one_way, &lattice, &one_way_solids, &circles};
  TerrainBuilder builder(origin);
  static_assert(build.size() == terrain_names.size());
  build[static_cast<std::size_t>(terrain)](builder, random);
  return std::move(builder.def);
}

}  // namespace paperproof::compare
