/// The article's speculative contacts with the time of impact of each point computed instead of searched: the pair
/// lands just at the edge of what it would enter. Then penetration resolution; all iterated.
///
/// The knob `unit` is left to penetration resolution. A contact's fraction is the time of impact of its point.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_speculative(const TechniqueDef& def,
                                                                  const Scenery<Scalar>& scenery,
                                                                  const CharacterDef& character);

}  // namespace paperproof
