/// When the octagon first overlaps a convex part whose vertices go on straight lines: exactly.
#pragma once

#include "records/vertex_way.hpp"

#include <paperproof/report.hpp>

#include <cstdint>
#include <span>

namespace paperproof::compare::detail {

struct Meeting {
  enum class Kind : std::uint8_t {
    apart,      ///< The open octagon meets the part at no moment.
    meets,      ///< It is apart before `low`, and overlaps the part at `high`.
    undecided,  ///< It is apart before `low`; later the two are nearer than the halving of the time could tell.
  };
  Kind kind = Kind::apart;
  double low = 0;  ///< Fractions of the step, rounded.
  double high = 0;
  bool by_second = false;  ///< Halving could not tell, and `second_meeting` did.
};

/// What is asked for: `whether` stops at the first overlap that is found, `when` closes in on the first one there is.
enum class Asked : std::uint8_t { whether, when };

/// The first overlap on a way. At every moment the part is the hull of its vertices.
///
/// While both go straight and evenly an edge of the one that turns with the time, and a point of the other as that edge
/// sees it, make a product of degree 2 (of an edge of the octagon: 1) in the time, with rational coefficients. Where no
/// product of one edge is negative in a span of time, that edge separates the two all along. Where none does, the
/// middle of the span is looked at: if no edge separates them there, they overlap; else both halves are asked in turn,
/// down to 2^-45 of what goes straight, and in no more than 4096 spans of it. Every sign is tried in doubles that know
/// their rounding, and decided in integers where these do not.
/// @param octagon convex, counter-clockwise, without repeated points; relative to the position.
/// @param path of the position, ascending in fractions of the step; a single corner asks about that moment.
/// @param way its instants hold those of the path. @param part the numbers of its vertices in `way`, counter-clockwise
///   or the two ends of a segment, or the centre of a disc.
/// @param radius of a disc, else 0. It is judged for all of a straight stretch at once.
[[nodiscard]] Meeting first_meeting(std::span<const Vec2d> octagon, std::span<const PathPoint> path,
                                    const VertexWay& way, std::span<const std::size_t> part,
                                    Asked asked = Asked::whether, double radius = 0);

/// The same question, and never undecided: by another method, so that one mistake of thought cannot be in both.
///
/// The octagon and the part go straight and evenly. The signs of finitely many polynomials of degree 2 in the time say
/// whether these two overlap: of each corner of the octagon and the line through two vertices of the part, and of each
/// vertex and the line of a side of the octagon (of a disc: of the squared distances from corners and sides). For a
/// segment enters the open octagon exactly if its line has corners on both sides, and no side of the octagon has both
/// of its ends outside; else the two overlap only if a triangle of vertices contains the octagon. So the answer changes
/// only where one of the signs does. The roots at which signs change are isolated in binary fractions, by the signs of
/// integers; two are told to be one by their resultant. Between each two that follow each other one moment is asked:
/// whether a segment between two vertices enters the octagon (Cyrus and Beck 1978), or a triangle of vertices contains
/// its centre.
///
/// All numbers are integers. Isolation ends: different roots of two quadratics with coefficients of B bits are at least
/// 2^-(4 B + 8) apart, and doubles keep 4 B below `most_bits`.
/// @throws std::logic_error where they do not.
[[nodiscard]] Meeting second_meeting(std::span<const Vec2d> octagon, std::span<const PathPoint> path,
                                     const VertexWay& way, std::span<const std::size_t> part, double radius = 0);

}  // namespace paperproof::compare::detail
