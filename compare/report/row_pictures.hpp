/// Rows as pictures: heat maps over two parameters, and error against run time.
#pragma once

#include "records/row.hpp"
#include "report/chart_page.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

inline constexpr const char* bullets_title = "Where do bullets pass?";
/// Of heat maps.
[[nodiscard]] std::string how_to_read_maps();

/// Who ran: the contender with its knobs, and its number type where it could be another.
/// @param varied keys that are left out: an axis shows what they are.
[[nodiscard]] std::string who_ran(const Row& row, const std::vector<std::string>& varied = {});

/// Counts rows into one heat map for each contender, its knobs and number type; keeps no row. What cannot run counts
/// for nothing. A cell keeps the words and the command of its first bad row, or of its first row.
class GridCounter {
 public:
  /// @param x,y keys in `parameters`; an empty `y` gives one line.
  GridCounter(std::string title, std::string x, std::string y, Bad bad);
  /// A row without these parameters is left out.
  void add(const Row& row);
  /// In the order in which the contenders came. Those that could run nowhere have none.
  [[nodiscard]] std::vector<ChartGrid> grids() const;

 private:
  using Place = std::pair<double, double>;
  struct Counts {
    std::string who;
    std::map<Place, ChartGrid::Cell> cells;
  };
  Counts& counts_of(const Row& row);

  std::string title_, x_, y_;
  Bad bad_;
  std::vector<Counts> counts_;
};

/// Whether a border lies on a side of a cell: it and its neighbour ran, and bad cases are in one of them alone.
[[nodiscard]] bool is_at_border(const ChartGrid& grid, std::size_t column, std::size_t row);

/// The slope of a curve that has one, with its 95 % interval: `0.98 ± 0.02`.
[[nodiscard]] std::string slope_in_words(const Row& curve);

/// Error against run time from the rows of `work-precision`: one chart for each motion, one series for each row with a
/// `curve`; its points are the rows that have this key in `parameters`, and of those over `dt_s` the ones without
/// another knob. Errors below 1e-9 m are drawn at 1e-9 m, as rounding has no order that a reader could use.
[[nodiscard]] ChartPage precision_page(const std::vector<Row>& rows);

/// A key of `parameters` as it stands at an axis: `speed_m_s` is "speed [m/s]".
[[nodiscard]] std::string axis_words(const std::string& key);

/// Pages from rows of any kind. Memory is taken by cells and by the rows of comparisons, not by the cases of a sweep.
class RowPictures {
 public:
  void add(Row row);
  /// One for each question that was swept: a heat map for each contender, over the first two axes.
  [[nodiscard]] std::vector<ChartPage> pages() const;

  using ByScene = std::vector<std::pair<std::string, std::vector<Row>>>;
  /// Rows that are no part of a study, in the order in which they came.
  [[nodiscard]] const ByScene& scenes() const { return scenes_; }

 private:
  struct Swept {
    std::string scene;
    SweptIn in;
    std::optional<GridCounter> counter;  ///< Where something is varied.
    std::vector<Row> borders;
  };
  Swept& swept(const Row& row);
  [[nodiscard]] static ChartPage page_of(const Swept& swept);

  std::vector<Row> precision_;
  std::vector<Swept> swept_;
  ByScene scenes_;
};

}  // namespace paperproof::compare
