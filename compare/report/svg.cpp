#include "report/svg.hpp"

#include "records/output_file.hpp"
#include "report/row_pictures.hpp"
#include "report/svg_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace paperproof::compare {
namespace {

/// A logarithmic axis between whole powers of ten, on so many pixels.
class LogAxis {
 public:
  LogAxis(const std::vector<double>& values, double from, double to) : from_(from), to_(to) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    low_ = static_cast<int>(std::floor(std::log10(*least * 0.9)));
    high_ = std::max(low_ + 1, static_cast<int>(std::ceil(std::log10(*most * 1.1))));
  }
  [[nodiscard]] double at(double value) const {
    return from_ + (to_ - from_) * (std::log10(value) - low_) / (high_ - low_);
  }
  /// Powers of ten that carry a line and a label.
  [[nodiscard]] std::vector<int> ticks() const {
    std::vector<int> all;
    for (int power = low_; power <= high_; power += std::max(1, (high_ - low_ + 7) / 8)) all.push_back(power);
    return all;
  }

 private:
  double from_, to_;
  int low_ = 0, high_ = 1;
};

std::string power_in_words(int power) {
  return std::abs(power) > 3 ? fmt::format("1e{}", power) : fmt::format("{:g}", std::pow(10.0, power));
}

struct Frame {
  double left, top, right, bottom;
};

void draw_axes(Svg& svg, const Frame& frame, const LogAxis& x, const LogAxis& y, const Chart& chart) {
  for (const int power : x.ticks()) {
    const double at = x.at(std::pow(10.0, power));
    svg.line(at, frame.top, at, frame.bottom, "grid");
    svg.text(at, frame.bottom + 16, "middle", power_in_words(power), "quiet");
  }
  for (const int power : y.ticks()) {
    const double at = y.at(std::pow(10.0, power));
    svg.line(frame.left, at, frame.right, at, "grid");
    svg.text(frame.left - 6, at + 4, "end", power_in_words(power), "quiet");
  }
  svg.text((frame.left + frame.right) / 2, frame.bottom + 36, "middle", chart.x_label);
  svg.text(8, frame.top - 12, "start", chart.y_label);
}

std::string_view class_of(const ChartGrid::Cell& cell) {
  if (cell.all == 0) return "none";
  if (cell.bad == 0) return "holds";
  return cell.bad == cell.all ? "all" : "some";
}

/// Both ran, and bad cases are on one side alone.
bool is_border(const ChartGrid::Cell& one, const ChartGrid::Cell& other) {
  return one.all > 0 && other.all > 0 && (one.bad == 0) != (other.bad == 0);
}

constexpr double cell_width = 34;
constexpr double cell_height = 24;

void draw_cell(Svg& svg, const ChartGrid::Cell& cell, double x, double y) {
  svg.rectangle(x, y, cell_width - 1, cell_height - 1, class_of(cell));
  const double middle = x + cell_width / 2;
  if (cell.all == 0) svg.text(middle, y + 16, "middle", "–", "quiet");
  if (cell.all > 0 && cell.bad == cell.all) svg.text(middle, y + 16, "middle", "✕", "on-all");
  if (cell.bad > 0 && cell.bad < cell.all) svg.text(middle, y + 16, "middle", "•", "mark-t");
}

}  // namespace

std::string svg_of(const Chart& chart) {
  constexpr Frame frame{70, 70, 560, 430};
  std::vector<double> xs;
  std::vector<double> ys;
  for (const ChartSeries& series : chart.series)
    for (const ChartPoint& point : series.points) {
      if (!series.shown) continue;
      xs.push_back(point.x);
      ys.push_back(point.y);
    }
  Svg svg(860, 490);
  svg.text(8, 24, "start", chart.title, "title");
  if (xs.empty()) return svg.finish(chart.title);
  const LogAxis x(xs, frame.left, frame.right);
  const LogAxis y(ys, frame.bottom, frame.top);
  draw_axes(svg, frame, x, y, chart);
  std::size_t kind = 0;
  for (const ChartSeries& series : chart.series) {
    if (!series.shown) continue;
    const std::string ink = fmt::format("i{}", kind % svg_inks);
    std::vector<double> way;
    for (const ChartPoint& point : series.points) way.insert(way.end(), {x.at(point.x), y.at(point.y)});
    svg.polyline(way, false, "curve " + ink);
    for (const ChartPoint& point : series.points)
      svg.mark(x.at(point.x), y.at(point.y), point.front ? 6 : 3.5, kind, ink);
    const double legend = frame.top + 18 * static_cast<double>(kind);
    svg.mark(frame.right + 24, legend - 4, 4, kind, ink);
    svg.text(frame.right + 36, legend, "start", series.name);
    ++kind;
  }
  return svg.finish(chart.title);
}

std::string svg_of(const ChartGrid& grid) {
  constexpr double left = 70;
  constexpr double top = 56;
  const ChartGrid::Cell sum = total_of(grid);
  const std::string title = fmt::format("{}: {} of {} cases {}", grid.title, sum.bad, sum.all, grid.bad_words);
  const std::size_t rows = grid.ys.size();
  const std::size_t columns = grid.xs.size();
  const double bottom = top + cell_height * static_cast<double>(rows);
  const double right = left + cell_width * static_cast<double>(columns);
  const auto x_of = [&](std::size_t column) { return left + cell_width * static_cast<double>(column); };
  const auto y_of = [&](std::size_t row) { return bottom - cell_height * static_cast<double>(row + 1); };
  Svg svg(std::max(right + 20, 8.0 * static_cast<double>(title.size()) + 20), bottom + 66);
  svg.text(8, 20, "start", title, "title");
  svg.text(8, 44, "start", grid.y_label);
  for (std::size_t row = 0; row < rows; ++row) {
    svg.text(left - 6, y_of(row) + 16, "end", grid.ys[row], "quiet");
    for (std::size_t column = 0; column < columns; ++column)
      draw_cell(svg, grid.cells[row][column], x_of(column), y_of(row));
  }
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column) {
      const ChartGrid::Cell& cell = grid.cells[row][column];
      const double edge = x_of(column + 1) - 0.5;
      if (column + 1 < columns && is_border(cell, grid.cells[row][column + 1]))
        svg.line(edge, y_of(row), edge, y_of(row) + cell_height, "border");
      if (row + 1 < rows && is_border(cell, grid.cells[row + 1][column]))
        svg.line(x_of(column), y_of(row) - 0.5, x_of(column + 1), y_of(row) - 0.5, "border");
    }
  for (std::size_t column = 0; column < columns; ++column)
    svg.text(x_of(column) + cell_width / 2, bottom + 16, "middle", grid.xs[column], "quiet");
  svg.text((left + right) / 2, bottom + 34, "middle", grid.x_label);
  svg.text(8, bottom + 56, "start",
           fmt::format("blank: none {}, •: some, ✕: all; the line is the border", grid.bad_words), "quiet");
  return svg.finish(title);
}

std::string write_picture(const std::string& title, std::string_view svg, const std::string& folder) {
  std::string name;
  for (const char c : title)
    name +=
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.' ? c : '-';
  std::filesystem::create_directories(folder);
  name += ".svg";
  OutputFile file((std::filesystem::path(folder) / name).string());
  file.write(svg);
  file.commit();
  return name;
}

std::vector<std::string> write_pictures(const ChartPage& page, const std::string& folder) {
  std::vector<std::string> names;
  for (const Chart& chart : page.charts)
    names.push_back(write_picture(chart.title.substr(0, chart.title.find(':')), svg_of(chart), folder));
  for (const ChartGrid& grid : page.grids) names.push_back(write_picture(grid.title, svg_of(grid), folder));
  return names;
}

}  // namespace paperproof::compare
