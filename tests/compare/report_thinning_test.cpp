/// Which steps of a long run stay in the report.
#include "compare/report_pages.hpp"
#include "support/steps_wanted.hpp"

#include <set>

namespace paperproof::compare {
namespace {

TEST_F(ReportTest, the_step_of_a_disagreement_survives_thinning) {
  ReportScene scene = walk_of(1000);
  Disagreement disagreement;
  disagreement.step = 777;
  disagreement.statements = {{0, Vec2d::Zero(), Vec2d::Zero(), {}}};
  scene.disagreements = {disagreement};
  ReportOptions options;
  options.max_replay_steps = 50;
  const json run = data(page(report_of(scene), options), "replay-0")["runs"][0];
  std::set<int> kept;
  int number = 0;
  for (const json& difference : run["step"]) kept.insert(number += difference.get<int>());
  EXPECT_LE(kept.size(), 50U);
  for (const int step : {776, 777, 778}) EXPECT_TRUE(kept.contains(step)) << step;
}

TEST_F(ReportTest, thinned_characters_keep_the_same_steps) {
  ReportRun run = sample_report().scenes[4].runs[0];
  thin_for_replay(run, 12);
  ASSERT_LE(run.steps.size(), 12U);
  ASSERT_EQ(run.others[0].size(), run.steps.size());
  for (std::size_t i = 0; i < run.steps.size(); ++i) EXPECT_EQ(run.others[0][i].step, run.steps[i].step);
}

TEST(ThinForReplay, keeps_ends_events_and_first_contact_within_the_limit) {
  for (const int steps : {5, 8, 9, 100, 1200, 1201, test::sanitized ? 1201 : 3600}) {
    for (const int limit : {8, 20, 60, 1200}) {
      ReportRun run = walk_of(steps).runs[0];
      for (TraceStep& step : run.steps) {
        if (step.step < steps / 2) step.contacts.clear();
      }
      run.events = {{steps / 3, ReportEvent::Kind::tunnel, ""}};
      thin_for_replay(run, limit);
      std::set<int> kept;
      for (const TraceStep& step : run.steps) kept.insert(step.step);
      const auto room = static_cast<std::size_t>(std::min(steps, limit));
      EXPECT_LE(kept.size(), room);
      EXPECT_GE(kept.size(), room / 3) << steps << " to " << limit;
      EXPECT_TRUE(kept.contains(0) && kept.contains(steps - 1));
      if (limit < 20) continue;  // half of less than 20 has no room for two events with their neighbours
      EXPECT_TRUE(kept.contains(steps / 3)) << steps << " to " << limit;
      EXPECT_TRUE(kept.contains(steps / 2)) << steps << " to " << limit;
    }
  }
}

TEST(ThinForReplay, leaves_a_short_run_as_it_is) {
  ReportRun run = walk_of(100).runs[0];
  thin_for_replay(run, 100);
  EXPECT_EQ(run.steps.size(), 100U);
  EXPECT_EQ(run.every, 1);
}

TEST(ThinForReplay, says_how_many_steps_one_stands_for) {
  ReportRun run = walk_of(1000).runs[0];
  run.events.clear();
  thin_for_replay(run, 100);
  EXPECT_GE(run.every, 10);
  EXPECT_LE(run.every, 12);
  thin_for_replay(run, 50);
  EXPECT_GE(run.every, 20) << "thinning twice multiplies";
}

TEST(CutToExcerpt, leaves_the_step_that_matters_and_those_around_it) {
  const auto steps_of = [](const std::vector<ReportEvent>& events, int around) {
    ReportRun run = walk_of(100).runs[0];
    for (TraceStep& step : run.steps)
      if (step.step < 30) step.contacts.clear();
    run.events = events;
    cut_to_excerpt(run, around);
    for (const ReportEvent& event : run.events) EXPECT_LE(std::abs(event.step - run.steps[0].step), 2 * around);
    return std::pair(run.steps.front().step, run.steps.back().step);
  };
  using Kind = ReportEvent::Kind;
  EXPECT_EQ(steps_of({}, 4), std::pair(26, 34)) << "the first contact";
  EXPECT_EQ(steps_of({{50, Kind::inside, ""}, {70, Kind::tunnel, ""}, {90, Kind::tunnel, ""}}, 4), std::pair(66, 74));
  EXPECT_EQ(steps_of({{20, Kind::note, ""}, {50, Kind::inside, ""}}, 3), std::pair(47, 53));
  EXPECT_EQ(steps_of({{1, Kind::inside, ""}}, 4), std::pair(0, 5));
  ReportRun pair = sample_report().scenes[4].runs[0];
  cut_to_excerpt(pair, 2);
  EXPECT_LE(pair.steps.size(), 5U);
  EXPECT_EQ(pair.others[0].size(), pair.steps.size());
}

TEST(OptionsFor, many_runs_share_the_room) {
  EXPECT_EQ(options_for(1).max_replay_steps, ReportOptions{}.max_replay_steps);
  EXPECT_EQ(options_for(0).max_replay_steps, ReportOptions{}.max_replay_steps);
  const std::size_t runs = 221 * 8;
  const auto per_run = static_cast<std::size_t>(options_for(runs).max_replay_steps);
  EXPECT_LE(per_run * runs, 600'000U);
  EXPECT_GT((per_run + 1) * runs, 600'000U);
  EXPECT_EQ(options_for(1'000'000).max_replay_steps, 60);
}

}  // namespace
}  // namespace paperproof::compare
