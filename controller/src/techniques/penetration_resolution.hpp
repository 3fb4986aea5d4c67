/// The article's penetration resolution: where the character arrives, pair by pair, the movement is adjusted by one
/// unit until the pair is free; iterated. In-between positions are never looked at: paper is passed, and a chain, which
/// has no inside, is never met. On the floor it shifts between two positions a unit apart: the jitter that the article
/// names. A contact is only known at the end of the frame: its fraction is 1.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_penetration_resolution(const TechniqueDef& def,
                                                                             const Scenery<Scalar>& scenery,
                                                                             const CharacterDef& character);

}  // namespace paperproof
