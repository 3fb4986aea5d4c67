/// The outline of everything solid, for one-sided chain loops.
#pragma once

#include "float_scenery.hpp"

#include <box2d/b2_common.h>

#include <vector>

namespace paperproof::box2d {

/// Smallest distance of neighbouring vertices in a chain [m]. Box2D asserts that it is more than the linear slop, also
/// between the last vertex and the first (when it copies the shape); the hundredth above covers a library that rounds
/// the square differently. Larger values would move the outline visibly.
inline constexpr float chain_spacing = 1.01F * b2_linearSlop;

/// Outline of the union of all polygons of `scenery` (chains are not looked at): outer loops counter-clockwise, holes
/// clockwise, so that Box2D's chains, solid on the left of their direction, are solid where the polygons are.
///
/// Polygons whose area is zero in float have no outline; `flat_polygons` names them.
/// Uses the Vatti clipping of Clipper 6 in integers of 2^-32 m: floats are exact in it from 2^-9 m on, smaller ones are
/// rounded by at most 1.2e-10 m, and crossings are rounded to the same grid. A coarser unit would open cracks between
/// abutting pieces of small scenes; a finer one would leave the 53 bits of the doubles that Clipper computes crossings
/// with: 2e6 m is 2^53 of these units.
[[nodiscard]] std::vector<Ring> solid_union(const SceneryDef& scenery);

/// The polygons that `solid_union` cannot see: in float their area is zero (paper thinner than the spacing of floats).
[[nodiscard]] std::vector<ColliderIndex> flat_polygons(const SceneryDef& scenery);

/// The loop with vertices left out until neighbours are more than `chain_spacing` apart, which moves its outline by
/// less than that: a third of Box2D's rest gap. Empty where no loop of the same winding is left: the solid is thinner
/// than the spacing, or smaller.
[[nodiscard]] Ring spaced(const Ring& loop);

}  // namespace paperproof::box2d
