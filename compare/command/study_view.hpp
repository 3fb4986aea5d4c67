/// What the rows of a study say together, on a terminal and on a page.
#pragma once

#include "report/row_pictures.hpp"
#include "runs/view.hpp"
#include "studies/bullet.hpp"
#include "studies/prepared_studies.hpp"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// Counts the verdicts of each part and contender, as tables and as heat maps, and lists the borders. Keeps the rows of
/// borders alone.
class StudyView {
 public:
  /// @param study,parts are to live as long as this.
  StudyView(const PreparedStudy& study, const std::vector<StudyPart>& parts);
  void add(const StudyPart& part, const Row& row);
  /// A table for each title, and one of the borders.
  [[nodiscard]] std::string text() const;
  /// The heat maps, and one table: first the borders, then the rates where only tunnels count, then the cases that do
  /// not hold where every clause counts, up to a number.
  [[nodiscard]] ChartPage page() const;

 private:
  struct Score {
    int cases = 0;
    int holds = 0;
    int through = 0;
    int beyond = 0;  ///< Beyond the contender's own limits, and nothing else.
    int other = 0;   ///< Ends inside something, or is flagged for another reason.
    int failed = 0;
    int cannot = 0;
    std::map<std::string, int> fails;  ///< Predicates that do not hold, in how many cases.
    std::string first_bad;             ///< Where the first case is that does not hold.
    [[nodiscard]] int ran() const { return cases - cannot - failed; }
    [[nodiscard]] Interval rate() const { return wilson(through, ran()); }  ///< Of tunnels.
  };
  using Scored = std::pair<std::string, Score>;  ///< By contender.
  struct Title {
    std::string question;
    std::vector<std::string> keys;  ///< Of the axes, in `parameters`.
    Bad bad = Bad::does_not_hold;
    std::vector<Scored> scores;
    std::optional<GridCounter> grids;  ///< Where something is varied.
  };
  struct Border {
    std::string title;
    std::string range;  ///< In which it is looked for; empty: all that the parameter takes.
    std::string at;
    std::string theory;
    Row row;
  };
  /// Of the page's table: question, contender, at, verdict, why, command.
  using Line = std::array<std::string, 6>;

  void add_border(const StudyPart& part, const Row& row);
  static std::vector<Column<Scored>> score_columns(Bad bad);

  const PreparedStudy& study_;
  std::vector<std::pair<std::string, Title>> titles_;
  std::vector<Border> borders_;
  std::vector<Line> faults_;
};

}  // namespace paperproof::compare
