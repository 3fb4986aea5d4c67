/// What a map lacks that comes without a scene.
#pragma once

#include "scenes/scene.hpp"

#include <fmt/format.h>

namespace paperproof::compare {

/// @param scene has its scale.
inline void set_map_defaults(Scene& scene) {
  scene.steps = 3600;
  scene.character.max_fall_speed = 25;  // [m/s]; a fall down a whole level would reach 60 m/s
  scene.moves_at_random = 1;            // a character that stands still meets nothing
  // Where a slope or a floor is drawn by hand its ends lie on whole or half pixels: beside its neighbour, which is off
  // by as much, there is a kerb of up to a pixel. Without a step height 6 mm hold a walker up for ever.
  scene.character.step_height = 1 / scene.pixels_per_metre;
  scene.description =
      fmt::format("its character climbs kerbs up to a pixel of the map ({:.4g} m)", scene.character.step_height);
}

}  // namespace paperproof::compare
