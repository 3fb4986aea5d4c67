/// The command `paperproof`.
#include "command/compare_command.hpp"
#include "command/study_command.hpp"
#include "runs/scene_plan.hpp"
#include "scenes/describe.hpp"
#include "scenes/load.hpp"
#include "scenes/sets.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <optional>

namespace {

using namespace paperproof::compare;

constexpr int unusable = 2;
constexpr const char* scene_words =
    "Built-in names (see `paperproof list scenes`), .json scenes, .tmx/.tmj maps, SuperTux .stl levels";

/// What stands on the command line, as it stands there.
struct Words {
  CompareArguments compare;
  std::string input;
  std::string mode = "free";
  std::string plan;
  std::vector<std::string> scalars;
  std::string what;                 ///< To list.
  std::vector<std::string> scenes;  ///< To check or to plan.
};

void add_input(CLI::App& command, Words& words) {
  command.add_option("--input", words.input, "Replaces the scene's input by one at random")->type_name("random:SEED");
}

void add_outputs(CLI::App& command, std::string& rows, std::string& report) {
  command.add_option("--rows", rows, "Write all rows as JSON to this file")->type_name("FILE.json");
  command.add_option("--report", report, "Write one self-contained HTML page to this file")->type_name("FILE.html");
}

CLI::App* add_compare(CLI::App& app, Words& words) {
  CompareArguments& arguments = words.compare;
  CLI::App* command = app.add_subcommand("compare", "Run scenes, judge every step exactly, say who is right");
  command->add_option("SCENE", arguments.scenes, scene_words)->required();
  command
      ->add_option("--contender", arguments.run.contenders,
                   "Only these and the Box2D twin (see `paperproof list contenders`), each by its own option or with "
                   "commas")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--scalar", words.scalars, "Number type of the techniques")
      ->check(CLI::IsMember({"double", "float"}))
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--mode", words.mode,
                   "free: each on its own; lockstep: the twin is put to the controller before each step")
      ->check(CLI::IsMember({"free", "lockstep"}));
  command->add_option("--steps", arguments.run.steps, "Instead of the scene's")->check(CLI::Range(1, 1'000'000'000));
  add_input(*command, words);
  command->add_option("--trace", arguments.run.trace_stem, "Write STEM.<scene>.<contender>.<scalar>.jsonl")
      ->type_name("STEM");
  add_outputs(*command, arguments.rows_path, arguments.report_path);
  command->add_option("--plan", words.plan, "full: leave nothing out, whatever the scene can need")
      ->check(CLI::IsMember({"full"}));
  command->add_flag_callback(
      "--no-reference", [&arguments] { arguments.run.reference = false; }, "Without the Box2D twin");
  command->add_flag_callback(
      "--no-timing", [&arguments] { arguments.run.measure_cost = false; }, "Without measuring the cost of a step");
  command->add_flag("--quiet", arguments.quiet, "No tables, no progress");
  command->add_flag("--json", arguments.json, "Rows as JSON on standard output");
  return command;
}

CLI::App* add_study(CLI::App& app, StudyArguments& arguments) {
  CLI::App* command = app.add_subcommand("study", "One question over a range, as numbers and as a picture");
  command->require_subcommand(1);
  CLI::App* scale = command->add_subcommand("scale", "Cost of a step against the number of pieces, per broad phase");
  scale->add_option("--grid", arguments.grid, "Numbers of pieces, multiples of 100")
      ->type_name("N,...")
      ->delimiter(',');
  add_outputs(*scale, arguments.rows_path, arguments.report_path);
  scale->add_flag("--quiet", arguments.quiet, "No table, no progress");
  return scale;
}

std::vector<std::string> without_repeats(const std::vector<std::string>& names) {
  std::vector<std::string> once;
  for (const std::string& name : names)
    if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
  return once;
}

void print_list(const std::string& what) {
  if (what == "contenders") {
    for (const std::string_view name : contender_names()) fmt::print("{}\n", name);
    return;
  }
  for (const BuiltInScene& scene : built_in_scenes()) fmt::print("{:<28} {}\n", scene.name, scene.description);
  for (const SceneSet& set : scene_sets()) fmt::print("{:<28} {}\n", set.name, set.description);
}

void check(const std::vector<std::string>& scenes) {
  for (const std::string& name : scenes)
    for (const Scene& scene : load_scenes(name)) fmt::print("{}\n", describe(scene));
}

void print_plans(const std::vector<std::string>& scenes, const std::optional<std::uint64_t>& seed) {
  for (const std::string& name : scenes)
    for (const Scene& scene : load_scenes(name))
      fmt::print("{}\n", describe_plan(scene, seed ? random_script(scene, *seed, scene.steps) : script_of(scene)));
}

CompareArguments compare_arguments(const Words& words, const std::optional<std::uint64_t>& seed) {
  CompareArguments arguments = words.compare;
  arguments.run.random_input = seed;
  arguments.run.full_plan = words.plan == "full";
  arguments.run.mode = words.mode == "lockstep" ? Mode::lockstep : Mode::free;
  if (!words.scalars.empty()) arguments.run.scalars.clear();
  for (const std::string& scalar : without_repeats(words.scalars))
    arguments.run.scalars.push_back(scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64);
  arguments.run.contenders = without_repeats(arguments.run.contenders);
  return arguments;
}

/// Why the arguments cannot be used, in one line: with the names that could stand where one is missing or unknown, or
/// with where to read on.
std::string refusal(CLI::App& app, const CLI::ParseError& error) {
  CLI::App* last = &app;
  std::string called = "paperproof";
  while (!last->get_subcommands().empty()) {
    last = last->get_subcommands().front();
    called += " " + last->get_name();
  }
  std::string names;
  for (const CLI::App* command : last->get_subcommands({})) names += (names.empty() ? "" : ", ") + command->get_name();
  if (names.empty()) return fmt::format("paperproof: {}; see {} --help\n", error.what(), called);
  return fmt::format("{}: expected one of {}; see {} --help\n", called, names, called);
}

int run(int argc, char** argv) {
  CLI::App app{"A 2D kinematic character controller beside Box2D, judged by exact arithmetic"};
  app.set_version_flag("--version", PAPERPROOF_VERSION);
  app.require_subcommand(1);
  Words words;
  const CLI::App* comparing = add_compare(app, words);
  StudyArguments study_arguments;
  const CLI::App* scale = add_study(app, study_arguments);
  CLI::App* list = app.add_subcommand("list", "Names, one per line");
  list->add_option("WHAT", words.what, "Which names")->required()->check(CLI::IsMember({"scenes", "contenders"}));
  CLI::App* checking = app.add_subcommand("check", "Validate scenes and say what is in them");
  checking->add_option("SCENE", words.scenes, scene_words)->required();
  CLI::App* planning = app.add_subcommand("plan", "Say what scenes cannot need and runs therefore leave out, and why");
  planning->add_option("SCENE", words.scenes, scene_words)->required();
  add_input(*planning, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    std::fputs(refusal(app, error).c_str(), stderr);
    return unusable;
  }
  std::optional<std::uint64_t> seed;
  if (!words.input.empty()) seed = parse_random_input(words.input);
  if (comparing->parsed()) return compare_scenes(compare_arguments(words, seed));
  if (scale->parsed()) return study_scale_command(study_arguments);
  if (list->parsed()) print_list(words.what);
  if (checking->parsed()) check(words.scenes);
  if (planning->parsed()) print_plans(words.scenes, seed);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fputs(fmt::format("{}\n", error.what()).c_str(), stderr);
    return unusable;
  }
}
