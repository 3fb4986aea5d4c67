/// The article's discrete collision detection for one character among static scenery: see `discrete::Solver`, which
/// does the same for many moving bodies.
///
/// The knob `iterations` is the number of rounds, each with its own search for nearby pieces; the others have no
/// meaning here. The response is the solver's: the part of the motion into a normal is taken away. The corners of the
/// character are one convex body, whichever `points` are chosen, so nothing slips between two of them; but only the
/// start and the end of a step are looked at, so paper is passed. A one-way segment stops what begins on its side of
/// the normal. Stopped motion leaves a gap of `Tolerances::stop`. A contact's fraction is its time of impact.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_discrete(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                               const CharacterDef& character);

}  // namespace paperproof
