/// Joints of a JSON scene.
#pragma once

#include "scenes/json_text.hpp"
#include "scenes/scene.hpp"

#include <string>

namespace paperproof::compare {

/// An entry of "joints". @param scene with its movers.
/// @throws InputError "file: /pointer: what was expected".
[[nodiscard]] Joint read_joint(const JsonCursor& entry, std::string id, const Scene& scene);

}  // namespace paperproof::compare
