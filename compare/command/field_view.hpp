/// What the rows of `study field` say together, on a terminal and on a page.
#pragma once

#include "report/chart_page.hpp"
#include "studies/field.hpp"

#include <string>
#include <utility>
#include <vector>

namespace paperproof::compare {

/// A contender, and all that it did.
using FieldLine = std::pair<std::string, std::vector<Row>>;

/// A table of contenders by groups, one of their metrics, and one of what the guarantee costs. The page also has what
/// the engines' own queries say of the worst runs. It keeps all rows.
class FieldView {
 public:
  /// @param study is to live as long as this. @param jobs processes for the page's checks; 0: one for each core.
  FieldView(const PreparedStudy& study, const std::vector<StudyPart>& parts, int jobs);
  void add(const StudyPart& part, const Row& row);
  [[nodiscard]] std::string text() const;
  [[nodiscard]] ChartPage page() const;

 private:
  [[nodiscard]] ChartGrid grid() const;
  [[nodiscard]] ChartTable spot_checks() const;

  const PreparedStudy& study_;
  int jobs_;
  std::vector<std::string> groups_;  ///< Titles of parts.
  std::vector<FieldLine> lines_;
};

}  // namespace paperproof::compare
