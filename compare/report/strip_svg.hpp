/// One step of one scene as a standalone picture, which follows the reader's colours, light or dark.
#pragma once

#include "records/scene_result.hpp"

#include <string>
#include <vector>

namespace paperproof::compare {

/// One run, in a picture of its own: the whole of a step.
struct StripPanel {
  std::string name;
  std::string words;               ///< What became of it.
  bool bad = false;                ///< Said in the colour of the words, too.
  const ReportRun* run = nullptr;  ///< None: it could not run.
};

/// All of them side by side as SVG, at the step of the first tunnel, else of the first contact.
[[nodiscard]] std::string svg_of_strip(const std::string& title, const std::vector<StripPanel>& panels);

}  // namespace paperproof::compare
