/// The subcommands with their options.
#include "command/command_line.hpp"

#include "command/campaign_command.hpp"
#include "command/commands.hpp"
#include "command/compare_command.hpp"
#include "command/complain.hpp"
#include "command/judge_command.hpp"
#include "command/option_checks.hpp"
#include "command/options.hpp"
#include "command/study_command.hpp"
#include "records/output_file.hpp"
#include "runs/peers.hpp"
#include "scenes/load.hpp"
#include "studies/scale.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <exception>
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

/// Those that are named, and all peers; none where none is named.
std::vector<std::string> chosen(std::vector<std::string> contenders) {
  for (const Peer& peer : peers())
    if (!contenders.empty()) contenders.push_back(peer.name);
  return without_repeats(contenders);
}

/// A command, and what its options say once they are parsed.
template <class Arguments>
struct Command {
  CLI::App& app;
  Arguments& typed;
};

/// @param run is called once the options are parsed. `status` gets its result.
template <class Arguments, class Run>
Command<Arguments> add_command(CLI::App& parent, int& status, const std::string& name, const std::string& help,
                               Run run) {
  CLI::App& app = *parent.add_subcommand(name, help);
  const auto arguments = std::make_shared<Arguments>();
  app.callback([&status, arguments, run] { status = run(*arguments); });
  return {app, *arguments};
}

/// Options of `compare` as typed.
struct CompareWords {
  CompareArguments arguments;
  std::string mode = "free";
  std::string plan;
  std::vector<std::string> scalars;
  std::vector<std::string> knobs;
};

int compare(const CompareWords& words) {
  CompareArguments arguments = words.arguments;
  if (arguments.scenes.empty() && arguments.files_from.empty())
    throw InputError("paperproof: SCENE is required; see paperproof compare --help");
  arguments.run.full_plan = words.plan == "full";
  arguments.run.continuous = true;
  arguments.run.mode = words.mode == "lockstep" ? Mode::lockstep : Mode::free;
  if (!words.scalars.empty()) arguments.run.scalars.clear();
  for (const std::string& scalar : without_repeats(words.scalars))
    arguments.run.scalars.push_back(scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64);
  arguments.run.contenders = chosen(arguments.run.contenders);
  arguments.run.knobs = parse_knobs(words.knobs, arguments.run.contenders);
  return compare_scenes(std::move(arguments));
}

void add_compare(CLI::App& app, int& status) {
  const auto [command, words] = add_command<CompareWords>(
      app, status, "compare", "Run scenes, judge every step exactly, say who is right", compare);
  CompareArguments& arguments = words.arguments;
  command.add_option("SCENE", arguments.scenes, scene_words);
  add_option(command, "--files-from", arguments.files_from, "FILE|-",
             "Read further SCENEs from this file, one per line");
  add_flag(command, "--keep-going", arguments.keep_going,
           "Run the others where a SCENE cannot be used; it is a failed row, and the status is 2");
  add_contenders(command, arguments.run.contenders, "Only these and the Box2D twin (see `paperproof list contenders`)");
  add_scalars(command, words.scalars);
  add_option(command, "--mode", words.mode, "free|lockstep",
             "free: each on its own; lockstep: the twin is put to the controller before each step");
  add_knobs(command, words.knobs);
  add_settings(command, arguments.settings);
  add_steps(command, arguments.run.steps);
  add_input(command, arguments.run.random_input);
  add_option(command, "--trace", arguments.run.trace_stem, "STEM", "Write STEM.<scene>.<contender>.<scalar>.jsonl");
  add_outputs(command, arguments.rows_path, arguments.report_path);
  add_option(command, "--strip", arguments.strip_path, "FILE.svg",
             "Draw one step of one scene, the contenders side by side");
  add_option(command, "--plan", words.plan, "full", "full: leave nothing out, whatever the scene can need");
  add_flag_off(command, "--no-reference", arguments.run.reference, "Without the Box2D twin");
  add_flag_off(command, "--no-timing", arguments.run.measure_cost, "Without measuring the cost of a step");
  add_flag(command, "--all-tables", arguments.all_tables, "The table of every scene, where there are several");
  add_flag(command, "--explain", arguments.explain, "Print what each contender is excused, and up to what size");
  add_flag(command, "--quiet", arguments.quiet, "No tables, no progress");
  add_flag(command, "--json", arguments.json, "Rows as JSON on standard output");
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
  add_option(command, "--log", run.log_path, "FILE", "Write how far the work is to this file, a line every 5 s");
  add_option(command, "--jobs", run.jobs, "N", "Processes at a time; one for each core where it is not given")
      .check(expect_whole_number(1024));
  add_option(
      command, "--limit", run.limit_s, "SECONDS",
      "A case that takes longer than this fails, with a minute more where peers are to greet; where not given 60 s "
      "in a sweep, 10 minutes in `study disagreement`, an hour in other studies, and a day on their full grid")
      .check(expect_whole_number(1'000'000));
  add_option(command, "--shard", run.shard, "K/N",
             "Every N-th case, from the K-th on; `merge` puts the parts together");
  add_flag(command, "--resume", run.resume, "Go on behind the rows that the file of --rows has");
}

void forget_repeats(CaseArguments& cases) {
  cases.contenders = chosen(cases.contenders);
  cases.scalars = without_repeats(cases.scalars);
}

void add_sweep(CLI::App& app, int& status) {
  const auto run = [](SweepArguments& typed) {
    forget_repeats(typed.cases);
    return sweep_command(typed);
  };
  const auto [command, typed] =
      add_command<SweepArguments>(app, status, "sweep", "Run a scene or family over ranges of its parameters", run);
  command.add_option("SCENE", typed.scene, scene_words)->required();
  add_option(command, "--vary", typed.vary, "KEY=FIRST:LAST:logN|linN|a,b,c",
             "An axis: a parameter of the scene (see `list parameters`) or a knob")
      .allow_extra_args(false);
  add_option(command, "--find-border", typed.border, "KEY[=FIRST:LAST]",
             "Bisect this parameter, over its range or a part of it, to where a contender ceases to hold");
  add_settings(command, typed.set);
  add_steps(command, typed.steps);
  add_input(command, typed.seed);
  add_cases(command, typed.cases);
  add_run_options(command, typed.run);
  add_flag_off(command, "--no-reference", typed.reference, "Without Box2D, where no contender is named");
  command
      .add_flag_callback(
          "--no-timing", [] {}, "A sweep measures no costs anyway")
      ->disable_flag_override();
}

/// A study that is a list of sweeps.
void add_prepared_study(CLI::App& parent, const PreparedStudy& study, int& status) {
  const auto run = [&study](StudyArguments& typed) {
    forget_repeats(typed.cases);
    return study_command(study, typed);
  };
  const auto [command, typed] = add_command<StudyArguments>(parent, status, study.name, study.help, run);
  typed.grid = study.grid;
  add_option(command, "--grid", typed.grid, "quick|standard|full", "How many cases");
  add_cases(command, typed.cases);
  add_run_options(command, typed.run);
}

void add_scale(CLI::App& study, int& status) {
  const auto [command, typed] = add_command<ScaleArguments>(
      study, status, "scale", "Cost of a step against the number of pieces, per broad phase", study_scale_command);
  add_option(command, "--grid", typed.grid, "N,...", fmt::format("Numbers of pieces, multiples of {}", tiles_per_floor))
      .check(expect_whole_number(most_tiles, tiles_per_floor))
      ->delimiter(',');
  add_run_outputs(command, typed.run);
}

void add_disagreement(CLI::App& study, int& status) {
  const auto [command, typed] = add_command<DisagreementArguments>(
      study, status, "disagreement", "Every event on which octagon_sweep and Box2D differ, and its cause",
      study_disagreement_command);
  command.add_option("SCENE", typed.scenes, std::string(scene_words) + "; every registered one if none is given");
  add_run_options(command, typed.run);
}

void add_precision(CLI::App& app, int& status) {
  const auto run = [](PrecisionArguments& typed) {
    typed.contenders = chosen(typed.contenders);
    return work_precision_command(typed);
  };
  const auto [command, typed] = add_command<PrecisionArguments>(
      app, status, "work-precision", "Error against run time, for motions known in closed form", run);
  command.add_option("MOTION", typed.motions, "Only these (without any: all)");
  add_contenders(command, typed.contenders);
  add_run_outputs(command, typed.run);
}

void add_studies(CLI::App& app, int& status) {
  CLI::App& study = *app.add_subcommand("study", "One question over a range, as numbers and as a picture");
  study.require_subcommand(1);
  add_scale(study, status);
  add_precision(app, status);
  for (const PreparedStudy& prepared : prepared_studies())
    add_prepared_study(prepared.name == "stability" ? app : study, prepared, status);
  add_disagreement(study, status);
}

void add_rows_commands(CLI::App& app, int& status) {
  const auto [merge, merged] = add_command<Given>(
      app, status, "merge", "Put rows of several files together: shards of a sweep, or any", merge_command);
  merge.add_option("ROWS", merged.names, "Files of rows, .jsonl")->required();
  add_option(merge, "--rows", merged.to, "FILE.jsonl", "Where they go").required();

  const auto [diff, differed] =
      add_command<Given>(app, status, "diff", "Name what changed between two files of rows, costs apart", diff_command);
  diff.add_option("ROWS", differed.names, "Two files of rows, .jsonl: before and after")->required()->expected(2);
}

void add_judge(CLI::App& app, int& status) {
  const auto [command, typed] = add_command<JudgeOptions>(
      app, status, "judge", "Say of each trace which clauses of the guarantee it breaks, with exact arithmetic",
      judge_command);
  command.add_option("TRACE", typed.traces, "Files written by --trace, or by any other program")->required();
  command.add_flag("--all", typed.all_clauses, "Ask for every clause, whatever the trace's contender guarantees");
  add_option(command, "--scene", typed.scene, "SCENE",
             "The scene of the traces: what it says stands instead of their headers");
  add_settings(command, typed.settings);
  add_steps(command, typed.steps);
  for (const char* name : {"--set", "--steps"}) command.get_option(name)->needs("--scene");
}

void add_random_runs(CLI::App& app, int& status) {
  const auto [campaign, counted] = add_command<CampaignArguments>(
      app, status, "campaign", "Run families of random runs, and count what they meet and break", campaign_command);
  campaign.add_option("FAMILY", counted.families, "Families such as movers/tiles, or kinds such as movers; none: all");
  add_option(campaign, "--steps", counted.steps, "N", "Of each family; slow ones take a share")
      .check(CLI::Range(1, 100'000'000));

  const auto [replay, again] = add_command<ReplayArguments>(
      app, status, "replay", "Run one random run again, as a test or `campaign` names it", replay_command);
  replay.add_option("FAMILY", again.family, "Such as movers/tiles")->required();
  replay.add_option("SEED", again.seed, "Of the run")->required();
  add_option(replay, "--scene", again.scene_path, "FILE.json", "Write the scene, which has no launches");
  const auto names = contender_names();
  const auto add_alike = [&](CLI::App& command, RunSettings& settings) {
    add_option(command, "--contender", settings.contender, "NAME", "Instead of octagon_sweep")
        .check(expect_one_of({names.begin(), names.end()}));
    add_option(command, "--trace", settings.trace_stem, "STEM", "Write STEM.<run>.<contender>.<scalar>.jsonl");
  };
  add_alike(campaign, counted.settings);
  add_alike(replay, again.settings);
}

void add_export(CLI::App& app, int& status) {
  CLI::App& command = *app.add_subcommand("export", "Write what others can use without this project");
  command.require_subcommand(1);
  const auto [queries, asked] = add_command<Given>(
      command, status, "queries", "Questions of first contact, with exact rational answers", export_queries_command);
  add_option(queries, "--count", asked.count, "N", "How many").check(CLI::Range(1, 10'000'000));
  add_option(queries, "OUT", asked.to, "FILE.jsonl|.csv", "Where they go").required();
  add_option(queries, "SCENES", asked.names, "SCENE|MAP...", "To go through beside the random runs");
}

void add_report(CLI::App& app, int& status) {
  const auto [command, typed] =
      add_command<Given>(app, status, "report", "Put rows, and pages of --report, into one page", report_command);
  add_option(command, "FILE", typed.to, "FILE.html", "Where the page goes").required();
  command.add_option("ROWS", typed.names, "Files of rows (.jsonl, .json), and pages (.html)")->required();
}

void add_scene_commands(CLI::App& app, int& status) {
  const auto [convert, converted] =
      add_command<Given>(app, status, "convert", "Write a map or a built-in scene as a JSON scene", convert_command);
  convert.add_option("SCENE", converted.what, scene_words)->required();
  add_option(convert, "OUT", converted.to, "OUT.json", "Where it goes").required();

  const auto [check, checked] =
      add_command<Given>(app, status, "check", "Validate scenes and say what is in them", check_command);
  check.add_option("SCENE", checked.names, scene_words)->required();

  const auto [plan, planned] = add_command<Given>(
      app, status, "plan", "Say what scenes cannot need and runs therefore leave out, and why", plan_command);
  plan.add_option("SCENE", planned.names, scene_words)->required();
  add_input(plan, planned.seed);
}

void add_demo_and_list(CLI::App& app, int& status) {
  const auto [demo, shown] = add_command<Given>(
      app, status, "demo", "The article's bullet, one technique at a time, in the terminal", demo_command);
  demo.add_option("TECHNIQUE", shown.what, "Only this one");

  const auto [list, listed] = add_command<Given>(app, status, "list", "Names, one per line", list_command);
  add_option(list, "WHAT", listed.what, "scenes|contenders|families|knobs|metrics|parameters|schema", "Which names")
      .required();
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
  add_export(app, status);
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
