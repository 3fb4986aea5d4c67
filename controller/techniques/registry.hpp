/// The techniques that ship. A new one is a file and a line here: `TechniqueEntry name_entry()` in the file.
#pragma once

#include <paperproof/techniques.hpp>

#define PAPERPROOF_TECHNIQUES(TECHNIQUE) \
  TECHNIQUE(grid)                        \
  TECHNIQUE(pixel_colour)                \
  TECHNIQUE(pixel_tile)                  \
  TECHNIQUE(mask)                        \
  TECHNIQUE(bounding_box)                \
  TECHNIQUE(discrete)                    \
  TECHNIQUE(wind_back)                   \
  TECHNIQUE(penetration_resolution)      \
  TECHNIQUE(speculative_march)           \
  TECHNIQUE(speculative)                 \
  TECHNIQUE(octagon_sweep)

namespace paperproof {

#define PAPERPROOF_DECLARE(name) [[nodiscard]] TechniqueEntry name##_entry();
PAPERPROOF_TECHNIQUES(PAPERPROOF_DECLARE)
#undef PAPERPROOF_DECLARE

}  // namespace paperproof
