/// Standalone pictures as SVG: they follow the reader's colours, light or dark, and need no browser to be made.
#pragma once

#include "records/scene_result.hpp"
#include "report/chart_page.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Error against run time and the like. Curves that a page does not show at first are left out.
[[nodiscard]] std::string svg_of(const Chart& chart);
/// A heat map with the border between cells where none is bad and cells where some are.
[[nodiscard]] std::string svg_of(const ChartGrid& grid);

/// One run, in a picture of its own: the whole of a step.
struct StripPanel {
  std::string name;
  std::string words;               ///< What became of it.
  bool bad = false;                ///< Said in the colour of the words, too.
  const ReportRun* run = nullptr;  ///< None: it could not run.
};
/// All of them side by side, at the step of the first tunnel, else of the first contact.
[[nodiscard]] std::string svg_of_strip(const std::string& title, const std::vector<StripPanel>& panels);

/// Writes a file for each chart and each heat map into the folder, which is made where it is missing.
/// @return their names.
/// @throws std::runtime_error that says in words which file could not be written and why.
std::vector<std::string> write_pictures(const ChartPage& page, const std::string& folder);

/// One file. @param title words that become its name.
/// @return the name.
std::string write_picture(const std::string& title, std::string_view svg, const std::string& folder);

}  // namespace paperproof::compare
