/// Everything of a JSON scene that has an id: what stands, what goes along paths, bodies, and joints.
#pragma once

#include "scenes/json_text.hpp"
#include "scenes/scene.hpp"

#include <optional>
#include <string>

namespace paperproof::compare {

/// The lists of a scene.
struct JsonScenery {
  JsonCursor scenery;
  std::optional<JsonCursor> movers;
  std::optional<JsonCursor> bodies;
  std::optional<JsonCursor> joints;
  double longest_step = 0;  ///< Of the scene [s].
};

/// Fills the scene's colliders, ids, movers and joints, notes of maps, and the box of maps and pictures.
/// @param path where the file lies: references to maps and pictures are relative to it.
/// @throws InputError "file: /pointer: what was expected".
void read_json_scenery(const JsonScenery& lists, const std::string& path, Scene& scene);

}  // namespace paperproof::compare
