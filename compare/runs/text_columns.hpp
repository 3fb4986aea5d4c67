/// Columns of text for a terminal.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What a table says in one place; nothing is shown as "-".
using Cell = std::optional<std::string>;

struct TextColumn {
  std::string heading;
  std::vector<Cell> cells;  ///< One per line, the same number in every column.
  bool words = false;       ///< Begins at the left; numbers end at the right.
};

/// A line of headings and one line per cell, two spaces between columns, each line with its line feed.
[[nodiscard]] std::string aligned(const std::vector<TextColumn>& columns);

}  // namespace paperproof::compare
