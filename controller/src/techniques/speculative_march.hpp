/// The article's speculative contacts as written: each pair advances along the movement vector one unit at a time, with
/// a last shorter step to its end; at a collision it goes back by one unit, or does nothing where there was no advance
/// yet; only the component of the pair's direction changes. Then penetration resolution; all iterated.
///
/// "If there was already a collision at the starting position, we do nothing": read as no backtracking. The free part
/// of the movement is nothing, so the pair's component becomes zero as after any other hit, and penetration resolution
/// takes the pair out. The article resolves object by object; the search along the vector is over all objects that are
/// near, since the first of them is what the pair reaches. After a hit nothing is left of the frame's movement, so a
/// further iteration has nothing to search: it resolves what the last one pushed into something else.
///
/// A polygon is met where a point is inside it after a step: what is thinner than a unit can be missed. A chain is met
/// where a step of a point crosses it. A contact's fraction is where the pair was last free: up to a unit too early.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_speculative_march(const TechniqueDef& def,
                                                                        const Scenery<Scalar>& scenery,
                                                                        const CharacterDef& character);

}  // namespace paperproof
