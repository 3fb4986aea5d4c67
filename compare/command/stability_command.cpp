#include "command/compare_command.hpp"
#include "command/progress.hpp"
#include "command/study_command.hpp"
#include "command/study_outputs.hpp"
#include "runs/contestant.hpp"
#include "runs/run_case.hpp"
#include "scenes/parameters.hpp"
#include "studies/grids.hpp"
#include "studies/stability.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <utility>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

constexpr const char* explanation =
    "Stiff and extreme cases, judged step by step by exact arithmetic. A cell says how many of its cases do not hold: "
    "pass a solid, end inside one, hang, miss the scene's exact answer, or are no number any more. A click on it says "
    "why, and which command repeats it.";

/// The cases of a region. Box2D always computes in float, so that it runs once.
std::vector<std::size_t> cases_of(const Sweep& sweep) {
  std::vector<std::size_t> cases;
  for (std::size_t i = 0; i < sweep.size(); ++i) {
    const Case one = sweep.at(i);
    if (!is_reference(one.contender) || one.scalar == "double") cases.push_back(i);
  }
  return cases;
}

std::vector<ChartGrid> grids_of_region(const StabilityRegion& region, const ordered_json& rows) {
  const std::vector<ParameterDef> defs = parameters_of(region.sweep.scene);
  const auto key = [&](std::size_t axis) { return row_key(*find_parameter(defs, region.sweep.axes[axis].key)); };
  return grids_of(rows, region.name, key(0), key(1));
}

class StabilityRun {
 public:
  explicit StabilityRun(const StudyArguments& arguments)
      : arguments_(arguments), progress_(!arguments.quiet), outputs_(arguments.rows_path, arguments.report_path) {
    page_.title = "stability";
    page_.paragraphs = {explanation};
    page_.table.heading = {"scene", "contender", "verdict", "reason"};
    page_.environment = environment();
  }

  int run() {
    const std::vector<StabilityRegion> regions = stability_regions(arguments_.contenders);
    for (std::size_t k = 0; k < regions.size(); ++k) {
      const double done = static_cast<double>(k) / static_cast<double>(regions.size());
      note(regions[k], rows_of(regions[k], done, 1 / static_cast<double>(regions.size())));
    }
    progress_.clear();
    outputs_.finish(page_);
    if (!arguments_.quiet) print_out(text_);
    return broken_ ? 1 : 0;
  }

 private:
  /// @param done, share of all that is done before, and that this region is.
  [[nodiscard]] ordered_json rows_of(const StabilityRegion& region, double done, double share) {
    const std::vector<std::size_t> cases = cases_of(region.sweep);
    ordered_json rows = ordered_json::array();
    Jobs jobs = jobs_of(region.sweep, cases.size(), [&](std::size_t job) { return cases[job]; });
    jobs.lost = [&](std::size_t job, const std::string& reason) {
      Row row = failed_row(region.sweep.at(cases[job]), reason);
      row.finite = false;
      return json_line(row_json(row));
    };
    jobs.take = [&](std::size_t job, const std::string& line) {
      outputs_.add(line);
      rows.push_back(ordered_json::parse(line));
      const double in_region = static_cast<double>(job) / static_cast<double>(cases.size());
      progress_.show("stability, " + region.name + ",", done + share * in_region);
    };
    run_in_processes(jobs, {.workers = processes_for(arguments_.jobs)});
    return rows;
  }

  void note(const StabilityRegion& region, const ordered_json& rows) {
    for (const ordered_json& row : rows) {
      const std::string verdict = row.value("verdict", "");
      broken_ = broken_ || breaks_guarantee(row);
      if (verdict != "holds")
        page_.table.rows.push_back(
            {row.value("scene", ""), row.value("contender", ""), verdict, shortened(row.value("reason", ""))});
    }
    text_ += fmt::format("{}: {}\n", region.name, region.question);
    for (ChartGrid& grid : grids_of_region(region, rows)) {
      ChartGrid::Cell sum;
      for (const auto& line : grid.cells)
        for (const ChartGrid::Cell& cell : line) {
          sum.bad += cell.bad;
          sum.all += cell.all;
        }
      const std::string who = grid.title.substr(region.name.size() + 2);
      text_ += fmt::format("  {:<40} {} of {} do not hold\n", who, sum.bad, sum.all);
      page_.grids.push_back(std::move(grid));
    }
  }

  const StudyArguments& arguments_;
  Progress progress_;
  StudyOutputs outputs_;
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
