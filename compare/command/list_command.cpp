#include "command/commands.hpp"

#include "campaign/families.hpp"
#include "command/progress.hpp"
#include "records/metric.hpp"
#include "records/output_file.hpp"
#include "records/rows_json.hpp"
#include "runs/contender.hpp"
#include "runs/input_cursor.hpp"
#include "runs/knobs.hpp"
#include "runs/preparation.hpp"
#include "runs/scene_plan.hpp"
#include "scenes/built_in.hpp"
#include "scenes/describe.hpp"
#include "scenes/load.hpp"
#include "scenes/parameters.hpp"

#include <fmt/format.h>

namespace paperproof::compare {
namespace {

std::string parameter_line(const ParameterDef& def) {
  return fmt::format("  {:<26} {} to {}{}{}: {}\n", def.key, def.least, def.most, def.unit.empty() ? "" : " ", def.unit,
                     def.meaning);
}

/// Why a contender cannot run a scene; empty where it can.
std::string why_not(std::string_view contender, const Scene& scene, const Scenery& scenery) {
  try {
    static_cast<void>(make_contender(contender, ScalarKind::binary64, scene, scenery));
  } catch (const std::exception& reason) {
    return reason.what();
  }
  return "";
}

/// What `compare` will do with a scene: who runs it, and why the others do not.
std::string describe_contenders(const Scene& scene) {
  constexpr double longest = 10;  // [s]; who only asks waits no longer
  const auto names = contender_names();
  const auto preparation = expected_preparation(scene, {names.begin(), names.end()}, {ScalarKind::binary64});
  if (preparation && preparation->seconds > longest)
    return fmt::format("  {:<10} about {} until the first step: who can run was not tried\n", "compare",
                       duration_in_words(preparation->seconds));
  const Scenery scenery(scene.scenery);
  const Script script = script_of(scene);
  std::string cannot_move;
  try {
    const InputCursor movers(scene, script);
  } catch (const NotApplicable& reason) {
    cannot_move = reason.what();
  }
  std::string others;
  std::size_t running = 0;
  bool is_guaranteed = false;
  for (const std::string_view name : names) {
    const std::string why = cannot_move.empty() ? why_not(name, scene, scenery) : cannot_move;
    if (why.empty()) {
      ++running;
      is_guaranteed = is_guaranteed || name == "octagon_sweep";
    } else {
      others += fmt::format("  {:<10} not {}: {}\n", "", name, why);
    }
  }
  return fmt::format("  {:<10} {} of {} contenders run{}\n{}", "compare", running, names.size(),
                     is_guaranteed ? "" : "; octagon_sweep does not, so that status 0 guarantees nothing", others);
}

}  // namespace

int list_command(const Given& given) {
  const std::string& what = given.what;
  std::string text;
  if (what == "contenders") {
    for (const std::string_view name : contender_names()) text += fmt::format("{}\n", name);
  } else if (what == "families") {
    for (const Family& family : families()) text += family.title() + "\n";
  } else if (what == "metrics") {
    for (const Metric& metric : metrics())
      text += fmt::format("{:<32} {:<15} {} ({})\n", metric.key, metric.unit, metric.meaning, name_of(metric.of));
  } else if (what == "schema") {
    text = rows_schema_text();
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

int check_command(const Given& given) {
  for (const std::string& name : given.names)
    for (const Scene& scene : load_scenes(name)) print_out(describe(scene) + describe_contenders(scene) + '\n');
  return 0;
}

int plan_command(const Given& given) {
  for (const std::string& name : given.names)
    for (const Scene& scene : load_scenes(name)) {
      const Scenery scenery(scene.scenery);
      print_out(describe_plan(scene, scenery));  // before the saving is measured, which may take long
      const Script script = given.seed ? random_script(scene, *given.seed, scene.steps) : script_of(scene);
      print_out(describe_saving(scene, scenery, script) + '\n');
    }
  return 0;
}

}  // namespace paperproof::compare
