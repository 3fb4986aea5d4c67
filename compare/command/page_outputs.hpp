/// What every study shows: a page and standalone pictures.
#pragma once

#include "command/cell_replays.hpp"
#include "command/claimed_files.hpp"
#include "records/output_file.hpp"
#include "report/report.hpp"
#include "report/svg.hpp"

#include <optional>
#include <string>

namespace paperproof::compare {

/// Where the pictures of a command go, as typed.
struct PagePaths {
  std::string report;  ///< A page; empty: none.
  std::string svg;     ///< A folder of standalone pictures; empty: none.
  [[nodiscard]] bool wanted() const { return !report.empty() || !svg.empty(); }
};

/// Opened before the work begins, so that what cannot be written is known before. Throws what OutputFile throws.
class PageOutputs {
 public:
  explicit PageOutputs(const PagePaths& paths) {
    if (!paths.report.empty()) page_.emplace(paths.report);
    if (!paths.svg.empty()) pictures_.emplace(paths.svg);
  }

  /// To be called once, last. The page gets replays of its cells. @param jobs processes that run their cases again; 0:
  /// one for each core.
  void finish(ChartPage page, int jobs = 0) {
    if (pictures_) write_pictures(page, *pictures_);
    if (!page_) return;
    add_cell_replays(page, jobs);
    page_->write(html_of(page));
    page_->commit();
  }

 private:
  std::optional<OutputFile> page_;
  std::optional<PictureFolder> pictures_;
};

}  // namespace paperproof::compare
