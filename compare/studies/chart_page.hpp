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

struct ChartTable {
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
};

struct ChartPage {
  std::string title;
  std::vector<std::string> paragraphs;
  Chart chart;
  ChartTable table;
  std::vector<std::pair<std::string, std::string>> environment;  ///< (name, value), as in every report.
};

/// The whole page as HTML; it opens from disk without a network. Chart.js, which draws it, is part of it.
[[nodiscard]] std::string html_of(const ChartPage& page);

}  // namespace paperproof::compare
