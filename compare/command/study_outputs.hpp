/// What every study writes: rows and a page.
#pragma once

#include "command/claimed_files.hpp"
#include "command/page_outputs.hpp"
#include "records/rows_file.hpp"
#include "runs/environment.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <optional>
#include <string>
#include <thread>

namespace paperproof::compare {

/// Opened before the work begins. Rows in `.jsonl` are written as they come; of other files they are kept until the
/// end.
class StudyOutputs {
 public:
  /// @param rows_path empty: none. @param log_path that somebody else writes.
  StudyOutputs(const std::string& rows_path, const PagePaths& pages, const std::string& log_path = {})
      : as_lines_(rows_path.ends_with(".jsonl")), pages_((check(rows_path, pages, log_path), pages)) {
    if (!rows_path.empty()) rows_.emplace(rows_path, environment());
  }

  void add(const Row& row) { add(json_line(row_json(row))); }
  /// @param line a row, with its line feed.
  void add(const std::string& line) {
    if (!rows_) return;
    rows_->add(line);
    if (!as_lines_) kept_.push_back(nlohmann::ordered_json::parse(line));
  }

  /// To be called once, last.
  void finish(const ChartPage& page) {
    if (rows_) {
      nlohmann::ordered_json document = rows_header(environment());
      document["rows"] = kept_;
      rows_->finish(document);
    }
    pages_.finish(page);
  }

 private:
  /// No two outputs may be one file.
  static void check(const std::string& rows_path, const PagePaths& pages, const std::string& log_path) {
    ClaimedFiles files;
    files.claim_for_option("--rows", rows_path);
    files.claim_for_option("--report", pages.report);
    files.claim_for_option("--log", log_path);
  }

  bool as_lines_;
  std::optional<RowsFile> rows_;
  PageOutputs pages_;
  nlohmann::ordered_json kept_ = nlohmann::ordered_json::array();
};

/// @param wanted 0: one for each core.
[[nodiscard]] inline int processes_for(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace paperproof::compare
