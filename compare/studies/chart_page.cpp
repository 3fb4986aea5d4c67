#include "studies/chart_page.hpp"

#include "studies/page_parts.hpp"

#include <nlohmann/json.hpp>

#include <stdexcept>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const Chart& chart) {
  ordered_json json{{"title", chart.title}, {"x", chart.x_label}, {"y", chart.y_label}};
  json["series"] = ordered_json::array();
  for (const ChartSeries& series : chart.series) {
    ordered_json points = ordered_json::array();
    for (const ChartPoint& point : series.points) points.push_back({{"x", point.x}, {"y", point.y}});
    json["series"].push_back({{"name", series.name}, {"points", std::move(points)}});
  }
  return json;
}

ordered_json json_of(const ChartGrid& grid) {
  ordered_json json{{"title", grid.title}, {"x", grid.x_label}, {"y", grid.y_label}, {"xs", grid.xs}, {"ys", grid.ys}};
  json["cells"] = ordered_json::array();
  for (const auto& line : grid.cells) {
    ordered_json cells = ordered_json::array();
    for (const ChartGrid::Cell& cell : line)
      cells.push_back({{"bad", cell.bad}, {"all", cell.all}, {"words", cell.words}});
    json["cells"].push_back(std::move(cells));
  }
  return json;
}

void replace(std::string& text, std::string_view marker, std::string_view with) {
  const std::size_t at = text.find(marker);
  if (at == std::string::npos) throw std::runtime_error("the study's page lacks " + std::string(marker));
  text.replace(at, marker.size(), with);
}

}  // namespace

std::string html_of(const ChartPage& page) {
  ordered_json data{{"title", page.title},
                    {"paragraphs", page.paragraphs},
                    {"heading", page.table.heading},
                    {"rows", page.table.rows}};
  data["charts"] = ordered_json::array();
  for (const Chart& chart : page.charts) data["charts"].push_back(json_of(chart));
  data["grids"] = ordered_json::array();
  for (const ChartGrid& grid : page.grids) data["grids"].push_back(json_of(grid));
  data["environment"] = page.environment;
  std::string text = data.dump();
  // A script of data ends at the first "</", wherever it stands.
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at)) text.replace(at, 2, "<\\/");
  std::string html(studies::study_html);
  replace(html, "/*DATA*/", text);
  replace(html, "/*STUDY*/", studies::study_js);
  replace(html, "/*LIBRARY*/", studies::chart_min_js);
  return html;
}

}  // namespace paperproof::compare
