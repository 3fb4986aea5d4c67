#include "studies/disagreement.hpp"

#include "runs/run.hpp"
#include "scenes/load.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <exception>

namespace paperproof::compare {
namespace {

constexpr const char* compared = "octagon_sweep";

/// What every row of the study has.
Row named(Row row, const DisagreementCase& one) {
  row.mode = one.lockstep ? "lockstep" : "free";
  row.command = fmt::format("paperproof study disagreement {}", one.scene);
  return row;
}

/// The row of a case that gave none. @param reason in words.
Row failed_row(const DisagreementCase& one, const std::string& reason) {
  Row row;
  row.scene = one.scene;
  row.contender = compared;
  row.verdict = Verdict::failed;
  row.reason = reason;
  return named(row, one);
}

}  // namespace

std::vector<std::string> registered_scenes() {
  std::vector<std::string> names;
  for (const BuiltInScene& scene : built_in_scenes()) names.push_back(scene.name);
  for (const SceneFamily& family : scene_families()) names.emplace_back(family.name);
  return names;
}

std::vector<DisagreementCase> disagreement_cases(const std::vector<std::string>& names) {
  std::vector<DisagreementCase> cases;
  for (const std::string& name : names) {
    const std::size_t scenes = load_scenes(name).size();
    for (std::size_t k = 0; k < scenes; ++k)
      for (const bool lockstep : {false, true}) cases.push_back({name, k, lockstep});
  }
  return cases;
}

Row run_disagreement(const DisagreementCase& one) {
  try {
    const std::vector<Scene> scenes = load_scenes(one.scene);
    RunOptions options;
    options.contenders = {compared};
    options.mode = one.lockstep ? Mode::lockstep : Mode::free;
    options.measure_cost = false;
    options.ledger = true;
    return named(run_scene(scenes.at(one.index), options).rows.front(), one);
  } catch (const std::exception& reason) {
    return failed_row(one, reason.what());
  }
}

StudyCases cases_of(const std::vector<DisagreementCase>& all) {
  StudyCases cases;
  std::string text;
  for (const DisagreementCase& one : all) text += fmt::format("{} {} {}\n", one.scene, one.index, one.lockstep);
  cases.id = hash_of(text);
  cases.count = all.size();
  cases.run = [&all](std::size_t index) { return run_disagreement(all[index]); };
  cases.lost = [&all](std::size_t index, const std::string& reason) { return failed_row(all[index], reason); };
  cases.is_of = [&all](std::size_t index, const Row& row) {
    const Row expected = named({}, all[index]);
    return row.mode == expected.mode && row.command == expected.command;
  };
  cases.limit_s = 600;  // a real level may take this long
  return cases;
}

std::string words_of(const Leftovers& found) {
  return fmt::format("{}: {} unexplained, {} beyond the known causes (remaining_lockstep), {} of {}, {} failed",
                     found.any() ? "fails" : "holds", counted(found.unexplained, "event"),
                     counted(found.remaining_lockstep, "event"), counted(found.errors_of_ours, "error"), compared,
                     counted(found.failed_runs, "run"));
}

std::string replay_command(std::string_view scene, std::string_view mode, int step) {
  return fmt::format("paperproof compare {} --contender {} --mode {} --steps {} --report page.html", scene, compared,
                     mode, step + 1);
}

}  // namespace paperproof::compare
