/// Reads files of rows.
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

namespace paperproof::compare {

/// Rows of a `.jsonl` file, one after the other. A last line without its end, which a kill leaves behind, is none.
class RowsReader {
 public:
  /// @throws std::runtime_error naming the file: it cannot be read, or does not begin with a header of rows.
  explicit RowsReader(const std::string& path);
  [[nodiscard]] const nlohmann::ordered_json& header() const noexcept { return header_; }
  /// The next row as it stands there, with its line feed; nothing at the end.
  /// @throws std::runtime_error naming file and line where a line is no JSON object.
  [[nodiscard]] std::optional<std::string> next();
  /// Where the lines end that were read so far [bytes].
  [[nodiscard]] std::uintmax_t end() const noexcept { return end_; }

 private:
  [[nodiscard]] bool read_line(std::string& line);

  std::string path_;
  std::ifstream stream_;
  nlohmann::ordered_json header_;
  std::uintmax_t end_ = 0;
  std::size_t line_ = 0;
};

/// Calls `visit(row)` for every row of a file, JSON or JSON Lines by its name.
/// @return the header.
/// @throws std::runtime_error as RowsReader does.
nlohmann::ordered_json for_each_row(const std::string& path,
                                    const std::function<void(nlohmann::ordered_json row)>& visit);

}  // namespace paperproof::compare
