#include "command/progress.hpp"
#include "command/study_command.hpp"
#include "command/study_outputs.hpp"
#include "records/output_file.hpp"
#include "records/trace.hpp"
#include "studies/scale.hpp"

#include <paperproof/techniques.hpp>

#include <fmt/format.h>

#include <cstdio>

namespace paperproof::compare {
namespace {

const std::vector<std::string> heading{"pieces",  "search",     "ns per step", "median",
                                       "largest", "build [ms]", "same bits"};

std::vector<std::string> cells_of(const ScalePoint& point) {
  return {std::to_string(point.pieces),
          std::string(name_of(point.search)),
          fmt::format("{:.1f}", point.ns_per_step_min),
          fmt::format("{:.1f}", point.ns_per_step_median),
          fmt::format("{:.1f}", point.ns_per_step_max),
          fmt::format("{:.2f}", point.build_ms),
          point.same_bits ? "yes" : "NO"};
}

std::string line_of(const std::vector<std::string>& cells) {
  return fmt::format("{:>9}  {:<11}  {:>11}  {:>10}  {:>10}  {:>10}  {:>9}\n", cells[0], cells[1], cells[2], cells[3],
                     cells[4], cells[5], cells[6]);
}

Row row_of(const ScalePoint& point) {
  Row row;
  row.scene = "floors";
  row.contender = "octagon_sweep";
  row.knob = fmt::format("search={} pieces={}", name_of(point.search), point.pieces);
  row.steps = point.steps;
  if (!point.same_bits) {
    row.verdict = Verdict::failed;
    row.reason = "the positions are not those of one_by_one";
  }
  row.ns_per_step = point.ns_per_step_min;
  row.ns_per_step_median = point.ns_per_step_median;
  row.ns_per_step_max = point.ns_per_step_max;
  return row;
}

std::string growth_sentence(const std::vector<ScalePoint>& points) {
  std::string sentence = "From the fewest pieces to the most a step costs";
  const char* separator = " ";
  for (const PieceSearch search : scale_searches) {
    sentence += fmt::format("{}{:.2f} times as much with {}", separator, growth(points, search), name_of(search));
    separator = ", ";
  }
  return sentence + ".";
}

ChartPage page_of(const std::vector<ScalePoint>& points) {
  ChartPage page;
  page.title = "cost of a step against the number of pieces";
  page.paragraphs = {
      "A character walks and jumps at random over tiles of 1 m, with octagon_sweep in double. What is near it stays "
      "the same; only the level around it grows. Minimum of nine runs after a warm-up, both taking turns in one "
      "process.",
      growth_sentence(points),
      "The candidates of a step are kept for the next ones, so that they are looked for only now and then."};
  Chart& chart = page.charts.emplace_back(Chart{"octagon_sweep, walking and jumping", "pieces", "ns per step", {}});
  for (const PieceSearch search : scale_searches) {
    ChartSeries series{std::string(name_of(search)), {}};
    for (const ScalePoint& point : points)
      if (point.search == search) series.points.push_back({static_cast<double>(point.pieces), point.ns_per_step_min});
    chart.series.push_back(std::move(series));
  }
  page.table.heading = heading;
  for (const ScalePoint& point : points) page.table.rows.push_back(cells_of(point));
  page.environment = environment();
  return page;
}

}  // namespace

int study_scale_command(const ScaleArguments& arguments) {
  StudyOutputs outputs(arguments.rows_path, arguments.report_path);
  const Progress progress(!arguments.quiet);
  const std::vector<ScalePoint> points =
      study_scale(arguments.grid, [&](double share) { progress.show("study scale,", share); });
  progress.clear();

  bool same = true;
  for (const ScalePoint& point : points) {
    outputs.add(row_of(point));
    same = same && point.same_bits;
  }
  if (!arguments.quiet) {
    std::string text = line_of(heading);
    for (const ScalePoint& point : points) text += line_of(cells_of(point));
    print_out(fmt::format("{}\n{}\n", text, growth_sentence(points)));
  }
  outputs.finish(page_of(points));
  return same ? 0 : 1;
}

}  // namespace paperproof::compare
