#include "command/compare_command.hpp"
#include "command/progress.hpp"
#include "command/study_command.hpp"
#include "command/study_outputs.hpp"
#include "report/row_pictures.hpp"
#include "runs/run_case.hpp"
#include "runs/text_columns.hpp"
#include "studies/bullet.hpp"
#include "studies/processes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

constexpr const char* about_bullets =
    "A character flies onto paper. The cases of a cell differ in angle, phase and length of a step. In numbers: the "
    "lowest speed at which each gets through head-on at 60 steps per second, found by bisection over all phases, "
    "beside "
    "what theory says.";

GridSize size_of(const std::string& grid) {
  if (grid == "full") return GridSize::full;
  return grid == "standard" ? GridSize::standard : GridSize::quick;
}

std::string speed_in_words(const BulletTheory& theory) {
  if (!theory.known) return "-";
  if (!theory.lowest) return "never";
  return *theory.lowest > 0 ? fmt::format("{:.4g}", *theory.lowest) : "any";
}

std::string speed_in_words(const Row& row) {
  if (row.verdict == Verdict::not_applicable) return "-";
  if (!row.border_high) return "never";
  return row.border_low ? fmt::format("{:.4g}", *row.border_high) : "any";
}

class BulletRun {
 public:
  explicit BulletRun(const StudyArguments& arguments)
      : arguments_(arguments),
        size_(size_of(arguments.grid)),
        contenders_(bullet_contenders(arguments.contenders)),
        outputs_(arguments.rows_path, arguments.pages, arguments.log_path),
        progress_(!arguments.quiet, arguments.log_path) {}

  int run() {
    for (const BulletContender& contender : contenders_) shoot(contender);
    find_lowest_speeds();
    progress_.clear();
    outputs_.finish(page());
    if (!arguments_.quiet) print_out(table());
    return broken_ ? 1 : 0;
  }

 private:
  [[nodiscard]] ProcessOptions processes() const { return {processes_for(arguments_.jobs), std::chrono::seconds(600)}; }

  void shoot(const BulletContender& contender) {
    const Sweep sweep = bullet_sweep(size_, contender);
    Jobs jobs = jobs_of(sweep, sweep.size(), [](std::size_t job) { return job; });
    jobs.take = [&](std::size_t job, const std::string& line) {
      const ordered_json row = ordered_json::parse(line);
      counter_.add(row);
      broken_ = broken_ || breaks_guarantee(row);
      outputs_.add(line);
      progress_.show(contender.called() + ",", static_cast<double>(job + 1) / static_cast<double>(sweep.size()));
    };
    run_in_processes(jobs, processes());
  }

  void find_lowest_speeds() {
    lowest_.resize(contenders_.size() * thicknesses_.size());
    Jobs jobs;
    jobs.count = lowest_.size();
    const auto contender_of = [&](std::size_t job) { return contenders_[job / thicknesses_.size()]; };
    jobs.run = [&](std::size_t job) {
      const double thickness = thicknesses_[job % thicknesses_.size()];
      return json_line(row_json(lowest_speed_through(contender_of(job), thickness, phases_of(size_))));
    };
    jobs.lost = [&](std::size_t job, const std::string& reason) {
      Case one;
      one.scene = "paper";
      one.contender = contender_of(job).name;
      return json_line(row_json(failed_row(one, reason)));
    };
    jobs.take = [&](std::size_t job, const std::string& line) {
      const ordered_json row = ordered_json::parse(line);
      if (row.contains("border_low")) lowest_[job].border_low = row["border_low"];
      if (row.contains("border_high")) lowest_[job].border_high = row["border_high"];
      if (row.value("verdict", "") == "not_applicable") lowest_[job].verdict = Verdict::not_applicable;
      outputs_.add(line);
      progress_.show("lowest speeds,", static_cast<double>(job + 1) / static_cast<double>(lowest_.size()));
    };
    run_in_processes(jobs, processes());
  }

  /// One line for each contender.
  [[nodiscard]] ChartTable numbers() const {
    ChartTable table;
    table.heading = {"contender", "cases", "through", "rate", "95 % from", "to"};
    for (const double thickness : thicknesses_) {
      table.heading.push_back(fmt::format("lowest at {:g} m", thickness));
      table.heading.emplace_back("theory");
    }
    const std::vector<ChartGrid> grids = counter_.grids();
    for (std::size_t c = 0; c < contenders_.size(); ++c) {
      const auto grid = std::find_if(grids.begin(), grids.end(),
                                     [&](const ChartGrid& one) { return one.title == contenders_[c].called(); });
      const ChartGrid::Cell sum = grid == grids.end() ? ChartGrid::Cell{} : total_of(*grid);
      const Interval interval = wilson(sum.bad, sum.all);
      const double rate = sum.all > 0 ? static_cast<double>(sum.bad) / sum.all : 0;
      std::vector<std::string> line{contenders_[c].called(),
                                    std::to_string(sum.all),
                                    std::to_string(sum.bad),
                                    fmt::format("{:.4f}", rate),
                                    fmt::format("{:.6f}", interval.low),
                                    fmt::format("{:.6f}", interval.high)};
      for (std::size_t t = 0; t < thicknesses_.size(); ++t) {
        line.push_back(speed_in_words(lowest_[c * thicknesses_.size() + t]));
        line.push_back(speed_in_words(bullet_theory(contenders_[c], thicknesses_[t])));
      }
      table.rows.push_back(std::move(line));
    }
    return table;
  }

  [[nodiscard]] std::string table() const {
    const ChartTable all = numbers();
    std::vector<TextColumn> columns;
    for (std::size_t k = 0; k < all.heading.size(); ++k) {
      TextColumn column{all.heading[k], {}, k == 0};
      for (const std::vector<std::string>& line : all.rows) column.cells.emplace_back(line[k]);
      columns.push_back(std::move(column));
    }
    return aligned(columns) + "\nspeeds in m/s\n";
  }

  [[nodiscard]] ChartPage page() const {
    ChartPage page;
    page.title = bullets_title;
    page.paragraphs = {how_to_read_maps, about_bullets};
    page.grids = counter_.grids();
    page.table = numbers();
    page.environment = environment();
    return page;
  }

  const StudyArguments& arguments_;
  GridSize size_;
  std::vector<BulletContender> contenders_;
  std::vector<double> thicknesses_ = bullet_thicknesses();
  StudyOutputs outputs_;
  Progress progress_;
  GridCounter counter_{"", "speed_m_s", "thickness_m", Bad::tunnels};
  std::vector<Row> lowest_;  ///< By contender, then by thickness.
  bool broken_ = false;
};

}  // namespace

int study_bullet_command(const StudyArguments& arguments) {
  check_contenders(arguments.contenders);
  return BulletRun(arguments).run();
}

}  // namespace paperproof::compare
