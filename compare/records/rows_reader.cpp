#include "records/rows_reader.hpp"

#include <stdexcept>

namespace paperproof::compare {

RowsReader::RowsReader(const std::string& path) : path_(path), stream_(path, std::ios::binary) {
  if (!stream_) throw std::runtime_error(path + ": cannot be read");
  std::string line;
  if (read_line(line)) header_ = nlohmann::ordered_json::parse(line, nullptr, false);
  if (!header_.is_object() || header_.value("paperproof_rows", 0) != 1)
    throw std::runtime_error(path + ": expected rows as JSON Lines (`\"paperproof_rows\": 1` in the first line)");
}

std::optional<std::string> RowsReader::next() {
  std::string line;
  if (!read_line(line)) return std::nullopt;
  if (!nlohmann::ordered_json::accept(line) || line.front() != '{')
    throw std::runtime_error(path_ + ":" + std::to_string(line_) + ": expected a row");
  return line;
}

nlohmann::ordered_json for_each_row(const std::string& path,
                                    const std::function<void(nlohmann::ordered_json row)>& visit) {
  if (path.ends_with(".jsonl")) {
    RowsReader reader(path);
    while (const std::optional<std::string> line = reader.next()) visit(nlohmann::ordered_json::parse(*line));
    return reader.header();
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw std::runtime_error(path + ": cannot be read");
  nlohmann::ordered_json file = nlohmann::ordered_json::parse(stream, nullptr, false);
  if (!file.is_object() || file.value("paperproof_rows", 0) != 1 || !file["rows"].is_array())
    throw std::runtime_error(path + ": expected rows as JSON (`\"paperproof_rows\": 1`)");
  for (nlohmann::ordered_json& row : file["rows"]) visit(std::move(row));
  file.erase("rows");
  return file;
}

bool RowsReader::read_line(std::string& line) {
  if (!std::getline(stream_, line) || stream_.eof()) return false;  // without its end it is not whole
  line += '\n';
  ++line_;
  end_ += line.size();
  return true;
}

}  // namespace paperproof::compare
