/// What a result was made with.
#pragma once

#include "records/rows_json.hpp"

namespace paperproof::compare {

/// Lines of code of the controller's core, without its techniques, when this was configured.
[[nodiscard]] int core_lines();

/// Versions, compiler, flags, cpu and build of this executable.
[[nodiscard]] Environment environment();

}  // namespace paperproof::compare
