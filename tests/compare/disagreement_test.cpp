/// The ledger of disagreement over the registered scenes: everything has a cause, and each cause occurs.
#include "studies/disagreement.hpp"

#include "metrics/ledger.hpp"
#include "scenes/load.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace paperproof::compare {
namespace {

/// Longer scenes, and some others, take minutes: the study itself runs them.
constexpr int most_steps = 300;
const std::set<std::string> left_out{"crowd_of_16", "technique_gallery"};

TEST(Disagreement, has_one_cause_on_every_registered_scene) {
  std::set<std::string> found;
  // Every error of ours, everything without a cause, and what lockstep has after divergence.
  std::string bad;
  for (const DisagreementCase& one : disagreement_cases(registered_scenes())) {
    if (left_out.contains(one.scene)) continue;
    if (load_scenes(one.scene).at(one.index).steps > most_steps) continue;
    const Row row = run_disagreement(one);
    EXPECT_NE(row.verdict, Verdict::failed) << one.scene << ": " << row.reason;
    for (const auto& [key, some] : row.disagreements) {
      const std::string cause = key.substr(0, key.find('.'));
      found.insert(cause);
      for (const Cause bad_one : {Cause::error_of_ours, Cause::unexplained, Cause::remaining_lockstep})
        if (cause == name_of(bad_one) || (cause == name_of(Cause::after_divergence) && row.mode == "lockstep"))
          bad += row.scene + " " + row.mode + " " + key + " " + std::to_string(some.count) + "\n";
    }
  }
  EXPECT_EQ(bad, "");
  for (const Cause cause :
       {Cause::skin, Cause::travel_cap, Cause::event_latency, Cause::response_law, Cause::solver_iterations,
        Cause::outline, Cause::sampled_time, Cause::intent, Cause::ghost_collision, Cause::float_rounding,
        Cause::start_inside, Cause::crush, Cause::company, Cause::error_of_box2d, Cause::after_divergence})
    EXPECT_TRUE(found.contains(std::string(name_of(cause)))) << name_of(cause);
}

TEST(Disagreement, fails_on_each_of_what_it_must_not_find) {
  EXPECT_FALSE(Leftovers{}.any());
  for (int Leftovers::*one :
       {&Leftovers::unexplained, &Leftovers::remaining_lockstep, &Leftovers::errors_of_ours, &Leftovers::failed_runs}) {
    Leftovers found;
    found.*one = 1;
    EXPECT_TRUE(found.any());
    EXPECT_TRUE(words_of(found).starts_with("fails: "));
    EXPECT_NE(words_of(found).find(" 1 "), std::string::npos);
  }
}

TEST(Disagreement, a_step_is_replayed_by_a_command) {
  EXPECT_EQ(replay_command("flush_tiles", "lockstep", 9),
            "paperproof compare flush_tiles --contender octagon_sweep --mode lockstep --steps 10 --report page.html");
}

}  // namespace
}  // namespace paperproof::compare
