#include "scenes/load.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "near_names.hpp"
#include "records/case.hpp"
#include "scenes/built_in.hpp"
#include "scenes/input_error.hpp"
#include "scenes/json_scene.hpp"
#include "scenes/json_text.hpp"
#include "scenes/picture.hpp"
#include "scenes/supertux.hpp"
#include "scenes/tiled.hpp"
#include "scenes/validate.hpp"
#include "scenes/write_json.hpp"

namespace paperproof::compare {

namespace {

/// All parameters of a family: the last value of each that is set, and the usual value of each other.
std::vector<ParameterSetting> values_of(const SceneFamily& family, std::span<const ParameterSetting> settings) {
  std::vector<ParameterSetting> values;
  for (const ParameterDef& def : family.parameters) {
    values.push_back({std::string(def.key), def.usual});
    for (const ParameterSetting& setting : settings)
      if (setting.key == def.key) values.back().value = setting.value;
  }
  return values;
}

/// @param entry nothing for a family by its own name. @param family that it is of, or nothing.
Scene load_built_in(const std::optional<BuiltInScene>& entry, const std::optional<SceneFamily>& family,
                    std::span<const ParameterSetting> more) {
  std::vector<ParameterSetting> settings;
  if (entry) settings = entry->settings;
  settings.insert(settings.end(), more.begin(), more.end());
  const auto values = family ? values_of(*family, settings) : std::vector<ParameterSetting>{};
  Scene scene = built_in_scene(family ? family->name : entry->name, values);
  scene.name = entry ? entry->name : family->name;
  scene.description = entry ? entry->description : family->description;
  for (std::size_t i = 0; i < values.size(); ++i)
    scene.parameters.emplace_back(row_key(family->parameters[i]), values[i].value);
  return scene;
}

/// What every scene has, behind its own.
void note_parameters(Scene& scene) {
  const auto note = [&](const std::string& key, double value) {
    const auto known = std::find_if(scene.parameters.begin(), scene.parameters.end(),
                                    [&](const auto& each) { return each.first == key; });
    if (known == scene.parameters.end())
      scene.parameters.emplace_back(key, value);
    else
      known->second = value;
  };
  note("dt_s", scene.dt);
  note("gravity_m_s2", 0.0 - scene.gravity.y());
  note("speed_m_s", scene.start.velocity.norm());
}

/// A scene and a Tiled map both end in .json.
Scene load_json(const std::string& path) {
  const Json document = parse_json(read_file(path, path), path);
  const bool is_map = document.is_object() && !document.contains("paperproof_scene") && document.contains("layers");
  return is_map ? read_tiled_json(document, path, path) : read_json_scene(document, path, path);
}

[[noreturn]] void refuse_unknown(const std::string& name) {
  std::vector<std::string> known;
  for (const BuiltInScene& scene : built_in_scenes()) known.push_back(scene.name);
  for (const SceneFamily& family : scene_families()) known.emplace_back(family.name);
  for (const SceneSet& set : scene_sets()) known.push_back(set.name);
  refuse(shown(name),
         "expected the name of a built-in scene (see `paperproof list scenes`), or a file that ends in .json, .tmx, "
         ".tmj, .stl or .png" +
             did_you_mean(name, known));
}

/// Of a built-in scene as JSON; of its name where the format cannot say it.
std::string hash_of_scene(const Scene& scene) {
  try {
    return hash_of(scene_json(scene).dump());
  } catch (const InputError&) {
    return hash_of(scene.name);
  }
}

std::vector<Scene> load_files(const std::string& name_or_path) {
  const std::string extension = std::filesystem::path(name_or_path).extension().string();
  if (extension == ".json") return {load_json(name_or_path)};
  if (extension == ".tmx" || extension == ".tmj") return {read_tiled(name_or_path, name_or_path)};
  if (extension == ".png") return {read_picture_map(name_or_path, name_or_path)};
  if (extension == ".stl") return read_supertux(name_or_path, name_or_path);
  refuse_unknown(name_or_path);
}

}  // namespace

std::vector<Scene> load_scenes(const std::string& name_or_path, std::span<const ParameterSetting> settings) {
  for (const ParameterSetting& setting : settings) check_setting(name_or_path, setting);
  std::vector<Scene> scenes;
  if (const auto set = find_set(name_or_path)) {
    for (const std::string& name : set->scenes) scenes.push_back(load_scene(name, settings));
    return scenes;
  }
  const std::optional<BuiltInScene> built_in = find_built_in(name_or_path);
  const std::optional<SceneFamily> family = find_family(family_of(name_or_path));
  const bool is_ours = built_in || family;
  if (is_ours)
    scenes.push_back(load_built_in(built_in, family, settings));
  else
    scenes = load_files(name_or_path);
  const std::string file =
      is_ours ? "" : fmt::format("{}#{}", name_or_path, hash_of(read_file(name_or_path, name_or_path)));
  for (Scene& scene : scenes) {
    scene.given = name_or_path;
    for (const ParameterSetting& setting : settings)
      if (!family || find_parameter(family->parameters, setting.key) == nullptr) turn(scene, setting);
    note_parameters(scene);
    scene.source = is_ours ? fmt::format("builtin:{}#{}", name_or_path, hash_of_scene(scene)) : file;
    if (!settings.empty()) check_scene(scene, name_or_path);
  }
  return scenes;
}

Scene load_scene(const std::string& name_or_path, std::span<const ParameterSetting> settings) {
  std::vector<Scene> scenes = load_scenes(name_or_path, settings);
  if (scenes.size() != 1) refuse(name_or_path, "expected one scene, not " + std::to_string(scenes.size()));
  return std::move(scenes.front());
}

}  // namespace paperproof::compare
