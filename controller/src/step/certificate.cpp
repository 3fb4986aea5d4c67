#include "step/certificate.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {
namespace {

/// Of the octagon's point `o` at `p`.
int side_of_point(const Vec2d& a, const Vec2d& b, const Vec2d& p, const Vec2d& o) noexcept {
  return geometry::orientation_sign_of_offset(a, b, p, o);
}
int side_of_point(const Vec2d& a, const Vec2d& b, const ExactPosition& p, const Vec2d& o) noexcept {
  FixedVector<Vec2d, geometry::most_terms> terms;
  for (const Vec2d& term : p.terms()) terms.push_back(term);
  terms.push_back(o);
  return geometry::orientation_sign_of_sum(a, b, {terms.begin(), terms.end()});
}

/// Of a vertex beside the octagon's edge o0 -> o1 at `p`.
int side_of_vertex(const Vec2d& o0, const Vec2d& o1, const Vec2d& p, const Vec2d& v) noexcept {
  return geometry::orientation_sign_of_edge_offset(p, o0, o1, v);
}
int side_of_vertex(const Vec2d& o0, const Vec2d& o1, const ExactPosition& p, const Vec2d& v) noexcept {
  FixedVector<Vec2d, geometry::most_terms> terms;
  terms.push_back(v);
  for (const Vec2d& term : p.terms()) terms.push_back(-term);
  return geometry::orientation_sign_of_sum(o0, o1, {terms.begin(), terms.end()});
}

/// All points of the octagon at `p` on the right-hand side of a -> b, or on the line.
template <class Position>
bool octagon_right_of(const ConfigurationSpace& space, const Vec2d& a, const Vec2d& b, const Position& p) noexcept {
  for (const Vec2d& o : space.hull())
    if (side_of_point(a, b, p, o) > 0) return false;
  return true;
}

/// All vertices of the piece on the right-hand side of the octagon's edge o0 -> o1 at `p`, or on its line.
template <class Position>
bool piece_right_of(const PieceVertices& vertices, const Vec2d& o0, const Vec2d& o1, const Position& p) noexcept {
  for (const Vec2d& v : vertices)
    if (side_of_vertex(o0, o1, p, v) > 0) return false;
  return true;
}

using Terms = FixedVector<Vec2d, geometry::most_terms>;
using Way = FixedVector<Vec2d, 2 * geometry::most_terms>;

template <std::size_t capacity>
std::span<const Vec2d> span_of(const FixedVector<Vec2d, capacity>& terms) noexcept {
  return {terms.begin(), terms.end()};
}
std::span<const Vec2d> terms_of(const Vec2d& p) noexcept { return {&p, 1}; }
std::span<const Vec2d> terms_of(const ExactPosition& p) noexcept { return p.terms(); }

template <class Position>
Vec2d rounded(const Position& p) noexcept {
  Vec2d sum = Vec2d::Zero();
  for (const Vec2d& term : terms_of(p)) sum += term;
  return sum;
}

/// The octagon beside a circle.
class BesideCircle {
 public:
  BesideCircle(const ConfigurationSpace& space, PieceIndex piece) noexcept
      : circle_{space.circle(piece).centre, space.circle(piece).radius} {
    for (const Vec2d& point : space.hull()) octagon_.push_back(point);
  }

  /// Whether their open interiors are apart: an edge is, or the corner that is nearest.
  template <class Position>
  [[nodiscard]] bool is_clear(const Position& p) const noexcept {
    const double separation = near(p).separation;
    if (std::abs(separation) >= tolerances.certain) return separation > 0;
    for (std::size_t k = 0; k < octagon_.size(); ++k)
      if (is_edge_apart(k, p) || is_corner_apart(k, p)) return true;
    return false;
  }

  /// Whether a motion is proved to be clear. The distance is convex in time: a motion that does not come nearer from
  /// one end is clear if that end is. Else an edge, or a tangent of the circle that is nearest at one of the ends,
  /// separates them at both.
  template <class Position>
  [[nodiscard]] bool are_clear(const Position& from, const Position& to) const noexcept {
    for (std::size_t k = 0; k < octagon_.size(); ++k)
      if ((is_edge_apart(k, from) && is_edge_apart(k, to)) || goes_away(k, from, to) || goes_away(k, to, from))
        return true;
    for (const Vec2d& normal : {near(from).normal, near(to).normal})
      if (is_tangent_apart(normal, from) && is_tangent_apart(normal, to)) return true;
    return false;
  }

 private:
  [[nodiscard]] const Vec2d& corner(std::size_t k) const noexcept { return octagon_[k % octagon_.size()]; }
  template <class Position>
  [[nodiscard]] geometry::NearCircle near(const Position& p) const noexcept {
    return geometry::near_circle({octagon_.begin(), octagon_.end()}, rounded(p), circle_);
  }
  /// From the circle's centre to a corner of the octagon.
  template <class Position>
  [[nodiscard]] Terms arm_to(const Vec2d& o, const Position& p) const noexcept {
    Terms terms;
    terms.push_back(o);
    terms.push_back(-circle_.centre);
    for (const Vec2d& term : terms_of(p)) terms.push_back(term);
    return terms;
  }
  template <class Position>
  [[nodiscard]] bool is_edge_apart(std::size_t k, const Position& p) const noexcept {
    Terms back;  // from the corner to the centre
    back.push_back(circle_.centre);
    back.push_back(-corner(k));
    for (const Vec2d& term : terms_of(p)) back.push_back(-term);
    return geometry::is_sum_as_far_right(corner(k), corner(k + 1), span_of(back), circle_.radius);
  }
  /// Whether a corner is the nearest place of the octagon, and is outside of the circle or on it.
  template <class Position>
  [[nodiscard]] bool is_corner_apart(std::size_t k, const Position& p) const noexcept {
    const Terms arm = arm_to(corner(k), p);
    const std::array after{corner(k + 1), Vec2d(-corner(k))};
    const std::array before{corner(k), Vec2d(-corner(k + octagon_.size() - 1))};
    return geometry::dot_sign_of_sums(span_of(arm), after) >= 0 &&
           geometry::dot_sign_of_sums(span_of(arm), before) <= 0 &&
           geometry::is_sum_as_long_as(span_of(arm), circle_.radius);
  }
  /// Whether a motion begins clear with a corner that is nearest, and this does not come nearer.
  template <class Position>
  [[nodiscard]] bool goes_away(std::size_t k, const Position& from, const Position& to) const noexcept {
    if (!is_corner_apart(k, from)) return false;
    Way way;
    for (const Vec2d& term : terms_of(to)) way.push_back(term);
    for (const Vec2d& term : terms_of(from)) way.push_back(-term);
    return geometry::dot_sign_of_sums(span_of(arm_to(corner(k), from)), span_of(way)) >= 0;
  }
  template <class Position>
  [[nodiscard]] bool is_tangent_apart(const Vec2d& normal, const Position& p) const noexcept {
    const double length = geometry::length_rounded_up(normal);
    return std::all_of(octagon_.begin(), octagon_.end(), [&](const Vec2d& o) {
      return geometry::height_sign_of_sum(normal, span_of(arm_to(o, p)), circle_.radius, length) >= 0;
    });
  }

  Circle circle_;
  FixedVector<Vec2d, CharacterShape::max_points> octagon_;
};

/// Whether the line of an edge of the piece or of the octagon has the two on different sides, at `from` and at `to`.
/// Both rings are counter-clockwise: the outside of an edge is on its right.
template <class Position>
bool some_line_separates(const ConfigurationSpace& space, PieceIndex piece, const Position& from,
                         const Position& to) noexcept {
  if (space.is_circle(piece)) return BesideCircle(space, piece).are_clear(from, to);
  const PieceVertices vertices = space.vertices_of(piece);
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    const Vec2d a = vertices[j];
    const Vec2d b = vertices[(j + 1) % vertices.size()];
    if (octagon_right_of(space, a, b, from) && octagon_right_of(space, a, b, to)) return true;
  }
  const std::span<const Vec2d> hull = space.hull();
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2d o0 = hull[k];
    const Vec2d o1 = hull[(k + 1) % hull.size()];
    if (piece_right_of(vertices, o0, o1, from) && piece_right_of(vertices, o0, o1, to)) return true;
  }
  return false;
}

}  // namespace

bool overlaps_exactly(const ConfigurationSpace& space, PieceIndex piece, const Vec2& position) noexcept {
  const Vec2d p = position.cast<double>();
  if (space.is_circle(piece)) return !BesideCircle(space, piece).is_clear(p);
  return !some_line_separates(space, piece, p, p);
}

bool clear_of_exactly(const ConfigurationSpace& space, PieceIndex piece, const Vec2& from, const Vec2& to) noexcept {
  return some_line_separates<Vec2d>(space, piece, from.cast<double>(), to.cast<double>());
}

bool overlaps_exactly(const ConfigurationSpace& space, PieceIndex piece, const ExactPosition& position) noexcept {
  if (space.is_circle(piece)) return !BesideCircle(space, piece).is_clear(position);
  return !some_line_separates(space, piece, position, position);
}

bool clear_of_exactly(const ConfigurationSpace& space, PieceIndex piece, std::span<const MoverMotion> movers,
                      const Vec2& from, Real begin, const Vec2& to, Real end) noexcept {
  const MoverIndex mover = space.info(piece).source.mover;
  if (mover == no_mover) return clear_of_exactly(space, piece, from, to);
  return some_line_separates(space, piece, ExactPosition(from, movers[mover], begin),
                             ExactPosition(to, movers[mover], end));
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
