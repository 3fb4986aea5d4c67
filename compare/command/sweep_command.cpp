#include "command/sweep_command.hpp"

#include "command/compare_command.hpp"
#include "command/forecast.hpp"
#include "command/progress.hpp"
#include "command/study_outputs.hpp"
#include "number_in.hpp"
#include "records/rows_reader.hpp"
#include "report/row_pictures.hpp"
#include "runs/contestant.hpp"
#include "runs/text_columns.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"
#include "words.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// Rows that a page lists one by one.
constexpr std::size_t most_listed = 2000;

/// Which part of a sweep: every `of`-th case, from the `part`-th on.
struct Shard {
  std::size_t part = 1;
  std::size_t of = 1;
  [[nodiscard]] std::size_t size(std::size_t all) const { return all < part ? 0 : (all - part) / of + 1; }
};

Shard parse_shard(const std::string& text) {
  Shard shard;
  if (text.empty()) return shard;
  const std::size_t slash = text.find('/');
  if (slash != std::string::npos) {
    shard.part = number_in<std::size_t>(std::string_view(text).substr(0, slash)).value_or(0);
    shard.of = number_in<std::size_t>(std::string_view(text).substr(slash + 1)).value_or(0);
    if (shard.part >= 1 && shard.part <= shard.of) return shard;
  }
  refuse("--shard " + text, "expected K/N with K from 1 to N");
}

std::vector<Case::Setting> settings_in(const std::vector<std::string>& typed) {
  std::vector<Case::Setting> settings;
  for (const std::string& text : typed) {
    static_cast<void>(parse_setting(text));
    const std::size_t equals = text.find('=');
    settings.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  return settings;
}

Sweep sweep_of(const SweepArguments& arguments) {
  Sweep sweep;
  sweep.scene = arguments.scene;
  for (const std::string& text : arguments.vary) sweep.axes.push_back(parse_axis(text));
  sweep.set = settings_in(arguments.set);
  check_contenders(arguments.contenders);
  sweep.contenders = arguments.contenders;
  if (sweep.contenders.empty())
    for (const std::string_view name : contender_names())
      if (arguments.reference || !is_reference(name)) sweep.contenders.emplace_back(name);
  if (!arguments.scalars.empty()) sweep.scalars = arguments.scalars;
  for (const KnobSetting& knob : parse_knobs(arguments.knobs, arguments.contenders))
    sweep.knobs.push_back({knob.name, knob.value});
  sweep.seed = arguments.seed;
  sweep.steps = arguments.steps;
  sweep.border = arguments.border;
  check(sweep);
  return sweep;
}

std::vector<std::string> axis_keys_of(const Sweep& sweep) {
  std::vector<std::string> keys;
  const std::vector<ParameterDef> defs = parameters_of(sweep.scene);
  for (const SweepAxis& axis : sweep.axes)
    if (const ParameterDef* def = find_parameter(defs, axis.key)) keys.push_back(row_key(*def));
  return keys;
}

/// What came of the cases of one contender.
struct Score {
  int cases = 0;
  int holds = 0;
  int through = 0;
  int other = 0;  ///< Ends inside something, or is flagged or failed for another reason.
  int cannot = 0;
};

class SweepRun {
 public:
  explicit SweepRun(const SweepArguments& arguments)
      : arguments_(arguments),
        sweep_(sweep_of(arguments)),
        axis_keys_(axis_keys_of(sweep_)),
        shard_(parse_shard(arguments.shard)),
        count_(shard_.size(sweep_.size())) {
    header_ = rows_header(environment());
    header_["sweep"] = {{"id", id_of(sweep_)}, {"cases", sweep_.size()}, {"shard", {shard_.part, shard_.of}}};
    ClaimedFiles files;
    files.claim_for_option("--rows", arguments.rows_path);
    files.claim_for_option("--report", arguments.pages.report);
    files.claim_for_option("--log", arguments.log_path);
    open_rows();
    pages_.emplace(arguments.pages);
  }

  int run() {
    const Progress progress(!arguments_.quiet, arguments_.log_path);
    Forecast forecast(!arguments_.quiet, static_cast<double>(count_ - done_));
    forecast.begin_scene(static_cast<double>(count_ - done_));
    forecast.done(0);
    const std::size_t before = done_;
    Jobs jobs = jobs_of(sweep_, count_ - before, [&](std::size_t job) { return case_of(before + job); });
    jobs.take = [&](std::size_t, const std::string& line) {
      take(line);
      const double share = static_cast<double>(done_ - before) / static_cast<double>(jobs.count);
      forecast.done(share);
      progress.show(fmt::format("sweep, {} of {} cases,", done_, count_), share);
    };
    run_in_processes(jobs, {processes_for(arguments_.jobs), std::chrono::seconds(arguments_.limit_s)});
    progress.clear();
    finish();
    return trouble_ ? 1 : 0;
  }

 private:
  [[nodiscard]] std::size_t case_of(std::size_t job) const { return shard_.part - 1 + job * shard_.of; }
  [[nodiscard]] bool as_lines() const { return arguments_.rows_path.ends_with(".jsonl"); }

  void open_rows() {
    const std::string& path = arguments_.rows_path;
    if (arguments_.resume && !as_lines()) throw InputError("--resume: expected --rows FILE.jsonl to go on with");
    if (path.empty()) return;
    const bool goes_on = arguments_.resume && std::filesystem::exists(path) && std::filesystem::file_size(path) > 0;
    if (goes_on) skip_what_is_done();
    using Appears = OutputFile::Appears;
    rows_.emplace(path, goes_on ? Appears::continued : as_lines() ? Appears::as_written : Appears::whole);
    if (!as_lines() || goes_on) return;
    rows_->write(json_line(header_));
    rows_->flush();
  }

  void skip_what_is_done() {
    RowsReader reader(arguments_.rows_path);
    if (reader.header().value("sweep", ordered_json{}) != header_["sweep"])
      throw InputError("--resume: " + arguments_.rows_path + " has rows of another sweep or shard");
    while (const std::optional<std::string> line = reader.next()) note(*line);
    std::filesystem::resize_file(arguments_.rows_path, reader.end());
  }

  void take(const std::string& line) {
    note(line);
    if (!rows_ || !as_lines()) return;
    rows_->write(line);
    rows_->flush();
  }

  void note(const std::string& line) {
    ++done_;
    ordered_json row = ordered_json::parse(line);
    const std::string verdict = row.value("verdict", "");
    const std::string contender = row.value("contender", "");
    Score& score = scores_[contender];
    ++score.cases;
    trouble_ = trouble_ || verdict == "failed" || breaks_guarantee(row);
    if (verdict == "holds")
      ++score.holds;
    else if (verdict == "not_applicable")
      ++score.cannot;
    else if (row.value("tunnels", 0) > 0)
      ++score.through;
    else
      ++score.other;
    if (keeps_rows()) kept_.push_back(std::move(row));
  }

  [[nodiscard]] bool keeps_rows() const {
    return (!as_lines() && !arguments_.rows_path.empty()) || arguments_.pages.wanted() || sweep_.border;
  }

  void finish() {
    if (rows_ && !as_lines()) {
      const bool csv = arguments_.rows_path.ends_with(".csv");
      ordered_json file = header_;
      file["rows"] = kept_;
      rows_->write(csv ? rows_csv(kept_) : file.dump(1, ' ', false, ordered_json::error_handler_t::replace) + '\n');
    }
    if (rows_) rows_->commit();
    if (arguments_.pages.wanted()) pages_->finish(page());
    if (!arguments_.quiet) print_out(sweep_.border ? borders() : scores());
  }

  [[nodiscard]] std::string scores() const {
    std::vector<TextColumn> columns{{"contender", {}, true}, {"cases", {}},        {"hold", {}},
                                    {"through", {}},         {"other faults", {}}, {"cannot run", {}}};
    for (const std::string& name : sweep_.contenders) {
      const auto found = scores_.find(name);
      const Score score = found == scores_.end() ? Score{} : found->second;
      columns[0].cells.emplace_back(name);
      std::size_t column = 1;
      for (const int number : {score.cases, score.holds, score.through, score.other, score.cannot})
        columns[column++].cells.emplace_back(std::to_string(number));
    }
    return fmt::format("{}: {}\n\n{}", sweep_.scene, counted(done_, "case"), aligned(columns));
  }

  /// The values of the axes of a row, as `thickness_m=0.01`.
  [[nodiscard]] std::string place_of(const ordered_json& row) const {
    std::string text;
    for (const std::string& key : axis_keys_)
      if (row.contains("parameters") && row["parameters"].contains(key))
        text += fmt::format("{}{}={:.4g}", text.empty() ? "" : " ", key, row["parameters"][key].get<double>());
    return text;
  }

  [[nodiscard]] std::string borders() const {
    std::vector<TextColumn> columns{
        {"contender", {}, true}, {"at", {}, true}, {"holds up to", {}}, {"does not hold from", {}}};
    for (const ordered_json& row : kept_) {
      const auto number = [&](const char* key) {
        return row.contains(key) ? Cell(fmt::format("{:.6g}", row[key].get<double>())) : Cell{};
      };
      columns[0].cells.emplace_back(row.value("contender", ""));
      columns[1].cells.emplace_back(place_of(row));
      columns[2].cells.push_back(number("border_low"));
      columns[3].cells.push_back(number("border_high"));
    }
    return fmt::format("{}: border of {}\n\n{}", sweep_.scene, *sweep_.border, aligned(columns));
  }

  [[nodiscard]] ChartPage page() const {
    ChartPage page;
    page.title = fmt::format("sweep of {}", sweep_.scene);
    page.paragraphs = {how_to_read_maps,
                       fmt::format("{}, each judged step by step by exact arithmetic. Every row has the command that "
                                   "runs its case alone.",
                                   counted(done_, "case"))};
    page.environment = environment();
    if (!axis_keys_.empty() && !sweep_.border)
      page.grids = grids_of(kept_, "", axis_keys_.front(), axis_keys_.size() > 1 ? axis_keys_[1] : "");
    page.table.heading = {"contender", "at", "verdict", "tunnels", "inside", "command"};
    for (const ordered_json& row : kept_) {
      if (page.table.rows.size() == most_listed) break;
      const auto number = [&](const char* key) { return row.contains(key) ? row[key].dump() : std::string(); };
      page.table.rows.push_back({row.value("contender", ""), place_of(row), row.value("verdict", ""), number("tunnels"),
                                 number("steps_ending_inside"), row.value("command", "")});
    }
    return page;
  }

  const SweepArguments& arguments_;
  Sweep sweep_;
  std::vector<std::string> axis_keys_;  ///< In `parameters`, of the axes that are parameters of the scene.
  Shard shard_;
  std::size_t count_;  ///< Cases of this shard.
  std::size_t done_ = 0;
  ordered_json header_;
  std::optional<OutputFile> rows_;
  std::optional<PageOutputs> pages_;
  ordered_json kept_ = ordered_json::array();
  std::map<std::string, Score> scores_;
  bool trouble_ = false;
};

}  // namespace

int sweep_command(const SweepArguments& arguments) { return SweepRun(arguments).run(); }

}  // namespace paperproof::compare
