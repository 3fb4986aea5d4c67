#include "command/study_command.hpp"

#include "command/compare_command.hpp"
#include "command/progress.hpp"
#include "command/study_outputs.hpp"
#include "runs/contestant.hpp"
#include "runs/text_columns.hpp"
#include "scenes/load.hpp"
#include "studies/work_precision.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

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
    for (const auto& line : lines) {
      const auto curve = std::find_if(found.curves.begin(), found.curves.end(), [&](const Row& row) {
        return row.scene == motion.name && name_of_curve(row) == line.first && row.curve == line.second;
      });
      const bool has = curve != found.curves.end() && curve->slope;
      column.cells.push_back(has ? Cell(fmt::format("{:.2f}", *curve->slope)) : Cell{});
    }
    columns.push_back(std::move(column));
  }
  return aligned(columns);
}

}  // namespace

int work_precision_command(const StudyArguments& arguments) {
#ifndef NDEBUG
  throw InputError("work-precision: expected a build without assertions (NDEBUG): this one's times mean nothing");
#endif
  check_contenders(arguments.contenders);
  StudyOutputs outputs(arguments.rows_path, arguments.report_path);
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
  bool failed = false;
  for (const std::vector<Row>* rows : {&found.points, &found.curves})
    for (const Row& row : *rows) {
      outputs.add(row);
      failed = failed || row.verdict == Verdict::failed;
    }
  outputs.finish(page_of(found));
  if (!arguments.quiet) {
    std::string text = "slope of log error over log knob\n\n" + slopes(found) + '\n';
    for (const std::string& sentence : found.sentences) text += sentence + '\n';
    print_out(text);
  }
  return failed ? 1 : 0;
}

}  // namespace paperproof::compare
