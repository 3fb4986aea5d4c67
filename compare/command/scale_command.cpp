#include "command/study_command.hpp"
#include "records/trace.hpp"
#include "runs/environment.hpp"
#include "runs/view.hpp"
#include "studies/scale.hpp"

#include <paperproof/techniques.hpp>

#include <fmt/format.h>

namespace paperproof::compare {
namespace {

Table table_of(const std::vector<ScalePoint>& points) {
  const auto number = [](auto ScalePoint::*of, const char* format) {
    return [of, format](const ScalePoint& point) { return fmt::format(fmt::runtime(format), point.*of); };
  };
  return table_of<ScalePoint>(points, {{"pieces", number(&ScalePoint::pieces, "{}")},
                                       {"search", [](const ScalePoint& p) { return std::string(name_of(p.search)); }},
                                       {"ns per step", number(&ScalePoint::ns_per_step_min, "{:.1f}")},
                                       {"median", number(&ScalePoint::ns_per_step_median, "{:.1f}")},
                                       {"largest", number(&ScalePoint::ns_per_step_max, "{:.1f}")},
                                       {"build [ms]", number(&ScalePoint::build_ms, "{:.2f}")},
                                       {"same bits", [](const ScalePoint& p) { return p.same_bits ? "yes" : "NO"; }}});
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
  const Table table = table_of(points);
  page.table = {"", table.heading, table.lines};
  page.environment = environment();
  return page;
}

}  // namespace

int study_scale_command(const ScaleArguments& arguments) {
  return measure_here(arguments.run, "study scale", [&](const std::function<void(double)>& tell) {
    const std::vector<ScalePoint> points = study_scale(arguments.grid, tell);
    std::vector<Row> rows;
    for (const ScalePoint& point : points) rows.push_back(row_of(point));
    return Measurements{rows, page_of(points), text_of(table_of(points)) + '\n' + growth_sentence(points) + '\n'};
  });
}

}  // namespace paperproof::compare
