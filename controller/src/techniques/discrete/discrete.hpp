/// The article's discrete collision detection: see `discrete::Solver`. The character is a body, and so are others that
/// move with it in a `Crowd`, all in one solve (this is a `JointTechnique`). Movers are bodies that nothing can move.
///
/// The knob `iterations` is the number of rounds, each with its own search for nearby pieces; the others have no
/// meaning here. Here the article's "more iterations" shows: where two surfaces push into each other every round leaves
/// a share of the depth that it found (`wedge_60`, `valley`, `leaning_valley`).
///
/// The response is the solver's: the part of the motion into a normal is taken away. The corners of the
/// character are one convex body, whichever `points` are chosen, so nothing slips between two of them; but only the
/// start and the end of a step are looked at, so paper is passed. A one-way segment stops what begins on its side of
/// the normal. Stopped motion leaves a gap of `Tolerances::stop`. A contact's fraction is its time of impact.
///
/// What stands on a mover is carried: the frame is worked out in the mover's frame of reference. What comes to rest on
/// it is carried at once, unless it had a speed of its own along it. A mover's push that leads through something that
/// stands still, or ends in it, is none: the character stays where it was, and is crushed.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_discrete(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                               const CharacterDef& character);

}  // namespace paperproof
