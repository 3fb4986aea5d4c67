#include "command/compare_command.hpp"

#include "command/claimed_files.hpp"
#include "command/progress.hpp"
#include "near_names.hpp"
#include "runs/gallery.hpp"
#include "runs/headline.hpp"
#include "runs/output_file.hpp"
#include "runs/rows_json.hpp"
#include "runs/summary.hpp"
#include "runs/table.hpp"
#include "runs/trace_writer.hpp"
#include "scenes/load.hpp"
#include "scenes/sets.hpp"
#include "words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <utility>

namespace paperproof::compare {
namespace {

/// Up to this many arguments their scenes are kept in memory; more are read once to be checked and again to be run.
constexpr std::size_t kept_in_memory = 16;

constexpr const char* gallery_title = "Where each contender fails, and where it is the cheapest of those that do not";

/// What was found over all scenes, for the closing line and the exit status.
class Totals {
 public:
  void add(const Row& row) {
    failed_ += row.verdict == Verdict::failed;
    if (row.contender != paperproof::name_of(TechniqueKind::octagon_sweep)) return;
    Count& count = row.scalar == "double" ? in_double_ : in_float_;
    const bool breaks =
        row.verdict == Verdict::tunnels || (row.verdict == Verdict::flagged && row.steps_ending_inside.value_or(0) > 0);
    count.steps += row.steps;
    count.asked_for = true;
    count.runs += row.verdict != Verdict::not_applicable;
    count.broken += row.scalar == "double" ? row.verdict == Verdict::violates : breaks;
  }
  [[nodiscard]] bool trouble() const { return in_double_.broken > 0 || failed_ > 0; }
  /// One line for each number type that ran.
  [[nodiscard]] std::vector<std::string> lines() const {
    std::vector<std::string> all;
    if (in_double_.asked_for)
      all.push_back(fmt::format("octagon_sweep in double: {}, {} with a violation of the guarantee",
                                in_double_.extent(), counted(in_double_.broken, "run")));
    if (in_float_.asked_for)
      all.push_back(
          fmt::format("octagon_sweep in float, for which nothing is guaranteed: {}, {} with a step through or "
                      "into a solid",
                      in_float_.extent(), counted(in_float_.broken, "run")));
    return all;
  }

 private:
  struct Count {
    long long steps = 0;
    bool asked_for = false;
    int runs = 0;
    int broken = 0;
    [[nodiscard]] std::string extent() const { return counted(steps, "step") + " in " + counted(runs, "run"); }
  };
  Count in_double_;
  Count in_float_;
  int failed_ = 0;
};

std::vector<NamedTolerance> tolerances_of(const ReportScene& scene) {
  for (const ReportRun& run : scene.runs)
    if (run.header.contender == paperproof::name_of(TechniqueKind::octagon_sweep)) return run.header.tolerances;
  return {};
}

/// The files that a comparison is going to write: no two may be the same, and none an input.
class Outputs {
 public:
  explicit Outputs(const CompareArguments& arguments) : arguments_(arguments) {}

  void add_scene(const std::string& given, const std::string& name) {
    if (std::filesystem::exists(given)) files_.claim(given, "the scene " + given);
    if (arguments_.run.trace_stem.empty()) return;
    const auto claim_traces = [&](const std::string& stem, const std::string& contender) {
      for (const ScalarKind scalar : {ScalarKind::binary64, ScalarKind::binary32}) {
        const std::string path = trace_path(stem, name, contender, name_of(scalar));
        if (!files_.claim(path, "a trace"))
          throw InputError(fmt::format(
              "{}: expected another name than {}: its traces would overwrite those of another scene", given, name));
      }
    };
    for (const std::string_view contender : contender_names()) {
      claim_traces(arguments_.run.trace_stem, std::string(contender));
      claim_traces(twin_stem(arguments_.run.trace_stem, contender), "box2d");
    }
  }

  void check() {
    files_.claim_for_option("--rows", arguments_.rows_path);
    files_.claim_for_option("--report", arguments_.report_path);
  }

 private:
  const CompareArguments& arguments_;
  ClaimedFiles files_;
};

class Comparison {
 public:
  explicit Comparison(CompareArguments& arguments)
      : arguments_(arguments), progress_(!arguments.quiet), outputs_(arguments) {
    check_contenders(arguments.run.contenders);
    check_lockstep();
    const bool keep = arguments.scenes.size() <= kept_in_memory;
    for (std::size_t i = 0; i < arguments.scenes.size(); ++i) {
      progress_.show("checking " + arguments.scenes[i],
                     static_cast<double>(i) / static_cast<double>(arguments.scenes.size()));
      std::vector<Scene> scenes = load_scenes(arguments.scenes[i]);
      shows_gallery_ = shows_gallery_ || find_set(arguments.scenes[i]) != nullptr;
      for (const Scene& scene : scenes) outputs_.add_scene(arguments.scenes[i], scene.name);
      scene_count_ += scenes.size();
      if (keep) kept_.push_back(std::move(scenes));
    }
    progress_.clear();
    outputs_.check();
    open_outputs();
  }

  int run() {
    for (std::size_t i = 0; i < arguments_.scenes.size(); ++i) {
      const std::vector<Scene> scenes = kept_.empty() ? load_scenes(arguments_.scenes[i]) : std::move(kept_[i]);
      for (const Scene& scene : scenes)
        run_one(scene, static_cast<double>(i) / static_cast<double>(arguments_.scenes.size()));
    }
    progress_.clear();
    finish();
    return totals_.trouble() ? 1 : 0;
  }

 private:
  void check_lockstep() const {
    if (arguments_.run.mode != Mode::lockstep) return;
    if (!arguments_.run.reference)
      throw InputError("--no-reference: expected to be left out, as lockstep compares with the reference");
    for (const std::string& name : arguments_.run.contenders)
      if (is_reference(name))
        throw InputError(fmt::format("--contender {}: expected a technique, as lockstep runs Box2D beside each", name));
  }

  /// Everything is opened before the first step: who waited for an hour wants to be able to keep the result.
  void open_outputs() {
    if (!arguments_.rows_path.empty()) rows_file_.emplace(arguments_.rows_path);
    if (!arguments_.report_path.empty()) open_report();
    if (!arguments_.run.trace_stem.empty()) const OutputFile probe(arguments_.run.trace_stem + ".jsonl");
  }

  void open_report() {
    const std::size_t contenders =
        arguments_.run.contenders.empty() ? contender_names().size() : arguments_.run.contenders.size() + 1;
    report_options_ = options_for(arguments_.scenes.size() * contenders);
    arguments_.run.max_replay_steps = report_options_.max_replay_steps;
    report_.emplace(arguments_.report_path, report_options_);
  }

  void run_one(const Scene& scene, double share) {
    arguments_.run.progress = [&](double of_scene) {
      progress_.show(fmt::format("{} ({:.0f} %),", scene.name, 100 * of_scene), share);
    };
    const ReportScene result = run_scene(scene, arguments_.run);
    progress_.clear();
    for (const Row& row : result.rows) {
      totals_.add(row);
      rows_.push_back(row);
    }
    if (tolerances_.empty()) tolerances_ = tolerances_of(result);
    if (report_) report_->add(result);
    if (!arguments_.quiet && !arguments_.json) print(result);
  }

  /// One scene, or each where all tables are asked for, as a table. Of several scenes the first in plain words, as soon
  /// as it is there; all of them stand in one table at the end.
  void print(const ReportScene& result) {
    const bool first = !std::exchange(printed_, true);
    const bool whole = scene_count_ == 1 || arguments_.all_tables;
    if (!whole && !first) return;
    fmt::print("{}\n", shortened(result.name + (result.description.empty() ? "" : ": " + result.description)));
    if (whole) {
      fmt::print("\n{}\n{}\n", table(result.rows), in_lines(result.sentence));
    } else {
      const std::string exact = exact_answer(result.rows);
      fmt::print("{}{}\n{}\n", exact, exact.empty() ? "" : "\n", headline(result.rows));
    }
    std::fflush(stdout);
  }

  void print_summary(const std::vector<ReportSection>& sections) const {
    if (scene_count_ > 1) fmt::print("{}\n\n{}\n", counted(scene_count_, "scene"), summary_table(rows_));
    for (const ReportSection& section : sections) {
      fmt::print("{}\n\n", section.title);
      for (const std::string& line : section.lines) fmt::print("- {}\n", shortened(line));
      fmt::print("\n");
    }
    for (const std::string& line : totals_.lines()) fmt::print("{}\n", line);
  }

  void finish() {
    nlohmann::ordered_json rows = rows_json(rows_);
    if (shows_gallery_) rows["gallery"] = gallery_json(gallery_of(rows_));
    const auto text = [&rows] { return rows.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace); };
    if (rows_file_) {
      rows_file_->write(text() + '\n');
      rows_file_->commit();
    }
    std::vector<ReportSection> sections;
    if (shows_gallery_) sections.push_back({gallery_title, gallery_lines(gallery_of(rows_))});
    if (report_) report_->finish(environment(), tolerances_, totals_.lines(), sections);
    if (arguments_.json)
      fmt::print("{}\n", text());
    else if (!arguments_.quiet)
      print_summary(sections);
    if (report_ && !arguments_.quiet && !arguments_.json) fmt::print("report: {}\n", arguments_.report_path);
  }

  CompareArguments& arguments_;
  Progress progress_;
  std::vector<std::vector<Scene>> kept_;
  Outputs outputs_;
  std::size_t scene_count_ = 0;
  bool printed_ = false;        ///< A scene was printed.
  bool shows_gallery_ = false;  ///< A set of scenes was asked for.
  std::optional<OutputFile> rows_file_;
  std::vector<Row> rows_;
  Totals totals_;
  ReportOptions report_options_;
  std::optional<ReportWriter> report_;
  std::vector<NamedTolerance> tolerances_;
};

}  // namespace

std::uint64_t parse_random_input(const std::string& text) {
  constexpr std::string_view prefix = "random:";
  std::uint64_t seed = 0;
  const char* end = text.data() + text.size();
  if (text.starts_with(prefix)) {
    const auto [last, error] = std::from_chars(text.data() + prefix.size(), end, seed);
    if (error == std::errc{} && last == end) return seed;
  }
  throw InputError(fmt::format("--input {}: expected random:SEED with a whole number from 0 to {}, such as random:1",
                               shown(text), std::numeric_limits<std::uint64_t>::max()));
}

std::vector<KnobSetting> parse_knobs(const std::vector<std::string>& texts,
                                     const std::vector<std::string>& contenders) {
  const auto asked_for = [&](TechniqueKind kind) {
    return contenders.empty() || std::find(contenders.begin(), contenders.end(), name_of(kind)) != contenders.end();
  };
  std::vector<KnobSetting> settings;
  for (const std::string& text : texts) {
    bool anyones = false;
    try {
      settings.push_back(parse_knob(text));
      for (const TechniqueKind kind : all_techniques) {
        if (!asked_for(kind) || !has_knob(kind, settings.back().name)) continue;
        check_knob(settings.back(), kind);
        anyones = true;
      }
    } catch (const std::invalid_argument& reason) {
      throw InputError(fmt::format("--knob {}: {}", text, reason.what()));
    }
    const std::string& name = settings.back().name;
    if (!anyones) throw InputError(fmt::format("--knob {}: expected a knob of {}", text, fmt::join(contenders, ", ")));
    const auto same = [&](const KnobSetting& setting) { return setting.name == name; };
    if (std::count_if(settings.begin(), settings.end(), same) > 1)
      throw InputError(fmt::format("--knob {}: expected {} once", text, name));
  }
  return settings;
}

void check_contenders(const std::vector<std::string>& names) {
  const auto views = contender_names();
  const std::vector<std::string> known(views.begin(), views.end());
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("--contender {}: expected {} (see `paperproof list contenders`){}", shown(name),
                                   one_of_words(known), did_you_mean(name, known)));
}

int compare_scenes(CompareArguments arguments) { return Comparison(arguments).run(); }

}  // namespace paperproof::compare
