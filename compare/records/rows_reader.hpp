/// Reads files of rows. Each is held against `paperproof_rows.schema.json`.
#pragma once

#include "records/rows_json.hpp"

#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <string>

namespace paperproof::compare {

/// The most that is read of a `.jsonl` file of rows, of one row of it, and of a `.json` file, which is in memory as a
/// whole [bytes]. Small: a large sweep does not fit. Large: a hostile file decides how much memory is used.
inline constexpr std::uintmax_t most_row_lines_bytes = 4'000'000'000;
inline constexpr std::size_t most_row_bytes = 4'000'000;
inline constexpr std::uintmax_t most_rows_json_bytes = 256'000'000;

/// A row of a file.
struct RowLine {
  std::string text;  ///< As it stands there, with its line feed.
  Row row;
};

/// Rows of a `.jsonl` file, one after the other.
class RowsReader {
 public:
  /// What a killed run leaves behind: a last line that is no whole row.
  enum class LastLine : std::uint8_t {
    whole,       ///< One that is cut short is an error. One that only lacks its line feed is a row.
    may_be_cut,  ///< One without its line feed, or that is no JSON, is passed over: see `cut_line`.
  };
  /// @throws std::runtime_error naming the file: it is no regular file, larger than `most_row_lines_bytes`, cannot be
  /// read, or does not begin with a header of rows.
  explicit RowsReader(const std::string& path, LastLine last = LastLine::whole);
  [[nodiscard]] const nlohmann::ordered_json& header() const noexcept { return header_; }
  /// The next row; nothing at the end.
  /// @throws std::runtime_error naming file, line and key where a line is no row.
  [[nodiscard]] std::optional<RowLine> next();
  /// Where the lines end that were read so far and have an end [bytes].
  [[nodiscard]] std::uintmax_t end() const noexcept { return end_; }
  /// The last line that was passed over, from 1; 0 for none.
  [[nodiscard]] std::size_t cut_line() const noexcept { return cut_line_; }

 private:
  enum class Found : std::uint8_t { nothing, cut, line };
  [[nodiscard]] Found read_line(std::string& line);
  [[nodiscard]] std::string here() const { return path_ + ":" + std::to_string(line_); }

  std::string path_;
  LastLine last_;
  std::ifstream stream_;
  nlohmann::ordered_json header_;
  std::uintmax_t end_ = 0;
  std::size_t line_ = 0;
  std::size_t cut_line_ = 0;
};

/// Calls `visit(row)` for every row of a file, JSON or JSON Lines by its name.
/// @return the header.
/// @throws std::runtime_error as RowsReader does.
nlohmann::ordered_json for_each_row(const std::string& path, const std::function<void(Row row)>& visit);

}  // namespace paperproof::compare
