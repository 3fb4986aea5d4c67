/// Convex pieces whose vertices go on straight lines, as those of everything near do in a part of a step, also of what
/// turns. Of a circle the centre goes on a straight line.
#pragma once

#include <paperproof/scenery.hpp>

#include <optional>
#include <span>
#include <vector>

namespace paperproof::turning {

/// The way of a convex piece: each vertex goes evenly from one place to another. Vertices are counter-clockwise, or the
/// two ends of a segment, or the centre of a circle.
struct PieceWay {
  static constexpr std::size_t most_vertices = 32;
  std::vector<Vec2d> from;
  std::vector<Vec2d> to;
  double radius = 0;  ///< Of a circle [m].
  double begin = 0;   ///< Only this share of the way counts,
  double end = 1;     ///< up to here.
};

/// The character's way in the share that counts.
struct HullWay {
  std::span<const Vec2d> hull;  ///< Relative to the position, counter-clockwise.
  Vec2d from{Vec2d::Zero()};
  Vec2d to{Vec2d::Zero()};
};

/// Proves that a character and a piece stay apart while both go their ways.
///
/// They are apart where the line of an edge of one has the other wholly on its outside. On which side of an edge a
/// point is, tells the sign of cross(edge, vertex - point), positive on the right: a polynomial of degree two in time,
/// as both factors are linear. It is positive over the whole time if its three Bernstein coefficients are. Where no
/// line is proved to separate the two over the whole time, each half is tried; where no line does at one moment, the
/// proof has failed. (R. T. Farouki, V. T. Rajan, On the numerical condition of polynomials in Bernstein form, 1987,
/// for the criterion.) Seen by the character a circle goes straight: see `geometry::approach`.
/// @param least distance that counts as apart [m]; below zero: so deep an overlap is none.
[[nodiscard]] bool stay_apart(const HullWay& character, const PieceWay& piece, double least);

/// A place on a straight way. At the end nothing is rounded.
[[nodiscard]] inline Vec2d between(const Vec2d& from, const Vec2d& to, double share) {
  return share < 1 ? Vec2d(from + (to - from) * share) : to;
}

/// Where a piece is nearest to a character.
struct Approach {
  double distance = 0;  ///< [m]
  Vec2d normal{0, 1};   ///< Unit, from the piece towards the character.
};

/// @param outline of a polygon, or the two ends of a segment.
[[nodiscard]] Approach nearest(std::span<const Vec2d> outline, std::span<const Vec2d> hull, const Vec2d& position);

/// The corner of an outline that is nearer to a point than every other point of the outline; nothing where a point
/// within an edge is.
[[nodiscard]] std::optional<Vec2d> nearest_vertex(std::span<const Vec2d> outline, const Vec2d& point);

}  // namespace paperproof::turning
