/// Tables for a terminal: columns as data, over lines of anything.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// What a table says in one place; nothing is shown as "-".
using Cell = std::optional<std::string>;

template <class Line>
struct Column {
  std::string heading;
  std::function<Cell(const Line&)> cell;
  bool trouble = false;   ///< Left out where it is zero for everyone.
  std::string meaning{};  ///< For a legend below the table; empty where the heading says it.
};

struct Table {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> lines;  ///< As many cells as the heading in each.
};

/// For a terminal: two spaces between columns, each line with its line feed. A column is aligned to the right where a
/// cell begins with a number.
[[nodiscard]] std::string text_of(const Table& table);

/// The columns that say something of a line.
template <class Line>
[[nodiscard]] std::vector<Column<Line>> shown(const std::vector<Line>& lines, std::vector<Column<Line>> columns) {
  std::erase_if(columns, [&](const Column<Line>& column) {
    return std::ranges::none_of(lines, [&](const Line& line) {
      const Cell cell = column.cell(line);
      return cell && !(column.trouble && *cell == "0");
    });
  });
  return columns;
}

/// Lines in those columns that say something of any.
template <class Line>
[[nodiscard]] Table table_of(const std::vector<Line>& lines, const std::vector<Column<Line>>& columns) {
  Table table{{}, std::vector<std::vector<std::string>>(lines.size())};
  for (const Column<Line>& column : shown(lines, columns)) {
    table.heading.push_back(column.heading);
    for (std::size_t i = 0; i < lines.size(); ++i) table.lines[i].push_back(column.cell(lines[i]).value_or("-"));
  }
  return table;
}

/// The same for a terminal.
template <class Line>
[[nodiscard]] std::string view(const std::vector<Line>& lines, const std::vector<Column<Line>>& columns) {
  return text_of(table_of(lines, columns));
}

/// What there is of a key, in the order in which keys came; made where there is nothing yet.
template <class Value>
[[nodiscard]] Value& entry_of(std::vector<std::pair<std::string, Value>>& all, const std::string& key) {
  const auto found = std::ranges::find(all, key, &std::pair<std::string, Value>::first);
  return found != all.end() ? found->second : all.emplace_back(key, Value{}).second;
}

}  // namespace paperproof::compare
