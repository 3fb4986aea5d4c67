/// The article's primitive: the whole position is wound back along the movement, one unit at a time, until it is free.
///
/// Every collision point is tested, at the positions it looks at and nowhere between: paper is passed, and a chain,
/// which has no inside, is never met. There is one pass and no iteration; the knobs `pairs`, `response` and
/// `iterations` have no meaning here. A start that collides is where winding back ends: it stays there, and says that
/// it is stuck. As the whole vector is shortened, a walker sticks to the floor that gravity pulls it into.
///
/// A contact names the point that was inside last; its fraction is where the position was wound back to.
#pragma once

#include <paperproof/techniques.hpp>

#include <memory>

namespace paperproof {

/// @param def its article knobs are valid. `scenery` must outlive the technique.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_wind_back(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                                const CharacterDef& character);

}  // namespace paperproof
