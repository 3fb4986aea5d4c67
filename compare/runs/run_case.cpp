#include "runs/run_case.hpp"

#include "runs/contender.hpp"
#include "runs/peers.hpp"
#include "scenes/load.hpp"

#include <paperproof/number_in.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

/// A recorded step takes about a kilobyte of memory.
constexpr int most_recorded_steps = 100'000;

/// What is wanted of a run besides its row.
struct Extras {
  bool recorded = false;
  bool beside_motion = false;
  bool timed = false;
};

ReportScene run_alone(const Case& one, const Extras& extras) {
  ReportScene result;
  try {
    if (one.mode != "free" || one.reference) throw std::invalid_argument("a Case runs free and by itself");
    if (!one.peer.empty() && find_peer(one.contender) == nullptr) add_peer({one.contender, one.peer});
    const Scene scene = scene_of(one);
    RunOptions options{.contenders = {one.contender},
                       .scalars = {one.scalar == "float" ? ScalarKind::binary32 : ScalarKind::binary64},
                       .steps = one.steps,
                       .random_input = one.seed,
                       .knobs = one.knobs,
                       .full_plan = one.full_plan,
                       .reference = false,
                       .measure_cost = extras.timed,
                       .continuous = extras.beside_motion};
    if (extras.recorded) options.max_replay_steps = one.steps.value_or(scene.steps);
    if (options.max_replay_steps > most_recorded_steps) throw std::length_error("too many steps to record");
    result = run_scene(scene, options);
    put_case(one, result.rows.front());
  } catch (const std::exception& reason) {
    result.rows = {failed_row(one, reason.what())};
  }
  return result;
}

}  // namespace

Scene scene_of(const Case& one) {
  std::vector<ParameterSetting> settings;
  for (const Case::Setting& each : one.parameters) settings.push_back(parse_setting(each.key + "=" + each.value));
  return load_scene(one.scene, settings);
}

Row run_case(const Case& one) { return run_alone(one, {}).rows.front(); }

Row run_case_beside_motion(const Case& one, bool timed) {
  return run_alone(one, {.beside_motion = true, .timed = timed}).rows.front();
}

ReportScene excerpt_of(const Case& one, int around, std::optional<int> middle) {
  ReportScene result = run_alone(one, {.recorded = true});
  std::size_t told = 0;  // steps up to the last that is left
  for (ReportRun& run : result.runs) {
    cut_to_excerpt(run, around, middle);
    if (!run.steps.empty()) told = std::max(told, static_cast<std::size_t>(run.steps.back().step) + 1);
  }
  if (told < result.dt_list.size()) result.dt_list.resize(told);
  return result;
}

std::optional<Case> case_of(const RunOptions& options, const std::string& scene,
                            std::span<const ParameterSetting> settings, const Row& row) {
  if (row.mode == "lockstep" && is_reference(row.contender)) return std::nullopt;
  Case one;
  one.scene = scene;
  for (const ParameterSetting& each : settings) one.parameters.push_back({each.key, fmt::format("{}", each.value)});
  one.contender = row.contender;
  one.peer = peer_command(row.contender);
  if (!is_reference(row.contender)) one.scalar = row.scalar;
  for (const KnobSetting& each : options.knobs)
    if (has_knob(row.contender, each.key)) one.knobs.push_back(each);
  one.seed = options.random_input;
  one.steps = options.steps;
  one.mode = row.mode;
  one.full_plan = options.full_plan;
  one.reference = options.reference;
  return one;
}

Row failed_row(const Case& one, const std::string& reason) {
  Row row;
  row.scene = one.scene;
  row.contender = one.contender;
  row.scalar = is_reference(one.contender) ? "float" : one.scalar;
  row.mode = one.mode;
  row.knob = turned_knobs(one.knobs, one.contender);
  row.verdict = Verdict::failed;
  row.reason = reason;
  put_case(one, row);
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
