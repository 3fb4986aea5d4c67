#include "scenes/load.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "near_names.hpp"
#include "scenes/input_error.hpp"
#include "scenes/json_scene.hpp"
#include "scenes/json_text.hpp"
#include "scenes/picture_map.hpp"
#include "scenes/sets.hpp"
#include "scenes/supertux.hpp"
#include "scenes/tiled.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {

namespace {

Scene load_built_in(const BuiltInScene& entry) {
  Scene scene = entry.make();
  scene.name = entry.name;
  scene.description = entry.description;
  check_scenery(scene.scenery, scene.ids, [&](ColliderIndex) { return entry.name; });
  for (std::size_t k = 0; k < character_count(scene); ++k) check_start(scene, entry.name, "", k);
  return scene;
}

/// A scene and a Tiled map both end in .json.
Scene load_json(const std::string& path) {
  const nlohmann::json document = parse_json(read_file(path, path), path);
  const bool is_map = document.is_object() && !document.contains("paperproof_scene") && document.contains("layers");
  return is_map ? read_tiled_json(document, path, path) : read_json_scene(document, path, path);
}

[[noreturn]] void refuse_unknown(const std::string& name) {
  std::vector<std::string> known;
  for (const BuiltInScene& scene : built_in_scenes()) known.push_back(scene.name);
  for (const SceneSet& set : scene_sets()) known.push_back(set.name);
  refuse(shown(name),
         "expected the name of a built-in scene (see `paperproof list scenes`), or a file that ends in .json, .tmx, "
         ".tmj, .stl or .png" +
             did_you_mean(name, known));
}

}  // namespace

std::vector<Scene> load_scenes(const std::string& name_or_path) {
  const std::vector<BuiltInScene>& known = built_in_scenes();
  const auto built_in = std::find_if(known.begin(), known.end(), [&](const auto& s) { return s.name == name_or_path; });
  if (built_in != known.end()) return {load_built_in(*built_in)};
  if (const SceneSet* set = find_set(name_or_path)) {
    std::vector<Scene> scenes;
    for (const std::string& name : set->scenes) scenes.push_back(load_scenes(name).front());
    return scenes;
  }
  const std::string extension = std::filesystem::path(name_or_path).extension().string();
  if (extension == ".json") return {load_json(name_or_path)};
  if (extension == ".tmx" || extension == ".tmj") return {read_tiled(name_or_path, name_or_path)};
  if (extension == ".png") return {read_picture_map(name_or_path, name_or_path)};
  if (extension == ".stl") return read_supertux(name_or_path, name_or_path);
  refuse_unknown(name_or_path);
}

}  // namespace paperproof::compare
