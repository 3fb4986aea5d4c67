/// A row of a table: a trace that is made by hand, and what the judge must tell of its steps. README.md has the
/// notation.
#pragma once

#include "scenes/json_text.hpp"

#include <ostream>
#include <string>
#include <vector>

namespace paperproof::compare::test {

struct Row {
  std::string name;  ///< With that of its file.
  Json file;         ///< What its file says for all of its rows.
  Json text;
};

/// For GoogleTest, which prints bytes otherwise.
inline void PrintTo(const Row& row, std::ostream* out) { *out << row.name; }

/// A trace, and beside each record what is no part of a trace.
struct RowTrace {
  std::string title;          ///< What tells it from the others of the row.
  Json header;                ///< As in a trace.
  std::vector<Json> records;  ///< The same.
  std::vector<Json> beside;   ///< `what`, `wanted`, `beside_another`, and `tells`, of each.
  double turned = 0;          ///< Everything, and up with it [rad].
};

/// All rows of a folder. @throws std::exception that names the file.
[[nodiscard]] std::vector<Row> read_rows(const std::string& folder);

/// One for each combination of `for`, `cases` and `contender`.
/// @throws std::exception for what is no row.
[[nodiscard]] std::vector<RowTrace> traces_of(const Row& row);

}  // namespace paperproof::compare::test
