/// Which words mark what on a Tiled map; the rule is written out in tiled.hpp.
#pragma once

#include "scenes/tiled_model.hpp"

#include <string_view>

namespace paperproof::compare {

enum class TiledRole : std::uint8_t {
  unmarked,  ///< Says nothing: what is around decides.
  solid,
  one_way,
  nothing,  ///< Says that it is not solid.
};

/// By property or class.
[[nodiscard]] TiledRole role_of(const TiledMarks& marks);
/// By property, class or name.
[[nodiscard]] TiledRole role_of_layer(const TiledLayer& layer);
[[nodiscard]] bool names_spawn(std::string_view name);
[[nodiscard]] bool names_movers(std::string_view layer_name);

}  // namespace paperproof::compare
