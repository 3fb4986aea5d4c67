/// Standalone pictures as SVG: they follow the reader's colours, light or dark, and need no browser to be made.
#pragma once

#include "records/scene_result.hpp"
#include "report/chart_page.hpp"

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Error against run time and the like. Curves that a page does not show at first are left out.
[[nodiscard]] std::string svg_of(const Chart& chart);
/// A heat map with the border between cells where none is bad and cells where some are.
[[nodiscard]] std::string svg_of(const ChartGrid& grid);
/// Maps over the same axes, side by side. @param maps at least one.
[[nodiscard]] std::string svg_of_maps(const std::string& title, const std::vector<const ChartGrid*>& maps);

/// One run, in a picture of its own: the whole of a step.
struct StripPanel {
  std::string name;
  std::string words;               ///< What became of it.
  bool bad = false;                ///< Said in the colour of the words, too.
  const ReportRun* run = nullptr;  ///< None: it could not run.
};
/// All of them side by side, at the step of the first tunnel, else of the first contact.
[[nodiscard]] std::string svg_of_strip(const std::string& title, const std::vector<StripPanel>& panels);

/// Where standalone pictures go.
class PictureFolder {
 public:
  /// Makes the folder where it is missing. Throws std::filesystem::filesystem_error.
  explicit PictureFolder(std::string path);
  /// One file, named by the title; where an earlier picture has this name, with a number behind it.
  /// @return the name.
  /// @throws std::runtime_error that says in words which file could not be written and why.
  std::string write(std::string_view title, std::string_view svg);

 private:
  std::string path_;
  std::set<std::string> taken_;
};

/// A file for each chart and each heat map, and one for the heat maps of each question: those whose titles begin alike
/// up to a colon, or all of a page. Throws as `PictureFolder::write`.
/// @return their names.
std::vector<std::string> write_pictures(const ChartPage& page, PictureFolder& folder);

}  // namespace paperproof::compare
