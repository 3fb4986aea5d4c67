/// Levels as players meet them: where a character can hang, hop, tremble or fall through.
#pragma once

#include "campaign/random.hpp"

#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>

#include <array>
#include <string_view>

namespace paperproof::compare {

enum class PlayLevel {
  gaps,       ///< Flat platforms with gaps of 0.7 to 3 m.
  kerbs,      ///< Steps of up to half a metre, up and down.
  ramps,      ///< Of 30 to 89.5 degrees, facing either way.
  funnels,    ///< Two slopes with a gap between them that may be narrower than the character.
  platforms,  ///< Random boxes, some of them turned.
  sawtooth,   ///< Notches of a walkable and a steep side.
  arches,     ///< Half circles of 4 to 33 edges.
  dead_ends,  ///< Walkable slopes into walls, some of them under a ceiling.
};

/// In the order of `PlayLevel`.
inline constexpr std::array<std::string_view, 8> play_level_names{"gaps",      "kerbs",    "ramps",  "funnels",
                                                                  "platforms", "sawtooth", "arches", "dead_ends"};

/// A closed hall from -30 to 30 m, with a floor at -12 m; a start between the walls at a height of 12 m is free.
[[nodiscard]] SceneryDef play_level(PlayLevel level, Random& random);

/// The article's octagon, a box or a triangle, each about as large.
[[nodiscard]] CharacterShape play_shape(int which);

}  // namespace paperproof::compare
