/// The straight ways of vertices that stand for a turn.
#pragma once

#include "records/trace.hpp"
#include "scenes/mover.hpp"

#include <span>
#include <vector>

namespace paperproof::compare {

/// So far a vertex on its chord is from where an even turn would have it, at most [m]. Zero: no number of chords is
/// enough. Large: what is judged is another motion than the one that ran.
inline constexpr double most_sag = 1e-4;

/// How a mover goes during a part of a step: offset and angle evenly, each from one end to the other.
struct TurningMotion {
  MoverMotion offset{};
  TurnMotion angle{};
  double begin = 0;  ///< Fractions of the step.
  double end = 1;
};

/// Adds a part of a step to the way of a collider: as many chords, of equal length, as `most_sag` needs.
/// @param way that of the parts before, or an empty one.
void add_turn(const ColliderDef& def, const TurningMotion& motion, VertexWay& way);

/// How all movers go during a part of a step.
struct MoversMotion {
  std::span<const MoverMotion> offsets;
  std::span<const TurnMotion> angles;
  double begin = 0;  ///< Fractions of the step.
  double end = 1;
};

/// The same for every collider whose mover turns.
/// @param ways those of the parts before, or none.
void add_ways(const TraceHeader& header, const MoversMotion& motion, std::vector<VertexWay>& ways);

}  // namespace paperproof::compare
