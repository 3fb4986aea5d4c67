#include "step/certificate.hpp"

namespace paperproof::octagon_sweep {
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
template <class Scalar, class Position>
bool octagon_right_of(const ConfigurationSpace<Scalar>& space, const Vec2d& a, const Vec2d& b,
                      const Position& p) noexcept {
  for (const Vec2<Scalar>& o : space.hull())
    if (side_of_point(a, b, p, o.template cast<double>()) > 0) return false;
  return true;
}

/// All vertices of the piece on the right-hand side of the octagon's edge o0 -> o1 at `p`, or on its line.
template <class Scalar, class Position>
bool piece_right_of(const PieceVertices<Scalar>& vertices, const Vec2d& o0, const Vec2d& o1,
                    const Position& p) noexcept {
  for (const Vec2<Scalar>& v : vertices)
    if (side_of_vertex(o0, o1, p, v.template cast<double>()) > 0) return false;
  return true;
}

/// Whether the line of an edge of the piece or of the octagon has the two on different sides, at `from` and at `to`.
/// Both rings are counter-clockwise: the outside of an edge is on its right.
template <class Scalar, class Position>
bool some_line_separates(const ConfigurationSpace<Scalar>& space, PieceIndex piece, const Position& from,
                         const Position& to) noexcept {
  const PieceVertices<Scalar> vertices = space.scenery().vertices_of(piece);
  for (std::size_t j = 0; j < vertices.size(); ++j) {
    const Vec2d a = vertices[j].template cast<double>();
    const Vec2d b = vertices[(j + 1) % vertices.size()].template cast<double>();
    if (octagon_right_of(space, a, b, from) && octagon_right_of(space, a, b, to)) return true;
  }
  const std::span<const Vec2<Scalar>> hull = space.hull();
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2d o0 = hull[k].template cast<double>();
    const Vec2d o1 = hull[(k + 1) % hull.size()].template cast<double>();
    if (piece_right_of(vertices, o0, o1, from) && piece_right_of(vertices, o0, o1, to)) return true;
  }
  return false;
}

}  // namespace

template <class Scalar>
bool overlaps_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                      const Vec2<Scalar>& position) noexcept {
  const Vec2d p = position.template cast<double>();
  return !some_line_separates(space, piece, p, p);
}

template <class Scalar>
bool clear_of_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece, const Vec2<Scalar>& from,
                      const Vec2<Scalar>& to) noexcept {
  return some_line_separates(space, piece, from.template cast<double>(), to.template cast<double>());
}

template <class Scalar>
bool overlaps_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                      const ExactPosition& position) noexcept {
  return !some_line_separates(space, piece, position, position);
}

template <class Scalar>
bool clear_of_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                      std::span<const MoverMotion<Scalar>> movers, const Vec2<Scalar>& from, Scalar begin,
                      const Vec2<Scalar>& to, Scalar end) noexcept {
  const MoverIndex mover = space.scenery().pieces()[piece].mover;
  if (mover == no_mover) return clear_of_exactly(space, piece, from, to);
  return some_line_separates(space, piece, ExactPosition(from, movers[mover], begin),
                             ExactPosition(to, movers[mover], end));
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                                                                \
  template bool overlaps_exactly(const ConfigurationSpace<Scalar>&, PieceIndex, const Vec2<Scalar>&) noexcept;        \
  template bool overlaps_exactly(const ConfigurationSpace<Scalar>&, PieceIndex, const ExactPosition&) noexcept;       \
  template bool clear_of_exactly(const ConfigurationSpace<Scalar>&, PieceIndex, const Vec2<Scalar>&,                  \
                                 const Vec2<Scalar>&) noexcept;                                                       \
  template bool clear_of_exactly(const ConfigurationSpace<Scalar>&, PieceIndex, std::span<const MoverMotion<Scalar>>, \
                                 const Vec2<Scalar>&, Scalar, const Vec2<Scalar>&, Scalar) noexcept;
PAPERPROOF_INSTANTIATE(float)
PAPERPROOF_INSTANTIATE(double)
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::octagon_sweep
