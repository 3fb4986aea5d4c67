#include "command/compare_command.hpp"

#include "command/claimed_files.hpp"
#include "command/complain.hpp"
#include "command/inputs.hpp"
#include "command/progress.hpp"
#include "command/standing_sections.hpp"
#include "command/totals.hpp"
#include "near_names.hpp"
#include "records/output_file.hpp"
#include "records/rows_file.hpp"
#include "records/trace_writer.hpp"
#include "report/report.hpp"
#include "report/strip_svg.hpp"
#include "runs/environment.hpp"
#include "runs/gallery.hpp"
#include "runs/preparation.hpp"
#include "runs/row_views.hpp"
#include "runs/run_case.hpp"
#include "scenes/built_in.hpp"
#include "scenes/load.hpp"
#include "words.hpp"

#include <paperproof/number_in.hpp>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <limits>
#include <utility>

namespace paperproof::compare {
namespace {

constexpr const char* gallery_title = "Where each contender fails, and where it is the cheapest of those that do not";

/// Of peers, where several scenes run.
constexpr std::size_t most_reasons = 20;

/// Exit status where an input could not be used, and no contender failed.
constexpr int unusable_input = 2;

std::vector<NamedTolerance> tolerances_of(const ReportScene& scene) {
  for (const ReportRun& run : scene.runs)
    if (run.header.contender == "octagon_sweep") return run.header.tolerances;
  return {};
}

/// The files that a comparison is going to write: no two may be the same, and none an input.
class Outputs {
 public:
  explicit Outputs(const CompareArguments& arguments) : arguments_(arguments) {}

  void add_input(const std::string& given) {
    std::error_code unknown;
    if (std::filesystem::exists(given, unknown)) files_.claim(given, "the scene " + given);
  }

  void add_scene(const std::string& given, const std::string& name) {
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
    if (arguments_.files_from != "-") files_.claim_for_option("--files-from", arguments_.files_from);
    files_.claim_for_option("--rows", arguments_.rows_path);
    files_.claim_for_option("--report", arguments_.report_path);
    files_.claim_for_option("--strip", arguments_.strip_path);
  }

 private:
  const CompareArguments& arguments_;
  ClaimedFiles files_;
};

std::vector<std::string> names_in(const CompareArguments& arguments) {
  std::vector<std::string> names = arguments.scenes;
  if (!arguments.files_from.empty()) {
    const std::vector<std::string> more = names_from(arguments.files_from);
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

class Comparison {
 public:
  explicit Comparison(CompareArguments& arguments)
      : arguments_(arguments),
        progress_(!arguments.quiet),
        inputs_(names_in(arguments), arguments.settings),
        outputs_(arguments) {
    check_contenders(arguments.run.contenders);
    check_lockstep();
    for (const std::string& name : inputs_.names()) outputs_.add_input(name);
    inputs_.check(
        progress_, [this](const std::string& name, const Scene& scene) { look_at(name, scene); },
        [this](const std::string& name, const InputError& error) { refuse(name, error); });
    outputs_.check();
    if (!arguments.strip_path.empty() && scene_count_ != 1) throw InputError("--strip: expected one scene");
    open_outputs();
  }

  int run() {
    progress_.foretell(steps_, "steps");
    inputs_.run([this](const std::string&, const Scene& scene) { run_one(scene); },
                [this](const std::string& name, const InputError& error) {
                  refuse(name, error);
                  rows_file_->add(refused_.back());
                });
    progress_.clear();
    finish();
    if (totals_.trouble()) return 1;
    return !refused_.empty() ? unusable_input : 0;
  }

 private:
  [[nodiscard]] int steps_of(const Scene& scene) const { return arguments_.run.steps.value_or(scene.steps); }

  void look_at(const std::string& name, const Scene& scene) {
    outputs_.add_scene(name, scene.name);
    shows_gallery_ = shows_gallery_ || find_set(name).has_value();
    steps_ += steps_of(scene);
    unscripted_ += scene.moves_at_random && !arguments_.run.random_input;
    ++scene_count_;
  }

  /// It is said at once, --quiet or not, and stands in the rows.
  void refuse(const std::string& name, const InputError& error) {
    if (!arguments_.keep_going) throw InputError(error);
    complain(error.what());
    Row row;
    row.scene = name;
    row.scalar.clear();
    row.mode.clear();
    row.verdict = Verdict::failed;
    row.reason = error.what();
    refused_.push_back(std::move(row));
  }

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
    rows_file_.emplace(arguments_.rows_path, rows_header(environment()));
    for (const Row& refused : refused_) rows_file_->add(refused);
    if (!arguments_.report_path.empty() || !arguments_.strip_path.empty()) open_pictures();
    if (!arguments_.run.trace_stem.empty()) const OutputFile probe(arguments_.run.trace_stem + ".jsonl");
  }

  void open_pictures() {
    const std::size_t contenders =
        arguments_.run.contenders.empty() ? contender_names().size() : arguments_.run.contenders.size() + 1;
    report_options_ = options_for(scene_count_ * contenders);
    arguments_.run.max_replay_steps = report_options_.max_replay_steps;
    if (!arguments_.report_path.empty()) report_.emplace(arguments_.report_path, report_options_);
    if (!arguments_.strip_path.empty()) strip_.emplace(arguments_.strip_path);
  }

  void run_one(const Scene& scene) {
    announce_preparation(scene);
    const double steps = steps_of(scene);
    arguments_.run.progress = [&](double of_scene) {
      progress_.show(fmt::format("{} ({:.0f} %),", scene.name, 100 * of_scene),
                     (steps_done_ + of_scene * steps) / steps_);
    };
    ReportScene result = run_scene(scene, arguments_.run);
    for (Row& row : result.rows)
      if (const std::optional<Case> one = case_of(arguments_.run, scene.given, arguments_.settings, row))
        put_case(*one, row);
    steps_done_ += steps;
    progress_.clear();
    for (const Row& row : result.rows) {
      totals_.add(row);
      rows_.push_back(row);
      rows_file_->add(row);
    }
    if (tolerances_.empty()) tolerances_ = tolerances_of(result);
    if (report_) report_->add(result);
    if (strip_) write_strip(result);
    if (!arguments_.quiet && !arguments_.json) print(result);
  }

  void write_strip(const ReportScene& scene) {
    std::vector<StripPanel> panels;
    for (const Row& row : scene.rows) {
      const auto run = std::find_if(scene.runs.begin(), scene.runs.end(), [&](const ReportRun& one) {
        return one.header.contender == row.contender && one.header.scalar == row.scalar && one.header.mode == row.mode;
      });
      const bool bad = row.tunnels.value_or(0) > 0 || row.steps_ending_inside.value_or(0) > 0;
      panels.push_back({called(row), outcome_of(row), bad, run == scene.runs.end() ? nullptr : &*run});
    }
    const std::string title = scene.name + (scene.description.empty() ? "" : ": " + scene.description);
    strip_->write(svg_of_strip(title, panels));
    strip_->commit();
  }

  void announce_preparation(const Scene& scene) {
    if (arguments_.quiet) return;
    if (const auto expected = expected_preparation(scene, contenders_of(arguments_.run), arguments_.run.scalars))
      progress_.prepare(scene.name, expected->seconds,
                        fmt::format("about {:.0f} pairs of its pieces are near each other", expected->pairs));
  }

  /// One scene, or each where all tables are asked for, as a table. Of several scenes the first in plain words, as soon
  /// as it is there; all of them stand in one table at the end.
  void print(const ReportScene& result) {
    const bool first = !std::exchange(printed_, true);
    const bool whole = scene_count_ == 1 || arguments_.all_tables;
    if (!whole && !first) return;
    const std::string title =
        shortened(result.name + (result.description.empty() ? "" : ": " + result.description)) + '\n';
    if (whole) {
      print_out(fmt::format("{}\n{}\n{}\n", title, table(result.rows), in_lines(result.sentence)));
    } else {
      const std::string exact = exact_answer(result.rows);
      print_out(fmt::format("{}{}{}\n{}\n", title, exact, exact.empty() ? "" : "\n", headline(result.rows)));
    }
  }

  void print_summary(const std::vector<ReportSection>& sections) const {
    std::string text;
    if (scene_count_ > 1) text += fmt::format("{}\n\n{}\n", counted(scene_count_, "scene"), summary_table(rows_));
    if (scene_count_ > 1 && !arguments_.all_tables) text += reasons_of_peers();
    for (const ReportSection& section : sections) {
      text += section.title + "\n\n";
      for (const std::string& line : section.lines) text += "- " + shortened(line) + '\n';
      text += '\n';
    }
    for (const std::string& line : totals_.lines()) text += line + '\n';
    if (unscripted_ > 0 && scene_count_ > 1)
      text += counted(unscripted_, "map") + " without a script: moved by random:1\n";
    if (!refused_.empty())
      text += fmt::format("{} of {} could not be used\n", refused_.size(), counted(inputs_.names().size(), "input"));
    print_out(text);
  }

  /// The summary counts; who writes a peer wants to know why.
  [[nodiscard]] std::string reasons_of_peers() const {
    std::string text;
    std::size_t told = 0;
    for (const Row& row : rows_)
      if (!row.reason.empty() && find_peer(row.contender) != nullptr && ++told <= most_reasons)
        text += shortened(fmt::format("{} in {}: {}", row.contender, row.scene, row.reason)) + '\n';
    if (told > most_reasons) text += fmt::format("and {} more: --all-tables has them\n", told - most_reasons);
    return text.empty() ? text : text + '\n';
  }

  void finish() {
    rows_file_->finish();
    std::vector<ReportSection> sections;
    if (shows_gallery_) sections.push_back({gallery_title, gallery_lines(gallery_of(rows_))});
    std::vector<ReportSection> reported = sections;
    for (ReportSection& standing : standing_sections()) reported.push_back(std::move(standing));
    if (report_) report_->finish({environment(), tolerances_, totals_.lines(), reported});
    if (arguments_.explain) sections.push_back(exemptions_section());
    if (arguments_.json)
      print_json();
    else if (!arguments_.quiet)
      print_summary(sections);
    if (report_ && !arguments_.quiet && !arguments_.json) print_out("report: " + arguments_.report_path + '\n');
  }

  void print_json() const {
    std::vector<Row> all = refused_;
    all.insert(all.end(), rows_.begin(), rows_.end());
    print_out(rows_json(all, environment()).dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) +
              '\n');
  }

  CompareArguments& arguments_;
  Progress progress_;
  Inputs inputs_;
  Outputs outputs_;
  std::size_t scene_count_ = 0;
  int unscripted_ = 0;  ///< Scenes that move by `Scene::moves_at_random`.
  double steps_ = 0;    ///< Of all scenes.
  double steps_done_ = 0;
  bool printed_ = false;               ///< A scene was printed.
  bool shows_gallery_ = false;         ///< A set of scenes was asked for.
  std::optional<RowsFile> rows_file_;  ///< Opened with the other outputs.
  std::vector<Row> refused_;           ///< One for each input that cannot be used.
  std::vector<Row> rows_;              ///< Of what ran.
  Totals totals_;
  ReportOptions report_options_;
  std::optional<ReportWriter> report_;
  std::optional<OutputFile> strip_;
  std::vector<NamedTolerance> tolerances_;
};

}  // namespace

std::uint64_t parse_random_input(const std::string& text) {
  constexpr std::string_view prefix = "random:";
  if (text.starts_with(prefix))
    if (const auto seed = number_in<std::uint64_t>(std::string_view(text).substr(prefix.size()))) return *seed;
  throw InputError(fmt::format("--input {}: expected random:SEED with a whole number from 0 to {}, such as random:1",
                               shown(text), std::numeric_limits<std::uint64_t>::max()));
}

std::vector<KnobSetting> parse_knobs(const std::vector<std::string>& texts,
                                     const std::vector<std::string>& contenders) {
  const auto asked_for = [&](std::string_view name) {
    return contenders.empty() || std::find(contenders.begin(), contenders.end(), name) != contenders.end();
  };
  std::vector<KnobSetting> settings;
  for (const std::string& text : texts) {
    bool anyones = false;
    try {
      settings.push_back(parse_knob(text));
      for (const std::string_view contender : contender_names()) {
        if (!asked_for(contender) || !has_knob(contender, settings.back().key)) continue;
        check_knob(settings.back(), contender);
        anyones = true;
      }
    } catch (const std::invalid_argument& reason) {
      throw InputError(fmt::format("--knob {}: {}", text, reason.what()));
    }
    const std::string& name = settings.back().key;
    if (!anyones) throw InputError(fmt::format("--knob {}: expected a knob of {}", text, fmt::join(contenders, ", ")));
    const auto same = [&](const KnobSetting& setting) { return setting.key == name; };
    if (std::count_if(settings.begin(), settings.end(), same) > 1)
      throw InputError(fmt::format("--knob {}: expected {} once", text, name));
  }
  return settings;
}

void check_contenders(const std::vector<std::string>& names, std::string_view asked) {
  const auto views = contender_names();
  const std::vector<std::string> known(views.begin(), views.end());
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw InputError(fmt::format("{} {}: expected {} (see `paperproof list contenders`){}", asked, shown(name),
                                   one_of_words(known), did_you_mean(name, known)));
}

int compare_scenes(CompareArguments arguments) { return Comparison(arguments).run(); }

}  // namespace paperproof::compare
