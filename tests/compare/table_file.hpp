/// The files of tables/.
#pragma once

#include "records/strict_json.hpp"
#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"

#include <string>

namespace paperproof::compare {

inline const std::string tables = PAPERPROOF_SOURCE_DIR "/tests/compare/tables/";

[[nodiscard]] inline Json read_table(const std::string& file) {
  return strict_json(read_file(tables + file, file), file);
}

}  // namespace paperproof::compare
