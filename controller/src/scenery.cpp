#include <paperproof/scenery.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "geometry/convex_pieces.hpp"
#include "geometry/exact.hpp"

namespace paperproof {
namespace {

/// A reason to refuse a collider, on its way to the place that knows which one.
class Refused : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Volatile, because g++ 12 takes two coordinates that are rounded side by side for one vector of them, and then drops
/// the way to `float` and back: the doubles came out as they went in.
template <class Scalar>
double rounded_coordinate(double value) noexcept {
  const volatile Scalar rounded = static_cast<Scalar>(value);
  return geometry::without_traces(static_cast<double>(rounded));
}

/// @param name called only to refuse: a level has hundreds of thousands of points.
template <class Scalar, class Name>
Vec2d rounded_point(const Vec2d& point, const Name& name) {
  const double range = Tolerances<double>{}.range;
  // Written so that NaN fails.
  if (!(std::abs(point.x()) <= range && std::abs(point.y()) <= range)) {
    throw Refused(name() + " has a coordinate that is not a finite number of at most 2e6 m");
  }
  return {rounded_coordinate<Scalar>(point.x()), rounded_coordinate<Scalar>(point.y())};
}

template <class Scalar>
ColliderDef rounded(const ColliderDef& def) {
  ColliderDef result = def;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    result.points[i] = rounded_point<Scalar>(def.points[i], [&] { return "point " + std::to_string(i); });
  }
  for (std::size_t hole = 0; hole < result.holes.size(); ++hole) {
    for (std::size_t i = 0; i < result.holes[hole].size(); ++i) {
      result.holes[hole][i] = rounded_point<Scalar>(
          def.holes[hole][i], [&] { return "point " + std::to_string(i) + " of hole " + std::to_string(hole); });
    }
  }
  if (def.one_way) result.one_way = rounded_point<Scalar>(*def.one_way, [] { return std::string("one_way"); });
  return result;
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
  if (chain.one_way && *chain.one_way == Vec2d::Zero()) throw Refused("one_way is zero: it must point somewhere");
}

/// Of a convex piece. Few: a round shape becomes many pieces. Many: a character near it tests edges that are far away,
/// and a technique may have room for a few dozen only.
constexpr std::size_t max_piece_vertices = 32;

struct Segment {
  Vec2d from;
  Vec2d to;
};

/// The segment with its blocking normal on the left, which is where `one_way` then points; nothing if it points along.
std::optional<Segment> blocking_segment(const Segment& segment, const Vec2d& one_way) {
  const int side = geometry::orientation_sign_of_offset(segment.from, segment.to, segment.from, one_way);
  if (side == 0) return std::nullopt;
  return side > 0 ? segment : Segment{segment.to, segment.from};
}

/// Where the pieces of all colliders are collected.
template <class Scalar>
struct Pieces {
  std::vector<PieceInfo>& infos;
  std::vector<Vec2<Scalar>>& vertices;
  std::vector<Box2<Scalar>>& boxes;
  MoverIndex mover = no_mover;  ///< Of what is being added.

  /// Casting back is exact: the vertices were rounded before.
  void add(ColliderIndex collider, std::span<const Vec2d> outline, bool one_way) {
    infos.push_back({collider, static_cast<std::uint32_t>(vertices.size()), static_cast<std::uint32_t>(outline.size()),
                     one_way, mover});
    const Box2<double> box = geometry::box_of(outline);
    boxes.push_back({box.lower.template cast<Scalar>(), box.upper.template cast<Scalar>()});
    for (const Vec2d& vertex : outline) vertices.push_back(vertex.template cast<Scalar>());
  }

  /// In a fan of parts that all have the first vertex, where there are more vertices than a piece may have.
  void add_convex(ColliderIndex collider, std::span<const Vec2d> ring) {
    std::vector<Vec2d> part;
    for (std::size_t next = 1; next + 1 < ring.size();) {
      const std::size_t count = std::min(max_piece_vertices - 1, ring.size() - next);
      part.assign(1, ring.front());
      part.insert(part.end(), ring.begin() + static_cast<std::ptrdiff_t>(next),
                  ring.begin() + static_cast<std::ptrdiff_t>(next + count));
      add(collider, part, false);
      next += count - 1;
    }
  }

  void add(ColliderIndex collider, const ColliderDef& def) {
    switch (def.shape) {
      case ColliderDef::Shape::polygon:
        return add_polygon(collider, def);
      case ColliderDef::Shape::chain:
        return add_chain(collider, def);
    }
  }

  void add_polygon(ColliderIndex collider, const ColliderDef& def) {
    if (def.one_way) throw Refused("one_way is for chains: a polygon blocks from all sides");
    const geometry::ConvexPieces convex = geometry::cut_into_convex_pieces(def.points, def.holes);
    std::span<const Vec2d> rest = convex.vertices;
    for (const std::uint32_t size : convex.sizes) {
      add_convex(collider, rest.first(size));
      rest = rest.subspan(size);
    }
  }

  void add_chain(ColliderIndex collider, const ColliderDef& def) {
    check_chain(def);
    for (std::size_t i = 1; i < def.points.size(); ++i) {
      std::optional<Segment> segment = Segment{def.points[i - 1], def.points[i]};
      if (def.one_way) segment = blocking_segment(*segment, *def.one_way);
      if (segment) add(collider, std::array{segment->from, segment->to}, def.one_way.has_value());
    }
  }
};

void check_role(const ColliderDef& def, std::size_t colliders) {
  if (def.mover != no_mover && def.mover >= colliders)
    throw Refused("its mover has the number " + std::to_string(def.mover) + ", and there are only " +
                  std::to_string(colliders) + " colliders");
  if (!std::isfinite(def.surface_speed)) throw Refused("surface_speed is not a finite number");
  if (def.sensor && def.one_way) throw Refused("a sensor cannot be one-way");
}

/// What stands, what moves, mover by mover, and what only watches; colliders of one kind as they came.
std::vector<ColliderIndex> by_role(std::span<const ColliderDef> colliders) {
  const auto role = [&](ColliderIndex i) {
    const ColliderDef& collider = colliders[i];
    return std::pair(collider.sensor, collider.sensor ? 0 : collider.mover + 1);  // no_mover + 1 is 0
  };
  std::vector<ColliderIndex> order(colliders.size());
  std::iota(order.begin(), order.end(), ColliderIndex{0});
  std::stable_sort(order.begin(), order.end(), [&](ColliderIndex a, ColliderIndex b) { return role(a) < role(b); });
  return order;
}

/// Rounding to `float` can make neighbours one point, or a thin polygon cross itself.
std::string explained(const std::string& reason, const ColliderDef& given, const ColliderDef& as_run) {
  const bool same = given.points == as_run.points && given.holes == as_run.holes;
  return same ? reason : reason + " (after rounding the coordinates to the scalar type that runs)";
}

}  // namespace

template <class Scalar>
Scenery<Scalar>::Scenery(const SceneryDef& def) {
  as_run_.colliders.reserve(def.colliders.size());
  MoverIndex movers = 0;
  for (const ColliderDef& given : def.colliders) {
    const auto collider = static_cast<ColliderIndex>(as_run_.colliders.size());
    try {
      check_role(given, def.colliders.size());
      as_run_.colliders.push_back(rounded<Scalar>(given));
    } catch (const Refused& refused) {
      throw InvalidScenery(collider, refused.what());
    }
    if (given.mover != no_mover) movers = std::max(movers, given.mover + 1);
  }
  mover_begin_.assign(movers + std::size_t{1}, 0);
  Pieces<Scalar> pieces{pieces_, vertices_, boxes_};
  for (const ColliderIndex collider : by_role(as_run_.colliders)) {
    const ColliderDef& as_run = as_run_.colliders[collider];
    pieces.mover = as_run.mover;
    try {
      pieces.add(collider, as_run);
    } catch (const std::invalid_argument& refused) {
      throw InvalidScenery(collider, explained(refused.what(), def.colliders[collider], as_run));
    }
    const auto count = static_cast<PieceIndex>(pieces_.size());
    if (as_run.sensor) continue;
    if (as_run.mover == no_mover)
      static_count_ = count;
    else
      mover_begin_[as_run.mover + 1] = count;
  }
  // A mover that only sensors go along with has no pieces of its own.
  mover_begin_.front() = static_count_;
  for (std::size_t i = 1; i < mover_begin_.size(); ++i)
    mover_begin_[i] = std::max(mover_begin_[i], mover_begin_[i - 1]);
}

template class Scenery<float>;
template class Scenery<double>;

}  // namespace paperproof
