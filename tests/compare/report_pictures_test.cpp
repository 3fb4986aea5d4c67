/// Pictures: of rows, in pages.
#include "compare/report_pages.hpp"
#include "report/cell_replay.hpp"
#include "report/page_reader.hpp"
#include "report/replay.hpp"
#include "report/row_pictures.hpp"

namespace paperproof::compare {
namespace {

Row shot(const std::string& contender, double speed, double thickness, int tunnels, double angle = 90) {
  Row row;
  row.scene = "paper";
  row.contender = contender;
  row.verdict = tunnels > 0 ? Verdict::tunnels : Verdict::holds;
  row.swept = {"", {"speed_m_s", "thickness_m", "angle_deg"}, Bad::tunnels};
  row.parameters = {{"speed_m_s", speed}, {"thickness_m", thickness}, {"angle_deg", angle}};
  row.tunnels = tunnels;
  row.command = "paperproof compare paper --no-reference";
  return row;
}

/// Two speeds and two thicknesses; at the higher speed the thin paper lets one of two through.
std::vector<Row> shots() {
  std::vector<Row> rows;
  for (const double speed : {10.0, 2000.0})
    for (const double thickness : {0.1, 0.01})
      for (const double angle : {45.0, 90.0})
        rows.push_back(shot("mask", speed, thickness, speed > 100 && thickness < 0.05 && angle > 60 ? 1 : 0, angle));
  return rows;
}

ChartGrid grid_of_shots() {
  GridCounter counter("", "speed_m_s", "thickness_m", Bad::tunnels);
  for (const Row& row : shots()) counter.add(row);
  return counter.grids().at(0);
}

TEST(RowPictures, questions_are_kept_apart_and_a_map_has_the_first_two_axes_of_the_sweep) {
  RowPictures pictures;
  for (const Row& row : shots()) pictures.add(row);
  for (const char* question : {"a fall", "a hit"})
    for (const char* contender : {"mask", "octagon_sweep"})
      for (const double speed : {1.0, 2.0}) {
        Row row = shot(contender, speed, 0.1, 0);
        row.swept = {question, {"speed_m_s"}, Bad::does_not_hold};
        row.parameters.emplace_back("jump_rules", contender == std::string("mask") ? 1 : 0);
        pictures.add(row);
      }
  Row compared = shot("mask", 10, 0.1, 0);
  compared.swept.reset();
  pictures.add(compared);
  EXPECT_EQ(pictures.scenes().size(), 1U) << "rows of a comparison are no sweep";
  for (Row refused : {shot("grid", 10, 0.1, 0), shot("mask", 20, 0.1, 0)}) {
    refused.verdict = Verdict::not_applicable;
    pictures.add(refused);
  }
  const std::vector<ChartPage> pages = pictures.pages();
  ASSERT_EQ(pages.size(), 3U);
  EXPECT_EQ(pages[0].title, bullets_title);
  ASSERT_EQ(pages[0].grids.size(), 1U) << "one that could run nowhere has no map";
  const ChartGrid& grid = pages[0].grids[0];
  EXPECT_EQ(grid.xs, (std::vector<std::string>{"10", "20", "2000"}));
  EXPECT_EQ(grid.ys, (std::vector<std::string>{"0.01", "0.1"}));
  for (std::size_t y = 0; y < 2; ++y)
    for (std::size_t x = 0; x < 3; ++x) {
      EXPECT_EQ(grid.cells[y][x].all, x == 1 ? 0 : 2) << x << " " << y;
      EXPECT_EQ(grid.cells[y][x].bad, y == 0 && x == 2 ? 1 : 0) << x << " " << y;
    }
  EXPECT_EQ(pages[1].title, "a fall");
  EXPECT_EQ(pages[2].title, "a hit");
  ASSERT_EQ(pages[1].grids.size(), 2U);
  EXPECT_EQ(pages[1].grids[0].ys.size(), 1U) << "what differs by contender is no axis";
  EXPECT_EQ(pages[1].grids[0].xs.size(), 2U);
}

TEST(CellReplays, are_of_the_border_first_then_of_bad_cells_then_of_the_rest) {
  ChartGrid grid;
  grid.cells.resize(1);
  for (const int bad : {0, 0, 1, 1, -1, 0, 1}) {  // of one case in each cell of a row; -1: nothing ran
    grid.xs.push_back(std::to_string(grid.xs.size()));
    grid.cells[0].push_back({std::max(bad, 0), bad < 0 ? 0 : 1});
  }
  const auto places = [&grid](std::size_t most) {
    std::vector<std::ptrdiff_t> all;
    for (const ChartGrid::Cell* cell : cells_to_replay(grid, most)) all.push_back(cell - grid.cells[0].data());
    return all;
  };
  EXPECT_EQ(places(100), (std::vector<std::ptrdiff_t>{1, 2, 5, 6, 3, 0}));
  EXPECT_EQ(places(5), (std::vector<std::ptrdiff_t>{1, 2, 5, 6, 3}));
  EXPECT_EQ(places(2), (std::vector<std::ptrdiff_t>{1, 5})) << "spread evenly";
  EXPECT_TRUE(places(0).empty());
}

TEST_F(ReportTest, replays_of_cells_stand_in_the_page_and_are_read_back) {
  ReportScene excerpt = walk_of(9);
  excerpt.rows[0].parameters = {{"speed_m_s", 120}, {"phase", 0.25}};
  ChartPage study;
  study.title = "study";
  study.grids = {grid_of_shots()};
  study.replays = {cell_replay_json(excerpt)};
  study.grids[0].cells[0][1].replay = 0;
  ReportWriter writer(path());
  writer.add_study(study);
  writer.finish({});
  const json cells = element(content(path()), "cells-0");
  ASSERT_EQ(cells.size(), 1U);
  EXPECT_EQ(cells[0]["parameters"], json::parse(R"([["speed [m/s]", "120"], ["phase", "0.25"]])"));
  EXPECT_EQ(unpacked(cells[0]["replay"].dump()), replay_lines(excerpt, 0));
  const PageReader reader(path());
  EXPECT_EQ(json::parse(reader.cells(0)), cells);
  EXPECT_EQ(reader.cells(1), "[]");
  const json row = reader.index()["studies"][0]["grids"][0]["cells"][0];
  EXPECT_EQ(row[0].size(), 4U) << "no replay";
  EXPECT_EQ(row[1][3], "paperproof compare paper --no-reference");
  EXPECT_EQ(row[1][4], 0);
}

Row precise(double dt, double error, double ns, const std::string& knob = "", double value = 0) {
  Row row;
  row.scene = "rest";
  row.contender = "mask";
  row.mode = "work_precision";
  row.parameters = {{"dt_s", dt}};
  row.error_max_m = error;
  row.ns_per_step = ns;
  if (!knob.empty()) row.parameters.emplace_back(knob, value);
  return row;
}

Row curve_over(const std::string& key, double slope) {
  Row row;
  row.scene = "rest";
  row.contender = "mask";
  row.mode = "work_precision";
  row.curve = key;
  row.slope = slope;
  return row;
}

TEST(RowPictures, a_curve_over_the_step_has_the_points_without_another_knob) {
  const ChartPage page =
      precision_page({precise(0.1, 1e-2, 50), precise(0.05, 0, 50), precise(0.1, 1e-3, 80, "pixel_m", 0.5),
                      curve_over("dt_s", 1), curve_over("pixel_m", 2)});
  ASSERT_EQ(page.charts.size(), 1U);
  const std::vector<ChartSeries>& series = page.charts[0].series;
  ASSERT_EQ(series.size(), 2U);
  EXPECT_EQ(series[0].name, "mask, slope 1.00 ± 0.00");
  ASSERT_EQ(series[0].points.size(), 2U);
  EXPECT_DOUBLE_EQ(series[0].points[0].x, 50 / 0.1);  // ns per second of motion
  EXPECT_DOUBLE_EQ(series[0].points[0].y, 1e-2);
  EXPECT_DOUBLE_EQ(series[0].points[1].y, 1e-9) << "an error of zero has a place, too";
  EXPECT_EQ(series[1].name, "mask over pixel [m], slope 2.00 ± 0.00");
  EXPECT_FALSE(series[1].shown);
  ASSERT_EQ(series[1].points.size(), 1U);
}

TEST(ChartPageHtml, carries_its_data_its_library_and_no_way_out_of_the_script) {
  ChartPage page;
  page.title = "a </script><b>title";
  page.charts = {{"chart", "x", "y", {{"series", {{1, 2}, {10, 3.5}}}}}};
  const std::string html = html_of(page);
  EXPECT_EQ(html.find("</script><b>"), std::string::npos);
  const json study = element(html, "index")["studies"][0];
  EXPECT_EQ(study["title"], page.title);
  EXPECT_EQ(study["charts"][0]["series"][0]["points"][1]["y"], 3.5);
  EXPECT_NE(html.find("Chart.js v"), std::string::npos);
}

}  // namespace
}  // namespace paperproof::compare
