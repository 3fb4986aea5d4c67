/// Scenes as JSON.
#pragma once

#include "scenes/scene.hpp"

#include <nlohmann/json_fwd.hpp>

namespace paperproof::compare {

/// A scene in the JSON format, which reads back as the same scene, bit for bit, but for the order of its colliders (what
/// stands, then movers, then bodies) and for what only maps have: they are not put back where they leave the map, and
/// their random input is written out.
/// @throws InputError for what the format cannot say: a body of several colliders, a character that is not centred.
[[nodiscard]] nlohmann::ordered_json scene_json(const Scene& scene);

}  // namespace paperproof::compare
