#include "command/study_command.hpp"

#include "command/compare_command.hpp"
#include "report/row_pictures.hpp"
#include "runs/environment.hpp"
#include "runs/peers.hpp"
#include "runs/view.hpp"
#include "scenes/load.hpp"
#include "studies/motions.hpp"
#include "studies/work_precision.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace paperproof::compare {
namespace {

ChartPage page_of(const std::vector<Row>& rows, const std::vector<std::string>& sentences) {
  ChartPage page = precision_page(rows);
  page.paragraphs.insert(page.paragraphs.end(), sentences.begin(), sentences.end());
  page.environment = environment();
  return page;
}

/// A line for each contender and what its curves are over, with the slope of each motion.
std::string slopes(const WorkPrecision& found) {
  using Line = std::pair<std::string, std::vector<const Row*>>;
  std::vector<Line> lines;
  for (const Row& curve : found.curves) entry_of(lines, called(curve) + ' ' + curve.curve).push_back(&curve);
  std::vector<Column<Line>> columns{{"contender", [](const Line& line) { return called(*line.second.front()); }},
                                    {"over", [](const Line& line) { return line.second.front()->curve; }}};
  for (const Motion& motion : motions())
    columns.push_back({std::string(motion.name), [&motion](const Line& line) -> Cell {
                         for (const Row* curve : line.second) {
                           if (curve->scene != motion.name) continue;
                           const std::string slope = curve->slope ? slope_in_words(*curve) : "";
                           const std::string mark = curve->on_front.value_or(false) ? "*" : "";
                           if (!slope.empty() || !mark.empty()) return slope + mark;
                         }
                         return std::nullopt;
                       }});
  return view(lines, columns);
}

}  // namespace

int work_precision_command(const PrecisionArguments& arguments) {
#ifndef NDEBUG
  throw InputError("work-precision: expected a build without assertions (NDEBUG): this one's times mean nothing");
#endif
  check_contenders(arguments.contenders);
  return measure_here(arguments.run, "work-precision", [&](const std::function<void(double)>& tell) {
    WorkPrecision found;
    try {
      found = study_work_precision(arguments.motions, arguments.contenders, tell);
    } catch (const std::invalid_argument& reason) {
      std::vector<std::string> names;
      for (const Motion& motion : motions()) names.emplace_back(motion.name);
      throw InputError(fmt::format("work-precision: expected {}: {}", one_of_words(names), reason.what()));
    }
    std::vector<Row> rows = found.points;
    rows.insert(rows.end(), found.curves.begin(), found.curves.end());
    std::string text =
        "slope of log error over log knob, with its 95 % interval, where the three finest points or more lie on a "
        "line; * on the front: no other has less error in less time" +
        std::string(peers().empty() ? "" : "; peers are not timed, and on none") + "\n\n" + slopes(found) + '\n';
    for (const std::string& sentence : found.sentences) text += sentence + '\n';
    return Measurements{rows, page_of(rows, found.sentences), text};
  });
}

}  // namespace paperproof::compare
