#include "command/precision_command.hpp"

#include "command/claimed_files.hpp"
#include "command/compare_command.hpp"
#include "command/progress.hpp"
#include "records/output_file.hpp"
#include "records/rows_file.hpp"
#include "runs/environment.hpp"
#include "runs/run_case.hpp"
#include "runs/text_columns.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"
#include "studies/bullet.hpp"
#include "studies/grids.hpp"
#include "studies/processes.hpp"
#include "studies/stability.hpp"
#include "studies/work_precision.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <thread>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// Rows and page, opened before the work begins.
struct Outputs {
  explicit Outputs(const PrecisionArguments& arguments) {
    ClaimedFiles files;
    files.claim_for_option("--rows", arguments.rows_path);
    files.claim_for_option("--report", arguments.report_path);
    if (!arguments.rows_path.empty()) rows.emplace(arguments.rows_path, environment());
    if (!arguments.report_path.empty()) report.emplace(arguments.report_path);
  }
  void finish(const ordered_json& all, const ChartPage& page) {
    ordered_json document = rows_header(environment());
    document["rows"] = all;
    if (rows) rows->finish(document);
    if (!report) return;
    report->write(html_of(page));
    report->commit();
  }
  std::optional<RowsFile> rows;
  std::optional<OutputFile> report;
};

std::string name_of_curve(const Row& row) {
  return row.contender + (row.scalar == "float" && !is_reference(row.contender) ? " float" : "");
}

/// One chart per motion: error over time, a curve for each contender and knob.
Chart chart_of(const KnownMotion& motion, const WorkPrecision& found) {
  Chart chart{std::string(motion.name) + ": " + std::string(motion.description),
              "ns per second of motion",
              "largest distance [m]",
              {}};
  for (const Row& curve : found.curves) {
    if (curve.scene != motion.name) continue;
    ChartSeries series{name_of_curve(curve) + (curve.curve == "dt_s" ? "" : " over " + curve.curve), {}};
    for (const Row& point : found.points) {
      const auto has = [&](const std::string& key) {
        return std::any_of(point.parameters.begin(), point.parameters.end(),
                           [&](const auto& each) { return each.first == key; });
      };
      const bool mine = point.scene == curve.scene && point.contender == curve.contender &&
                        point.scalar == curve.scalar && has(curve.curve) &&
                        (curve.curve != "dt_s" || point.parameters.size() == 1);
      if (!mine || !point.error_max_m || !point.ns_per_step || !(*point.error_max_m > 0)) continue;
      series.points.push_back({*point.ns_per_step / point.parameters.front().second, *point.error_max_m});
    }
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  return chart;
}

ChartPage page_of(const WorkPrecision& found) {
  ChartPage page;
  page.title = "work and precision";
  page.paragraphs = {
      "How far each contender is from continuous motion, which is known in closed form, against the time that a second "
      "of motion takes to compute. Left and down is better. Each curve goes over the length of a step, from 1/15 to "
      "1/480 s, or over the contender's own knob at 1/60 s. Errors and times are measured apart; times are the minimum "
      "of nine runs after a warm-up, contenders taking turns. Box2D stops 15 mm away from what it meets: its curves "
      "end there."};
  for (const std::string& sentence : found.sentences) page.paragraphs.push_back(sentence);
  for (const KnownMotion& motion : known_motions()) {
    Chart chart = chart_of(motion, found);
    if (!chart.series.empty()) page.charts.push_back(std::move(chart));
  }
  page.table.heading = {"motion", "contender", "over", "slope"};
  for (const Row& curve : found.curves)
    page.table.rows.push_back({curve.scene, name_of_curve(curve), curve.curve,
                               curve.slope ? fmt::format("{:.2f}", *curve.slope) : curve.reason});
  page.environment = environment();
  return page;
}

std::string slopes(const WorkPrecision& found) {
  std::vector<TextColumn> columns{{"contender", {}, true}, {"over", {}, true}};
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Row& curve : found.curves) {
    const std::pair line{name_of_curve(curve), curve.curve};
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  for (const auto& [who, over] : lines) {
    columns[0].cells.emplace_back(who);
    columns[1].cells.emplace_back(over);
  }
  for (const KnownMotion& motion : known_motions()) {
    TextColumn column{std::string(motion.name), {}};
    for (const auto& [who, over] : lines) {
      const auto curve = std::find_if(found.curves.begin(), found.curves.end(), [&](const Row& row) {
        return row.scene == motion.name && name_of_curve(row) == who && row.curve == over;
      });
      const bool has = curve != found.curves.end() && curve->slope;
      column.cells.push_back(has ? Cell(fmt::format("{:.2f}", *curve->slope)) : Cell{});
    }
    columns.push_back(std::move(column));
  }
  return aligned(columns);
}

}  // namespace

int work_precision_command(const PrecisionArguments& arguments) {
#ifndef NDEBUG
  throw InputError("work-precision: expected a build without assertions (NDEBUG): this one's times mean nothing");
#endif
  check_contenders(arguments.contenders);
  Outputs outputs(arguments);
  const Progress progress(!arguments.quiet);
  WorkPrecision found;
  try {
    found = study_work_precision(arguments.motions, arguments.contenders,
                                 [&](double share) { progress.show("work-precision,", share); });
  } catch (const std::invalid_argument& reason) {
    std::vector<std::string> names;
    for (const KnownMotion& motion : known_motions()) names.emplace_back(motion.name);
    throw InputError(fmt::format("work-precision: expected {}: {}", one_of_words(names), reason.what()));
  }
  progress.clear();
  ordered_json all = ordered_json::array();
  bool failed = false;
  for (const std::vector<Row>* rows : {&found.points, &found.curves})
    for (const Row& row : *rows) {
      all.push_back(row_json(row));
      if (outputs.rows) outputs.rows->add(row);
      failed = failed || row.verdict == Verdict::failed;
    }
  outputs.finish(all, page_of(found));
  if (!arguments.quiet) {
    std::string text = "slope of log error over log knob\n\n" + slopes(found) + '\n';
    for (const std::string& sentence : found.sentences) text += sentence + '\n';
    print_out(text);
  }
  return failed ? 1 : 0;
}

int stability_command(const PrecisionArguments& arguments) {
  check_contenders(arguments.contenders);
  const std::vector<StabilityRegion> regions = stability_regions(arguments.contenders);
  Outputs outputs(arguments);
  const Progress progress(!arguments.quiet);
  ChartPage page;
  page.title = "stability";
  page.paragraphs = {
      "Stiff and extreme cases, judged step by step by exact arithmetic. A cell says how many of its cases do not "
      "hold: "
      "pass a solid, end inside one, hang, miss the scene's exact answer, or are no number any more. A click on it "
      "says "
      "why, and which command repeats it."};
  ordered_json all = ordered_json::array();
  bool broken = false;
  std::string text;
  for (std::size_t k = 0; k < regions.size(); ++k) {
    const StabilityRegion& region = regions[k];
    ordered_json rows = ordered_json::array();
    Jobs jobs;
    // Box2D computes in float whatever is asked for: once is enough.
    std::vector<std::size_t> cases;
    for (std::size_t i = 0; i < region.sweep.size(); ++i) {
      const Case one = region.sweep.at(i);
      if (!is_reference(one.contender) || one.scalar == "double") cases.push_back(i);
    }
    jobs.count = cases.size();
    jobs.run = [&](std::size_t job) { return json_line(row_json(run_at(region.sweep, cases[job]))); };
    jobs.lost = [&](std::size_t job, const std::string& reason) {
      Row row = failed_row(region.sweep.at(cases[job]), reason);
      row.finite = false;
      return json_line(row_json(row));
    };
    jobs.take = [&](std::size_t job, const std::string& line) {
      ordered_json row = ordered_json::parse(line);
      const bool guaranteed = row.value("contender", "") == "octagon_sweep" && row.value("scalar", "") == "double";
      broken = broken || (guaranteed && row.value("verdict", "") == "violates");
      if (outputs.rows) outputs.rows->add(line);
      all.push_back(row);
      rows.push_back(std::move(row));
      const double done = static_cast<double>(job) / static_cast<double>(cases.size());
      progress.show("stability, " + region.name + ",",
                    (static_cast<double>(k) + done) / static_cast<double>(regions.size()));
    };
    const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    run_in_processes(jobs, {arguments.jobs > 0 ? arguments.jobs : cores, std::chrono::seconds(60)});
    std::vector<std::string> keys;
    const std::vector<ParameterDef> defs = parameters_of(region.sweep.scene);
    for (const SweepAxis& axis : region.sweep.axes) keys.push_back(row_key(*find_parameter(defs, axis.key)));
    std::vector<ChartGrid> grids = grids_of(rows, region.name, keys[0], keys[1]);
    text += fmt::format("{}: {}\n", region.name, region.question);
    for (const ChartGrid& grid : grids) {
      int bad = 0;
      int count = 0;
      for (const auto& line : grid.cells)
        for (const ChartGrid::Cell& cell : line) {
          bad += cell.bad;
          count += cell.all;
        }
      text += fmt::format("  {:<40} {} of {} do not hold\n", grid.title.substr(region.name.size() + 2), bad, count);
    }
    page.grids.insert(page.grids.end(), grids.begin(), grids.end());
  }
  progress.clear();
  page.table.heading = {"scene", "contender", "verdict", "reason"};
  for (const ordered_json& row : all)
    if (row.value("verdict", "") != "holds")
      page.table.rows.push_back({row.value("scene", ""), row.value("contender", ""), row.value("verdict", ""),
                                 shortened(row.value("reason", ""))});
  page.environment = environment();
  outputs.finish(all, page);
  if (!arguments.quiet) print_out(text);
  return broken ? 1 : 0;
}

namespace {

/// What the cases of a contender came to, counted as they come: nothing is kept of a million rows.
class BulletPicture {
 public:
  BulletPicture(const BulletContender& contender, const Sweep& sweep) : contender_(contender) {
    grid_.title = contender.called();
    grid_.x_label = "speed_m_s";
    grid_.y_label = "thickness_m";
    for (const std::string& speed : sweep.axes[0].values) grid_.xs.push_back(fmt::format("{:.3g}", std::stod(speed)));
    grid_.ys = sweep.axes[1].values;
    grid_.cells.assign(grid_.ys.size(), std::vector<ChartGrid::Cell>(grid_.xs.size()));
  }

  void add(std::size_t speed, std::size_t thickness, const ordered_json& row) {
    const std::string verdict = row.value("verdict", "");
    if (verdict == "not_applicable") return;
    ChartGrid::Cell& cell = grid_.cells[thickness][speed];
    const bool through = row.value("tunnels", 0) > 0;
    if (cell.all == 0 || (through && cell.bad == 0)) cell.words = row.value("command", "");
    ++cell.all;
    cell.bad += through;
    ++all_;
    bad_ += through;
  }

  [[nodiscard]] const BulletContender& contender() const { return contender_; }
  [[nodiscard]] const ChartGrid& grid() const { return grid_; }
  [[nodiscard]] int all() const { return all_; }
  [[nodiscard]] int bad() const { return bad_; }

 private:
  BulletContender contender_;
  ChartGrid grid_;
  int all_ = 0;
  int bad_ = 0;
};

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

}  // namespace

int study_bullet_command(const PrecisionArguments& arguments) {
  check_contenders(arguments.contenders);
  const GridSize size = arguments.grid == "full"       ? GridSize::full
                        : arguments.grid == "standard" ? GridSize::standard
                                                       : GridSize::quick;
  Outputs outputs(arguments);
  const Progress progress(!arguments.quiet);
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const ProcessOptions processes{arguments.jobs > 0 ? arguments.jobs : cores, std::chrono::seconds(600)};
  const std::vector<BulletContender> contenders = bullet_contenders(arguments.contenders);
  const bool keeps = outputs.rows.has_value() && !arguments.rows_path.ends_with(".jsonl");
  ordered_json kept = ordered_json::array();
  const auto keep = [&](const std::string& line) {
    if (outputs.rows) outputs.rows->add(line);
    if (keeps) kept.push_back(ordered_json::parse(line));
  };
  std::vector<BulletPicture> pictures;
  bool broken = false;
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const Sweep sweep = bullet_sweep(size, contenders[c]);
    BulletPicture picture(contenders[c], sweep);
    const std::size_t thicknesses = sweep.axes[1].values.size();
    const std::size_t each = sweep.size() / sweep.axes[0].values.size() / thicknesses;
    Jobs jobs;
    jobs.count = sweep.size();
    jobs.run = [&](std::size_t job) { return json_line(row_json(run_at(sweep, job))); };
    jobs.lost = [&](std::size_t job, const std::string& reason) {
      return json_line(row_json(failed_row(sweep.at(job), reason)));
    };
    jobs.take = [&](std::size_t job, const std::string& line) {
      const ordered_json row = ordered_json::parse(line);
      picture.add(job / each / thicknesses, job / each % thicknesses, row);
      broken = broken || (contenders[c].name == "octagon_sweep" && row.value("verdict", "") == "violates");
      keep(line);
      progress.show(contenders[c].called() + ",", static_cast<double>(job) / static_cast<double>(sweep.size()));
    };
    run_in_processes(jobs, processes);
    pictures.push_back(std::move(picture));
  }
  const std::vector<double> thicknesses = bullet_thicknesses();
  std::vector<Row> lowest(contenders.size() * thicknesses.size());
  Jobs jobs;
  jobs.count = lowest.size();
  const auto row_of_job = [&](std::size_t job) {
    return lowest_speed_through(contenders[job / thicknesses.size()], thicknesses[job % thicknesses.size()],
                                phases_of(size));
  };
  jobs.run = [&](std::size_t job) { return json_line(row_json(row_of_job(job))); };
  jobs.lost = [&](std::size_t job, const std::string& reason) {
    Case one;
    one.scene = "paper";
    one.contender = contenders[job / thicknesses.size()].name;
    return json_line(row_json(failed_row(one, reason)));
  };
  jobs.take = [&](std::size_t job, const std::string& line) {
    const ordered_json row = ordered_json::parse(line);
    if (row.contains("border_low")) lowest[job].border_low = row["border_low"];
    if (row.contains("border_high")) lowest[job].border_high = row["border_high"];
    if (row.value("verdict", "") == "not_applicable") lowest[job].verdict = Verdict::not_applicable;
    keep(line);
    progress.show("lowest speeds,", static_cast<double>(job) / static_cast<double>(lowest.size()));
  };
  run_in_processes(jobs, processes);
  progress.clear();

  ChartPage page;
  page.title = "bullets and paper";
  page.paragraphs = {
      "A character flies onto paper: how many of the cases at a speed and a thickness get through it, over angles, "
      "phases and lengths of a step. Below, the lowest speed at which each gets through head-on at 60 steps per "
      "second, "
      "found by bisection over all phases, beside what theory says. A click on a cell gives the command of a case that "
      "got through, or of one that did not where none did."};
  page.table.heading = {"contender", "cases", "through", "rate", "95 % from", "to"};
  std::vector<TextColumn> columns{{"contender", {}, true}, {"cases", {}}, {"through", {}}, {"rate", {}}, {"95 %", {}}};
  for (const double thickness : thicknesses) {
    columns.push_back({fmt::format("lowest at {:g} m", thickness), {}});
    columns.push_back({"theory", {}});
    page.table.heading.push_back(fmt::format("lowest speed at {:g} m [m/s]", thickness));
    page.table.heading.emplace_back("theory");
  }
  for (std::size_t c = 0; c < contenders.size(); ++c) {
    const BulletPicture& picture = pictures[c];
    if (picture.all() > 0) page.grids.push_back(picture.grid());
    const Interval interval = wilson(picture.bad(), picture.all());
    const double rate = picture.all() > 0 ? static_cast<double>(picture.bad()) / picture.all() : 0;
    std::vector<std::string> line{
        contenders[c].called(),      std::to_string(picture.all()),       std::to_string(picture.bad()),
        fmt::format("{:.4f}", rate), fmt::format("{:.6f}", interval.low), fmt::format("{:.6f}", interval.high)};
    columns[0].cells.emplace_back(line[0]);
    columns[1].cells.emplace_back(line[1]);
    columns[2].cells.emplace_back(line[2]);
    columns[3].cells.emplace_back(line[3]);
    columns[4].cells.emplace_back(fmt::format("{:.4f} to {:.4f}", interval.low, interval.high));
    for (std::size_t t = 0; t < thicknesses.size(); ++t) {
      const std::string measured = speed_in_words(lowest[c * thicknesses.size() + t]);
      const std::string theory = speed_in_words(bullet_theory(contenders[c], thicknesses[t]));
      line.push_back(measured);
      line.push_back(theory);
      columns[5 + 2 * t].cells.emplace_back(measured);
      columns[6 + 2 * t].cells.emplace_back(theory);
    }
    page.table.rows.push_back(std::move(line));
  }
  page.environment = environment();
  outputs.finish(kept, page);
  if (!arguments.quiet) print_out(aligned(columns));
  return broken ? 1 : 0;
}

}  // namespace paperproof::compare
