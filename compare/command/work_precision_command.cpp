#include "command/study_command.hpp"

#include "command/compare_command.hpp"
#include "command/progress.hpp"
#include "command/study_outputs.hpp"
#include "report/row_pictures.hpp"
#include "runs/contender.hpp"
#include "runs/text_columns.hpp"
#include "scenes/load.hpp"
#include "studies/front.hpp"
#include "studies/motions.hpp"
#include "studies/work_precision.hpp"
#include "words.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

std::string name_of_curve(const Row& row) {
  return row.contender + (row.scalar == "float" && !is_reference(row.contender) ? " float" : "");
}

ChartPage page_of(const WorkPrecision& found) {
  std::vector<nlohmann::ordered_json> rows;
  for (const std::vector<Row>* part : {&found.points, &found.curves})
    for (const Row& row : *part) rows.push_back(row_json(row));
  ChartPage page = precision_page(rows);
  page.paragraphs.insert(page.paragraphs.end(), found.sentences.begin(), found.sentences.end());
  page.environment = environment();
  return page;
}

std::string slopes(const WorkPrecision& found) {
  std::vector<TextColumn> columns{{"contender", {}, true}, {"over", {}, true}};
  std::vector<std::pair<std::string, std::string>> lines;
  for (const Row& curve : found.curves) {
    const std::pair line{name_of_curve(curve), curve.curve};
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
  for (const auto& [who, over] : lines) {
    columns[0].cells.emplace_back(who);
    columns[1].cells.emplace_back(over);
  }
  for (const Motion& motion : motions()) {
    TextColumn column{std::string(motion.name), {}};
    for (const auto& line : lines) {
      const auto curve = std::find_if(found.curves.begin(), found.curves.end(), [&](const Row& row) {
        return row.scene == motion.name && name_of_curve(row) == line.first && row.curve == line.second;
      });
      const bool known = curve != found.curves.end();
      const std::string slope = known && curve->slope ? fmt::format("{:.2f}", *curve->slope) : "";
      const std::string mark = known && curve->on_front.value_or(false) ? "*" : "";
      column.cells.push_back(slope.empty() && mark.empty() ? Cell{} : Cell(slope + mark));
    }
    columns.push_back(std::move(column));
  }
  return aligned(columns);
}

}  // namespace

int work_precision_command(const StudyArguments& arguments) {
#ifndef NDEBUG
  throw InputError("work-precision: expected a build without assertions (NDEBUG): this one's times mean nothing");
#endif
  check_contenders(arguments.contenders);
  StudyOutputs outputs(arguments.rows_path, arguments.report_path);
  const Progress progress(!arguments.quiet);
  WorkPrecision found;
  try {
    found = study_work_precision(arguments.motions, arguments.contenders,
                                 [&](double share) { progress.show("work-precision,", share); });
  } catch (const std::invalid_argument& reason) {
    std::vector<std::string> names;
    for (const Motion& motion : motions()) names.emplace_back(motion.name);
    throw InputError(fmt::format("work-precision: expected {}: {}", one_of_words(names), reason.what()));
  }
  progress.clear();
  bool failed = false;
  for (const std::vector<Row>* rows : {&found.points, &found.curves})
    for (const Row& row : *rows) {
      outputs.add(row);
      failed = failed || row.verdict == Verdict::failed;
    }
  outputs.finish(page_of(found));
  if (!arguments.quiet) {
    std::string text = "slope of log error over log knob; * on the front: no other has less error in less time\n\n" +
                       slopes(found) + '\n';
    for (const std::string& sentence : found.sentences) text += sentence + '\n';
    print_out(text);
  }
  return failed ? 1 : 0;
}

}  // namespace paperproof::compare
