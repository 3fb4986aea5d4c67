#include "report/chart_json.hpp"

#include "report/json_text.hpp"

#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

ordered_json json_of(const ChartPoint& point) {
  ordered_json json{{"x", point.x}, {"y", point.y}};
  if (!point.words.empty()) json["words"] = point.words;
  if (point.front) json["front"] = true;
  if (point.hollow) json["hollow"] = true;
  if (point.struck) json["struck"] = true;
  return json;
}

ordered_json json_of(const Chart& chart) {
  ordered_json json{{"title", chart.title}, {"x", chart.x_label}, {"y", chart.y_label}};
  json["series"] = ordered_json::array();
  for (const ChartSeries& series : chart.series) {
    ordered_json points = ordered_json::array();
    for (const ChartPoint& point : series.points) points.push_back(json_of(point));
    json["series"].push_back({{"name", series.name}, {"shown", series.shown}, {"points", std::move(points)}});
  }
  return json;
}

/// A cell is [bad, all, words, command, replay]; the last one is absent where there is none.
ordered_json json_of(const ChartGrid::Cell& cell) {
  ordered_json json{cell.bad, cell.all, cell.words, cell.command};
  if (cell.replay) json.push_back(*cell.replay);
  return json;
}

/// Of a grid that is a table: [label, gravity] of each cell. Gravity is 0 for none, 1 for what is bad, 2 for what is
/// unsafe.
ordered_json labels_of(const ChartGrid& grid) {
  ordered_json labels = ordered_json::array();
  for (const auto& line : grid.cells) {
    ordered_json cells = ordered_json::array();
    for (const ChartGrid::Cell& cell : line) cells.push_back({cell.label, cell.grave ? 2 : cell.bad > 0 ? 1 : 0});
    labels.push_back(std::move(cells));
  }
  return labels;
}

ordered_json json_of(const ChartTable& table) {
  return {{"title", table.title}, {"heading", table.heading}, {"rows", table.rows}};
}

ordered_json json_of(const ChartGrid& grid) {
  ordered_json json{{"title", grid.title}, {"bad_words", grid.bad_words},
                    {"x", grid.x_label},   {"y", grid.y_label},
                    {"xs", grid.xs},       {"ys", grid.ys}};
  json["cells"] = ordered_json::array();
  for (const auto& line : grid.cells) {
    ordered_json cells = ordered_json::array();
    for (const ChartGrid::Cell& cell : line) cells.push_back(json_of(cell));
    json["cells"].push_back(std::move(cells));
  }
  if (!grid.beside.empty()) json["labels"] = labels_of(grid);
  return json;
}

template <class Item>
ordered_json list_in_json(const std::vector<Item>& items) {
  ordered_json list = ordered_json::array();
  for (const Item& item : items) list.push_back(json_of(item));
  return list;
}

}  // namespace

std::string chart_page_json(const ChartPage& page) {
  ordered_json data{{"title", page.title},
                    {"paragraphs", page.paragraphs},
                    {"charts", list_in_json(page.charts)},
                    {"grids", list_in_json(page.grids)},
                    {"heading", page.table.heading},
                    {"rows", page.table.rows}};
  if (!page.more_tables.empty()) data["tables"] = list_in_json(page.more_tables);
  return script_safe(dumped(data));
}

}  // namespace paperproof::compare
