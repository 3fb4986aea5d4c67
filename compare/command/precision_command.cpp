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

}  // namespace paperproof::compare
