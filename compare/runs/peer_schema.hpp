/// `compare/peers/paperproof_peer.schema.json`, embedded at build time (see embed.cmake).
#pragma once

#include <string_view>

namespace paperproof::compare::peer_schema {

extern const std::string_view paperproof_peer_schema_json;

}  // namespace paperproof::compare::peer_schema
