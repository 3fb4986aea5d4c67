/// What every study writes: rows and a page.
#pragma once

#include "command/claimed_files.hpp"
#include "command/page_output.hpp"
#include "records/rows_file.hpp"
#include "runs/environment.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace paperproof::compare {

/// No two outputs of a command may be one file.
inline void claim_outputs(const std::string& rows_path, const std::string& report_path, const std::string& log_path) {
  ClaimedFiles files;
  files.claim_for_option("--rows", rows_path);
  files.claim_for_option("--report", report_path);
  files.claim_for_option("--log", log_path);
}

/// Opened before the work begins.
class StudyOutputs {
 public:
  /// @param rows_path empty: none. @param log_path that somebody else writes.
  StudyOutputs(const std::string& rows_path, const std::string& report_path, const std::string& log_path = {})
      : rows_((claim_outputs(rows_path, report_path, log_path), rows_path), rows_header(environment())),
        page_(report_path) {}

  void add(const Row& row) { rows_.add(row); }
  /// @param line a row, with its line feed.
  void add(const std::string& line) { rows_.add(line); }

  /// To be called once, last. @param jobs see `PageOutput::finish`.
  void finish(const ChartPage& page, int jobs = 0) {
    rows_.finish();
    page_.finish(page, jobs);
  }

 private:
  RowsFile rows_;
  PageOutput page_;
};

}  // namespace paperproof::compare
