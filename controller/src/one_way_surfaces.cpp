#include "one_way_surfaces.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/exact.hpp"

namespace paperproof {
namespace {

using geometry::orientation_sign;
using geometry::orientation_sign_of_edge_offset;
using geometry::orientation_sign_of_offset;
using geometry::turn_sign;
using geometry::turn_sign_of_offset;

constexpr PieceIndex no_piece = std::numeric_limits<PieceIndex>::max();

/// An end of a chain's first or last segment, at which a line begins or ends.
struct OpenEnd {
  MoverIndex mover;
  Filter filter;
  Vec2d one_way;
  Vec2d at;
  bool begins;
  PieceIndex piece;

  [[nodiscard]] auto place() const noexcept {
    return std::tuple(mover, filter.category, filter.mask, filter.group, one_way.x(), one_way.y(), at.x(), at.y());
  }
};

/// Which segment continues the line where another segment ends.
template <class Scalar>
class Joints {
 public:
  explicit Joints(const Scenery<Scalar>& scenery)
      : scenery_(scenery), next_(scenery.pieces().size(), no_piece), has_previous_(next_.size(), false) {
    PieceIndex piece = 0;
    while (piece < scenery.pieces().size()) piece = add_collider(piece);
    join_ends();
  }

  [[nodiscard]] PieceIndex next(PieceIndex piece) const noexcept { return next_[piece]; }
  [[nodiscard]] bool begins(PieceIndex piece) const noexcept { return !has_previous_[piece]; }

 private:
  void join(PieceIndex before, PieceIndex after) {
    next_[before] = after;
    has_previous_[after] = true;
  }

  /// The pieces of a collider are consecutive, and those of its lines are in order.
  /// @return one past the last piece of the collider.
  PieceIndex add_collider(PieceIndex piece) {
    const PieceInfo& info = scenery_.pieces()[piece];
    if (!info.one_way) return scenery_.pieces_of(info.collider).end;
    const ColliderDef def = scenery_.as_run(info.collider);
    for (const std::vector<Vec2d>& line : one_way_lines(def)) piece = add_line(line, def, piece);
    return piece;
  }

  PieceIndex add_line(const std::vector<Vec2d>& line, const ColliderDef& def, PieceIndex piece) {
    int side_before = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      const int side = turn_sign(line[i - 1], line[i], Vec2d::Zero(), *def.one_way);
      if (side != 0) {
        if (i == 1) ends_.push_back({def.mover, def.filter, *def.one_way, line[0], side > 0, piece});
        if (side == side_before) side > 0 ? join(piece - 1, piece) : join(piece, piece - 1);
        if (i + 1 == line.size()) ends_.push_back({def.mover, def.filter, *def.one_way, line[i], side < 0, piece});
        ++piece;
      }
      side_before = side;
    }
    return piece;
  }

  void join_ends() {
    std::stable_sort(ends_.begin(), ends_.end(),
                     [](const OpenEnd& a, const OpenEnd& b) { return a.place() < b.place(); });
    for (auto first = ends_.begin(); first != ends_.end();) {
      const auto end =
          std::find_if(first, ends_.end(), [&](const OpenEnd& other) { return other.place() != first->place(); });
      if (end - first == 2 && first[0].begins != first[1].begins) {
        const bool in_order = first[1].begins;
        join(first[in_order ? 0 : 1].piece, first[in_order ? 1 : 0].piece);
      }
      first = end;
    }
  }

  const Scenery<Scalar>& scenery_;
  std::vector<PieceIndex> next_;
  std::vector<bool> has_previous_;
  std::vector<OpenEnd> ends_;
};

}  // namespace

template <class Scalar>
OneWaySurfaces<Scalar>::OneWaySurfaces(const Scenery<Scalar>& scenery, const CharacterShape& shape) {
  const std::span<const PieceInfo> pieces = scenery.pieces();
  if (std::none_of(pieces.begin(), pieces.end(), [](const PieceInfo& piece) { return piece.one_way; })) return;
  for (const Vec2d& corner : shape.hull()) hull_.push_back(corner.cast<Scalar>());
  of_piece_.assign(pieces.size(), none);
  const Joints<Scalar> joints(scenery);
  std::vector<Vec2d> line;
  for (PieceIndex first = 0; first < pieces.size(); ++first) {
    if (!pieces[first].one_way || !joints.begins(first)) continue;
    line.assign(1, scenery.vertices_of(first)[0].template cast<double>());
    for (PieceIndex piece = first; piece != no_piece; piece = joints.next(piece)) {
      const Vec2d end = scenery.vertices_of(piece)[1].template cast<double>();
      // Segments on the same line are one edge.
      if (line.size() > 1 && orientation_sign(line[line.size() - 2], line.back(), end) == 0) line.pop_back();
      line.push_back(end);
      of_piece_[piece] = static_cast<Index>(surfaces_.size());
    }
    add_surface(line, *scenery.collider(pieces[first].collider).one_way);
  }
}

template <class Scalar>
void OneWaySurfaces<Scalar>::add_surface(std::span<const Vec2d> line, const Vec2d& one_way) {
  const std::uint32_t frame = find_frame(one_way);
  surfaces_.push_back({frame, static_cast<std::uint32_t>(edges_.size()), static_cast<std::uint32_t>(line.size() - 1)});
  for (std::size_t i = 0; i < line.size(); ++i) {
    Edge edge{.from = line[i].template cast<Scalar>(),
              .begins = frames_[frame].across.dot(line[i].template cast<Scalar>()),
              .normal = Vec2<Scalar>::Zero(),
              .offset = 0};
    if (i + 1 < line.size()) {
      const Vec2d along = line[i + 1] - line[i];
      const Vec2d normal = Vec2d{-along.y(), along.x()} / std::sqrt(along.dot(along));
      edge.normal = normal.template cast<Scalar>();
      // The offset belongs to the rounded normal, because positions are multiplied with that normal.
      const Vec2d rounded = edge.normal.template cast<double>();
      double lowest = std::numeric_limits<double>::infinity();
      for (const Vec2<Scalar>& o : hull_) lowest = std::min(lowest, rounded.dot(o.template cast<double>()));
      edge.offset = static_cast<Scalar>(std::max(rounded.dot(line[i]), rounded.dot(line[i + 1])) - lowest);
    }
    edges_.push_back(edge);
  }
}

template <class Scalar>
std::uint32_t OneWaySurfaces<Scalar>::find_frame(const Vec2d& one_way) {
  for (std::uint32_t known = 0; known < frames_.size(); ++known)
    if (frames_[known].one_way == one_way) return known;
  Frame frame;
  frame.one_way = one_way;
  const Vec2d up = one_way / std::sqrt(one_way.dot(one_way));
  frame.across = Vec2d{up.y(), -up.x()}.cast<Scalar>();
  const auto add_axis = [&](const Vec2d& normal) {
    Axis axis{normal.cast<Scalar>(), std::numeric_limits<Scalar>::infinity()};
    for (const Vec2<Scalar>& o : hull_) axis.low = std::min(axis.low, axis.normal.dot(o));
    frame.axes.push_back(axis);
    return axis.low;
  };
  for (std::size_t k = 0; k < hull_.size(); ++k) {
    const Vec2d a = hull_[k].template cast<double>();
    const Vec2d b = hull_[(k + 1) % hull_.size()].template cast<double>();
    if (turn_sign(a, b, Vec2d::Zero(), one_way) <= 0) continue;
    frame.lower.push_back(static_cast<std::uint8_t>(k));
    const Vec2d along = b - a;
    add_axis(Vec2d{-along.y(), along.x()} / std::sqrt(along.dot(along)));
  }
  frame.first = add_axis(frame.across.template cast<double>());
  frame.last = -add_axis(-frame.across.template cast<double>());
  frames_.push_back(frame);
  return static_cast<std::uint32_t>(frames_.size() - 1);
}

/// Tests every edge that the octagon covers across `one_way`; the other edges are beside the octagon.
template <class Scalar>
template <class Visit>
bool OneWaySurfaces<Scalar>::all_edges_below(const Surface& surface, const Vec2<Scalar>& position,
                                             const Visit& is_below) const noexcept {
  constexpr Scalar margin = Tolerances<Scalar>{}.certain;
  const Frame& frame = frames_[surface.frame];
  const Scalar at = frame.across.x() * position.x() + frame.across.y() * position.y();
  const Scalar first = at + frame.first - margin;
  const Scalar last = at + frame.last + margin;
  const Edge* const edges = edges_.data() + surface.first_edge;
  // The first vertex between two edges that is not before the octagon, or the end of the line.
  const Edge* const vertex = std::partition_point(edges + 1, edges + surface.edge_count,
                                                  [&](const Edge& edge) { return edge.begins < first; });
  auto edge = static_cast<std::uint32_t>(vertex - edges) - 1;
  do {
    if (!is_below(edge)) return false;
    ++edge;
  } while (edge < surface.edge_count && edges[edge].begins <= last);
  return true;
}

/// The largest separation of an edge from the octagon and all that lies above it [m], or the first separation that is
/// certainly above zero; negative where the edge overlaps them. For an end that is extended to infinity, only an axis
/// along which the extension does not come nearer can separate.
template <class Scalar>
Scalar OneWaySurfaces<Scalar>::separation(const Surface& surface, std::uint32_t index,
                                          const Vec2<Scalar>& position) const noexcept {
  const Edge& edge = edges_[surface.first_edge + index];
  constexpr Scalar enough = Tolerances<Scalar>{}.certain;
  Scalar best = edge.normal.x() * position.x() + edge.normal.y() * position.y() - edge.offset;
  if (best >= enough) return best;
  const Vec2<Scalar>& end = edges_[surface.first_edge + index + 1].from;
  for (const Axis& axis : frames_[surface.frame].axes) {
    const Scalar at_begin = axis.normal.x() * edge.from.x() + axis.normal.y() * edge.from.y();
    const Scalar at_end = axis.normal.x() * end.x() + axis.normal.y() * end.y();
    if (index == 0 && at_begin > at_end) continue;
    if (index + 1 == surface.edge_count && at_end > at_begin) continue;
    const Scalar at = axis.normal.x() * position.x() + axis.normal.y() * position.y() + axis.low;
    best = std::max(best, at - std::max(at_begin, at_end));
    if (best >= enough) return best;
  }
  return best;
}

/// The separating axis theorem with signs of exact determinants, for the octagon and all that lies above it.
template <class Scalar>
bool OneWaySurfaces<Scalar>::is_below_exactly(const Surface& surface, std::uint32_t index, const Vec2<Scalar>& position,
                                              const Vec2<Scalar>& rest) const noexcept {
  const Frame& frame = frames_[surface.frame];
  const Vec2d a = edges_[surface.first_edge + index].from.template cast<double>();
  const Vec2d b = edges_[surface.first_edge + index + 1].from.template cast<double>();
  const Vec2d p = position.template cast<double>();
  const Vec2d r = rest.template cast<double>();
  const bool goes_on_before = index == 0;
  const bool goes_on_after = index + 1 == surface.edge_count;
  const auto all_corners = [&](const auto& holds) {
    return std::all_of(hull_.begin(), hull_.end(),
                       [&](const Vec2<Scalar>& o) { return holds(Vec2d(o.template cast<double>())); });
  };
  if (all_corners([&](const Vec2d& o) { return orientation_sign_of_offset(a, b, p, o, r) >= 0; })) return true;
  if (!goes_on_after &&
      all_corners([&](const Vec2d& o) { return turn_sign_of_offset(frame.one_way, b, p, o, r) <= 0; }))
    return true;
  if (!goes_on_before &&
      all_corners([&](const Vec2d& o) { return turn_sign_of_offset(frame.one_way, a, p, o, r) >= 0; }))
    return true;
  return std::any_of(frame.lower.begin(), frame.lower.end(), [&](std::uint8_t k) {
    const Vec2d o0 = hull_[k].template cast<double>();
    const Vec2d o1 = hull_[(k + 1) % hull_.size()].template cast<double>();
    if (goes_on_before && turn_sign(o0, o1, b, a) > 0) return false;
    if (goes_on_after && turn_sign(o0, o1, a, b) > 0) return false;
    return orientation_sign_of_edge_offset(p, o0, o1, a, r) <= 0 &&
           orientation_sign_of_edge_offset(p, o0, o1, b, r) <= 0;
  });
}

template <class Scalar>
bool OneWaySurfaces<Scalar>::is_above(Index index, const Vec2<Scalar>& position,
                                      const Vec2<Scalar>& rest) const noexcept {
  constexpr Scalar certain = Tolerances<Scalar>{}.certain;
  const Surface& surface = surfaces_[index];
  return all_edges_below(surface, position, [&](std::uint32_t edge) {
    const Scalar apart = separation(surface, edge, position);
    if (apart >= certain) return true;
    return apart > -certain && is_below_exactly(surface, edge, position, rest);
  });
}

template <class Scalar>
bool OneWaySurfaces<Scalar>::may_be_above(Index index, const Vec2<Scalar>& position, Scalar slack) const noexcept {
  const Surface& surface = surfaces_[index];
  return all_edges_below(surface, position,
                         [&](std::uint32_t edge) { return separation(surface, edge, position) >= -slack; });
}

template class OneWaySurfaces<float>;
template class OneWaySurfaces<double>;

}  // namespace paperproof
