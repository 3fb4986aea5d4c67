/// For the crowd, which moves each character by `octagon_sweep` among the others.
#pragma once

#include <paperproof/octagon_sweep.hpp>

namespace paperproof {

/// As `make_octagon_sweep`.
/// @param first_companion colliders from here on are other characters: they are in the way and push, and carry nobody.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_sweep_among_companions(const SweepDef& def,
                                                                             const Scenery<Scalar>& scenery,
                                                                             const CharacterDef& character,
                                                                             ColliderIndex first_companion);

}  // namespace paperproof
