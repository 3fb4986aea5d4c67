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
  std::string title;            ///< What tells it from the others of the row.
  Json header;                  ///< As in a trace.
  std::vector<Json> records{};  ///< The same.
  std::vector<Json> beside{};   ///< `what`, `wanted`, `beside_another`, and `tells`, of each.
  double turned = 0;            ///< Everything, and up with it [rad].
};

/// A row in one of its cases, with all numbers computed.
struct RowCase {
  std::string title;  ///< What tells it from the others.
  Json said;
};

/// All rows of a folder. @throws std::exception that names the file.
[[nodiscard]] std::vector<Row> read_rows(const std::string& folder);

/// One for each combination of `for` and `cases`.
[[nodiscard]] std::vector<RowCase> cases_of(const Row& row);

/// One for each of its contenders. @throws std::exception for what is no row.
[[nodiscard]] std::vector<RowTrace> traces_of(const RowCase& one);

/// The header of a trace with the colliders of a row, which the rest of the row says something of.
[[nodiscard]] Json header_of(const Json& said, const std::string& contender);

/// How each mover of a header goes: as it is said to, or it rests.
[[nodiscard]] Json movers_of(const Json& said, const Json& header);

/// The path with a fraction at each corner.
[[nodiscard]] Json path_of(Json path);

/// In words what is not told as it must be, line by line.
[[nodiscard]] std::string missed(const Json& tells, const Json& told);

}  // namespace paperproof::compare::test
