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

}  // namespace paperproof::compare::detail
