#include "oracle/convex_parts.hpp"

#include "oracle/world.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <unordered_map>
#include <utility>

namespace paperproof::compare::detail {
namespace {

using Ring = std::vector<std::uint32_t>;  ///< Indices of vertices.

struct Polygon {
  std::vector<Vec2d> vertices;
  std::vector<Ring> rings;  ///< The outer one counter-clockwise, then the holes, clockwise.
};

Polygon with_windings(const ColliderDef& def) {
  Polygon polygon;
  const auto add = [&](const std::vector<Vec2d>& points, Sign wanted) {
    Ring ring;
    for (const Vec2d& point : points) {
      ring.push_back(static_cast<std::uint32_t>(polygon.vertices.size()));
      polygon.vertices.push_back(point);
    }
    if (winding(points) != wanted) std::ranges::reverse(ring);
    polygon.rings.push_back(std::move(ring));
  };
  add(def.points, Sign::positive);
  for (const std::vector<Vec2d>& hole : def.holes) add(hole, Sign::negative);
  return polygon;
}

Sign turn_at(const Polygon& polygon, const Ring& ring, std::size_t i) {
  const std::size_t n = ring.size();
  return turn(polygon.vertices[ring[(i + n - 1) % n]], polygon.vertices[ring[i]], polygon.vertices[ring[(i + 1) % n]]);
}

bool is_convex(const Polygon& polygon, const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (turn_at(polygon, ring, i) == Sign::negative) return false;
  return true;
}

/// Strictly between a and b, for a point on their line.
bool between(const Vec2d& a, const Vec2d& b, const Vec2d& p) {
  return p != a && p != b && Box2::between(a, b).overlaps({p, p});
}

/// Whether the open segments a-b and c-d have a point in common, or an end of one lies inside the other.
bool blocks(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  const Sign c_side = turn(a, b, c);
  const Sign d_side = turn(a, b, d);
  const Sign a_side = turn(c, d, a);
  const Sign b_side = turn(c, d, b);
  if (c_side == Sign::zero && between(a, b, c)) return true;
  if (d_side == Sign::zero && between(a, b, d)) return true;
  if (a_side == Sign::zero && between(c, d, a)) return true;
  if (b_side == Sign::zero && between(c, d, b)) return true;
  const bool crosses_line = c_side != d_side && c_side != Sign::zero && d_side != Sign::zero;
  return crosses_line && a_side != b_side && a_side != Sign::zero && b_side != Sign::zero;
}

/// Whether the way from the corner `at` of a ring to `p` begins inside the polygon.
bool begins_inside(const Polygon& polygon, const Ring& ring, std::size_t at, const Vec2d& p) {
  const std::size_t n = ring.size();
  const Vec2d& corner = polygon.vertices[ring[at]];
  const bool left_of_in = turn(polygon.vertices[ring[(at + n - 1) % n]], corner, p) == Sign::positive;
  const bool left_of_out = turn(corner, polygon.vertices[ring[(at + 1) % n]], p) == Sign::positive;
  return turn_at(polygon, ring, at) == Sign::negative ? left_of_in || left_of_out : left_of_in && left_of_out;
}

struct Bridge {
  std::size_t ring = 0;    ///< Which hole.
  std::size_t corner = 0;  ///< Of the hole.
  std::size_t outer = 0;   ///< Corner of the outer ring.
};

bool is_bridge(const Polygon& polygon, const Bridge& bridge) {
  const Ring& outer = polygon.rings[0];
  const Ring& hole = polygon.rings[bridge.ring];
  const Vec2d& from = polygon.vertices[outer[bridge.outer]];
  const Vec2d& to = polygon.vertices[hole[bridge.corner]];
  if (!begins_inside(polygon, outer, bridge.outer, to) || !begins_inside(polygon, hole, bridge.corner, from))
    return false;
  for (const Ring& ring : polygon.rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2d& c = polygon.vertices[ring[i]];
      const Vec2d& d = polygon.vertices[ring[(i + 1) % ring.size()]];
      if (blocks(from, to, c, d)) return false;
    }
  }
  return true;
}

Bridge find_bridge(const Polygon& polygon) {
  for (std::size_t ring = 1; ring < polygon.rings.size(); ++ring) {
    for (std::size_t corner = 0; corner < polygon.rings[ring].size(); ++corner) {
      for (std::size_t outer = 0; outer < polygon.rings[0].size(); ++outer) {
        const Bridge bridge{ring, corner, outer};
        if (is_bridge(polygon, bridge)) return bridge;
      }
    }
  }
  throw std::logic_error("a hole cannot be joined to its polygon: does it touch it?");
}

/// Joins every hole to the outer ring by a cut that is walked in both directions.
void join_holes(Polygon& polygon) {
  while (polygon.rings.size() > 1) {
    const Bridge bridge = find_bridge(polygon);
    Ring& outer = polygon.rings[0];
    Ring hole = polygon.rings[bridge.ring];
    std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(bridge.corner), hole.end());
    hole.push_back(hole.front());
    hole.push_back(outer[bridge.outer]);
    outer.insert(outer.begin() + static_cast<std::ptrdiff_t>(bridge.outer) + 1, hole.begin(), hole.end());
    polygon.rings.erase(polygon.rings.begin() + static_cast<std::ptrdiff_t>(bridge.ring));
  }
}

bool in_closed_triangle(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& p) {
  if (!Box2::between(a, b).with(c).overlaps({p, p})) return false;
  return turn(a, b, p) != Sign::negative && turn(b, c, p) != Sign::negative && turn(c, a, p) != Sign::negative;
}

bool is_ear(const Polygon& polygon, const Ring& ring, std::size_t i) {
  const std::size_t n = ring.size();
  const std::size_t before = (i + n - 1) % n;
  const std::size_t after = (i + 1) % n;
  if (turn_at(polygon, ring, i) != Sign::positive) return false;
  const Vec2d& a = polygon.vertices[ring[before]];
  const Vec2d& b = polygon.vertices[ring[i]];
  const Vec2d& c = polygon.vertices[ring[after]];
  // A cut that is walked twice has both of its copies in the ring: the cone tells which one the diagonal may leave
  // from.
  if (!begins_inside(polygon, ring, before, c) || !begins_inside(polygon, ring, after, a)) return false;
  for (const std::uint32_t other : ring) {
    if (other == ring[before] || other == ring[i] || other == ring[after]) continue;
    if (in_closed_triangle(a, b, c, polygon.vertices[other])) return false;
  }
  return true;
}

std::vector<Ring> triangles(const Polygon& polygon) {
  Ring ring = polygon.rings[0];
  std::vector<Ring> found;
  const auto next_to_cut = [&](std::size_t i) {
    while (i < ring.size() && turn_at(polygon, ring, i) != Sign::zero && !is_ear(polygon, ring, i)) ++i;
    return i;
  };
  std::size_t i = 0;
  while (ring.size() > 3) {
    // A cut makes new ears of its neighbours alone, so that the search goes on before it. Where a corner touched the
    // cut one that does not hold: then it begins anew.
    i = next_to_cut(i == 0 ? 0 : i - 1);
    if (i == ring.size()) i = next_to_cut(0);
    if (i == ring.size()) throw std::logic_error("a polygon cannot be cut: does it touch itself?");
    const std::size_t n = ring.size();
    if (turn_at(polygon, ring, i) == Sign::positive)
      found.push_back({ring[(i + n - 1) % n], ring[i], ring[(i + 1) % n]});
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(i));
  }
  if (turn_at(polygon, ring, 0) == Sign::positive) found.push_back(ring);
  return found;
}

/// The pieces of a cut polygon, which grow into their neighbours as long as they stay convex. Each knows its neighbours
/// by the edges that both walk, in opposite directions: looking for them would take time with the cube of the corners.
class Parts {
 public:
  Parts(const Polygon& polygon, std::vector<Ring> rings) : polygon_(polygon), rings_(std::move(rings)) {
    for (std::size_t p = 0; p < rings_.size(); ++p) own(rings_[p], p);
  }

  [[nodiscard]] std::vector<Ring> merged() {
    for (std::size_t p = 0; p < rings_.size(); ++p) grow(p);
    std::erase_if(rings_, [](const Ring& ring) { return ring.empty(); });
    return std::move(rings_);
  }

 private:
  static std::uint64_t edge(std::uint32_t from, std::uint32_t to) { return std::uint64_t{from} << 32U | to; }

  void own(const Ring& ring, std::size_t part) {
    for (std::size_t i = 0; i < ring.size(); ++i) owners_[edge(ring[i], ring[(i + 1) % ring.size()])] = part;
  }

  /// Takes over the neighbours of a part, among those behind it, with which it stays convex. Growing makes no corner
  /// sharper: a neighbour that did not fit never will.
  void grow(std::size_t part) {
    Ring& ring = rings_[part];
    for (std::size_t at = 0; at < ring.size();) {
      const auto neighbour = owners_.find(edge(ring[(at + 1) % ring.size()], ring[at]));
      const bool behind = neighbour != owners_.end() && neighbour->second > part;
      if (!behind || !stays_convex(ring, at, rings_[neighbour->second])) {
        ++at;
        continue;
      }
      const Ring other = std::exchange(rings_[neighbour->second], {});
      own(other, part);
      ring = joined(ring, at, other);
    }
  }

  /// Both are convex: only the corners at the ends of the edge between them change.
  [[nodiscard]] bool stays_convex(const Ring& left, std::size_t at, const Ring& right) const {
    const std::size_t n = left.size();
    const std::size_t m = right.size();
    const auto start = static_cast<std::size_t>(std::ranges::find(right, left[at]) - right.begin());
    const auto corner = [this](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      return turn(polygon_.vertices[a], polygon_.vertices[b], polygon_.vertices[c]) != Sign::negative;
    };
    return corner(left[(at + n - 1) % n], left[at], right[(start + 1) % m]) &&
           corner(right[(start + m - 2) % m], left[(at + 1) % n], left[(at + 2) % n]);
  }

  /// `left` with `right` in place of its edge number `at`; both contain it, in opposite directions.
  static Ring joined(const Ring& left, std::size_t at, Ring right) {
    const std::uint32_t end = left[(at + 1) % left.size()];
    std::rotate(right.begin(), std::ranges::find(right, left[at]), right.end());
    Ring ring(left.begin(), left.begin() + static_cast<std::ptrdiff_t>(at) + 1);
    for (std::size_t i = 1; i < right.size() && right[i] != end; ++i) ring.push_back(right[i]);
    ring.insert(ring.end(), left.begin() + static_cast<std::ptrdiff_t>(at) + 1, left.end());
    return ring;
  }

  const Polygon& polygon_;
  std::vector<Ring> rings_;  ///< Empty where another part has taken it over.
  std::unordered_map<std::uint64_t, std::size_t> owners_;
};

ConvexPart make_part(std::vector<Vec2d> points) {
  const Box2 box = Box2::around(points);
  return {std::move(points), box};
}

}  // namespace

Box2 box_of_disc(const Vec2d& centre, double radius) {
  const Box2 box{centre, centre};
  return box.inflated(radius + (centre.cwiseAbs().maxCoeff() + radius) * 0x1p-52);
}

ConvexPart with_corners(ConvexPart part) {
  constexpr int corners = 64;
  if (part.radius == 0) return part;
  const Vec2d centre = part.points.front();
  const double reach = part.radius / std::cos(std::numbers::pi / corners) * (1 + 1e-12);
  part.points.clear();
  for (int k = 0; k < corners; ++k) {
    const double angle = 2 * std::numbers::pi * k / corners;
    part.points.emplace_back(centre + reach * Vec2d(std::cos(angle), std::sin(angle)));
  }
  return make_part(std::move(part.points));
}

std::vector<ConvexPart> convex_parts(const ColliderDef& def) {
  std::vector<ConvexPart> parts;
  if (def.shape == ColliderDef::Shape::circle)
    return {{def.points, box_of_disc(def.points.front(), def.radius), def.radius}};
  const auto add_segments = [&parts](const std::vector<Vec2d>& line) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      if (line[i] != line[i + 1]) parts.push_back(make_part({line[i], line[i + 1]}));
    }
  };
  if (def.shape == ColliderDef::Shape::chain) {
    add_segments(def.points);
    return parts;
  }
  if (def.one_way) {
    for (const std::vector<Vec2d>& line : one_way_lines_of(def)) add_segments(line);
    return parts;
  }
  Polygon polygon = with_windings(def);
  std::vector<Ring> rings;
  if (polygon.rings.size() == 1 && is_convex(polygon, polygon.rings[0])) {
    rings = polygon.rings;
  } else {
    join_holes(polygon);
    rings = Parts(polygon, triangles(polygon)).merged();
  }
  for (const Ring& ring : rings) {
    std::vector<Vec2d> points;
    for (const std::uint32_t i : ring) points.push_back(polygon.vertices[i]);
    parts.push_back(make_part(std::move(points)));
  }
  return parts;
}

}  // namespace paperproof::compare::detail
