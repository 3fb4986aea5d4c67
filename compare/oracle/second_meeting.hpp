/// When the octagon first overlaps a convex part whose vertices go on straight lines: by another method than
/// `first_meeting`, so that one mistake of thought cannot be in both.
#pragma once

#include "oracle/first_meeting.hpp"

namespace paperproof::compare::detail {

/// The same question as `first_meeting`, and never undecided.
///
/// While both go straight and evenly, whether they overlap is told by the signs of finitely many polynomials of degree
/// 2 in the time: of each corner of the octagon and the line through two vertices of the part, and of each vertex and
/// the line of a side of the octagon (of a disc: of the squared distances from corners and sides). For a segment enters
/// the open octagon exactly if its line has corners on both sides, and no side of the octagon has both of its ends
/// outside; else the two overlap only if a triangle of vertices contains the octagon. So the answer changes only where
/// one of the signs does. The roots at which signs change are isolated in binary fractions, by the signs of integers;
/// two are told to be one by their resultant. Between each two that follow each other one moment is asked: whether a
/// segment between two vertices enters the octagon (Cyrus and Beck 1978), or a triangle of vertices contains its
/// centre.
///
/// All numbers are integers. Isolation ends: different roots of two quadratics with coefficients of B bits are at least
/// 2^-(4 B + 8) apart, and doubles keep 4 B below `most_bits`.
/// @throws std::logic_error where they do not.
[[nodiscard]] Meeting second_meeting(std::span<const Vec2d> octagon, std::span<const PathPoint> path,
                                     const VertexWay& way, std::span<const std::size_t> part, double radius = 0);

}  // namespace paperproof::compare::detail
