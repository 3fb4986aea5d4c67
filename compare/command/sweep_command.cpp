#include "command/sweep_command.hpp"

#include "command/compare_command.hpp"
#include "runs/contender.hpp"
#include "runs/environment.hpp"
#include "runs/knobs.hpp"
#include "scenes/load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace paperproof::compare {
namespace {

using nlohmann::ordered_json;

/// Rows that a page lists one by one.
constexpr std::size_t most_listed = 2000;

/// Whether a contender has the knobs among the axes.
bool has_knobs(std::string_view contender, const Sweep& sweep) {
  const std::vector<ParameterDef> defs = parameters_of(sweep.scene);
  return std::all_of(sweep.axes.begin(), sweep.axes.end(), [&](const SweepAxis& axis) {
    return find_parameter(defs, axis.key) != nullptr || has_knob(contender, axis.key);
  });
}

Sweep sweep_of(const SweepArguments& arguments) {
  Sweep sweep;
  sweep.scene = arguments.scene;
  for (const std::string& text : arguments.vary) sweep.axes.push_back(parse_axis(text));
  for (const std::string& text : arguments.set) {
    static_cast<void>(parse_setting(text));
    const std::size_t equals = text.find('=');
    sweep.set.push_back({text.substr(0, equals), text.substr(equals + 1)});
  }
  for (const std::string& name : arguments.cases.contenders) sweep.contenders.push_back({name});
  if (sweep.contenders.empty())
    for (const std::string_view name : contender_names())
      if ((arguments.reference || !is_reference(name)) && has_knobs(name, sweep))
        sweep.contenders.push_back({std::string(name)});
  sweep.seed = arguments.seed;
  sweep.steps = arguments.steps;
  if (arguments.border) parse_border(*arguments.border, sweep);
  return sweep;
}

std::string number_text(const ordered_json& row, const char* key) {
  return row.contains(key) ? row[key].dump() : std::string();
}

std::vector<std::string> border_line(const ordered_json& row, const std::vector<std::string>& keys) {
  const auto number = [&](const char* key) {
    return row.contains(key) ? fmt::format("{:.6g}", row[key].get<double>()) : std::string("-");
  };
  const std::string verdict = row.value("verdict", "");
  const bool ran = verdict != "failed" && verdict != "not_applicable";
  return {row.value("contender", ""), values_of(row, keys), number("border_low"), number("border_high"),
          ran ? "" : row.value("reason", "")};
}

/// Lists the rows that do not hold, up to a number.
class Faults {
 public:
  void add(const StudyPart& part, const ordered_json& row) {
    if (row.value("verdict", "") == "holds" || row.value("verdict", "") == "not_applicable") return;
    if (table_.rows.size() == most_listed) return;
    table_.rows.push_back({row.value("contender", ""), values_of(row, axis_keys_of(part.sweep)),
                           row.value("verdict", ""), number_text(row, "tunnels"),
                           number_text(row, "steps_ending_inside"), row.value("command", "")});
  }
  [[nodiscard]] ChartTable table() const { return table_; }

 private:
  ChartTable table_{{"contender", "at", "verdict", "tunnels", "inside", "command"}, {}};
};

/// @param title of the page.
int run_parts(const RunArguments& arguments, const std::vector<StudyPart>& parts, const std::string& title) {
  StudyScores scores(parts);
  Faults faults;
  StudyRun study(arguments, parts, [&](const StudyPart& part, const ordered_json& row) {
    scores.add(part, row);
    faults.add(part, row);
  });
  study.run();
  const auto page = [&] {
    ChartPage made;
    made.title = title;
    made.paragraphs = {how_to_read_maps,
                       "Each case is judged step by step by exact arithmetic. The table lists the cases that do not "
                       "hold, each with the command that runs it alone."};
    made.environment = environment();
    made.grids = scores.grids();
    made.table = faults.table();
    return made;
  };
  return study.finish(page, scores.tables());
}

int find_borders(const RunArguments& arguments, const std::vector<StudyPart>& parts) {
  const Sweep& sweep = parts.front().sweep;
  ChartPage page;
  page.title = fmt::format("{}: border of {}", sweep.scene, *sweep.border);
  page.table.heading = {"contender", "at", "safe at", "not safe at", "cannot run further"};
  StudyRun study(arguments, parts, [&, keys = axis_keys_of(sweep)](const StudyPart&, const ordered_json& row) {
    page.table.rows.push_back(border_line(row, keys));
  });
  study.run();
  page.environment = environment();
  return study.finish([&] { return page; }, page.title + "\n\n" + text_of(page.table));
}

}  // namespace

void apply(const CaseArguments& arguments, std::vector<StudyPart>& parts) {
  check_contenders(arguments.contenders);
  keep_only(arguments.contenders, parts);
  for (StudyPart& part : parts) {
    if (!arguments.scalars.empty()) part.sweep.scalars = arguments.scalars;
    for (const KnobSetting& knob : parse_knobs(arguments.knobs, arguments.contenders))
      for (NamedContender& contender : part.sweep.contenders) contender.knobs.push_back({knob.name, knob.value});
  }
}

int sweep_command(const SweepArguments& arguments) {
  std::vector<StudyPart> parts{{"", sweep_of(arguments), {}}};
  apply(arguments.cases, parts);
  check(parts.front().sweep);
  if (arguments.border) return find_borders(arguments.run, parts);
  return run_parts(arguments.run, parts, "sweep of " + arguments.scene);
}

int study_prepared_command(const PreparedStudy& study, const PreparedArguments& arguments) {
  std::vector<StudyPart> parts = study.parts(grid_size(arguments.grid));
  apply(arguments.cases, parts);
  return run_parts(arguments.run, parts, fmt::format("study {}", study.name));
}

}  // namespace paperproof::compare
