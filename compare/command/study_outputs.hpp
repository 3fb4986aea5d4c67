/// What every study writes: rows and a page.
#pragma once

#include "command/claimed_files.hpp"
#include "records/output_file.hpp"
#include "records/rows_file.hpp"
#include "runs/environment.hpp"
#include "report/report.hpp"

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
  /// @param rows_path,report_path empty: none. @param log_path that somebody else writes.
  StudyOutputs(const std::string& rows_path, const std::string& report_path, const std::string& log_path = {})
      : as_lines_(rows_path.ends_with(".jsonl")) {
    ClaimedFiles files;
    files.claim_for_option("--rows", rows_path);
    files.claim_for_option("--report", report_path);
    files.claim_for_option("--log", log_path);
    if (!rows_path.empty()) rows_.emplace(rows_path, environment());
    if (!report_path.empty()) report_.emplace(report_path);
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
    if (!report_) return;
    report_->write(html_of(page));
    report_->commit();
  }

 private:
  bool as_lines_;
  std::optional<RowsFile> rows_;
  std::optional<OutputFile> report_;
  nlohmann::ordered_json kept_ = nlohmann::ordered_json::array();
};

/// @param wanted 0: one for each core.
[[nodiscard]] inline int processes_for(int wanted) {
  return wanted > 0 ? wanted : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

}  // namespace paperproof::compare
