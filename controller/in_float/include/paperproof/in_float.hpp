/// The step of `octagon_sweep` once more, in `float`: for studies of what rounding does. It guarantees nothing.
#pragma once

#include <paperproof/controller.hpp>

namespace paperproof {

/// A controller that moves the character in `float`. The wanted velocity, sensors and one-way chains stay in `double`.
/// @param scenery,character as of `Controller`; all coordinates are numbers that a `float` holds.
/// @throws as `Controller`.
[[nodiscard]] Controller make_controller_in_float(const Scenery& scenery, const CharacterDef& character,
                                                  const SweepDef& sweep = {});

}  // namespace paperproof
