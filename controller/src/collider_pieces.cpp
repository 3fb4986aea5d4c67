#include "collider_pieces.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>

#include "geometry/convex_pieces.hpp"
#include "geometry/exact.hpp"
#include "geometry/vectors.hpp"

namespace paperproof {
namespace {

/// A reason to refuse a collider; `Scenery` adds the index of the collider.
using Refused = std::invalid_argument;

/// @param name called only if the point is refused: a level has hundreds of thousands of points.
template <class Name>
Vec2d accepted_point(const Vec2d& point, const Name& name) {
  if (!geometry::in_range(point))
    throw Refused(name() + " has a coordinate that is not a finite number of at most 2e6 m");
  return {geometry::without_traces(point.x()), geometry::without_traces(point.y())};
}

/// The definition as it runs, in memory that is used for one collider after the other.
void copy_accepted(const ColliderDef& def, ColliderDef& result) {
  result = def;
  for (std::size_t i = 0; i < def.points.size(); ++i)
    result.points[i] = accepted_point(def.points[i], [&] { return "point " + std::to_string(i); });
  for (std::size_t hole = 0; hole < def.holes.size(); ++hole)
    for (std::size_t i = 0; i < def.holes[hole].size(); ++i)
      result.holes[hole][i] = accepted_point(
          def.holes[hole][i], [&] { return "point " + std::to_string(i) + " of hole " + std::to_string(hole); });
  if (def.one_way) result.one_way = accepted_point(*def.one_way, [] { return std::string("one_way"); });
  if (def.radius != 0) result.radius = geometry::without_traces(def.radius);
}

void check_chain(const ColliderDef& chain) {
  if (!chain.holes.empty()) throw Refused("a chain cannot have holes");
  if (chain.points.size() < 2)
    throw Refused("a chain needs at least 2 points, it has " + std::to_string(chain.points.size()));
  geometry::check_neighbours(chain.points, false, "the chain");
}

void check_circle(const ColliderDef& circle) {
  if (!circle.holes.empty()) throw Refused("a circle cannot have holes");
  if (circle.points.size() != 1)
    throw Refused("a circle needs exactly 1 point, its centre; it has " + std::to_string(circle.points.size()));
  if (circle.one_way) throw Refused("a circle cannot be one-way: give a chain or a polygon the shape of its top");
  // Written so that NaN fails.
  if (!(circle.radius > 0 && circle.radius <= Tolerances{}.range))
    throw Refused("the radius of a circle must be above 0 and at most 2e6 m, not " + std::to_string(circle.radius));
}

/// Movers are counted from 0: one with a large number would take memory for all before it.
constexpr MoverIndex most_movers = 65'536;

void check_role(const ColliderDef& def) {
  const bool is_body = def.mover == its_character;
  if (is_body && (def.shape != ColliderDef::Shape::polygon || def.sensor || def.one_way))
    throw Refused("the body of a character must be a solid polygon");
  if (def.mover != no_mover && !is_body && def.mover >= most_movers)
    throw Refused("the mover of a collider must be below 65,536, not " + std::to_string(def.mover));
  if (!std::isfinite(def.surface_speed)) throw Refused("surface_speed is not a finite number");
  if (def.sensor && def.one_way) throw Refused("a sensor cannot be one-way");
  if (def.radius != 0 && def.shape != ColliderDef::Shape::circle) throw Refused("only a circle has a radius");
}

/// Most vertices of a convex piece. Few: a round shape becomes many pieces. Many: a character near it tests edges that
/// are far away, and a technique may have room for only a few dozen vertices.
constexpr std::size_t max_piece_vertices = 32;

/// Four corners of a box, one after the other, either way round.
bool is_upright_rectangle(std::span<const Vec2d> ring) {
  if (ring.size() != 4 || ring[0].x() == ring[2].x() || ring[0].y() == ring[2].y()) return false;
  const auto upright = [&](std::size_t i, std::size_t j) { return ring[i].x() == ring[j].x(); };
  const auto level = [&](std::size_t i, std::size_t j) { return ring[i].y() == ring[j].y(); };
  return (level(0, 1) && upright(1, 2) && level(2, 3) && upright(3, 0)) ||
         (upright(0, 1) && level(1, 2) && upright(2, 3) && level(3, 0));
}

/// Index of a corner of the box, counter-clockwise from the lower left one.
std::uint8_t corner_of(const Box2& box, const Vec2d& corner) {
  const bool right = corner.x() == box.upper.x();
  return corner.y() == box.lower.y() ? (right ? 1 : 0) : (right ? 2 : 3);
}

/// Cuts one collider.
struct Cutter {
  const ColliderDef& def;
  const PieceLists& lists;

  void add_piece(std::span<const Vec2d> outline) const {
    PieceInfo info{.collider = no_collider,
                   .mover = def.mover,
                   .first_vertex = static_cast<std::uint32_t>(lists.vertices.size()),
                   .vertex_count = static_cast<std::uint8_t>(outline.size()),
                   .one_way = def.one_way.has_value(),
                   .sensor = def.sensor};
    const Box2 box = Box2::around(outline);
    lists.boxes.push_back(box);
    if (is_upright_rectangle(outline))
      info.rectangle_corner = corner_of(box, outline[0]);
    else
      lists.vertices.insert(lists.vertices.end(), outline.begin(), outline.end());
    lists.infos.push_back(info);
  }

  /// A ring with more vertices than a piece may have becomes a fan of parts that share the first vertex.
  void add_convex(std::span<const Vec2d> ring) const {
    if (ring.size() <= max_piece_vertices) return add_piece(ring);
    std::vector<Vec2d> part;
    for (std::size_t next = 1; next + 1 < ring.size();) {
      const auto others = ring.subspan(next, std::min(max_piece_vertices - 1, ring.size() - next));
      part.assign(1, ring.front());
      part.insert(part.end(), others.begin(), others.end());
      add_piece(part);
      next += others.size() - 1;
    }
  }

  void add_circle() const {
    check_circle(def);
    add_piece(def.points);
    lists.boxes.back() = lists.boxes.back().inflated(def.radius);
    lists.vertices.push_back({def.radius, 0});
  }

  void add_polygon() const {
    // Rectangles are most of a level.
    if (!def.one_way && def.holes.empty() && is_upright_rectangle(def.points)) {
      std::array<Vec2d, 4> outline{def.points[0], def.points[1], def.points[2], def.points[3]};
      if (geometry::winding(outline) < 0) std::reverse(outline.begin(), outline.end());
      return add_piece(outline);
    }
    const geometry::ConvexPieces convex = geometry::cut_into_convex_pieces(def.points, def.holes);
    if (def.one_way) return add_one_way();
    std::span<const Vec2d> rest = convex.vertices;
    for (const std::uint32_t size : convex.sizes) {
      add_convex(rest.first(size));
      rest = rest.subspan(size);
    }
  }

  void add_chain() const {
    check_chain(def);
    if (def.one_way) return add_one_way();
    for (std::size_t i = 1; i < def.points.size(); ++i) add_piece(std::span(def.points).subspan(i - 1, 2));
  }

  /// The segments, directed so that `one_way` points to their left, the side of their blocking normals. One that
  /// `one_way` points along is none.
  void add_one_way() const {
    for (const std::vector<Vec2d>& line : one_way_lines(def))
      for (std::size_t i = 1; i < line.size(); ++i) {
        const int side = geometry::turn_sign(line[i - 1], line[i], Vec2d::Zero(), *def.one_way);
        if (side > 0) add_piece(std::array{line[i - 1], line[i]});
        if (side < 0) add_piece(std::array{line[i], line[i - 1]});
      }
  }
};

}  // namespace

std::vector<std::vector<Vec2d>> one_way_lines(const ColliderDef& def) {
  if (def.shape == ColliderDef::Shape::chain) return {def.points};
  const std::vector<Vec2d>& ring = def.points;
  const int outside = -geometry::winding(ring);  // 1 where it is on the left of the edges
  const auto blocks = [&](std::size_t i) {
    return geometry::turn_sign(ring[i], ring[(i + 1) % ring.size()], Vec2d::Zero(), *def.one_way) == outside;
  };
  // Not all edges of a ring face one way: it is read from one that does not.
  std::size_t first = 0;
  while (first < ring.size() && blocks(first)) ++first;
  std::vector<std::vector<Vec2d>> lines;
  bool goes_on = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const std::size_t i = (first + k) % ring.size();
    const bool is_part = blocks(i);
    if (is_part && !goes_on) lines.push_back({ring[i]});
    if (is_part) lines.back().push_back(ring[(i + 1) % ring.size()]);
    goes_on = is_part;
  }
  return lines;
}

void cut_into_pieces(const ColliderDef& def, ColliderDef& accepted, const PieceLists& lists) {
  check_role(def);
  copy_accepted(def, accepted);
  if (def.one_way && *accepted.one_way == Vec2d::Zero()) throw Refused("one_way is zero: it must point somewhere");
  const Cutter cutter{accepted, lists};
  switch (def.shape) {
    case ColliderDef::Shape::polygon:
      return cutter.add_polygon();
    case ColliderDef::Shape::chain:
      return cutter.add_chain();
    case ColliderDef::Shape::circle:
      return cutter.add_circle();
  }
}

}  // namespace paperproof
