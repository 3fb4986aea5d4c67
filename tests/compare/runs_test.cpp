/// A run from scene to rows: verdicts, modes, failures.
#include "compare/scene_runs.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

TEST(Replay, has_each_drop_and_crush_as_an_event) {
  Scene scene = built_in("one_way_drop");
  const RunOptions options = alone("octagon_sweep", scene.steps);
  const ReportRun drop = run_of(run_scene(scene, options), "octagon_sweep");
  const auto asked = std::find_if(scene.input.begin(), scene.input.end(),
                                  [](const InputEvent& event) { return event.drop.value_or(false); });
  ASSERT_EQ(drop.events.size(), 1U) << "the second ledge holds";
  EXPECT_EQ(drop.events[0].kind, ReportEvent::Kind::drop);
  EXPECT_EQ(drop.events[0].words, "drops through ledge");
  EXPECT_EQ(drop.events[0].step, asked->step) << "it stands on the ledge, and passes it at once";

  scene = built_in("closing_ceiling");
  const ReportRun crush = run_of(run_scene(scene, options), "octagon_sweep");
  ASSERT_EQ(crush.events.size(), 1U);
  EXPECT_EQ(crush.events[0].kind, ReportEvent::Kind::crush);
  EXPECT_EQ(crush.events[0].step, 21) << "where gap / (v h) = 21.4 falls";
}

TEST(Respawn, puts_back_who_has_left_the_map_by_ten_metres) {
  Scene scene = empty_sky(400);
  scene.start.position = {1, 2};
  scene.start.velocity = {3, 0};
  scene.respawn_box = Box2{{-4, -1}, {40, 6}};
  // It is below -1 - 10 m after n steps of g dt² n (n + 1) / 2 each, and put back before the next one.
  int lost_after = 1;
  while (2 - 10.0 / 3600 * lost_after * (lost_after + 1) / 2 >= -11) ++lost_after;
  const ReportScene result = run_scene(scene, quick({}, scene.steps));
  for (const Row& row : result.rows) {
    // The grid falls by whole squares: it is lost a little earlier.
    if (row.verdict == Verdict::not_applicable || row.contender == "grid") continue;
    EXPECT_EQ(row.respawns, (400 - 1) / lost_after) << row.contender;
    const ReportRun& run = run_of(result, row.contender);
    for (int step = 0; step < 400; ++step) {
      const TraceStep& record = run.steps[static_cast<std::size_t>(step)];
      ASSERT_EQ(record.respawn, step > 0 && step % lost_after == 0) << row.contender << ", step " << step;
      if (record.respawn) {
        EXPECT_EQ(record.path.front().position, scene.start.position) << row.contender;
        EXPECT_NEAR(record.requested.x(), 3.0 / 60, 1e-7) << row.contender << ": with its velocity";
      }
    }
  }
}

TEST(Lockstep, compares_one_step_at_a_time) {
  RunOptions options = quick({}, 200);
  options.mode = Mode::lockstep;
  const ReportScene result = run_scene(built_in("jump_into_corner"), options);
  for (const Row& row : result.rows) EXPECT_TRUE(row.mode == "lockstep" && row.steps == 180) << row.contender;
  // The controller does not notice that it is watched.
  options.mode = Mode::free;
  const ReportScene alone = run_scene(built_in("jump_into_corner"), options);
  const ReportRun& in_lockstep = run_of(result, "octagon_sweep");
  const ReportRun& freely = run_of(alone, "octagon_sweep");
  ASSERT_EQ(in_lockstep.steps.size(), freely.steps.size());
  // And the twin begins every step no further from it than Box2D's skin, along two contacts at once at most.
  const ReportRun& beside = run_of(result, "box2d");
  for (std::size_t i = 0; i < freely.steps.size(); ++i) {
    EXPECT_EQ(in_lockstep.steps[i].path.back().position, freely.steps[i].path.back().position) << "step " << i;
    const Vec2d apart = beside.steps[i].path.front().position - in_lockstep.steps[i].path.front().position;
    EXPECT_LE(apart.norm(), 0.015 * std::sqrt(2.0) + 1e-6) << "step " << i;
  }
}

TEST(Failures, become_rows_with_a_reason) {
  const ReportScene result = run_scene(built_in("article_bullet"), quick({"octagon_sweep", "nobody"}));
  ASSERT_EQ(result.rows.size(), 3U);
  const Row& failed = row_of(result, "nobody");
  EXPECT_EQ(failed.verdict, Verdict::failed);
  EXPECT_TRUE(holds(failed.reason, "nobody"));
  EXPECT_FALSE(failed.steps != 0 || failed.tunnels) << "what did not run has no numbers";
  EXPECT_EQ(row_of(result, "octagon_sweep").verdict, Verdict::holds) << "the others run on";
}

}  // namespace
}  // namespace paperproof::compare
