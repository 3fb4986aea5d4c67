/// Runs of several characters: who is told what, and who cannot run. What octagon_sweep makes of the scenes is said by
/// their answers, and the law of `discrete` is tested without runs.
#include "compare/same_steps.hpp"
#include "compare/scene_runs.hpp"
#include "runs/crowd_contestant.hpp"
#include "runs/input_cursor.hpp"
#include "runs/technique_contestant.hpp"
#include "support/steps_wanted.hpp"

namespace paperproof::compare {
namespace {

TEST(Crowd, is_told_record_by_record_in_the_order_of_its_characters) {
  const SceneFiles files;
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.reference = false;
  options.trace_stem = files.path("t");
  (void)run_scene(built_in("characters_head_on"), options);
  const auto lines = lines_of(files.path("t.characters_head_on.octagon_sweep.double.jsonl"));
  ASSERT_EQ(lines.size(), 1 + 2 * 30U);
  EXPECT_EQ(lines[0].at("characters"), 2);
  for (std::size_t i = 1; i < lines.size(); ++i) {
    EXPECT_EQ(lines[i].at("step"), (i - 1) / 2);
    EXPECT_EQ(lines[i].at("character"), (i - 1) % 2);
  }
  const nlohmann::json& met = lines[1 + 2 * 2].at("met").at(0);
  EXPECT_EQ(met.at("character"), 1);
  EXPECT_EQ(met.at("side"), "right");
  EXPECT_NEAR(met.at("fraction").get<double>(), 0.5, 1e-12);
}

TEST(Crowd, takes_the_random_input_of_its_own_seed_for_each) {
  const Scene scene = built_in("crowd_of_16");
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.reference = false;
  options.max_replay_steps = options.steps.emplace(120);
  const ReportScene own = run_scene(scene, options);
  options.random_input = 1;  // as the scene has it
  const ReportScene random = run_scene(scene, options);
  for (std::size_t k = 0; k < 15; ++k) {
    const auto end_of = [k](const ReportScene& result) {
      return run_of(result, "octagon_sweep").others[k].back().path.back().position;
    };
    EXPECT_EQ(end_of(own), end_of(random)) << k;
  }
}

TEST(Crowd, is_refused_in_words_by_who_knows_one_character) {
  RunOptions options = quick();
  Scene scene = built_in("characters_head_on");
  for (const Row& row : run_scene(scene, options).rows) {
    const bool knows =
        row.contender == "octagon_sweep" || row.contender == "discrete" || row.contender.starts_with("box2d");
    EXPECT_EQ(row.verdict == Verdict::not_applicable, !knows) << row.contender << ": " << row.reason;
    if (!knows) {
      EXPECT_EQ(row.reason, row.contender + " knows one character, and here are 2");
    }
  }
  options.mode = Mode::lockstep;
  for (const Row& row : run_scene(scene, options).rows) {
    EXPECT_EQ(row.verdict, Verdict::not_applicable);
    EXPECT_TRUE(holds(row.reason, "lockstep is between one character and its twin"));
  }
}

TEST(DiscreteCrowdOf16, runs_through) {
  Scene scene = built_in("crowd_of_16");
  RunOptions options = quick();
  options.contenders = {"discrete"};
  options.steps = test::sampled(scene.steps);
  const Row row = row_of(run_scene(scene, options), "discrete");
  EXPECT_NE(row.verdict, Verdict::failed) << row.reason;
  EXPECT_EQ(row.finite, true);
  EXPECT_EQ(row.characters, 16);
  EXPECT_EQ(row.steps, options.steps);
}

TEST(DiscreteCrowdOfOne, has_the_bits_of_the_run_of_one_character) {
  const TechniqueEntry& discrete = *find_technique("discrete");
  for (const char* name : {"article_bullet", "slope_joints", "jump_into_corner", "flush_tiles", "lift_sideways",
                           "closing_ceiling", "one_way_lift_drop", "thin_sensor", "sweeping_paper"}) {
    const Scene scene = built_in(name);
    const Scenery<double> scenery(scene.scenery);
    const auto alone = make_technique_contestant(discrete, ScalarKind::binary64, scene, scenery, {});
    const auto one = make_crowd_contestant(discrete, ScalarKind::binary64, scene, scenery, {});
    const Script script = script_of(scene);
    InputCursor cursor(scene, script);
    std::vector<TraceStep> of_alone(1);
    std::vector<TraceStep> of_one(1);
    for (int step = 0; step < scene.steps; ++step) {
      const StepInput input = cursor.at(step);
      alone->step(input, of_alone);
      one->step(input, of_one);
      ASSERT_TRUE(same_step(of_one[0], of_alone[0])) << name << ", step " << step;
    }
  }
}

}  // namespace
}  // namespace paperproof::compare
