/// The page of a study.
#pragma once

#include "command/cell_replays.hpp"
#include "records/output_file.hpp"
#include "report/report.hpp"

#include <optional>
#include <string>

namespace paperproof::compare {

/// Opened before the work begins, so that what cannot be written is known before. Throws what OutputFile throws.
class PageOutput {
 public:
  /// @param path empty: none.
  explicit PageOutput(const std::string& path) {
    if (!path.empty()) file_.emplace(path);
  }

  /// To be called once, last. The page gets replays of its cells. @param jobs processes that run their cases again; 0:
  /// one for each core.
  void finish(ChartPage page, int jobs = 0) {
    if (!file_) return;
    add_cell_replays(page, jobs);
    file_->write(html_of(page));
    file_->commit();
  }

 private:
  std::optional<OutputFile> file_;
};

}  // namespace paperproof::compare
