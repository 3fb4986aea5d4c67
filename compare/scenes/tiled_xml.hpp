/// TMX and TSX as Tiled's JSON, so that one reader knows what a map means.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace paperproof::compare {

/// The document that Tiled would write as JSON of the same map or tileset, as far as it is read here: members have the
/// names of the attributes, lists those of the documentation. Values of properties stay as they are written. Each
/// object has its line: see `JsonCursor::of_converted`.
/// @throws InputError "file:line: ..." for what is no XML, or no map or tileset.
[[nodiscard]] nlohmann::ordered_json read_tmx(const std::string& path, const std::string& given);
[[nodiscard]] nlohmann::ordered_json read_tsx(const std::string& path, const std::string& given);

}  // namespace paperproof::compare
