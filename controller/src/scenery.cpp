#include <paperproof/scenery.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "geometry/convex_pieces.hpp"
#include "geometry/exact.hpp"

namespace paperproof {
namespace {

/// A reason to refuse a collider; the constructor of `Scenery` adds the index of the collider.
class Refused : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// @param name called only if the point is refused: a level has hundreds of thousands of points.
template <class Name>
Vec2d accepted_point(const Vec2d& point, const Name& name) {
  const double range = Tolerances{}.range;
  // Written so that NaN fails.
  if (!(std::abs(point.x()) <= range && std::abs(point.y()) <= range)) {
    throw Refused(name() + " has a coordinate that is not a finite number of at most 2e6 m");
  }
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
  if (chain.points.size() < 2) {
    throw Refused("a chain needs at least 2 points, it has " + std::to_string(chain.points.size()));
  }
  for (std::size_t i = 1; i < chain.points.size(); ++i) {
    if (chain.points[i] == chain.points[i - 1]) {
      throw Refused("the chain has the same point twice in a row: points " + std::to_string(i - 1) + " and " +
                    std::to_string(i) + " (counted from 0) are both " + geometry::text_of(chain.points[i]));
    }
  }
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

/// Most vertices of a convex piece. Few: a round shape becomes many pieces. Many: a character near it tests edges that
/// are far away, and a technique may have room for only a few dozen vertices.
constexpr std::size_t max_piece_vertices = 32;

struct Segment {
  Vec2d from;
  Vec2d to;
};

/// The segment, directed so that `one_way` points to its left, the side of its blocking normal; nothing if `one_way`
/// points along the segment.
std::optional<Segment> blocking_segment(const Segment& segment, const Vec2d& one_way) {
  const int side = geometry::orientation_sign_of_offset(segment.from, segment.to, segment.from, one_way);
  if (side == 0) return std::nullopt;
  return side > 0 ? segment : Segment{segment.to, segment.from};
}

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

/// The collected pieces of all colliders.
struct Pieces {
  std::vector<PieceInfo>& infos;
  std::vector<Vec2d>& vertices;
  std::vector<Box2>& boxes;

  void add(ColliderIndex collider, const ColliderDef& def, std::span<const Vec2d> outline) {
    PieceInfo info{.collider = collider,
                   .mover = def.mover,
                   .first_vertex = static_cast<std::uint32_t>(vertices.size()),
                   .vertex_count = static_cast<std::uint8_t>(outline.size()),
                   .one_way = def.one_way.has_value()};
    const Box2 box = Box2::around(outline);
    boxes.push_back(box);
    if (is_upright_rectangle(outline))
      info.rectangle_corner = corner_of(box, outline[0]);
    else
      vertices.insert(vertices.end(), outline.begin(), outline.end());
    infos.push_back(info);
  }

  /// A ring with more vertices than a piece may have becomes a fan of parts that share the first vertex.
  void add_convex(ColliderIndex collider, const ColliderDef& def, std::span<const Vec2d> ring) {
    if (ring.size() <= max_piece_vertices) return add(collider, def, ring);
    std::vector<Vec2d> part;
    for (std::size_t next = 1; next + 1 < ring.size();) {
      const std::size_t count = std::min(max_piece_vertices - 1, ring.size() - next);
      part.assign(1, ring.front());
      part.insert(part.end(), ring.begin() + static_cast<std::ptrdiff_t>(next),
                  ring.begin() + static_cast<std::ptrdiff_t>(next + count));
      add(collider, def, part);
      next += count - 1;
    }
  }

  void add(ColliderIndex collider, const ColliderDef& def) {
    if (def.one_way && *def.one_way == Vec2d::Zero()) throw Refused("one_way is zero: it must point somewhere");
    switch (def.shape) {
      case ColliderDef::Shape::polygon:
        return add_polygon(collider, def);
      case ColliderDef::Shape::chain:
        return add_chain(collider, def);
      case ColliderDef::Shape::circle:
        return add_circle(collider, def);
    }
  }

  void add_circle(ColliderIndex collider, const ColliderDef& def) {
    check_circle(def);
    add(collider, def, def.points);
    const double radius = def.radius;
    boxes.back() = boxes.back().inflated(radius);
    vertices.push_back({radius, 0});
  }

  void add_polygon(ColliderIndex collider, const ColliderDef& def) {
    if (!def.one_way && def.holes.empty() && is_upright_rectangle(def.points)) return add_rectangle(collider, def);
    const geometry::ConvexPieces convex = geometry::cut_into_convex_pieces(def.points, def.holes);
    if (def.one_way) return add_one_way(collider, def);
    std::span<const Vec2d> rest = convex.vertices;
    for (const std::uint32_t size : convex.sizes) {
      add_convex(collider, def, rest.first(size));
      rest = rest.subspan(size);
    }
  }

  /// Rectangles are most of a level.
  void add_rectangle(ColliderIndex collider, const ColliderDef& def) {
    std::array<Vec2d, 4> outline{def.points[0], def.points[1], def.points[2], def.points[3]};
    if (geometry::winding(outline) < 0) std::reverse(outline.begin(), outline.end());
    add(collider, def, outline);
  }

  void add_chain(ColliderIndex collider, const ColliderDef& def) {
    check_chain(def);
    if (def.one_way) return add_one_way(collider, def);
    for (std::size_t i = 1; i < def.points.size(); ++i)
      add(collider, def, std::array{def.points[i - 1], def.points[i]});
  }

  void add_one_way(ColliderIndex collider, const ColliderDef& def) {
    for (const std::vector<Vec2d>& line : one_way_lines(def))
      for (std::size_t i = 1; i < line.size(); ++i)
        if (const auto segment = blocking_segment({line[i - 1], line[i]}, *def.one_way))
          add(collider, def, std::array{segment->from, segment->to});
  }
};

void check_role(const ColliderDef& def, std::size_t colliders) {
  if (def.mover != no_mover && def.mover >= colliders)
    throw Refused("the number of its mover is " + std::to_string(def.mover) + ", and there are only " +
                  std::to_string(colliders) + " colliders");
  if (!std::isfinite(def.surface_speed)) throw Refused("surface_speed is not a finite number");
  if (def.sensor && def.one_way) throw Refused("a sensor cannot be one-way");
  if (def.radius != 0 && def.shape != ColliderDef::Shape::circle) throw Refused("only a circle has a radius");
}

}  // namespace

std::vector<std::vector<Vec2d>> one_way_lines(const ColliderDef& def) {
  if (def.shape == ColliderDef::Shape::chain) return {def.points};
  const std::vector<Vec2d>& ring = def.points;
  const int outside = -geometry::winding(ring);  // 1 where it is on the left of the edges
  const auto blocks = [&](std::size_t i) {
    return geometry::orientation_sign_of_offset(ring[i], ring[(i + 1) % ring.size()], ring[i], *def.one_way) == outside;
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

Scenery::Scenery(const SceneryDef& def) {
  colliders_.resize(def.colliders.size());
  pieces_.reserve(def.colliders.size());
  boxes_.reserve(def.colliders.size());
  ColliderDef accepted;
  const auto add = [&](ColliderIndex i) {
    const ColliderDef& given = def.colliders[i];
    try {
      check_role(given, def.colliders.size());
      copy_accepted(given, accepted);
      this->add(i, accepted);
    } catch (const std::invalid_argument& refused) {
      throw InvalidScenery(i, refused.what());
    }
    return static_cast<PieceIndex>(pieces_.size());
  };
  // Order: standing colliders, moving colliders by mover, sensors likewise; colliders of one kind keep their order.
  std::vector<ColliderIndex> others;
  for (ColliderIndex i = 0; i < colliders_.size(); ++i) {
    const ColliderDef& given = def.colliders[i];
    if (given.sensor || given.mover != no_mover)
      others.push_back(i);
    else
      static_count_ = add(i);
  }
  const auto role = [&](ColliderIndex i) {
    const ColliderDef& given = def.colliders[i];
    return std::pair(given.sensor, given.mover);
  };
  std::stable_sort(others.begin(), others.end(), [&](ColliderIndex a, ColliderIndex b) { return role(a) < role(b); });
  mover_begin_.assign(1, static_count_);
  for (const ColliderIndex i : others) {
    const PieceIndex count = add(i);
    const ColliderDef& given = def.colliders[i];
    // A mover that moves only sensors has no solid pieces.
    if (given.mover != no_mover && given.mover + std::size_t{2} > mover_begin_.size())
      mover_begin_.resize(given.mover + std::size_t{2}, mover_begin_.back());
    if (!given.sensor) mover_begin_.back() = count;
  }
  pieces_.shrink_to_fit();
  boxes_.shrink_to_fit();
  vertices_.shrink_to_fit();
  moving_.resize(mover_count());
  for (PieceIndex piece = 0; piece < pieces_.size(); ++piece) {
    Group& group = pieces_[piece].mover == no_mover ? standing_ : moving_[pieces_[piece].mover];
    (piece < sensor_pieces().first ? group.solids : group.sensors).add(piece, boxes_[piece]);
  }
}

void Scenery::add(ColliderIndex collider, const ColliderDef& def) {
  const ColliderInfo info{.shape = def.shape,
                          .sensor = def.sensor,
                          .mover = def.mover,
                          .surface_speed = def.surface_speed,
                          .carries = def.carries,
                          .filter = def.filter,
                          .one_way = def.one_way};
  if (infos_.empty() || infos_.back() != info) infos_.push_back(info);
  colliders_[collider].info = static_cast<std::uint32_t>(infos_.size() - 1);
  colliders_[collider].first_piece = static_cast<PieceIndex>(pieces_.size());
  Pieces{pieces_, vertices_, boxes_}.add(collider, def);
  colliders_[collider].shape = shape_of(collider, def);
}

/// Decides how the points of a collider are stored, once its pieces exist.
std::uint32_t Scenery::shape_of(ColliderIndex collider, const ColliderDef& def) {
  if (const PieceRange range = pieces_of(collider); range.size() == 1 && def.holes.empty()) {
    const PieceVertices vertices = vertices_of(range.first);
    if (std::equal(vertices.begin(), vertices.end(), def.points.begin(), def.points.end())) return Collider::piece;
    if (std::equal(vertices.begin(), vertices.end(), def.points.rbegin(), def.points.rend()))
      return Collider::piece_backwards;
  }
  shapes_.push_back({def.points, def.holes});
  return static_cast<std::uint32_t>(shapes_.size() - 1);
}

PieceRange Scenery::pieces_of(ColliderIndex collider) const noexcept {
  PieceRange range{colliders_[collider].first_piece, colliders_[collider].first_piece};
  while (range.end < pieces_.size() && pieces_[range.end].collider == collider) ++range.end;
  return range;
}

ColliderDef Scenery::as_run(ColliderIndex collider) const {
  const Collider& kept = colliders_[collider];
  const ColliderInfo& info = infos_[kept.info];
  ColliderDef def{.shape = info.shape,
                  .points = {},
                  .one_way = info.one_way,
                  .mover = info.mover,
                  .sensor = info.sensor,
                  .surface_speed = info.surface_speed,
                  .carries = info.carries,
                  .filter = info.filter};
  if (kept.shape == Collider::piece || kept.shape == Collider::piece_backwards) {
    const PieceVertices vertices = vertices_of(kept.first_piece);
    def.points.assign(vertices.begin(), vertices.end());
    if (kept.shape == Collider::piece_backwards) std::reverse(def.points.begin(), def.points.end());
    if (info.shape == ColliderDef::Shape::circle) def.radius = circle(kept.first_piece).radius;
    return def;
  }
  def.points = shapes_[kept.shape].points;
  def.holes = shapes_[kept.shape].holes;
  return def;
}

SceneryDef Scenery::as_run() const {
  SceneryDef def;
  def.colliders.reserve(colliders_.size());
  for (ColliderIndex i = 0; i < colliders_.size(); ++i) def.colliders.push_back(as_run(i));
  return def;
}

}  // namespace paperproof
