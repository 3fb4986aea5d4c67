/// The default technique: the whole octagon is swept, so nothing slips between two points.
#pragma once

#include <paperproof/techniques.hpp>

namespace paperproof {

/// See `make_technique`. The guarantee is in the README; `octagon_sweep.cpp` has the method.
/// @throws InvalidScenery, InvalidCharacter, std::invalid_argument
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_octagon_sweep(const TechniqueDef& def,
                                                                    const Scenery<Scalar>& scenery,
                                                                    const CharacterDef& character);

}  // namespace paperproof
