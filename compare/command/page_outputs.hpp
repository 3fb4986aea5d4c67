/// What every study shows: a page and standalone pictures.
#pragma once

#include "command/claimed_files.hpp"
#include "records/output_file.hpp"
#include "report/report.hpp"
#include "report/svg.hpp"

#include <filesystem>
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
  explicit PageOutputs(const PagePaths& paths) : folder_(paths.svg) {
    if (!paths.report.empty()) page_.emplace(paths.report);
    if (!folder_.empty()) std::filesystem::create_directories(folder_);
  }

  /// To be called once, last.
  void finish(const ChartPage& page) {
    if (!folder_.empty()) write_pictures(page, folder_);
    if (!page_) return;
    page_->write(html_of(page));
    page_->commit();
  }

 private:
  std::optional<OutputFile> page_;
  std::string folder_;
};

}  // namespace paperproof::compare
