/// What a map lacks that comes without a scene.
#pragma once

#include "scenes/scene.hpp"

namespace paperproof::compare {

inline void set_map_defaults(Scene& scene) {
  scene.steps = 3600;
  scene.character.max_fall_speed = 25;  // [m/s]; a fall down a whole level would reach 60 m/s
  scene.moves_at_random = 1;            // who stands still meets nothing
}

}  // namespace paperproof::compare
