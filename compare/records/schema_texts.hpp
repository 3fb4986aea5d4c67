/// The schemas that ship, embedded at build time (see embed.cmake).
#pragma once

#include <string_view>

namespace paperproof::compare::schema_text {

extern const std::string_view paperproof_rows_schema_json;

}  // namespace paperproof::compare::schema_text
