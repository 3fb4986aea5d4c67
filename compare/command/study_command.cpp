#include "command/study_command.hpp"

#include "command/compare_command.hpp"
#include "command/field_view.hpp"
#include "command/study_view.hpp"
#include "runs/contender.hpp"
#include "runs/knobs.hpp"
#include "scenes/load.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {
namespace {

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

/// Turns the knobs and takes the number types that the options ask for, in every part; leaves contenders out that they
/// do not name. @throws InputError where they name what there is not.
void apply(const CaseArguments& arguments, std::vector<StudyPart>& parts) {
  keep_only(arguments.contenders, parts);
  for (StudyPart& part : parts) {
    if (!arguments.scalars.empty()) part.sweep.scalars = arguments.scalars;
    for (const KnobSetting& knob : parse_knobs(arguments.knobs, arguments.contenders))
      for (NamedContender& contender : part.sweep.contenders) contender.knobs.push_back(knob);
  }
}

template <class View>
int run_study(const RunArguments& arguments, View view, const std::vector<StudyPart>& parts, const StudyCases& cases) {
  StudyRun run(arguments, cases,
               [&](std::size_t index, const Row& row) { view.add(parts[part_case(parts, index).part], row); });
  run.run();
  return run.finish([&] { return view.page(); }, view.text());
}

}  // namespace

int sweep_command(const SweepArguments& arguments) {
  check_contenders(arguments.cases.contenders);
  std::vector<StudyPart> parts{{"", sweep_of(arguments), {}}};
  apply(arguments.cases, parts);
  const Sweep& sweep = parts.front().sweep;
  check(sweep);
  PreparedStudy study{};
  study.title = sweep.border ? fmt::format("{}: border of {}", sweep.scene, *sweep.border) : "sweep of " + sweep.scene;
  study.paragraphs = {
      "Each case is judged step by step by exact arithmetic. The table lists the cases that do not hold, each with the "
      "command that runs it alone."};
  return run_study(arguments.run, StudyView(study, parts), parts, cases_of(parts));
}

int study_command(const PreparedStudy& study, const StudyArguments& arguments) {
  constexpr int hour = 3600;  // [s]
  constexpr int day = 24 * hour;
  check_contenders(arguments.cases.contenders);
  const GridSize size = grid_size(arguments.grid);
  std::vector<StudyPart> parts = study.parts(size, arguments.cases.contenders);
  apply(arguments.cases, parts);
  StudyCases cases = cases_of(parts);
  cases.limit_s = size == GridSize::full ? day : hour;
  if (study.in_one_table) return run_study(arguments.run, FieldView(study, parts, arguments.run.jobs), parts, cases);
  return run_study(arguments.run, StudyView(study, parts), parts, cases);
}

}  // namespace paperproof::compare
