/// Reads scenes: built-in names, JSON scenes, Tiled maps, SuperTux levels, pictures.
#pragma once

#include "scenes/parameters.hpp"
#include "scenes/scene.hpp"

#include <stdexcept>
#include <string>
#include <vector>

namespace paperproof::compare {

/// Unusable input. `what()` is one line that begins with the file (or name) as the user gave it, then the line or JSON
/// pointer, then what was expected.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A built-in name, or a path that ends in .json (a scene or a Tiled map: told apart by content), .tmx, .tmj, .stl or
/// .png. The scene is complete and validated: its polygons are simple, its numbers finite, its start is free of solids
/// (exactly) unless it asks to resolve that. A SuperTux level with several sectors gives one scene per sector that has
/// solids and a spawn point, named `<level>` or `<level>/<sector>`.
/// @param settings parameters that are turned, of each scene.
/// @throws InputError
[[nodiscard]] std::vector<Scene> load_scenes(const std::string& name_or_path,
                                             std::span<const ParameterSetting> settings = {});

/// The one scene of that name. @throws InputError as well where there are several.
[[nodiscard]] Scene load_scene(const std::string& name_or_path, std::span<const ParameterSetting> settings);

/// A built-in scene: by itself, or a member of a family with these settings.
struct BuiltInScene {
  std::string name;
  std::string description;
  std::string family;  ///< Empty where it is none of a family.
  std::vector<ParameterSetting> settings;
};
/// All of them, in the order of registration.
[[nodiscard]] const std::vector<BuiltInScene>& built_in_scenes();

/// The family of a built-in member, empty where it has none; any other name as it is.
[[nodiscard]] std::string_view family_of(std::string_view scene);

}  // namespace paperproof::compare
