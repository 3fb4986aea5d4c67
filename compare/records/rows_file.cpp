#include "records/rows_file.hpp"

#include "one_line.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

std::string text_of(const ordered_json& value) {
  if (!value.is_array())
    return value.is_string() ? value.get<std::string>()
                             : value.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
  std::string joined;
  for (const ordered_json& item : value) joined += (joined.empty() ? "" : "; ") + text_of(item);
  return joined;
}

using Cells = std::vector<std::pair<std::string, std::string>>;  ///< By key.

void flatten(const ordered_json& object, const std::string& prefix, Cells& cells) {
  for (const auto& [key, value] : object.items()) {
    if (value.is_object())
      flatten(value, prefix + key + ".", cells);
    else
      cells.emplace_back(prefix + key, text_of(value));
  }
}

/// A new key goes behind the one that it follows in its row.
void add_columns(const Cells& cells, std::vector<std::string>& columns) {
  auto next = columns.begin();
  for (const auto& [key, text] : cells) {
    const auto found = std::ranges::find(columns, key);
    next = 1 + (found != columns.end() ? found : columns.insert(next, key));
  }
}

/// As `box2d[continuous=off]`: rows that are grouped by contender do not mix up what was set differently.
ordered_json with_knobs_named(ordered_json row) {
  const std::string knob = row.value("knob", "");
  if (!knob.empty()) row["contender"] = fmt::format("{}[{}]", row.value("contender", ""), knob);
  return row;
}

/// As `# compiler: g++ 12.2`.
std::string comments_of(const ordered_json& header) {
  std::string text;
  const ordered_json environment = header.value("environment", ordered_json::object());
  for (const auto& [key, value] : environment.items())
    text += "# " + without_controls(key + ": " + text_of(value)) + "\r\n";
  return text;
}

}  // namespace

RowsFile::Format RowsFile::format_of(const std::string& path) {
  if (path.empty()) return Format::none;
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension == ".jsonl") return Format::json_lines;
  return extension == ".csv" ? Format::csv : Format::json;
}

RowsFile::RowsFile(const std::string& path, ordered_json header, bool continued)
    : format_(format_of(path)), header_(std::move(header)) {
  using Appears = OutputFile::Appears;
  if (format_ == Format::none) return;
  if (format_ != Format::json_lines) {
    file_.emplace(path, Appears::whole);
    return;
  }
  file_.emplace(path, continued ? Appears::continued : Appears::as_written);
  if (!continued) add(json_line(header_));
}

void RowsFile::add(const std::string& line) {
  if (format_ == Format::none) return;
  if (format_ != Format::json_lines) {
    rows_.push_back(ordered_json::parse(line));
    return;
  }
  file_->write(line);
  file_->flush();
}

void RowsFile::finish() {
  if (format_ == Format::none) return;
  if (format_ == Format::csv) file_->write(rows_csv(rows_, header_));
  if (format_ == Format::json) {
    header_["rows"] = std::move(rows_);
    file_->write(header_.dump(1, ' ', false, ordered_json::error_handler_t::replace) + '\n');
  }
  file_->commit();
}

std::string csv_quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n#") == std::string::npos) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

std::string rows_csv(const ordered_json& rows, const ordered_json& header) {
  std::vector<std::string> columns;
  std::vector<Cells> lines;
  for (const ordered_json& row : rows) {
    flatten(with_knobs_named(row), "", lines.emplace_back());
    add_columns(lines.back(), columns);
  }
  std::string text = comments_of(header);
  const auto add_line = [&](const auto& cell_in) {
    for (const std::string& column : columns) {
      if (column != columns.front()) text += ',';
      text += csv_quoted(cell_in(column));
    }
    text += "\r\n";
  };
  add_line([](const std::string& column) { return column; });
  for (const Cells& cells : lines)
    add_line([&](const std::string& column) {
      const auto cell = std::ranges::find(cells, column, &Cells::value_type::first);
      return cell == cells.end() ? std::string() : cell->second;
    });
  return text;
}

}  // namespace paperproof::compare
