/// The files of tables/.
#pragma once

#include "records/strict_json.hpp"
#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"

#include <string>

namespace paperproof::compare {

// Tests of tables are registered before main: a string might not be made by then.
inline constexpr const char* tables = PAPERPROOF_SOURCE_DIR "/tests/compare/tables/";

[[nodiscard]] inline Json read_table(const std::string& file) {
  return strict_json(read_file(tables + file, file), file);
}

}  // namespace paperproof::compare
