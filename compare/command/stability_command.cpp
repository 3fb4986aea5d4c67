#include "command/compare_command.hpp"
#include "command/progress.hpp"
#include "command/study_command.hpp"
#include "command/study_outputs.hpp"
#include "report/row_pictures.hpp"
#include "runs/contender.hpp"
#include "runs/run_case.hpp"
#include "runs/text_columns.hpp"
#include "scenes/parameters.hpp"
#include "studies/processes.hpp"
#include "studies/stability.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

constexpr const char* about_stability =
    "Stiff and extreme cases, judged step by step by exact arithmetic. A cell says how many of its cases do not hold: "
    "one of the predicates below fails, the scene's exact answer is missed, or the contender's limits are passed. "
    "Point at it to read why; a click, or Enter, replays its first case that does not hold, and names the command.";

/// Keys of a row that say whether a predicate holds, in the order of `stability_predicates`.
constexpr std::array<const char*, 6> predicate_keys{"finite",    "penetration_ok", "drift_ok",
                                                    "energy_ok", "hanging_ok",     "events_ok"};

/// The cases of a region. Box2D computes in float whatever is asked for: once is enough.
std::vector<std::size_t> cases_of(const Sweep& sweep) {
  std::vector<std::size_t> cases;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const Case one = sweep.at(i);
    if (!is_reference(one.contender) || one.scalar == "double") cases.push_back(i);
  }
  return cases;
}

/// What the contender of a row is called in a table.
std::string who(const ordered_json& row) {
  const std::string contender = row.value("contender", "");
  return is_reference(contender) ? contender : contender + " in " + row.value("scalar", "");
}

/// Each once, Box2D last: float stands beside double.
std::vector<std::string> names_in(const ordered_json& rows) {
  std::vector<std::string> names;
  for (const ordered_json& row : rows)
    if (std::find(names.begin(), names.end(), who(row)) == names.end()) names.push_back(who(row));
  std::stable_partition(names.begin(), names.end(), [](const std::string& name) { return !is_reference(name); });
  return names;
}

std::vector<ChartGrid> grids_of_region(const StabilityRegion& region, const ordered_json& rows) {
  const std::vector<ParameterDef> defs = parameters_of(region.sweep.scene);
  const auto key = [&](std::size_t axis) { return row_key(*find_parameter(defs, region.sweep.axes[axis].key)); };
  return grids_of(rows, region.name, key(0), key(1));
}

/// Which predicates fail, how often: `drift 3, energy 1`.
std::string failures_in(const ordered_json& rows, const std::string& of) {
  std::string text;
  for (std::size_t k = 0; k < predicate_keys.size(); ++k) {
    const auto fails = [&](const ordered_json& row) { return who(row) == of && !row.value(predicate_keys[k], true); };
    const auto count = std::count_if(rows.begin(), rows.end(), fails);
    if (count > 0) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", stability_predicates()[k].name, count);
  }
  return text;
}

/// A region or a border, and which of its cases.
struct Job {
  bool is_border = false;
  std::size_t of = 0;
  std::size_t index = 0;
};

class StabilityRun {
 public:
  explicit StabilityRun(const StudyArguments& arguments)
      : arguments_(arguments),
        regions_(stability_regions(arguments.contenders, arguments.grid)),
        borders_(stability_borders(arguments.contenders, arguments.grid)),
        outputs_(arguments.rows_path, arguments.report_path, arguments.log_path),
        progress_(!arguments.quiet, arguments.log_path),
        rows_(regions_.size() + borders_.size(), ordered_json::array()) {
    for (std::size_t k = 0; k < regions_.size(); ++k)
      for (const std::size_t index : cases_of(regions_[k].sweep)) jobs_.push_back({false, k, index});
    for (std::size_t k = 0; k < borders_.size(); ++k)
      for (const std::size_t index : cases_of(borders_[k].sweep)) jobs_.push_back({true, k, index});
    page_.title = "stability";
    page_.paragraphs = {about_stability};
    for (const Predicate& predicate : stability_predicates())
      page_.paragraphs.push_back(predicate.name + ": " + predicate.meaning + ".");
    page_.table.heading = {"scene", "contender", "verdict", "reason"};
    page_.environment = environment();
  }

  int run() {
    run_all();
    progress_.clear();
    for (std::size_t k = 0; k < regions_.size(); ++k) note(regions_[k], rows_[k]);
    text_ += borders_in_words();
    outputs_.finish(page_, arguments_.jobs);
    if (!arguments_.quiet) print_out(text_);
    return broken_ ? 1 : 0;
  }

 private:
  [[nodiscard]] Row row_of(const Job& job) const {
    return job.is_border ? run_at(borders_[job.of], job.index) : run_at(regions_[job.of], job.index);
  }

  [[nodiscard]] Case case_of(const Job& job) const {
    return (job.is_border ? borders_[job.of].sweep : regions_[job.of].sweep).at(job.index);
  }

  void run_all() {
    Jobs jobs;
    jobs.count = jobs_.size();
    jobs.run = [&](std::size_t job) { return json_line(row_json(row_of(jobs_[job]))); };
    jobs.lost = [&](std::size_t job, const std::string& reason) {
      Row row = failed_row(case_of(jobs_[job]), reason);
      row.finite = false;
      return json_line(row_json(row));
    };
    jobs.take = [&](std::size_t job, const std::string& line) {
      outputs_.add(line);
      ordered_json row = ordered_json::parse(line);
      broken_ = broken_ || breaks_guarantee(row);
      rows_[jobs_[job].is_border ? regions_.size() + jobs_[job].of : jobs_[job].of].push_back(std::move(row));
      progress_.show(fmt::format("stability, {} of {} cases,", job + 1, jobs.count),
                     static_cast<double>(job + 1) / static_cast<double>(jobs.count));
    };
    const std::chrono::seconds limit(arguments_.grid == "full" ? 24 * 3600 : 600);
    run_in_processes(jobs, {.workers = processes_for(arguments_.jobs), .limit = limit});
  }

  void note(const StabilityRegion& region, const ordered_json& rows) {
    for (const ordered_json& row : rows) {
      const std::string verdict = row.value("verdict", "");
      if (verdict != "holds")
        page_.table.rows.push_back({row.value("scene", ""), who(row), verdict, shortened(row.value("reason", ""))});
    }
    text_ += fmt::format("{}: {}\n", region.name, region.question);
    for (const std::string& name : names_in(rows)) text_ += score_of(rows, name);
    for (ChartGrid& grid : grids_of_region(region, rows)) page_.grids.push_back(std::move(grid));
  }

  static std::string score_of(const ordered_json& rows, const std::string& name) {
    const auto is_of = [&](const ordered_json& row) {
      return who(row) == name && row.value("verdict", "") != "not_applicable";
    };
    const auto does_not_hold = [&](const ordered_json& row) {
      return is_of(row) && row.value("verdict", "") != "holds";
    };
    const std::string failures = failures_in(rows, name);
    return fmt::format("  {:<24} {} of {} do not hold{}\n", name,
                       std::count_if(rows.begin(), rows.end(), does_not_hold),
                       std::count_if(rows.begin(), rows.end(), is_of), failures.empty() ? "" : " (" + failures + ")");
  }

  /// `up to X` where it holds from the least value on, `all` where no border is in the range, `none` where it never
  /// holds, `-` where it cannot run, `?` where the search failed.
  static std::string border_in_words(const ordered_json& row) {
    const bool low = row.contains("border_low");
    const bool high = row.contains("border_high");
    if (row.value("verdict", "") == "failed") return "?";
    if (!low && !high) return "-";
    if (!low) return "none";
    return high ? fmt::format("{:.4g}", row["border_low"].get<double>()) : "all";
  }

  /// One line for each border, here and first on the page.
  [[nodiscard]] std::string borders_in_words() {
    std::vector<TextColumn> columns{{"holds up to", {}, true}, {"parameter", {}, true}, {"range", {}}};
    const std::vector<std::string> names = names_in(rows_.back());
    for (const std::string& name : names) columns.push_back({name, {}});
    for (std::size_t k = 0; k < borders_.size(); ++k) {
      const ordered_json& rows = rows_[regions_.size() + k];
      columns[0].cells.emplace_back(borders_[k].name);
      columns[1].cells.emplace_back(rows.front().value("border", *borders_[k].sweep.border));
      columns[2].cells.emplace_back(
          fmt::format("{:g} to {:g}", borders_[k].sweep.border_range->first, borders_[k].sweep.border_range->second));
      std::vector<std::string> words;
      for (std::size_t n = 0; n < names.size(); ++n) {
        const auto row =
            std::find_if(rows.begin(), rows.end(), [&](const auto& each) { return who(each) == names[n]; });
        columns[3 + n].cells.emplace_back(border_in_words(*row));
        words.push_back(names[n] + ": " + border_in_words(*row));
      }
      page_.table.rows.insert(page_.table.rows.begin() + static_cast<std::ptrdiff_t>(k),
                              {borders_[k].name, "", "border", fmt::format("{}", fmt::join(words, ", "))});
    }
    return "\n" + aligned(columns);
  }

  const StudyArguments& arguments_;
  std::vector<StabilityRegion> regions_;
  std::vector<StabilityBorder> borders_;
  StudyOutputs outputs_;
  Progress progress_;
  std::vector<Job> jobs_;
  std::vector<ordered_json> rows_;  ///< Of each region, then of each border.
  ChartPage page_;
  std::string text_;
  bool broken_ = false;
};

}  // namespace

int stability_command(const StudyArguments& arguments) {
  check_contenders(arguments.contenders);
  return StabilityRun(arguments).run();
}

}  // namespace paperproof::compare
