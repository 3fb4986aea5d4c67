#include "one_way_surfaces.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <array>
#include <tuple>
#include <unordered_set>

#include "geometry/pose.hpp"
#include "geometry/vectors.hpp"

namespace paperproof {
namespace {

using geometry::least_along;
using geometry::normal_of;
using geometry::orientation_sign;
using geometry::orientation_sign_of_sum;
using geometry::turn_sign;

/// An end of a chain's first or last segment, at which a line begins or ends.
struct OpenEnd {
  MoverIndex mover;
  Filter filter;
  Vec2d one_way;
  Vec2d at;
  bool begins;
  PieceIndex piece;

  [[nodiscard]] auto place() const {
    return std::tuple(mover, filter.category, filter.mask, filter.group, one_way.x(), one_way.y(), at.x(), at.y());
  }
};

/// Which segment continues the line where another segment ends.
class Joints {
 public:
  /// @param pieces one-way ones, ascending: all of each collider.
  Joints(const Scenery& scenery, std::span<const PieceIndex> pieces) {
    ColliderIndex last = no_collider;
    for (const PieceIndex piece : pieces) {
      const ColliderIndex collider = scenery.pieces()[piece].collider;
      if (collider != last) add_collider(scenery.as_run(collider), piece);
      last = collider;
    }
    join_ends();
  }

  [[nodiscard]] std::optional<PieceIndex> next(PieceIndex piece) const {
    const auto known = next_.find(piece);
    return known == next_.end() ? std::nullopt : std::optional(known->second);
  }
  [[nodiscard]] bool begins(PieceIndex piece) const { return !has_previous_.contains(piece); }

 private:
  void join(PieceIndex before, PieceIndex after) {
    next_[before] = after;
    has_previous_.insert(after);
  }

  /// The pieces of a collider are consecutive, and those of its lines are in order.
  void add_collider(const ColliderDef& def, PieceIndex piece) {
    for (const std::vector<Vec2d>& line : one_way_lines(def)) piece = add_line(line, def, piece);
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
    std::ranges::stable_sort(ends_, [](const OpenEnd& a, const OpenEnd& b) { return a.place() < b.place(); });
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

  std::unordered_map<PieceIndex, PieceIndex> next_;
  std::unordered_set<PieceIndex> has_previous_;
  std::vector<OpenEnd> ends_;
};

}  // namespace

OneWaySurfaces::OneWaySurfaces(const Scenery& scenery, const CharacterShape& shape) : shape_(shape) {
  if (scenery.counts().one_way == 0) return;
  std::vector<PieceIndex> pieces;
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece)
    if (scenery.pieces()[piece].one_way) pieces.push_back(piece);
  build(scenery, pieces, 0);
}

OneWaySurfaces::OneWaySurfaces(const Scenery& scenery, const CharacterShape& shape, MoverIndex mover, double angle)
    : shape_(shape) {
  const PieceGrid& solids = scenery.group_of(mover).solids;
  std::vector<PieceIndex> pieces;
  solids.find(solids.whole(), scenery.boxes(), pieces);
  std::erase_if(pieces, [&](PieceIndex piece) { return !scenery.pieces()[piece].one_way; });
  std::ranges::sort(pieces);
  build(scenery, pieces, angle);
}

void OneWaySurfaces::build(const Scenery& scenery, std::span<const PieceIndex> pieces, double angle) {
  const Joints joints(scenery, pieces);
  const geometry::Turn turn(angle);
  const auto turned = [&](const Vec2d& v) { return angle == 0 ? v : turn(v); };
  std::vector<Vec2d> line;
  for (const PieceIndex first : pieces) {
    if (!joints.begins(first)) continue;
    line.assign(1, turned(scenery.vertices_of(first)[0]));
    for (std::optional<PieceIndex> piece = first; piece; piece = joints.next(*piece)) {
      const Vec2d end = turned(scenery.vertices_of(*piece)[1]);
      // Segments on the same line are one edge.
      if (line.size() > 1 && orientation_sign(line[line.size() - 2], line.back(), end) == 0) line.pop_back();
      line.push_back(end);
      of_piece_[*piece] = static_cast<Index>(surfaces_.size());
    }
    add_surface(line, turned(*scenery.collider(scenery.pieces()[first].collider).one_way));
  }
}

void OneWaySurfaces::add_surface(std::span<const Vec2d> line, const Vec2d& one_way) {
  const std::uint32_t frame = find_frame(one_way);
  surfaces_.push_back({frame, static_cast<std::uint32_t>(edges_.size()), static_cast<std::uint32_t>(line.size() - 1)});
  for (std::size_t i = 0; i < line.size(); ++i) {
    Edge edge{.from = line[i], .begins = frames_[frame].across.dot(line[i]), .normal = Vec2d::Zero(), .offset = 0};
    if (i + 1 < line.size()) {
      edge.normal = normal_of(line[i + 1] - line[i]);
      edge.offset = std::max(edge.normal.dot(line[i]), edge.normal.dot(line[i + 1])) - least_along(hull(), edge.normal);
    }
    edges_.push_back(edge);
  }
}

std::uint32_t OneWaySurfaces::find_frame(const Vec2d& one_way) {
  for (std::uint32_t known = 0; known < frames_.size(); ++known)
    if (frames_[known].one_way == one_way) return known;
  Frame frame;
  frame.one_way = one_way;
  frame.across = -normal_of(one_way);
  const auto add_axis = [&](const Vec2d& normal) {
    frame.axes.push_back({normal, least_along(hull(), normal)});
    return frame.axes.back().low;
  };
  for (std::size_t k = 0; k < hull().size(); ++k) {
    const Vec2d a = hull()[k];
    const Vec2d b = hull()[(k + 1) % hull().size()];
    if (turn_sign(a, b, Vec2d::Zero(), one_way) <= 0) continue;
    frame.lower.push_back(static_cast<std::uint8_t>(k));
    add_axis(normal_of(b - a));
  }
  frame.first = add_axis(frame.across);
  frame.last = -add_axis(-frame.across);
  frames_.push_back(frame);
  return static_cast<std::uint32_t>(frames_.size() - 1);
}

/// Tests every edge that the octagon covers across `one_way`; the other edges are beside the octagon.
template <class Visit>
bool OneWaySurfaces::all_edges_below(const Surface& surface, const Vec2d& position, const Visit& is_below) const {
  constexpr double margin = Tolerances{}.certain;
  const Frame& frame = frames_[surface.frame];
  const double at = frame.across.x() * position.x() + frame.across.y() * position.y();
  const double first = at + frame.first - margin;
  const double last = at + frame.last + margin;
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
double OneWaySurfaces::separation(const Surface& surface, std::uint32_t index, const Vec2d& position) const {
  const Edge& edge = edges_[surface.first_edge + index];
  constexpr double enough = Tolerances{}.certain;
  double best = edge.normal.x() * position.x() + edge.normal.y() * position.y() - edge.offset;
  if (best >= enough) return best;
  const Vec2d& end = edges_[surface.first_edge + index + 1].from;
  for (const Axis& axis : frames_[surface.frame].axes) {
    const double at_begin = axis.normal.x() * edge.from.x() + axis.normal.y() * edge.from.y();
    const double at_end = axis.normal.x() * end.x() + axis.normal.y() * end.y();
    if (index == 0 && at_begin > at_end) continue;
    if (index + 1 == surface.edge_count && at_end > at_begin) continue;
    const double at = axis.normal.x() * position.x() + axis.normal.y() * position.y() + axis.low;
    best = std::max(best, at - std::max(at_begin, at_end));
    if (best >= enough) return best;
  }
  return best;
}

/// The separating axis theorem with signs of exact determinants, for the octagon and all that lies above it.
bool OneWaySurfaces::is_below_exactly(const Surface& surface, std::uint32_t index, const Vec2d& position,
                                      const Vec2d& rest) const {
  const Frame& frame = frames_[surface.frame];
  const Vec2d a = edges_[surface.first_edge + index].from;
  const Vec2d b = edges_[surface.first_edge + index + 1].from;
  const bool goes_on_before = index == 0;
  const bool goes_on_after = index + 1 == surface.edge_count;
  // The octagon is on this side of the line from -> to, seen from `at`, or on it: 1 for left.
  const auto is_beside = [&](int side, const Vec2d& from, const Vec2d& to, const Vec2d& at) {
    return std::ranges::all_of(hull(), [&](const Vec2d& o) {
      return side * orientation_sign_of_sum(from, to, std::array{position, rest, o, Vec2d(-at)}) >= 0;
    });
  };
  const Vec2d zero = Vec2d::Zero();
  if (is_beside(1, a, b, zero) || (!goes_on_after && is_beside(-1, zero, frame.one_way, b)) ||
      (!goes_on_before && is_beside(1, zero, frame.one_way, a)))
    return true;
  return std::ranges::any_of(frame.lower, [&](std::uint8_t k) {
    const Vec2d o0 = hull()[k];
    const Vec2d o1 = hull()[(k + 1) % hull().size()];
    if (goes_on_before && turn_sign(o0, o1, b, a) > 0) return false;
    if (goes_on_after && turn_sign(o0, o1, a, b) > 0) return false;
    const auto is_right = [&](const Vec2d& v) {
      return orientation_sign_of_sum(o0, o1, std::array{v, Vec2d(-position), Vec2d(-rest)}) <= 0;
    };
    return is_right(a) && is_right(b);
  });
}

bool OneWaySurfaces::is_above(Index index, const Vec2d& position, const Vec2d& rest) const {
  constexpr double certain = Tolerances{}.certain;
  const Surface& surface = surfaces_[index];
  return all_edges_below(surface, position, [&](std::uint32_t edge) {
    const double apart = separation(surface, edge, position);
    if (apart >= certain) return true;
    return apart > -certain && is_below_exactly(surface, edge, position, rest);
  });
}

bool OneWaySurfaces::may_be_above(Index index, const Vec2d& position, double slack) const {
  const Surface& surface = surfaces_[index];
  return all_edges_below(surface, position,
                         [&](std::uint32_t edge) { return separation(surface, edge, position) >= -slack; });
}

}  // namespace paperproof
