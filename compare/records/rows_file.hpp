/// Rows in a file: JSON, JSON Lines or CSV, by its name.
#pragma once

#include "records/output_file.hpp"
#include "records/rows_json.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace paperproof::compare {

/// `.jsonl` grows in place: the header first, then a line for each row as soon as it is known, so that a kill keeps
/// what is done. `.csv` and everything else (JSON) keep their rows in memory and appear whole at the end. Not
/// thread-safe. Throws what OutputFile throws.
class RowsFile {
 public:
  /// @param path empty: nothing is written. @param header see `rows_header`.
  /// @param continued a file of JSON Lines that has its header and some rows: more are appended.
  RowsFile(const std::string& path, nlohmann::ordered_json header, bool continued = false);
  void add(const Row& row) { add(json_line(row_json(row))); }
  /// A row as it stands in a file, with its line feed.
  void add(const std::string& line);
  /// To be called once, last.
  void finish();

 private:
  enum class Format : std::uint8_t { none, json, json_lines, csv };
  [[nodiscard]] static Format format_of(const std::string& path);

  Format format_;
  nlohmann::ordered_json header_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();  ///< Of JSON and CSV.
  std::optional<OutputFile> file_;
};

/// Rows as comma-separated values (RFC 4180), a line each below the line of keys. A column stands where its key first
/// stands in a row; objects are laid out as `key.inner`, lists are joined by "; ", and what does not apply is empty.
/// The contender's column has its knobs, as `box2d[continuous=off]`. The environment of `header` stands before all, in
/// lines that begin with `#`.
[[nodiscard]] std::string rows_csv(const nlohmann::ordered_json& rows, const nlohmann::ordered_json& header);

/// A cell, within quotes where it must be. A `#` is quoted, too: behind one that is not, readers that know comments see
/// none of the line.
[[nodiscard]] std::string csv_quoted(const std::string& text);

}  // namespace paperproof::compare
