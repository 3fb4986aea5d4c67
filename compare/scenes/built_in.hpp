/// The built-in scenes and families: the files of `built_in/`, embedded. README.md says how to add one.
#pragma once

#include "scenes/json_text.hpp"
#include "scenes/load.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// Built-in scenes that are asked for by one name.
struct SceneSet {
  std::string name;
  std::string description;
  std::vector<std::string> scenes;
};
[[nodiscard]] const std::vector<SceneSet>& scene_sets();

/// Nothing where there is none of that name.
[[nodiscard]] std::optional<BuiltInScene> find_built_in(std::string_view name);
[[nodiscard]] std::optional<SceneSet> find_set(std::string_view name);

/// What the files list under "scenes", "families", "sets" or "motions", in order.
[[nodiscard]] std::vector<const Json*> texts_of(std::string_view kind);

/// From a list as `answers` of a built-in scene, all numbers computed.
[[nodiscard]] std::vector<Answer> answers_of(const Json& texts);

/// The scene of that name, with its answers.
/// @param parameters all that it has, where it is a family.
[[nodiscard]] Scene built_in_scene(std::string_view name, std::span<const ParameterSetting> parameters);

}  // namespace paperproof::compare
