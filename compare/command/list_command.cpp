#include "command/list_command.hpp"

#include "records/metric.hpp"
#include "records/output_file.hpp"
#include "runs/contestant.hpp"
#include "runs/knobs.hpp"
#include "runs/scene_plan.hpp"
#include "scenes/describe.hpp"
#include "scenes/load.hpp"
#include "scenes/parameters.hpp"
#include "scenes/sets.hpp"

#include <fmt/format.h>

namespace paperproof::compare {
namespace {

std::string parameter_line(const ParameterDef& def) {
  return fmt::format("  {:<26} {} to {}{}{}: {}\n", def.key, def.least, def.most, def.unit.empty() ? "" : " ", def.unit,
                     def.meaning);
}

}  // namespace

int list_command(const std::string& what) {
  std::string text;
  if (what == "contenders") {
    for (const std::string_view name : contender_names()) text += fmt::format("{}\n", name);
  } else if (what == "metrics") {
    for (const Metric& metric : metrics())
      text += fmt::format("{:<32} {:<15} {} ({})\n", metric.key, metric.unit, metric.meaning, name_of(metric.of));
  } else if (what == "knobs") {
    for (const std::string& line : describe_knobs()) text += line + '\n';
  } else if (what == "parameters") {
    for (const SceneFamily& family : scene_families()) {
      text += fmt::format("{:<28} {}\n", family.name, family.description);
      for (const ParameterDef& def : family.parameters) text += parameter_line(def);
    }
    text += fmt::format("{:<28} {}\n", "*", "every scene");
    for (const ParameterDef& def : common_parameters()) text += parameter_line(def);
  } else {
    for (const BuiltInScene& scene : built_in_scenes())
      text += fmt::format("{:<28} {}\n", scene.name, scene.description);
    for (const SceneFamily& family : scene_families())
      text += fmt::format("{:<28} {}\n", family.name, family.description);
    for (const SceneSet& set : scene_sets()) text += fmt::format("{:<28} {}\n", set.name, set.description);
  }
  print_out(text);
  return 0;
}

int check_command(const std::vector<std::string>& scenes) {
  for (const std::string& name : scenes)
    for (const Scene& scene : load_scenes(name)) print_out(describe(scene) + '\n');
  return 0;
}

int plan_command(const std::vector<std::string>& scenes, const std::optional<std::uint64_t>& seed) {
  for (const std::string& name : scenes)
    for (const Scene& scene : load_scenes(name))
      print_out(describe_plan(scene, seed ? random_script(scene, *seed, scene.steps) : script_of(scene)) + '\n');
  return 0;
}

}  // namespace paperproof::compare
