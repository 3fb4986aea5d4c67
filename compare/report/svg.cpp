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

constexpr double cell_width = 28;
constexpr double cell_height = 24;
constexpr double left_of_cells = 64;
/// Maps stand side by side up to this width: that of a README.
constexpr double page_width = 900;

struct Size {
  double width, height;
};

std::string before_colon(const std::string& title) { return title.substr(0, title.find(':')); }

double width_of_text(std::string_view words, double of_letter) {
  return of_letter * static_cast<double>(words.size()) + 16;
}

std::string counted_in_words(const ChartGrid& grid) {
  const ChartGrid::Cell sum = total_of(grid);
  return fmt::format("{} of {} cases {}", sum.bad, sum.all, grid.bad_words);
}

std::string counted_title(const ChartGrid& grid) { return grid.title + ": " + counted_in_words(grid); }

/// In a picture of several maps each is headed by its name and its count, without the question they share.
double height_of_heading(bool headed) { return headed ? 38 : 0; }

Size size_of(const ChartGrid& grid, bool headed) {
  const double cells = left_of_cells + cell_width * static_cast<double>(grid.xs.size());
  const double heading = headed ? width_of_text(grid.title, 7) : 0;
  return {std::max(cells, heading) + 24,
          height_of_heading(headed) + cell_height * static_cast<double>(grid.ys.size()) + 52};
}

void draw_cell(Svg& svg, const ChartGrid::Cell& cell, double x, double y) {
  svg.rectangle(x, y, cell_width - 1, cell_height - 1, class_of(cell));
  const double middle = x + cell_width / 2;
  if (cell.all == 0) svg.text(middle, y + 16, "middle", "–", "quiet");
  if (cell.all > 0 && cell.bad == cell.all) svg.text(middle, y + 16, "middle", "✕", "on-all");
  if (cell.bad > 0 && cell.bad < cell.all) svg.text(middle, y + 16, "middle", "•", "mark-t");
}

/// Labels that would touch are left out.
std::size_t label_stride(const std::vector<std::string>& labels) {
  std::size_t longest = 1;
  for (const std::string& label : labels) longest = std::max(longest, label.size());
  return static_cast<std::size_t>(std::ceil((7.0 * static_cast<double>(longest) + 8) / cell_width));
}

void draw_map(Svg& svg, const ChartGrid& grid, double x, double y, bool headed) {
  if (headed) {
    const std::size_t colon = grid.title.find(": ");
    svg.text(x + 8, y + 14, "start", colon == std::string::npos ? grid.title : grid.title.substr(colon + 2), "name");
    svg.text(x + 8, y + 30, "start", counted_in_words(grid), "quiet");
  }
  const std::size_t rows = grid.ys.size();
  const std::size_t columns = grid.xs.size();
  const double left = x + left_of_cells;
  const double bottom = y + height_of_heading(headed) + cell_height * static_cast<double>(rows);
  const auto x_of = [&](std::size_t column) { return left + cell_width * static_cast<double>(column); };
  const auto y_of = [&](std::size_t row) { return bottom - cell_height * static_cast<double>(row + 1); };
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
  for (std::size_t column = 0; column < columns; column += label_stride(grid.xs))
    svg.text(x_of(column) + cell_width / 2, bottom + 16, "middle", grid.xs[column], "quiet");
  svg.text(left + cell_width * static_cast<double>(columns) / 2, bottom + 34, "middle", grid.x_label);
}

/// Letters and digits of a title, with one dash for what is between them.
std::string file_words(std::string_view title) {
  std::string words;
  for (const char c : title) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '.';
    if (plain)
      words += c;
    else if (!words.empty() && words.back() != '-')
      words += '-';
  }
  if (words.ends_with('-')) words.pop_back();
  return words.empty() ? "picture" : words;
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

std::string svg_of(const ChartGrid& grid) { return svg_of_maps(counted_title(grid), {&grid}); }

std::string svg_of_maps(const std::string& title, const std::vector<const ChartGrid*>& maps) {
  const bool headed = maps.size() > 1;
  double width = 0;
  double height = 0;
  for (const ChartGrid* map : maps) {
    const Size size = size_of(*map, headed);
    width = std::max(width, size.width);
    height = std::max(height, size.height);
  }
  const auto fitting = static_cast<std::size_t>(page_width / width);
  const std::size_t columns = std::clamp<std::size_t>(fitting, 1, maps.size());
  const std::size_t lines = (maps.size() + columns - 1) / columns;
  constexpr double top = 52;
  const double bottom = top + height * static_cast<double>(lines);
  const ChartGrid& first = *maps.front();
  const std::string key =
      fmt::format("no mark: none {}, •: some, ✕: all, –: nothing ran; the line is the border", first.bad_words);
  Svg svg(std::max({width * static_cast<double>(columns), width_of_text(title, 8), width_of_text(key, 6.5)}),
          bottom + 24);
  svg.text(8, 20, "start", title, "title");
  if (!first.y_label.empty())
    svg.text(8, 40, "start", fmt::format("Upwards: {}. Across: {}.", first.y_label, first.x_label), "quiet");
  for (std::size_t k = 0; k < maps.size(); ++k)
    draw_map(svg, *maps[k], width * static_cast<double>(k % columns), top + height * static_cast<double>(k / columns),
             headed);
  svg.text(8, bottom + 12, "start", key, "quiet");
  return svg.finish(title);
}

PictureFolder::PictureFolder(std::string path) : path_(std::move(path)) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (error) throw std::runtime_error(path_ + ": no folder for pictures: " + error.message());
}

std::string PictureFolder::write(std::string_view title, std::string_view svg) {
  const std::string words = file_words(title);
  std::string name = words;
  for (int n = 2; !taken_.insert(name).second; ++n) name = fmt::format("{}-{}", words, n);
  name += ".svg";
  OutputFile file((std::filesystem::path(path_) / name).string());
  file.write(svg);
  file.commit();
  return name;
}

std::vector<std::string> write_pictures(const ChartPage& page, PictureFolder& folder) {
  std::vector<std::string> names;
  for (const Chart& chart : page.charts) names.push_back(folder.write(before_colon(chart.title), svg_of(chart)));
  std::vector<std::pair<std::string, std::vector<const ChartGrid*>>> questions;
  for (const ChartGrid& grid : page.grids) {
    names.push_back(folder.write(grid.title, svg_of(grid)));
    const bool named = grid.title.find(':') != std::string::npos;
    const std::string question = named ? before_colon(grid.title) : page.title;
    if (questions.empty() || questions.back().first != question) questions.push_back({question, {}});
    questions.back().second.push_back(&grid);
  }
  for (const auto& [question, maps] : questions)
    if (maps.size() > 1) names.push_back(folder.write(question, svg_of_maps(question, maps)));
  return names;
}

}  // namespace paperproof::compare
