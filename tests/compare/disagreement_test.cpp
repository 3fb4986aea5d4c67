/// The ledger of disagreement over the registered scenes: everything has a cause, and each cause occurs.
#include "studies/disagreement.hpp"

#include "metrics/ledger.hpp"
#include "scenes/load.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace paperproof::compare {
namespace {

/// Longer scenes repeat the same rest.
constexpr int most_steps = 10'000;

using Counts = std::map<std::string, int>;  ///< By cause, consequences apart.

/// @param ours every error of ours, as `scene mode kind`.
Counts count_over_scenes(std::string& ours, std::string& unexplained) {
  Counts counts;
  for (const DisagreementCase& one : test::sampled_of(disagreement_cases(registered_scenes()))) {
    if (load_scenes(one.scene).at(one.index).steps > most_steps) continue;
    const Row row = run_disagreement(one);
    EXPECT_NE(row.verdict, Verdict::failed) << one.scene << ": " << row.reason;
    for (const auto& [key, some] : row.disagreements) {
      counts[key.substr(0, key.find('.'))] += some.count;
      const std::string line = row.scene + " " + row.mode + " " + key + " " + std::to_string(some.count) + "\n";
      if (key.find(name_of(Cause::error_of_ours)) != std::string::npos) ours += line;
      if (key.find(name_of(Cause::unexplained)) != std::string::npos) unexplained += line;
    }
  }
  return counts;
}

TEST(Disagreement, has_one_cause_on_every_registered_scene) {
  std::string ours;
  std::string unexplained;
  const Counts counts = count_over_scenes(ours, unexplained);
  EXPECT_EQ(unexplained, "");
  EXPECT_EQ(ours, "");
  EXPECT_FALSE(counts.empty());
  if (test::sanitized) return;  // a sixteenth of the scenes does not have every cause
  for (const Cause cause :
       {Cause::skin, Cause::travel_cap, Cause::event_latency, Cause::response_law, Cause::solver_iterations,
        Cause::outline, Cause::sampled_time, Cause::intent, Cause::ghost_collision, Cause::float_rounding,
        Cause::start_inside, Cause::crush, Cause::company, Cause::error_of_box2d})
    EXPECT_GT(counts.count(std::string(name_of(cause))), 0U) << name_of(cause);
  EXPECT_GT(counts.count("consequence_of_response_law"), 0U);
}

TEST(Disagreement, in_lockstep_nothing_is_a_consequence) {
  const Row row = run_disagreement({.scene = "jump_into_wall", .index = 0, .lockstep = true});
  EXPECT_EQ(row.mode, "lockstep");
  EXPECT_FALSE(row.disagreements.empty());
  for (const auto& [key, some] : row.disagreements) EXPECT_FALSE(key.starts_with("consequence")) << key;
}

TEST(Disagreement, a_step_is_replayed_by_a_command) {
  EXPECT_EQ(replay_command("flush_tiles", "lockstep", 9),
            "paperproof compare flush_tiles --contender octagon_sweep --mode lockstep --steps 10 --report page.html");
}

}  // namespace
}  // namespace paperproof::compare
