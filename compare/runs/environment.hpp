/// What a result was made with.
#pragma once

#include "records/rows_json.hpp"

namespace paperproof::compare {

/// Versions, compiler, flags, cpu and build of this executable.
[[nodiscard]] Environment environment();

}  // namespace paperproof::compare
