/// Reads the project's own scene files; `paperproof_scene.schema.json` beside this file describes them key by key.
#pragma once

#include "scenes/json_text.hpp"
#include "scenes/scene.hpp"

#include <string>

namespace paperproof::compare {

/// @param document the parsed file. @param path where it lies: references to maps are relative to it.
/// @param given the file as the user named it, for messages.
/// @throws InputError "file: /pointer: what was expected".
[[nodiscard]] Scene read_json_scene(const Json& document, const std::string& path, const std::string& given);

}  // namespace paperproof::compare
