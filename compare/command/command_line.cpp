/// The subcommands with their options.
#include "command/command_line.hpp"

#include "command/campaign_command.hpp"
#include "command/compare_command.hpp"
#include "command/complain.hpp"
#include "command/convert_command.hpp"
#include "command/demo_command.hpp"
#include "command/judge_command.hpp"
#include "command/list_command.hpp"
#include "command/option_checks.hpp"
#include "command/options.hpp"
#include "command/report_command.hpp"
#include "command/rows_command.hpp"
#include "command/study_command.hpp"
#include "records/output_file.hpp"
#include "scenes/load.hpp"
#include "studies/scale.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <new>
#include <optional>
#include <sstream>

namespace {

using namespace paperproof::compare;

constexpr int unusable = 2;
constexpr const char* scene_words =
    "Built-in names (see `paperproof list scenes`), .json scenes, .tmx/.tmj maps, SuperTux .stl levels, .png pictures";

std::vector<std::string> without_repeats(const std::vector<std::string>& names) {
  std::vector<std::string> once;
  for (const std::string& name : names)
    if (std::find(once.begin(), once.end(), name) == once.end()) once.push_back(name);
  return once;
}

std::optional<std::uint64_t> seed_of(const std::optional<std::string>& input) {
  return input ? std::optional(parse_random_input(*input)) : std::nullopt;
}

/// Runs a command when its options are parsed, and keeps its exit status.
/// @param arguments live as long as the command.
template <class Arguments, class Command>
void on_parsed(CLI::App& app, int& status, std::shared_ptr<Arguments> arguments, Command command) {
  app.callback([&status, arguments = std::move(arguments), command] { status = command(*arguments); });
}

/// Options of `compare` as typed.
struct CompareWords {
  CompareArguments arguments;
  std::optional<std::string> input;
  std::string mode = "free";
  std::string plan;
  bool no_reference = false;
  bool no_timing = false;
  std::vector<std::string> scalars;
  std::vector<std::string> knobs;
  std::vector<std::string> settings;
};

void add_compare_options(CLI::App& command, CompareWords& words) {
  CompareArguments& arguments = words.arguments;
  command.add_option("SCENE", arguments.scenes, scene_words);
  command.add_option("--files-from", arguments.files_from, "Read further SCENEs from this file, one per line")
      ->type_name("FILE|-")
      ->check(expect_file_name());
  add_flag(command, "--keep-going", arguments.keep_going,
           "Run the others where a SCENE cannot be used; it is a failed row, and the status is 2");
  add_contenders(command, arguments.run.contenders, "Only these and the Box2D twin (see `paperproof list contenders`)");
  add_scalars(command, words.scalars);
  command
      .add_option("--mode", words.mode,
                  "free: each on its own; lockstep: the twin is put to the controller before each step")
      ->type_name("free|lockstep")
      ->check(expect_one_of({"free", "lockstep"}));
  add_knobs(command, words.knobs);
  add_settings(command, words.settings);
  add_steps(command, arguments.run.steps);
  add_input(command, words.input);
  command.add_option("--trace", arguments.run.trace_stem, "Write STEM.<scene>.<contender>.<scalar>.jsonl")
      ->type_name("STEM")
      ->check(expect_file_name());
  add_outputs(command, arguments.rows_path, arguments.report_path);
  command.add_option("--strip", arguments.strip_path, "Draw one step of one scene, the contenders side by side")
      ->type_name("FILE.svg")
      ->check(expect_file_name())
      ->check(expect_ending({".svg"}));
  command.add_option("--plan", words.plan, "full: leave nothing out, whatever the scene can need")
      ->type_name("full")
      ->check(expect_one_of({"full"}));
  add_flag(command, "--no-reference", words.no_reference, "Without the Box2D twin");
  add_flag(command, "--no-timing", words.no_timing, "Without measuring the cost of a step");
  add_flag(command, "--all-tables", arguments.all_tables, "The table of every scene, where there are several");
  add_flag(command, "--explain", arguments.explain, "Print what each contender is excused, and up to what size");
  add_flag(command, "--quiet", arguments.quiet, "No tables, no progress");
  add_flag(command, "--json", arguments.json, "Rows as JSON on standard output");
}

int compare(const CompareWords& words) {
  CompareArguments arguments = words.arguments;
  if (arguments.scenes.empty() && arguments.files_from.empty())
    throw InputError("paperproof: SCENE is required; see paperproof compare --help");
  arguments.run.random_input = seed_of(words.input);
  arguments.run.full_plan = words.plan == "full";
  arguments.run.reference = !words.no_reference;
  arguments.run.measure_cost = !words.no_timing;
  arguments.run.continuous = true;
  arguments.run.mode = words.mode == "lockstep" ? Mode::lockstep : Mode::free;
  if (!words.scalars.empty()) arguments.run.scalars.clear();
  for (const std::string& scalar : without_repeats(words.scalars))
    arguments.run.scalars.push_back(scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64);
  arguments.run.contenders = without_repeats(arguments.run.contenders);
  for (const std::string& setting : words.settings) arguments.settings.push_back(parse_setting(setting));
  arguments.run.knobs = parse_knobs(words.knobs, arguments.run.contenders);
  return compare_scenes(std::move(arguments));
}

void add_compare(CLI::App& app, int& status) {
  CLI::App& command = *app.add_subcommand("compare", "Run scenes, judge every step exactly, say who is right");
  const auto words = std::make_shared<CompareWords>();
  add_compare_options(command, *words);
  on_parsed(command, status, words, compare);
}

void add_cases(CLI::App& command, CaseArguments& cases) {
  add_contenders(command, cases.contenders);
  add_scalars(command, cases.scalars);
  add_knobs(command, cases.knobs);
}

/// What a study that measures in one process writes.
void add_run_outputs(CLI::App& command, RunArguments& run) {
  add_outputs(command, run.rows_path, run.report_path);
  add_flag(command, "--quiet", run.quiet, "No table, no progress");
}

/// The options of everything that runs cases.
void add_run_options(CLI::App& command, RunArguments& run) {
  add_run_outputs(command, run);
  add_log(command, run.log_path);
  add_jobs(command, run.jobs);
  command
      .add_option("--limit", run.limit_s,
                  "A case that takes longer than this fails; where not given 60 s in a sweep, 10 minutes in `study "
                  "disagreement`, an hour in other studies, and a day on their full grid")
      ->type_name("SECONDS")
      ->check(expect_whole_number(1'000'000));
  command.add_option("--shard", run.shard, "Every N-th case, from the K-th on; `merge` puts the parts together")
      ->type_name("K/N");
  add_flag(command, "--resume", run.resume, "Go on behind the rows that the file of --rows has");
}

void forget_repeats(CaseArguments& cases) {
  cases.contenders = without_repeats(cases.contenders);
  cases.scalars = without_repeats(cases.scalars);
}

/// Options of `sweep` as typed.
struct SweepWords {
  SweepArguments arguments;
  std::optional<std::string> input;
  bool no_reference = false;
  bool no_timing = false;
};

int sweep(const SweepWords& words) {
  SweepArguments arguments = words.arguments;
  arguments.seed = seed_of(words.input);
  arguments.reference = !words.no_reference;
  forget_repeats(arguments.cases);
  return sweep_command(arguments);
}

void add_sweep(CLI::App& app, int& status) {
  CLI::App* command = app.add_subcommand("sweep", "Run a scene or family over ranges of its parameters");
  const auto words = std::make_shared<SweepWords>();
  SweepArguments& arguments = words->arguments;
  command->add_option("SCENE", arguments.scene, scene_words)->required();
  command->add_option("--vary", arguments.vary, "An axis: a parameter of the scene (see `list parameters`) or a knob")
      ->type_name("KEY=FIRST:LAST:logN|linN|a,b,c")
      ->allow_extra_args(false);
  command
      ->add_option("--find-border", arguments.border,
                   "Bisect this parameter, over its range or a part of it, to where a contender ceases to hold")
      ->type_name("KEY[=FIRST:LAST]");
  add_settings(*command, arguments.set);
  add_steps(*command, arguments.steps);
  add_input(*command, words->input);
  add_cases(*command, arguments.cases);
  add_run_options(*command, arguments.run);
  add_flag(*command, "--no-reference", words->no_reference, "Without Box2D, where no contender is named");
  add_flag(*command, "--no-timing", words->no_timing, "A sweep measures no costs anyway");
  on_parsed(*command, status, words, sweep);
}

/// A study that is a list of sweeps.
void add_prepared_study(CLI::App& parent, const PreparedStudy& study, int& status) {
  CLI::App& command = *parent.add_subcommand(study.name, study.help);
  const auto arguments = std::make_shared<StudyArguments>();
  arguments->grid = study.grid;
  add_grid_size(command, arguments->grid);
  add_cases(command, arguments->cases);
  add_run_options(command, arguments->run);
  on_parsed(command, status, arguments, [&study](StudyArguments& typed) {
    forget_repeats(typed.cases);
    return study_command(study, typed);
  });
}

void add_scale(CLI::App& study, int& status) {
  CLI::App& command = *study.add_subcommand("scale", "Cost of a step against the number of pieces, per broad phase");
  const auto arguments = std::make_shared<ScaleArguments>();
  command.add_option("--grid", arguments->grid, fmt::format("Numbers of pieces, multiples of {}", tiles_per_floor))
      ->type_name("N,...")
      ->check(expect_whole_number(most_tiles, tiles_per_floor))
      ->delimiter(',');
  add_run_outputs(command, arguments->run);
  on_parsed(command, status, arguments, study_scale_command);
}

void add_disagreement(CLI::App& study, int& status) {
  CLI::App& command =
      *study.add_subcommand("disagreement", "Every event on which octagon_sweep and Box2D differ, and its cause");
  const auto arguments = std::make_shared<DisagreementArguments>();
  command.add_option("SCENE", arguments->scenes, std::string(scene_words) + "; every registered one if none is given");
  add_run_options(command, arguments->run);
  on_parsed(command, status, arguments, study_disagreement_command);
}

void add_precision(CLI::App& app, int& status) {
  CLI::App& command = *app.add_subcommand("work-precision", "Error against run time, for motions known in closed form");
  const auto arguments = std::make_shared<PrecisionArguments>();
  command.add_option("MOTION", arguments->motions, "Only these (without any: all)");
  add_contenders(command, arguments->contenders);
  add_run_outputs(command, arguments->run);
  on_parsed(command, status, arguments, work_precision_command);
}

void add_studies(CLI::App& app, int& status) {
  CLI::App& study = *app.add_subcommand("study", "One question over a range, as numbers and as a picture");
  study.require_subcommand(1);
  add_scale(study, status);
  add_precision(app, status);
  for (const PreparedStudy& prepared : prepared_studies())
    add_prepared_study(std::string_view(prepared.name) == "stability" ? app : study, prepared, status);
  add_disagreement(study, status);
}

struct RowsWords {
  std::vector<std::string> files;
  std::string rows_path;
};

void add_rows_commands(CLI::App& app, int& status) {
  CLI::App& merge = *app.add_subcommand("merge", "Put rows of several files together: shards of a sweep, or any");
  const auto merged = std::make_shared<RowsWords>();
  merge.add_option("ROWS", merged->files, "Files of rows, .jsonl")->required();
  merge.add_option("--rows", merged->rows_path, "Where they go")
      ->required()
      ->type_name("FILE.jsonl")
      ->check(expect_file_name())
      ->check(expect_ending({".jsonl"}));
  on_parsed(merge, status, merged, [](const RowsWords& typed) { return merge_command(typed.files, typed.rows_path); });

  CLI::App& diff = *app.add_subcommand("diff", "Name what changed between two files of rows, costs apart");
  const auto differed = std::make_shared<RowsWords>();
  diff.add_option("ROWS", differed->files, "Two files of rows, .jsonl: before and after")->required()->expected(2);
  on_parsed(diff, status, differed,
            [](const RowsWords& typed) { return diff_command(typed.files[0], typed.files[1]); });
}

/// Options of `judge` as typed.
struct JudgeWords {
  JudgeOptions options;
  std::vector<std::string> settings;
};

void add_judge(CLI::App& app, int& status) {
  CLI::App& command =
      *app.add_subcommand("judge", "Say of each trace which clauses of the guarantee it breaks, with exact arithmetic");
  const auto words = std::make_shared<JudgeWords>();
  JudgeOptions* const options = &words->options;
  command.add_option("TRACE", options->traces, "Files written by --trace, or by any other program")->required();
  command.add_flag("--all", options->all_clauses, "Ask for every clause, whatever the trace's contender guarantees");
  command
      .add_option("--scene", options->scene, "The scene of the traces: what it says stands instead of their headers")
      ->type_name("SCENE");
  add_settings(command, words->settings);
  add_steps(command, options->steps);
  for (const char* name : {"--set", "--steps"}) command.get_option(name)->needs("--scene");
  on_parsed(command, status, words, [](JudgeWords& typed) {
    for (const std::string& setting : typed.settings) typed.options.settings.push_back(parse_setting(setting));
    return judge_command(typed.options);
  });
}

void add_random_runs(CLI::App& app, int& status) {
  CLI::App& campaign =
      *app.add_subcommand("campaign", "Run families of random runs, and count what they meet and break");
  const auto counted = std::make_shared<CampaignArguments>();
  campaign.add_option("FAMILY", counted->families, "Families such as movers/tiles, or kinds such as movers; none: all");
  campaign.add_option("--steps", counted->steps, "Of each family; slow ones take a share")
      ->type_name("N")
      ->check(CLI::Range(1, 100'000'000));
  on_parsed(campaign, status, counted, campaign_command);

  CLI::App& replay = *app.add_subcommand("replay", "Run one random run again, as a test or `campaign` names it");
  const auto again = std::make_shared<ReplayArguments>();
  replay.add_option("FAMILY", again->family, "Such as movers/tiles")->required();
  replay.add_option("SEED", again->seed, "Of the run")->required();
  replay.add_option("--scene", again->scene_path, "Write the scene, which has no launches")
      ->type_name("FILE.json")
      ->check(expect_file_name())
      ->check(expect_ending({".json"}));
  const auto names = contender_names();
  const auto add_alike = [&](CLI::App& command, std::string& contender, std::string& trace_stem) {
    command.add_option("--contender", contender, "Instead of octagon_sweep")
        ->type_name("NAME")
        ->check(expect_one_of({names.begin(), names.end()}));
    command.add_option("--trace", trace_stem, "Write STEM.<run>.<contender>.<scalar>.jsonl")
        ->type_name("STEM")
        ->check(expect_file_name());
  };
  add_alike(campaign, counted->contender, counted->trace_stem);
  add_alike(replay, again->contender, again->trace_stem);
  on_parsed(replay, status, again, replay_command);
}

void add_report(CLI::App& app, int& status) {
  struct Words {
    std::string page;
    std::vector<std::string> records;
  };
  CLI::App& command = *app.add_subcommand("report", "Put rows, and pages of --report, into one page");
  const auto words = std::make_shared<Words>();
  command.add_option("FILE", words->page, "Where the page goes")
      ->required()
      ->type_name("FILE.html")
      ->check(expect_file_name())
      ->check(expect_ending({".html"}));
  command.add_option("ROWS", words->records, "Files of rows (.jsonl, .json), and pages (.html)")->required();
  on_parsed(command, status, words, [](const Words& typed) { return report_command(typed.page, typed.records); });
}

struct SceneWords {
  std::vector<std::string> scenes;
  std::optional<std::string> input;  ///< Of `plan`.
  std::string from;                  ///< Of `convert`.
  std::string to;                    ///< The same.
};

void add_scene_commands(CLI::App& app, int& status) {
  CLI::App& convert = *app.add_subcommand("convert", "Write a map or a built-in scene as a JSON scene");
  const auto converted = std::make_shared<SceneWords>();
  convert.add_option("SCENE", converted->from, scene_words)->required();
  convert.add_option("OUT", converted->to, "Where it goes")->required()->type_name("OUT.json");
  on_parsed(convert, status, converted, [](const SceneWords& typed) { return convert_command(typed.from, typed.to); });

  CLI::App& check = *app.add_subcommand("check", "Validate scenes and say what is in them");
  const auto checked = std::make_shared<SceneWords>();
  check.add_option("SCENE", checked->scenes, scene_words)->required();
  on_parsed(check, status, checked, [](const SceneWords& typed) { return check_command(typed.scenes); });

  CLI::App& plan = *app.add_subcommand("plan", "Say what scenes cannot need and runs therefore leave out, and why");
  const auto planned = std::make_shared<SceneWords>();
  plan.add_option("SCENE", planned->scenes, scene_words)->required();
  add_input(plan, planned->input);
  on_parsed(plan, status, planned,
            [](const SceneWords& typed) { return plan_command(typed.scenes, seed_of(typed.input)); });
}

void add_demo_and_list(CLI::App& app, int& status) {
  CLI::App& demo = *app.add_subcommand("demo", "The article's bullet, one technique at a time, in the terminal");
  const auto technique = std::make_shared<std::string>();
  demo.add_option("TECHNIQUE", *technique, "Only this one");
  on_parsed(demo, status, technique, demo_command);

  CLI::App& list = *app.add_subcommand("list", "Names, one per line");
  const auto what = std::make_shared<std::string>();
  list.add_option("WHAT", *what, "Which names")
      ->required()
      ->type_name("scenes|contenders|families|knobs|metrics|parameters|schema")
      ->check(expect_one_of({"scenes", "contenders", "families", "knobs", "metrics", "parameters", "schema"}));
  on_parsed(list, status, what, list_command);
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
  int status = 0;
  add_compare(app, status);
  add_studies(app, status);
  add_sweep(app, status);
  add_rows_commands(app, status);
  add_judge(app, status);
  add_random_runs(app, status);
  add_report(app, status);
  add_scene_commands(app, status);
  add_demo_and_list(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    std::ostringstream text;
    status = app.exit(wanted, text, text);
    print_out(text.str());
  } catch (const CLI::ParseError& error) {
    return refuse(refusal(app, error));
  }
  return status;
}

}  // namespace

int paperproof::compare::run_command_line(int argc, char** argv) {
  hold_standard_streams();
  std::signal(SIGPIPE, SIG_IGN);
  remove_unfinished_on_signals();
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
