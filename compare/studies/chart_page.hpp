/// A self-contained page with charts: what a study found, as pictures and as numbers.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

struct ChartPoint {
  double x = 0;
  double y = 0;
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
};

/// Both axes are logarithmic; every number must be above zero.
struct Chart {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<ChartSeries> series;
};

/// A share for each of two values: a picture of where something holds.
struct ChartGrid {
  struct Cell {
    int bad = 0;        ///< Of so many
    int all = 0;        ///< there were; 0: nothing ran.
    std::string words;  ///< More about it.
  };
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<std::string> xs;
  std::vector<std::string> ys;
  std::vector<std::vector<Cell>> cells;  ///< By y, then by x.
};

struct ChartTable {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
};

struct ChartPage {
  std::string title;
  std::vector<std::string> paragraphs;
  std::vector<Chart> charts;
  std::vector<ChartGrid> grids;
  ChartTable table;
  std::vector<std::pair<std::string, std::string>> environment;  ///< (name, value), as in every report.
};

/// The whole page as HTML; it opens from disk without a network. Chart.js, which draws it, is part of it.
[[nodiscard]] std::string html_of(const ChartPage& page);

}  // namespace paperproof::compare
