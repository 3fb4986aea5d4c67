/// `paperproof_trace.schema.json`, embedded at build time (see embed.cmake).
#pragma once

#include <string_view>

namespace paperproof::compare::trace_schema {

extern const std::string_view paperproof_trace_schema_json;

}  // namespace paperproof::compare::trace_schema
