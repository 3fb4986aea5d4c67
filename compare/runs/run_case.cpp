#include "runs/run_case.hpp"

#include "number_in.hpp"
#include "runs/run.hpp"
#include "scenes/load.hpp"

#include <exception>

namespace paperproof::compare {
namespace {

std::vector<ParameterSetting> settings_of(const Case& one) {
  std::vector<ParameterSetting> settings;
  for (const Case::Setting& each : one.parameters) settings.push_back(parse_setting(each.key + "=" + each.value));
  return settings;
}

void name_case(const Case& one, Row& row) {
  row.case_id = id_of(one);
  row.command = command_of(one);
  for (const Case::Setting& each : one.knobs)  // one that is a word stands in `knob`
    if (const std::optional<double> value = number_in<double>(each.value))
      row.parameters.emplace_back(each.key, *value);
  if (one.seed) row.parameters.emplace_back("seed", static_cast<double>(*one.seed));
}

}  // namespace

Row run_case(const Case& one) {
  try {
    const Scene scene = load_scene(one.scene, settings_of(one));
    RunOptions options;
    options.contenders = {one.contender};
    options.scalars = {one.scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64};
    options.steps = one.steps;
    options.random_input = one.seed;
    for (const Case::Setting& each : one.knobs) options.knobs.push_back({each.key, each.value});
    options.reference = false;
    options.measure_cost = false;
    Row row = run_scene(scene, options).rows.front();
    name_case(one, row);
    return row;
  } catch (const std::exception& reason) {
    return failed_row(one, reason.what());
  }
}

Row failed_row(const Case& one, const std::string& reason) {
  Row row;
  row.scene = one.scene;
  row.contender = one.contender;
  row.scalar = is_reference(one.contender) ? "float" : one.scalar;
  row.verdict = Verdict::failed;
  row.reason = reason;
  name_case(one, row);
  std::vector<std::pair<std::string, double>> numbers;
  for (const ParameterDef& def : parameters_of(one.scene))
    for (const Case::Setting& each : one.parameters)
      if (each.key == def.key)
        if (const std::optional<double> value = number_in<double>(each.value))
          numbers.emplace_back(row_key(def), *value);
  row.parameters.insert(row.parameters.begin(), numbers.begin(), numbers.end());
  return row;
}

}  // namespace paperproof::compare
