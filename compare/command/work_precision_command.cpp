#include "command/study_command.hpp"

#include "command/compare_command.hpp"
#include "command/progress.hpp"
#include "command/study_outputs.hpp"
#include "runs/contestant.hpp"
#include "runs/text_columns.hpp"
#include "scenes/load.hpp"
#include "studies/front.hpp"
#include "studies/motions.hpp"
#include "studies/work_precision.hpp"
#include "words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

std::string name_of_curve(const Row& row) {
  return row.contender + (row.scalar == "float" && !is_reference(row.contender) ? " float" : "");
}

bool belongs_to(const Row& point, const Row& curve) {
  const bool has = std::any_of(point.parameters.begin(), point.parameters.end(),
                               [&](const auto& each) { return each.first == curve.curve; });
  return point.scene == curve.scene && point.contender == curve.contender && point.scalar == curve.scalar && has &&
         (curve.curve != "dt_s" || point.parameters.size() == 1);
}

/// One chart per motion: error over time, a curve for each contender and knob.
Chart chart_of(const Motion& motion, const WorkPrecision& found) {
  const std::string laws = motion.without_friction.empty() ? "" : fmt::format("; {}", motion.without_friction);
  Chart chart{fmt::format("{}: {}{}", motion.name, motion.description, laws),
              "ns per second of motion",
              "largest distance [m]",
              {}};
  for (const Row& curve : found.curves) {
    if (curve.scene != motion.name) continue;
    ChartSeries series{name_of_curve(curve) + (curve.curve == "dt_s" ? "" : " over " + curve.curve), {}};
    for (const Row& point : found.points) {
      const std::optional<double> time = time_per_second(point);
      if (!belongs_to(point, curve) || !point.error_max_m || !time || !(*point.error_max_m > 0)) continue;
      series.points.push_back({*time, *point.error_max_m});
    }
    if (!series.points.empty()) chart.series.push_back(std::move(series));
  }
  return chart;
}

/// The values of the curve's knob there, each with its error.
std::string points_on_front(const Row& curve, const WorkPrecision& found) {
  std::vector<std::string> points;
  for (const Row& point : found.points)
    if (belongs_to(point, curve) && point.on_front.value_or(false))
      points.push_back(fmt::format("{:.3g}: {:.2g} m", point.parameters.back().second, *point.error_max_m));
  return fmt::format("{}", fmt::join(points, ", "));
}

ChartPage page_of(const WorkPrecision& found) {
  ChartPage page;
  page.title = "work and precision";
  page.paragraphs = {
      "How far each contender is from continuous motion against the time that a second of motion takes to compute. "
      "Left "
      "and down is better. Each curve goes over the length of a step, from 1/15 to 1/480 s, or over one of the "
      "contender's own knobs at 1/60 s. Errors and times are measured apart; times are the minimum of nine runs after "
      "a "
      "warm-up, contenders taking turns.",
      "The continuous motion is computed from event to event with 50 digits. Each side is compared with the motion of "
      "its own law: Box2D with that of a body without friction, octagon_sweep with that of walking, and so are the "
      "techniques of the article, which have no law of their own that steps could come to. Box2D stops 15 mm away from "
      "what it meets: its curves end there.",
      "A row of the table names the points of a curve that are on the front of its motion: no other has less error in "
      "less time."};
  for (const std::string& sentence : found.sentences) page.paragraphs.push_back(sentence);
  for (const Motion& motion : motions()) {
    Chart chart = chart_of(motion, found);
    if (!chart.series.empty()) page.charts.push_back(std::move(chart));
  }
  page.table.heading = {"motion", "contender", "over", "slope", "on the front"};
  for (const Row& curve : found.curves)
    page.table.rows.push_back({curve.scene, name_of_curve(curve), curve.curve,
                               curve.slope ? fmt::format("{:.2f}", *curve.slope) : curve.reason,
                               points_on_front(curve, found)});
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
  for (const Motion& motion : motions()) {
    TextColumn column{std::string(motion.name), {}};
    for (const auto& line : lines) {
      const auto curve = std::find_if(found.curves.begin(), found.curves.end(), [&](const Row& row) {
        return row.scene == motion.name && name_of_curve(row) == line.first && row.curve == line.second;
      });
      const bool known = curve != found.curves.end();
      const std::string slope = known && curve->slope ? fmt::format("{:.2f}", *curve->slope) : "";
      const std::string mark = known && curve->on_front.value_or(false) ? "*" : "";
      column.cells.push_back(slope.empty() && mark.empty() ? Cell{} : Cell(slope + mark));
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
    for (const Motion& motion : motions()) names.emplace_back(motion.name);
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
    std::string text = "slope of log error over log knob; * on the front: no other has less error in less time\n\n" +
                       slopes(found) + '\n';
    for (const std::string& sentence : found.sentences) text += sentence + '\n';
    print_out(text);
  }
  return failed ? 1 : 0;
}

}  // namespace paperproof::compare
