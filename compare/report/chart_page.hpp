/// What a study found, as pictures and as numbers: what a page is made of.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

struct ChartPoint {
  double x = 0;
  double y = 0;
  std::string words{};  ///< Shown while the point is pointed at: the value of the knob.
  bool front = false;   ///< No other point of the chart is better along both axes; drawn larger.
  bool hollow = false;  ///< It is beyond a limit that its contender documents.
  bool struck = false;  ///< Its run passes something, or ends inside it.
};

struct ChartSeries {
  std::string name;
  std::vector<ChartPoint> points;
  bool shown = true;  ///< At first; the page's legend shows and hides any.
};

/// Both axes are logarithmic; every number must be above zero.
struct Chart {
  std::string title;  ///< What the picture shows. A first word with a colon names it where there are several.
  std::string x_label;
  std::string y_label;
  std::vector<ChartSeries> series;
};

/// A share for each of two values: a picture of where something holds.
struct ChartGrid {
  struct Cell {
    int bad = 0;  ///< Cases that are bad.
    int all = 0;  ///< Cases that ran; 0: none.
    // Of its first bad case; where none is bad, of its first one:
    std::string words{};                  ///< What came of it.
    std::string command{};                ///< That runs it alone.
    bool through = false;                 ///< It passed a solid.
    std::optional<std::size_t> replay{};  ///< Position in `ChartPage::replays`; none: there is no replay of it.
    std::string label{};                  ///< Of a cell that is read, and not only seen.
    bool grave = false;                   ///< With a label: something unsafe is bad in it.
  };
  std::string title;  ///< Who is tried, and in what.
  std::string x_label;
  std::string y_label;
  std::vector<std::string> xs;
  std::vector<std::string> ys;
  std::vector<std::vector<Cell>> cells;   ///< By y, then by x.
  std::string bad_words = "do not hold";  ///< What bad cases do.
  std::string beside{};  ///< A contender who runs each replayed case as well. With it the grid is a table of labels.
};

struct ChartTable {
  std::string title{};  ///< Where a page has several.
  std::vector<std::string> heading;
  std::vector<std::vector<std::string>> rows;
};

struct ChartPage {
  std::string title;
  std::vector<std::string> paragraphs;  ///< The first one says how to read the pictures.
  std::vector<Chart> charts{};
  std::vector<ChartGrid> grids{};
  ChartTable table{};
  std::vector<ChartTable> more_tables{};
  std::vector<std::string> replays{};  ///< Of cells; one JSON object each: see `cell_replay_json`.
  std::vector<std::pair<std::string, std::string>> environment{};  ///< (name, value), as in every report.
};

}  // namespace paperproof::compare
