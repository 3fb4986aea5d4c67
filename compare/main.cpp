/// The command `paperproof`.
#include "command/compare_command.hpp"
#include "command/complain.hpp"
#include "command/convert_command.hpp"
#include "command/demo_command.hpp"
#include "command/option_checks.hpp"
#include "command/precision_command.hpp"
#include "command/rows_command.hpp"
#include "command/study_command.hpp"
#include "command/sweep_command.hpp"
#include "records/output_file.hpp"
#include "runs/scene_plan.hpp"
#include "scenes/describe.hpp"
#include "scenes/load.hpp"
#include "scenes/sets.hpp"
#include "studies/scale.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <optional>
#include <sstream>

namespace {

using namespace paperproof::compare;

constexpr int unusable = 2;
constexpr const char* scene_words =
    "Built-in names (see `paperproof list scenes`), .json scenes, .tmx/.tmj maps, SuperTux .stl levels, .png pictures";

/// What stands on the command line, as it stands there.
struct Words {
  CompareArguments compare;
  std::optional<std::string> input;
  std::string mode = "free";
  std::string plan;
  bool no_reference = false;
  bool no_timing = false;
  std::vector<std::string> scalars;
  std::vector<std::string> knobs;
  std::vector<std::string> settings;
  std::string what;                 ///< To list.
  std::vector<std::string> scenes;  ///< To check or to plan.
};

void add_input(CLI::App& command, Words& words) {
  command.add_option("--input", words.input, "Replaces the scene's input by one at random")->type_name("random:SEED");
}

void add_outputs(CLI::App& command, std::string& rows, std::string& report) {
  command.add_option("--rows", rows, "Write all rows to this file; .jsonl grows line by line as results come")
      ->type_name("FILE.json|.jsonl|.csv")
      ->check(expect_file_name())
      ->check(expect_rows_name());
  command.add_option("--report", report, "Write one self-contained HTML page to this file")
      ->type_name("FILE.html")
      ->check(expect_file_name());
}

void add_jobs(CLI::App& command, int& jobs) {
  command.add_option("--jobs", jobs, "Processes at a time; one for each core where it is not given")
      ->type_name("N")
      ->check(expect_whole_number(1024));
}

/// It is given or not: a value behind it is refused.
template <class Variable>
void add_flag(CLI::App& command, const std::string& name, Variable& variable, const std::string& help) {
  command.add_flag(name, variable, help)->disable_flag_override();
}

CLI::App* add_compare(CLI::App& app, Words& words) {
  CompareArguments& arguments = words.compare;
  CLI::App* command = app.add_subcommand("compare", "Run scenes, judge every step exactly, say who is right");
  command->add_option("SCENE", arguments.scenes, scene_words);
  command->add_option("--files-from", arguments.files_from, "Read further SCENEs from this file, one per line")
      ->type_name("FILE|-")
      ->check(expect_file_name());
  add_flag(*command, "--keep-going", arguments.keep_going,
           "Run the others where a SCENE cannot be used; it is a failed row, and the status is 2");
  command
      ->add_option("--contender", arguments.run.contenders,
                   "Only these and the Box2D twin (see `paperproof list contenders`), each by its own option or with "
                   "commas")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--scalar", words.scalars, "Number type of the techniques")
      ->type_name("double|float")
      ->check(expect_one_of({"double", "float"}))
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--mode", words.mode,
                   "free: each on its own; lockstep: the twin is put to the controller before each step")
      ->type_name("free|lockstep")
      ->check(expect_one_of({"free", "lockstep"}));
  command
      ->add_option("--knob", words.knobs,
                   "Turns a knob of the techniques that have it (see `paperproof list knobs`), each by its own option")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command->add_option("--set", words.settings, "Turns a parameter of the scenes (see `paperproof list parameters`)")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--steps", arguments.run.steps, "Instead of the scene's")
      ->type_name("N")
      ->check(expect_whole_number(1'000'000'000));
  add_input(*command, words);
  command->add_option("--trace", arguments.run.trace_stem, "Write STEM.<scene>.<contender>.<scalar>.jsonl")
      ->type_name("STEM")
      ->check(expect_file_name());
  add_outputs(*command, arguments.rows_path, arguments.report_path);
  command->add_option("--plan", words.plan, "full: leave nothing out, whatever the scene can need")
      ->type_name("full")
      ->check(expect_one_of({"full"}));
  add_flag(*command, "--no-reference", words.no_reference, "Without the Box2D twin");
  add_flag(*command, "--no-timing", words.no_timing, "Without measuring the cost of a step");
  add_flag(*command, "--all-tables", arguments.all_tables, "The table of every scene, where there are several");
  add_flag(*command, "--explain", arguments.explain, "Print what each contender is excused, and up to what size");
  add_flag(*command, "--quiet", arguments.quiet, "No tables, no progress");
  add_flag(*command, "--json", arguments.json, "Rows as JSON on standard output");
  return command;
}

/// What a sweep and a study prepared as one have alike.
void add_sweep_options(CLI::App& command, SweepArguments& arguments) {
  command.add_option("--contender", arguments.contenders, "Only these, each by its own option or with commas")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--scalar", arguments.scalars, "Number type of the techniques")
      ->type_name("double|float")
      ->check(expect_one_of({"double", "float"}))
      ->delimiter(',')
      ->allow_extra_args(false);
  command.add_option("--knob", arguments.knobs, "Turns a knob of the contenders that have it")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  add_outputs(command, arguments.rows_path, arguments.report_path);
  add_jobs(command, arguments.jobs);
  command.add_option("--limit", arguments.limit_s, "A case that takes longer than this fails; 60 s where not given")
      ->type_name("SECONDS")
      ->check(expect_whole_number(1'000'000));
  command.add_option("--shard", arguments.shard, "Every N-th case, from the K-th on; `merge` puts the parts together")
      ->type_name("K/N");
  add_flag(command, "--resume", arguments.resume, "Go on behind the rows that the file of --rows has");
  add_flag(command, "--quiet", arguments.quiet, "No table, no progress");
}

CLI::App* add_sweep(CLI::App& app, Words& words, SweepArguments& arguments) {
  CLI::App* command = app.add_subcommand("sweep", "Run a scene or family over ranges of its parameters");
  command->add_option("SCENE", arguments.scene, scene_words)->required();
  command->add_option("--vary", arguments.vary, "An axis: a parameter of the scene (see `list parameters`) or a knob")
      ->type_name("KEY=FIRST:LAST:logN|linN|a,b,c")
      ->allow_extra_args(false);
  command->add_option("--find-border", arguments.border, "Bisect this parameter to where a contender ceases to hold")
      ->type_name("KEY");
  command->add_option("--set", arguments.set, "A parameter that is the same in all cases")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command->add_option("--steps", arguments.steps, "Instead of the scene's")
      ->type_name("N")
      ->check(expect_whole_number(1'000'000'000));
  add_input(*command, words);
  add_sweep_options(*command, arguments);
  add_flag(*command, "--no-reference", words.no_reference, "Without Box2D, where no contender is named");
  add_flag(*command, "--no-timing", words.no_timing, "A sweep measures no costs anyway");
  return command;
}

/// A study that is a sweep prepared: a scene, with axes for each size of the grid.
struct PreparedStudy {
  const char* name;
  const char* help;
  const char* scene;
  std::vector<std::string> quick;
  std::vector<std::string> standard;
  std::vector<std::string> full;
};

const std::vector<PreparedStudy>& prepared_studies() {
  static const std::vector<PreparedStudy> all{
      {"corner",
       "Falls into wedges from 60 to 1 degrees: who ends inside",
       "wedge",
       {"angle=1:60:log8", "dt=0.016666666666666666"},
       {"angle=1:60:log30", "dt=0.004166666666666667,0.008333333333333333,0.016666666666666666,0.03333333333333333"},
       {"angle=1:120:log120", "dt=0.001:0.1:log12"}},
      {"seam",
       "Walks over flush tiles at many speeds: who snags at their seams",
       "tiles",
       {"speed=0.5:12:lin12"},
       {"speed=0.12:12:lin100"},
       {"speed=0.012:12:lin1000"}},
      {"squeeze",
       "Falls down shafts as wide as the character and a little more: who gets stuck or inside",
       "shaft",
       {"clearance=0,1e-9,1e-6,1e-3,0.05", "dt=0.016666666666666666"},
       {"clearance=0,1e-12,1e-9,2e-7,1e-6,1e-5,1e-4,1e-3,0.01,0.02,0.05", "dt=0.001:0.1:log7"},
       {"clearance=1e-9:0.1:log60", "dt=0.0001:0.1:log16"}}};
  return all;
}

/// @param bullet becomes the subcommand of that name.
/// @param prepared gets one subcommand for each of `prepared_studies`.
CLI::App* add_study(CLI::App& app, StudyArguments& arguments, PrecisionArguments& bullets, CLI::App*& bullet,
                    SweepArguments& sweep, std::vector<CLI::App*>& prepared) {
  CLI::App* command = app.add_subcommand("study", "One question over a range, as numbers and as a picture");
  command->require_subcommand(1);
  CLI::App* scale = command->add_subcommand("scale", "Cost of a step against the number of pieces, per broad phase");
  scale->add_option("--grid", arguments.grid, fmt::format("Numbers of pieces, multiples of {}", tiles_per_floor))
      ->type_name("N,...")
      ->check(expect_whole_number(most_tiles, tiles_per_floor))
      ->delimiter(',');
  add_outputs(*scale, arguments.rows_path, arguments.report_path);
  add_flag(*scale, "--quiet", arguments.quiet, "No table, no progress");
  bullet = command->add_subcommand("bullet", "Who gets through paper: rates, and the lowest speeds beside theory");
  bullet->add_option("--grid", bullets.grid, "How many cases")
      ->type_name("quick|standard|full")
      ->check(expect_one_of({"quick", "standard", "full"}));
  bullet->add_option("--contender", bullets.contenders, "Only these, each by its own option or with commas")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_jobs(*bullet, bullets.jobs);
  add_outputs(*bullet, bullets.rows_path, bullets.report_path);
  add_flag(*bullet, "--quiet", bullets.quiet, "No table, no progress");
  for (const PreparedStudy& study : prepared_studies()) {
    CLI::App* one = prepared.emplace_back(command->add_subcommand(study.name, study.help));
    one->add_option("--grid", bullets.grid, "How many cases")
        ->type_name("quick|standard|full")
        ->check(expect_one_of({"quick", "standard", "full"}));
    add_sweep_options(*one, sweep);
  }
  return scale;
}

CLI::App* add_precision(CLI::App& app, const std::string& name, const std::string& help,
                        PrecisionArguments& arguments) {
  CLI::App* command = app.add_subcommand(name, help);
  command->add_option("--contender", arguments.contenders, "Only these, each by its own option or with commas")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_outputs(*command, arguments.rows_path, arguments.report_path);
  add_flag(*command, "--quiet", arguments.quiet, "No table, no progress");
  return command;
}

SweepArguments prepared_sweep(const PreparedStudy& study, const std::string& grid, SweepArguments arguments) {
  arguments.scene = study.scene;
  arguments.vary = grid == "full" ? study.full : grid == "standard" ? study.standard : study.quick;
  return arguments;
}

std::vector<std::string> without_repeats(const std::vector<std::string>& names) {
  std::vector<std::string> once;
  for (const std::string& name : names)
    if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
  return once;
}

std::string parameter_line(const ParameterDef& def) {
  return fmt::format("  {:<26} {} to {}{}{}: {}\n", def.key, def.least, def.most, def.unit.empty() ? "" : " ", def.unit,
                     def.meaning);
}

void print_list(const std::string& what) {
  std::string text;
  if (what == "contenders") {
    for (const std::string_view name : contender_names()) text += fmt::format("{}\n", name);
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
}

void check(const std::vector<std::string>& scenes) {
  for (const std::string& name : scenes)
    for (const Scene& scene : load_scenes(name)) print_out(describe(scene) + '\n');
}

void print_plans(const std::vector<std::string>& scenes, const std::optional<std::uint64_t>& seed) {
  for (const std::string& name : scenes)
    for (const Scene& scene : load_scenes(name))
      print_out(describe_plan(scene, seed ? random_script(scene, *seed, scene.steps) : script_of(scene)) + '\n');
}

CompareArguments compare_arguments(const Words& words, const std::optional<std::uint64_t>& seed) {
  CompareArguments arguments = words.compare;
  arguments.run.random_input = seed;
  arguments.run.full_plan = words.plan == "full";
  arguments.run.reference = !words.no_reference;
  arguments.run.measure_cost = !words.no_timing;
  arguments.run.mode = words.mode == "lockstep" ? Mode::lockstep : Mode::free;
  if (!words.scalars.empty()) arguments.run.scalars.clear();
  for (const std::string& scalar : without_repeats(words.scalars))
    arguments.run.scalars.push_back(scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64);
  arguments.run.contenders = without_repeats(arguments.run.contenders);
  for (const std::string& setting : words.settings) arguments.settings.push_back(parse_setting(setting));
  arguments.run.knobs = parse_knobs(words.knobs, arguments.run.contenders);
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
  if (names.empty()) return fmt::format("paperproof: {}; see {} --help", reason_of(error, *last), called);
  return fmt::format("{}: expected one of {}; see {} --help", called, names, called);
}

int refuse(const std::string& reason) {
  complain(reason);
  return unusable;
}

/// What a file is opened as must not be what is printed to: a standard stream that the caller has closed takes the
/// first descriptor that is free, and reads nothing and refuses what is written.
void hold_standard_streams() {
  for (int descriptor = 0; descriptor <= 2; ++descriptor)
    if (fcntl(descriptor, F_GETFD) == -1 && open("/dev/null", O_RDONLY) != descriptor) std::abort();
}

/// Ends as everyone does whose pipe is closed, once nothing half-written is left behind.
int end_quietly() {
  std::signal(SIGPIPE, SIG_DFL);
  std::raise(SIGPIPE);
  return 128 + SIGPIPE;
}

int run(int argc, char** argv) {
  CLI::App app{"A 2D kinematic character controller beside Box2D, judged by exact arithmetic"};
  app.set_version_flag("--version", PAPERPROOF_VERSION);
  app.require_subcommand(1);
  Words words;
  const CLI::App* comparing = add_compare(app, words);
  StudyArguments study_arguments;
  PrecisionArguments bullet_arguments;
  CLI::App* bullet = nullptr;
  SweepArguments prepared_arguments;
  std::vector<CLI::App*> prepared;
  const CLI::App* scale = add_study(app, study_arguments, bullet_arguments, bullet, prepared_arguments, prepared);
  SweepArguments sweep_arguments;
  const CLI::App* sweeping = add_sweep(app, words, sweep_arguments);
  PrecisionArguments precision_arguments;
  CLI::App* precision = add_precision(app, "work-precision", "Error against run time, for motions known in closed form",
                                      precision_arguments);
  precision->add_option("MOTION", precision_arguments.motions, "Only these (without any: all)");
  CLI::App* stability = add_precision(app, "stability", "Stiff and extreme cases: where each side holds, and where not",
                                      precision_arguments);
  add_jobs(*stability, precision_arguments.jobs);
  CLI::App* merging = app.add_subcommand("merge", "Put rows of several files together: shards of a sweep, or any");
  std::vector<std::string> merged;
  std::string merged_path;
  merging->add_option("ROWS", merged, "Files of rows, .jsonl")->required();
  merging->add_option("--rows", merged_path, "Where they go")->required()->type_name("FILE.jsonl");
  CLI::App* differing = app.add_subcommand("diff", "Name what changed between two files of rows, costs apart");
  std::vector<std::string> differed;
  differing->add_option("ROWS", differed, "Two files of rows, .jsonl: before and after")->required()->expected(2);
  CLI::App* demo = app.add_subcommand("demo", "The article's bullet, one technique at a time, in the terminal");
  std::string shown_technique;
  demo->add_option("TECHNIQUE", shown_technique, "Only this one");
  CLI::App* converting = app.add_subcommand("convert", "Write a map or a built-in scene as a JSON scene");
  std::string converted_from;
  std::string converted_to;
  converting->add_option("SCENE", converted_from, scene_words)->required();
  converting->add_option("OUT", converted_to, "Where it goes")->required()->type_name("OUT.json");
  CLI::App* list = app.add_subcommand("list", "Names, one per line");
  list->add_option("WHAT", words.what, "Which names")
      ->required()
      ->type_name("scenes|contenders|knobs|parameters")
      ->check(expect_one_of({"scenes", "contenders", "knobs", "parameters"}));
  CLI::App* checking = app.add_subcommand("check", "Validate scenes and say what is in them");
  checking->add_option("SCENE", words.scenes, scene_words)->required();
  CLI::App* planning = app.add_subcommand("plan", "Say what scenes cannot need and runs therefore leave out, and why");
  planning->add_option("SCENE", words.scenes, scene_words)->required();
  add_input(*planning, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    std::ostringstream text;
    const int status = app.exit(wanted, text, text);
    print_out(text.str());
    return status;
  } catch (const CLI::ParseError& error) {
    return refuse(refusal(app, error));
  }
  if (comparing->parsed() && words.compare.scenes.empty() && words.compare.files_from.empty())
    return refuse("paperproof: SCENE is required; see paperproof compare --help");
  std::optional<std::uint64_t> seed;
  if (words.input) seed = parse_random_input(*words.input);
  if (comparing->parsed()) return compare_scenes(compare_arguments(words, seed));
  for (std::size_t k = 0; k < prepared.size(); ++k)
    if (prepared[k]->parsed())
      return sweep_command(prepared_sweep(prepared_studies()[k], bullet_arguments.grid, prepared_arguments));
  if (bullet->parsed()) return study_bullet_command(bullet_arguments);
  if (scale->parsed()) return study_scale_command(study_arguments);
  if (sweeping->parsed()) {
    sweep_arguments.seed = seed;
    sweep_arguments.reference = !words.no_reference;
    sweep_arguments.contenders = without_repeats(sweep_arguments.contenders);
    sweep_arguments.scalars = without_repeats(sweep_arguments.scalars);
    return sweep_command(sweep_arguments);
  }
  if (precision->parsed()) return work_precision_command(precision_arguments);
  if (stability->parsed()) return stability_command(precision_arguments);
  if (differing->parsed()) return diff_command(differed[0], differed[1]);
  if (converting->parsed()) return convert_command(converted_from, converted_to);
  if (demo->parsed()) return demo_command(shown_technique);
  if (merging->parsed()) return merge_command(merged, merged_path);
  if (list->parsed()) print_list(words.what);
  if (checking->parsed()) check(words.scenes);
  if (planning->parsed()) print_plans(words.scenes, seed);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  hold_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
  try {
    return run(argc, argv);
  } catch (const ClosedPipe&) {
    return end_quietly();
  } catch (const std::bad_alloc&) {
    return refuse("paperproof: there is not enough memory for what was asked");
  } catch (const std::exception& error) {
    return refuse(error.what());
  }
}
