#include "runs/text_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace paperproof::compare {

std::string aligned(const std::vector<TextColumn>& columns) {
  if (columns.empty()) return "";
  std::vector<std::string> lines(columns.front().cells.size() + 1);
  for (const TextColumn& column : columns) {
    std::size_t width = column.heading.size();
    for (const Cell& cell : column.cells) width = std::max(width, cell ? cell->size() : 1);
    const auto put = [&](std::string& line, std::string_view what) {
      if (!line.empty()) line += "  ";
      line += column.words ? fmt::format("{:<{}}", what, width) : fmt::format("{:>{}}", what, width);
    };
    put(lines[0], column.heading);
    for (std::size_t i = 0; i < column.cells.size(); ++i)
      put(lines[i + 1], column.cells[i] ? std::string_view(*column.cells[i]) : "-");
  }
  std::string text;
  for (std::string& line : lines) {
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

}  // namespace paperproof::compare
