/// The straight ways of vertices that stand for a turn.
#pragma once

#include "records/trace.hpp"

#include <paperproof/controller.hpp>

#include <span>
#include <vector>

namespace paperproof::compare {

/// So far a vertex on its chord is from where an even turn would have it, at most [m]. Zero: no number of chords is
/// enough. Large: what is judged is another motion than the one that ran.
inline constexpr double most_sag = 1e-4;

/// A part of a step, by fractions: in it offset and angle of a mover go evenly from one end to the other.
struct PartOfStep {
  double begin = 0;
  double end = 1;
};

/// Adds a part of a step to the way of a collider: as many chords, of equal length, as `most_sag` needs.
/// @param way that of the parts before, or an empty one.
void add_turn(const ColliderDef& def, const MoverMotion& motion, const PartOfStep& part, VertexWay& way);

/// The same for every collider whose mover turns.
/// @param movers how they go in that part. @param ways those of the parts before, or none.
void add_ways(const TraceHeader& header, std::span<const MoverMotion> movers, const PartOfStep& part,
              std::vector<VertexWay>& ways);

/// Of every collider that moves, as the controller of a level went among them. What was not near the character went
/// beside it: where it is at both ends says enough.
/// @param turned as `Controller::turned`, with the indices of the scenery as ids. @param motions by mover.
[[nodiscard]] std::vector<VertexWay> ways_in_level(const SceneryDef& scenery, std::span<const TurnedCollider> turned,
                                                   std::span<const MoverMotion> motions);

}  // namespace paperproof::compare
