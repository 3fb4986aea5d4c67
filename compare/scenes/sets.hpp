/// Sets of built-in scenes that are asked for by one name.
#pragma once

#include <string>
#include <vector>

namespace paperproof::compare {

struct SceneSet {
  std::string name;
  std::string description;
  std::vector<std::string> scenes;  ///< Names of built-in scenes.
};

[[nodiscard]] const std::vector<SceneSet>& scene_sets();

/// The set of that name; null where there is none.
[[nodiscard]] const SceneSet* find_set(const std::string& name);

}  // namespace paperproof::compare
