/// The sweeps behind `study corner`, `study seam` and `study squeeze`.
#pragma once

#include <string>
#include <vector>

namespace paperproof::compare {

/// A sweep that is prepared: a scene, with axes for each size of the grid.
struct PreparedSweep {
  const char* name;
  const char* help;
  const char* scene;
  std::vector<std::string> quick;
  std::vector<std::string> standard;
  std::vector<std::string> full;
};

[[nodiscard]] const std::vector<PreparedSweep>& prepared_sweeps();

}  // namespace paperproof::compare
