#include "records/rows_reader.hpp"

#include "records/input_file.hpp"
#include "records/strict_json.hpp"

#include <stdexcept>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// @param definition see `Schema::fault`. @param where file, and line where there is one.
void hold_to_schema(const ordered_json& value, const std::string& definition, const std::string& where) {
  if (const std::optional<std::string> fault = rows_schema().fault(value, definition))
    throw std::runtime_error(where + ": " + *fault);
}

bool is_of_rows(const ordered_json& header) {
  return header.is_object() && header.contains("paperproof_rows") && header["paperproof_rows"] == 1;
}

}  // namespace

RowsReader::RowsReader(const std::string& path, LastLine last)
    : path_(path), last_(last), stream_(open_input(path, most_row_lines_bytes)) {
  std::string line;
  if (read_line(line) != Found::nothing) header_ = ordered_json::parse(line, nullptr, false);
  if (!is_of_rows(header_) || header_.contains("rows"))
    throw std::runtime_error(path +
                             ": expected rows as JSON Lines, as `--rows FILE.jsonl` writes them "
                             "(`\"paperproof_rows\": 1` in the first line)");
  hold_to_schema(strict_json(line, path_), "", here());
}

std::optional<RowLine> RowsReader::next() {
  std::string line;
  const Found found = read_line(line);
  const bool is_last = found == Found::cut || stream_.peek() == std::ifstream::traits_type::eof();
  if (found == Found::nothing) return std::nullopt;
  if (is_last && (!ordered_json::accept(line) || (found == Found::cut && last_ == LastLine::may_be_cut))) {
    if (last_ == LastLine::whole)
      throw std::runtime_error(here() +
                               ": expected a whole row; this last one is cut short, as a run that is killed leaves it "
                               "(`--resume` computes it again)");
    cut_line_ = line_;
    if (found == Found::line) end_ -= line.size();
    return std::nullopt;
  }
  const ordered_json row = strict_json(line, path_, line_);
  hold_to_schema(row, "row", here());
  if (found == Found::cut) line += '\n';
  return RowLine{std::move(line), row_of(row)};
}

RowsReader::Found RowsReader::read_line(std::string& line) {
  ++line_;
  std::streambuf& from = *stream_.rdbuf();
  constexpr int no_more = std::ifstream::traits_type::eof();
  for (int c = from.sbumpc(); c != no_more; c = from.sbumpc()) {
    line += static_cast<char>(c);
    if (line.size() > most_row_bytes)
      throw std::runtime_error(here() + ": expected lines of at most " + std::to_string(most_row_bytes / 1'000'000) +
                               " MB");
    if (c != '\n') continue;
    end_ += line.size();
    return Found::line;
  }
  return line.empty() ? Found::nothing : Found::cut;
}

ordered_json for_each_row(const std::string& path, const std::function<void(Row row)>& visit) {
  if (path.ends_with(".jsonl")) {
    RowsReader reader(path);
    while (std::optional<RowLine> line = reader.next()) visit(std::move(line->row));
    return reader.header();
  }
  ordered_json file = strict_json(read_input(path, most_rows_json_bytes), path);
  if (!is_of_rows(file) || !file.contains("rows"))
    throw std::runtime_error(path + ": expected rows as JSON (`\"paperproof_rows\": 1`)");
  hold_to_schema(file, "", path);
  for (const ordered_json& row : file["rows"]) visit(row_of(row));
  file.erase("rows");
  return file;
}

}  // namespace paperproof::compare
