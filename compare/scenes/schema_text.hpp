/// `paperproof_scene.schema.json`, embedded at build time (see embed.cmake).
#pragma once

#include <string_view>

namespace paperproof::compare::schema_text {

extern const std::string_view paperproof_scene_schema_json;

}  // namespace paperproof::compare::schema_text
