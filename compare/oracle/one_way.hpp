/// One-way chains as surfaces: see `ExactScenery::met`.
///
/// The octagon is above a surface where its lower rim is nowhere below it, across the whole of what it covers. Both are
/// straight between their corners, so the corners decide: no corner of the octagon lies below the edge of the surface
/// that passes under it, and no vertex of the surface lies above the rim.
#pragma once

#include "oracle/predicates.hpp"

#include <paperproof/scenery.hpp>

#include <map>
#include <tuple>
#include <vector>

namespace paperproof::compare::detail {

struct Edge;

/// Segments of one-way chains that go on from one to the next across `one_way`; before the first and after the last the
/// line goes on straight.
struct Surface {
  Vec2d one_way{Vec2d::Zero()};
  std::vector<std::uint32_t> edges;  ///< Into `World::edges()`, in order, the normal of each on its left.
  std::vector<double> begins;        ///< Where each begins across `one_way` [m], rounded.
  int unit = 0;                      ///< Lowest bit of the vertices.
};

/// Whether `one_way` points to the left (positive) or to the right of the way from a to b, exact.
[[nodiscard]] Sign side_of(const Vec2d& a, const Vec2d& b, const Vec2d& one_way);

/// The chains that a one-way collider is. A polygon has one for each run of edges of its outer ring that face where
/// `one_way` points; the others, and those of holes, block nothing.
[[nodiscard]] std::vector<std::vector<Vec2d>> one_way_lines_of(const ColliderDef& def);

/// Finds the surfaces of all one-way chains. The segments of one chain are joined where both go the same way across
/// `one_way`; chains of equal `one_way` and of one mover are, in a point where one ends and one begins, and no more.
class SurfaceFinder {
 public:
  /// @param def whose line it is. @param sides of each segment: see `side_of`.
  /// @param first_edge of the segments that block, which stand together.
  void add_line(const ColliderDef& def, std::span<const Vec2d> line, std::span<const Sign> sides,
                std::uint32_t first_edge);
  /// Sets `Edge::surface`, too.
  [[nodiscard]] std::vector<Surface> find(std::vector<Edge>& edges) const;

 private:
  using Place = std::tuple<MoverIndex, double, double, double, double>;  ///< Mover, one_way, point.
  struct Ends {
    std::vector<std::uint32_t> ending;
    std::vector<std::uint32_t> beginning;
  };
  std::map<std::uint32_t, Vec2d> one_way_of_;  ///< Of each edge.
  std::map<std::uint32_t, std::uint32_t> next_;
  std::map<Place, Ends> ends_;
};

/// Whether a corner of the octagon lies below an edge that passes under it.
/// @param up the direction of `one_way`. @param first, last whether the edge goes on straight before a, after b.
template <class Number>
[[nodiscard]] Answer corner_below(const Octagon<Number>& octagon, const Point<Number>& up, const Point<Number>& a,
                                  const Point<Number>& b, bool first, bool last) {
  Answer none_below = Answer::yes;
  for (std::size_t k = 0; k < octagon.size; ++k) {
    const Point<Number>& corner = octagon.corners[k];
    Answer below = is(sign_of(cross(b - a, corner - a)), Sign::negative);
    if (!first) below = both(below, is_not(is(sign_of(cross(corner - a, up)), Sign::negative)));
    if (!last) below = both(below, is_not(is(sign_of(cross(corner - b, up)), Sign::positive)));
    none_below = both(none_below, is_not(below));
  }
  return is_not(none_below);
}

/// Whether a vertex lies above the lower rim of the octagon, which covers it across `up`.
template <class Number>
[[nodiscard]] Answer vertex_above_rim(const Octagon<Number>& octagon, const Point<Number>& up, const Point<Number>& v) {
  Answer above_all = Answer::yes;
  Answer none_before = Answer::yes;
  Answer none_after = Answer::yes;
  for (std::size_t k = 0; k < octagon.size; ++k) {
    const Point<Number>& corner = octagon.corners[k];
    const Sign place = sign_of(cross(v - corner, up));
    none_before = both(none_before, is_not(is(place, Sign::positive)));
    none_after = both(none_after, is_not(is(place, Sign::negative)));
    const Answer faces_down = is(sign_of(cross(octagon.edge(k), up)), Sign::positive);
    const Answer beyond = is_not(is(sign_of(cross(octagon.edge(k), v - corner)), Sign::positive));
    above_all = both(above_all, is_not(both(faces_down, beyond)));
  }
  return both(above_all, both(is_not(none_before), is_not(none_after)));
}

}  // namespace paperproof::compare::detail
