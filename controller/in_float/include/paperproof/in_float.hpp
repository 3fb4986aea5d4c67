/// The step of `octagon_sweep` once more, in `float`: for studies of what rounding does. It guarantees nothing.
#pragma once

#include <paperproof/controller.hpp>

namespace paperproof {

/// A controller whose steps compute in `float`. What it wants, its sensors and its one-way chains stay in `double`.
/// @param scenery,character as of `Controller`; all coordinates are numbers that a `float` holds.
/// @throws as `Controller`.
[[nodiscard]] Controller make_controller_in_float(const Scenery& scenery, const CharacterDef& character,
                                                  const SweepDef& sweep = {});

}  // namespace paperproof
