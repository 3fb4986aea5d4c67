#include "report/row_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

constexpr double least_error = 1e-9;  ///< Drawn [m].

std::optional<double> parameter_of(const ordered_json& row, const std::string& key) {
  if (!row.contains("parameters") || !row["parameters"].contains(key)) return std::nullopt;
  return row["parameters"][key].get<double>();
}

/// Numbers that a file has as null are none.
std::optional<double> number_of(const ordered_json& row, const char* key) {
  if (!row.contains(key) || !row[key].is_number()) return std::nullopt;
  return row[key].get<double>();
}

/// Without a sign where nothing is left of the number.
std::string in_hundredths(double number) { return fmt::format("{:.2f}", std::round(number * 100) / 100 + 0.0); }

std::vector<std::string> texts_of(const std::set<double>& values) {
  std::vector<std::string> texts;
  for (const double value : values)
    texts.push_back(value >= 100 && value < 1e6 ? fmt::format("{:.0f}", value) : fmt::format("{:.3g}", value));
  return texts;
}

std::size_t place_in(const std::set<double>& values, double value) {
  return static_cast<std::size_t>(std::distance(values.begin(), values.find(value)));
}

bool goes_through(const ordered_json& row) { return number_of(row, "tunnels").value_or(0) > 0; }

bool is_bad(const ordered_json& row, Bad bad) {
  return bad == Bad::tunnels ? goes_through(row) : row.value("verdict", "") != "holds";
}

std::string verdict_and_reason(const ordered_json& row) {
  const std::string reason = row.value("reason", "");
  return row.value("verdict", "") + (reason.empty() ? "" : ": ") + reason;
}

}  // namespace

std::string who_ran(const ordered_json& row, const std::vector<std::string>& varied) {
  std::string name = row.value("contender", "");
  const bool is_float = row.value("scalar", "") == "float" && !name.starts_with("box2d");
  std::istringstream knobs(row.value("knob", ""));
  for (std::string knob; knobs >> knob;)
    if (std::find(varied.begin(), varied.end(), knob.substr(0, knob.find('='))) == varied.end()) name += ' ' + knob;
  return is_float ? name + " in float" : name;
}

std::string axis_words(const std::string& key) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 8> units{{{"_m_s2", "m/s²"},
                                                                                {"_m_s", "m/s"},
                                                                                {"_n_m", "N/m"},
                                                                                {"_hz", "Hz"},
                                                                                {"_deg", "degrees"},
                                                                                {"_kg", "kg"},
                                                                                {"_m", "m"},
                                                                                {"_s", "s"}}};
  for (const auto& [ending, unit] : units)
    if (key.ends_with(ending)) return fmt::format("{} [{}]", key.substr(0, key.size() - ending.size()), unit);
  return key;
}

GridCounter::GridCounter(std::string title, std::string x, std::string y, Bad bad)
    : title_(std::move(title)), x_(std::move(x)), y_(std::move(y)), bad_(bad) {}

GridCounter::Counts& GridCounter::counts_of(const ordered_json& row) {
  const std::string name = who_ran(row, {x_, y_});
  const auto found = std::find_if(counts_.begin(), counts_.end(), [&](const Counts& one) { return one.who == name; });
  return found != counts_.end() ? *found : counts_.emplace_back(Counts{name, {}});
}

void GridCounter::add(const ordered_json& row) {
  const std::optional<double> across = parameter_of(row, x_);
  const std::optional<double> up = y_.empty() ? std::optional(0.0) : parameter_of(row, y_);
  if (!across || !up) return;
  ChartGrid::Cell& cell = counts_of(row).cells[{*across, *up}];
  if (row.value("verdict", "") == "not_applicable") return;
  const bool bad = is_bad(row, bad_);
  if (cell.all == 0 || (bad && cell.bad == 0)) {
    cell.words = verdict_and_reason(row);
    cell.command = row.value("command", "");
    cell.through = goes_through(row);
  }
  ++cell.all;
  cell.bad += bad;
}

std::vector<ChartGrid> GridCounter::grids() const {
  std::set<double> xs;
  std::set<double> ys;
  for (const Counts& counts : counts_)
    for (const auto& [place, cell] : counts.cells) {
      xs.insert(place.first);
      ys.insert(place.second);
    }
  std::vector<ChartGrid> grids;
  for (const Counts& counts : counts_) {
    const auto ran = [](const auto& each) { return each.second.all > 0; };
    if (std::none_of(counts.cells.begin(), counts.cells.end(), ran)) continue;
    ChartGrid& grid = grids.emplace_back();
    grid.title = title_ + (title_.empty() ? "" : ": ") + counts.who;
    grid.bad_words = bad_ == Bad::tunnels ? "get through" : "do not hold";
    grid.x_label = axis_words(x_);
    grid.y_label = axis_words(y_);
    grid.xs = texts_of(xs);
    grid.ys = y_.empty() ? std::vector<std::string>{""} : texts_of(ys);
    grid.cells.assign(ys.size(), std::vector<ChartGrid::Cell>(xs.size()));
    for (const auto& [place, cell] : counts.cells)
      grid.cells[place_in(ys, place.second)][place_in(xs, place.first)] = cell;
  }
  return grids;
}

std::vector<ChartGrid> grids_of(const ordered_json& rows, const std::string& title, const std::string& x,
                                const std::string& y) {
  GridCounter counter(title, x, y, Bad::does_not_hold);
  for (const ordered_json& row : rows) counter.add(row);
  return counter.grids();
}

bool is_at_border(const ChartGrid& grid, std::size_t column, std::size_t row) {
  const ChartGrid::Cell& cell = grid.cells[row][column];
  const auto differs = [&](std::size_t x, std::size_t y) {
    if (y >= grid.cells.size() || x >= grid.cells[y].size()) return false;
    const ChartGrid::Cell& other = grid.cells[y][x];
    return cell.all > 0 && other.all > 0 && (cell.bad == 0) != (other.bad == 0);
  };
  return differs(column - 1, row) || differs(column + 1, row) || differs(column, row - 1) || differs(column, row + 1);
}

namespace {

bool same_side(const ordered_json& one, const ordered_json& other) {
  const auto equal = [&](const char* key) { return one.value(key, "") == other.value(key, ""); };
  return equal("scene") && equal("contender") && equal("scalar");
}

/// What the curves of a contender are over.
std::set<std::string> knobs_of(const ordered_json& curve, const std::vector<ordered_json>& rows) {
  std::set<std::string> keys;
  for (const ordered_json& row : rows)
    if (row.contains("curve") && same_side(row, curve)) keys.insert(row["curve"].get<std::string>());
  return keys;
}

bool is_on(const ordered_json& point, const ordered_json& curve, const std::set<std::string>& knobs) {
  const std::string over = curve["curve"].get<std::string>();
  if (point.contains("curve") || !same_side(point, curve) || !parameter_of(point, over)) return false;
  return over != "dt_s" || std::none_of(knobs.begin(), knobs.end(), [&](const std::string& knob) {
           return knob != over && parameter_of(point, knob).has_value();
         });
}

ChartSeries series_of(const ordered_json& curve, const std::vector<ordered_json>& rows) {
  const std::string over = curve["curve"].get<std::string>();
  ChartSeries series{who_ran(curve) + (over == "dt_s" ? "" : " over " + axis_words(over)), {}, over == "dt_s"};
  if (const std::optional<double> slope = number_of(curve, "slope")) series.name += ", slope " + in_hundredths(*slope);
  const std::set<std::string> knobs = knobs_of(curve, rows);
  for (const ordered_json& row : rows) {
    if (!is_on(row, curve, knobs)) continue;
    const std::optional<double> error = number_of(row, "error_max_m");
    const std::optional<double> cost = number_of(row, "ns_per_step");
    if (!error || !cost) continue;
    series.points.push_back(
        {*cost / parameter_of(row, "dt_s").value_or(1), std::max(*error, least_error),
         fmt::format("{} = {:.4g}, error {:.3g} m", axis_words(over), *parameter_of(row, over), *error),
         row.value("on_front", false)});
  }
  return series;
}

std::vector<Chart> charts_of(const std::vector<ordered_json>& rows) {
  std::vector<Chart> charts;
  for (const ordered_json& curve : rows) {
    if (!curve.contains("curve")) continue;
    const std::string title = curve.value("scene", "") + ": the error from continuous motion, against run time";
    auto chart = std::find_if(charts.begin(), charts.end(), [&](const Chart& one) { return one.title == title; });
    if (chart == charts.end())
      chart = charts.insert(charts.end(), {title, "run time [ns per second of motion]", "largest error [m]", {}});
    ChartSeries series = series_of(curve, rows);
    if (!series.points.empty()) chart->series.push_back(std::move(series));
  }
  std::erase_if(charts, [](const Chart& chart) { return chart.series.empty(); });
  return charts;
}

bool is_precision(const ordered_json& row) { return row.value("mode", "") == "work_precision"; }
bool is_swept(const ordered_json& row) {
  return row.contains("swept") && row["swept"].is_object() && row.contains("parameters");
}

ChartTable borders_table(const std::vector<ordered_json>& borders) {
  ChartTable table;
  if (borders.empty()) return table;
  table.heading = {"contender", "border of", "holds up to", "does not from", "command"};
  for (const ordered_json& row : borders) {
    const auto text = [&](const char* key) {
      const std::optional<double> number = number_of(row, key);
      return number ? fmt::format("{:.6g}", *number) : std::string("-");
    };
    table.rows.push_back(
        {who_ran(row), row.value("border", ""), text("border_low"), text("border_high"), row.value("command", "")});
  }
  return table;
}

}  // namespace

ChartPage precision_page(const std::vector<ordered_json>& rows) {
  ChartPage page;
  page.title = "What does accuracy cost?";
  page.paragraphs = {
      "How to read this: each point is one setting of a contender, and each curve goes over its settings from coarse "
      "to fine: the length of a step, or a knob of its own. Lower is closer to continuous motion, further left is "
      "faster, so that the best are below and to the left. Large points are on the front: no other is both faster and "
      "closer. A slope of 1 means that half the knob gives half the error. Errors below 1e-9 m are drawn there. Errors "
      "and times "
      "are measured apart; times are the minimum of nine runs after a warm-up, contenders taking turns.",
      "The continuous motion is computed from event to event with 50 digits. Each side is compared with the motion of "
      "its own law: Box2D with that of a body without friction, octagon_sweep and the techniques of the article with "
      "that of walking. Box2D stops 15 mm away from what it meets: its curves end there."};
  page.charts = charts_of(rows);
  page.table.heading = {"motion", "contender", "over", "slope"};
  for (const ordered_json& row : rows) {
    if (!row.contains("curve")) continue;
    const std::optional<double> slope = number_of(row, "slope");
    page.table.rows.push_back({row.value("scene", ""), who_ran(row), row["curve"].get<std::string>(),
                               slope ? in_hundredths(*slope) : row.value("reason", "")});
  }
  return page;
}

RowPictures::Swept& RowPictures::swept(const ordered_json& row) {
  const ordered_json& in = row["swept"];
  const std::string question = in.value("question", "");
  const std::string scene = row.value("scene", "");
  const auto axes = in.value("axes", std::vector<std::string>{});
  const auto found = std::find_if(swept_.begin(), swept_.end(), [&](const Swept& one) {
    return one.question == question && one.scene == scene && one.axes == axes;
  });
  if (found != swept_.end()) return *found;
  const Bad bad = in.value("bad", "") == "tunnels" ? Bad::tunnels : Bad::does_not_hold;
  Swept& made = swept_.emplace_back(Swept{question, scene, axes, bad, {}, {}});
  if (!axes.empty()) made.counter.emplace("", axes[0], axes.size() > 1 ? axes[1] : "", bad);
  return made;
}

void RowPictures::add(ordered_json row) {
  const std::string scene = row.value("scene", "");
  if (is_precision(row)) {
    precision_.push_back(std::move(row));
  } else if (!is_swept(row)) {
    auto found = std::find_if(scenes_.begin(), scenes_.end(), [&](const auto& one) { return one.first == scene; });
    if (found == scenes_.end()) found = scenes_.insert(scenes_.end(), {scene, {}});
    found->second.push_back(std::move(row));
  } else if (row.contains("border")) {
    swept(row).borders.push_back(std::move(row));
  } else if (Swept& into = swept(row); into.counter) {
    into.counter->add(row);
  }
}

ChartPage RowPictures::page_of(const Swept& swept) {
  ChartPage page;
  if (swept.counter) page.grids = swept.counter->grids();
  if (!swept.question.empty())
    page.title = swept.question;
  else
    page.title = swept.bad == Bad::tunnels ? bullets_title : fmt::format("Where does `{}` hold?", swept.scene);
  page.paragraphs = {how_to_read_maps};
  page.table = borders_table(swept.borders);
  return page;
}

std::vector<ChartPage> RowPictures::pages() const {
  std::vector<ChartPage> pages;
  if (!precision_.empty()) pages.push_back(precision_page(precision_));
  for (const Swept& one : swept_) pages.push_back(page_of(one));
  return pages;
}

}  // namespace paperproof::compare
