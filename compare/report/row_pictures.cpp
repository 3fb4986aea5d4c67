#include "report/row_pictures.hpp"

#include "embedded.hpp"
#include "records/verdict.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <sstream>

namespace paperproof::compare {
namespace {

/// What pages say first.
const nlohmann::json& how_to_read() {
  static const auto words = nlohmann::json::parse(how_to_read_file.front().text);
  return words;
}

constexpr double least_error = 1e-9;  ///< Drawn [m].

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

bool goes_through(const Row& row) { return row.tunnels.value_or(0) > 0; }

bool is_bad(const Row& row, Bad bad) { return bad == Bad::tunnels ? goes_through(row) : row.verdict != Verdict::holds; }

std::string verdict_and_reason(const Row& row) {
  return fmt::format("{}{}{}", name_of(row.verdict), row.reason.empty() ? "" : ": ", row.reason);
}

}  // namespace

std::string how_to_read_maps() { return how_to_read().at("maps"); }

std::string slope_in_words(const Row& curve) {
  return in_hundredths(*curve.slope) + " \u00b1 " + in_hundredths(curve.slope_within.value_or(0));
}

std::string who_ran(const Row& row, const std::vector<std::string>& varied) {
  std::string name = row.contender;
  std::istringstream knobs(row.knob);
  for (std::string knob; knobs >> knob;)
    if (std::find(varied.begin(), varied.end(), knob.substr(0, knob.find('='))) == varied.end()) name += ' ' + knob;
  return is_float_by_choice(row) ? name + " in float" : name;
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

GridCounter::Counts& GridCounter::counts_of(const Row& row) {
  const std::string name = who_ran(row, {x_, y_});
  const auto found = std::find_if(counts_.begin(), counts_.end(), [&](const Counts& one) { return one.who == name; });
  return found != counts_.end() ? *found : counts_.emplace_back(Counts{name, {}});
}

void GridCounter::add(const Row& row) {
  const std::optional<double> across = parameter_of(row, x_);
  const std::optional<double> up = y_.empty() ? std::optional(0.0) : parameter_of(row, y_);
  if (!across || !up) return;
  ChartGrid::Cell& cell = counts_of(row).cells[{*across, *up}];
  if (row.verdict == Verdict::not_applicable) return;
  const bool bad = is_bad(row, bad_);
  if (cell.all == 0 || (bad && cell.bad == 0)) {
    cell.words = verdict_and_reason(row);
    cell.command = row.command;
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

bool same_side(const Row& one, const Row& other) {
  return one.scene == other.scene && one.contender == other.contender && one.scalar == other.scalar;
}

/// What the curves of a contender are over.
std::set<std::string> knobs_of(const Row& curve, const std::vector<Row>& rows) {
  std::set<std::string> keys;
  for (const Row& row : rows)
    if (!row.curve.empty() && same_side(row, curve)) keys.insert(row.curve);
  return keys;
}

bool is_on(const Row& point, const Row& curve, const std::set<std::string>& knobs) {
  const std::string& over = curve.curve;
  if (!point.curve.empty() || !same_side(point, curve) || !parameter_of(point, over)) return false;
  return over != "dt_s" || std::none_of(knobs.begin(), knobs.end(), [&](const std::string& knob) {
           return knob != over && parameter_of(point, knob).has_value();
         });
}

/// Where what has no cost stands: above the fastest point of its motion.
std::optional<double> least_time(const std::string& scene, const std::vector<Row>& rows) {
  std::optional<double> least;
  for (const Row& row : rows)
    if (const auto time = time_per_second(row); row.scene == scene && time)
      least = std::min(*time, least.value_or(*time));
  return least;
}

ChartSeries series_of(const Row& curve, const std::vector<Row>& rows) {
  const std::string& over = curve.curve;
  ChartSeries series{who_ran(curve) + (over == "dt_s" ? "" : " over " + axis_words(over)), {}, over == "dt_s"};
  if (curve.slope) series.name += ", slope " + slope_in_words(curve);
  const std::set<std::string> knobs = knobs_of(curve, rows);
  for (const Row& row : rows) {
    if (!is_on(row, curve, knobs)) continue;
    const std::optional<double>& error = row.error_max_m;
    const bool is_law = row.contender == law_of_steps;
    const std::optional<double> time = is_law ? least_time(row.scene, rows) : time_per_second(row);
    if (!error || !time) continue;
    std::string words = fmt::format("{} = {:.4g}, error {:.3g} m", axis_words(over), *parameter_of(row, over), *error);
    const bool hollow = falls_short(row, Axis::validity);
    const bool struck = falls_short(row, Axis::safety);
    if (is_law) words += "; it has no cost";
    if (hollow || struck) words += "; " + row.reason;
    series.points.push_back(
        {*time, std::max(*error, least_error), std::move(words), row.on_front.value_or(false), hollow, struck});
  }
  return series;
}

std::vector<Chart> charts_of(const std::vector<Row>& rows) {
  std::vector<Chart> charts;
  for (const Row& curve : rows) {
    if (curve.curve.empty()) continue;
    const std::string title = curve.scene + ": the error from continuous motion, against run time";
    auto chart = std::find_if(charts.begin(), charts.end(), [&](const Chart& one) { return one.title == title; });
    if (chart == charts.end())
      chart = charts.insert(charts.end(), {title, "run time [ns per second of motion]", "largest error [m]", {}});
    ChartSeries series = series_of(curve, rows);
    if (!series.points.empty()) chart->series.push_back(std::move(series));
  }
  std::erase_if(charts, [](const Chart& chart) { return chart.series.empty(); });
  return charts;
}

bool is_precision(const Row& row) { return row.mode == "work_precision"; }
/// Over axes, or for a border: a map of one place shows nothing.
bool is_swept(const Row& row) {
  return row.swept && !row.parameters.empty() && (!row.border.empty() || !row.swept->axes.empty());
}

ChartTable borders_table(const std::vector<Row>& borders) {
  ChartTable table;
  if (borders.empty()) return table;
  table.heading = {"contender", "border of", "holds up to", "does not from", "command"};
  for (const Row& row : borders) {
    const auto text = [](const std::optional<double>& number) {
      return number ? fmt::format("{:.6g}", *number) : std::string("-");
    };
    table.rows.push_back({who_ran(row), row.border, text(row.border_low), text(row.border_high), row.command});
  }
  return table;
}

}  // namespace

ChartPage precision_page(const std::vector<Row>& rows) {
  ChartPage page;
  page.title = "What does accuracy cost?";
  page.paragraphs = how_to_read().at("precision");
  page.charts = charts_of(rows);
  page.table.heading = {"motion", "contender", "over", "slope"};
  for (const Row& row : rows) {
    if (row.curve.empty()) continue;
    page.table.rows.push_back({row.scene, who_ran(row), row.curve, row.slope ? slope_in_words(row) : row.reason});
  }
  return page;
}

RowPictures::Swept& RowPictures::swept(const Row& row) {
  const auto found = std::find_if(swept_.begin(), swept_.end(), [&](const Swept& one) {
    return one.in.question == row.swept->question && one.scene == row.scene && one.in.axes == row.swept->axes;
  });
  if (found != swept_.end()) return *found;
  const std::vector<std::string>& axes = row.swept->axes;
  Swept& made = swept_.emplace_back(Swept{row.scene, *row.swept, {}, {}});
  if (!axes.empty()) made.counter.emplace("", axes[0], axes.size() > 1 ? axes[1] : "", row.swept->bad);
  return made;
}

void RowPictures::add(Row row) {
  if (is_precision(row)) {
    precision_.push_back(std::move(row));
  } else if (!is_swept(row)) {
    const auto is_of = [&](const auto& one) { return one.first == row.scene; };
    auto found = std::find_if(scenes_.begin(), scenes_.end(), is_of);
    if (found == scenes_.end()) found = scenes_.insert(scenes_.end(), {row.scene, {}});
    found->second.push_back(std::move(row));
  } else if (!row.border.empty()) {
    swept(row).borders.push_back(std::move(row));
  } else {
    swept(row).counter->add(row);
  }
}

ChartPage RowPictures::page_of(const Swept& swept) {
  ChartPage page;
  if (swept.counter) page.grids = swept.counter->grids();
  if (!swept.in.question.empty())
    page.title = swept.in.question;
  else
    page.title = swept.in.bad == Bad::tunnels ? bullets_title : fmt::format("Where does `{}` hold?", swept.scene);
  page.paragraphs = {how_to_read_maps()};
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
