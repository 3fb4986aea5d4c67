/// A run from scene to rows: verdicts, modes, failures.
#include "compare/scene_runs.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

TEST(Sentence, says_who_is_wrong_and_how_far_the_others_agree) {
  const ReportScene result = run_scene(built_in("article_bullet"), quick());
  EXPECT_EQ(result.rows.size(), contender_names().size());
  EXPECT_TRUE(holds(row_of(result, "penetration_resolution").reason, "platform"));
  const Row& ours = row_of(result, "octagon_sweep");
  EXPECT_EQ(ours.reason, "");
  EXPECT_LE(ours.max_contact_gap_m.value_or(1), 1e-6);
  EXPECT_LE(ours.max_position_difference_box2d_m.value_or(1), 0.02) << "Box2D's skin";
  EXPECT_TRUE(holds(result.sentence, "agree to 0.015 m, which is Box2D's skin."));
  const std::string wrong = result.sentence.substr(0, result.sentence.find("wrong"));
  EXPECT_TRUE(holds(wrong, "penetration_resolution"));
  EXPECT_FALSE(holds(wrong, "octagon_sweep"));
  EXPECT_TRUE(holds(run_scene(empty_sky(9), quick()).sentence, "m, which is less than Box2D's skin."));
}

TEST(Contenders, are_those_asked_for_and_the_twin_beside_them) {
  const Scene scene = built_in("article_bullet");
  RunOptions options = quick();
  options.contenders = {"speculative"};
  options.steps = 7;
  ReportScene result = run_scene(scene, options);
  ASSERT_EQ(result.rows.size(), 2U);
  EXPECT_EQ(result.rows[0].contender, "speculative");
  EXPECT_EQ(result.rows[1].contender, "box2d");
  EXPECT_EQ(result.rows[0].steps, 7);

  options.reference = false;
  EXPECT_EQ(run_scene(scene, options).rows.size(), 1U);

  options.reference = true;
  options.scalars = {ScalarKind::binary64, ScalarKind::binary32};
  result = run_scene(scene, options);
  ASSERT_EQ(result.rows.size(), 3U) << "two of the technique, one of Box2D, which has no choice";
  EXPECT_NE(find_row(result, "speculative", "double"), nullptr);
  EXPECT_NE(find_row(result, "speculative", "float"), nullptr);
  EXPECT_NE(find_row(result, "box2d", "float"), nullptr);
}

TEST(Replay, has_each_drop_and_crush_as_an_event_and_the_lengths_of_the_steps) {
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.reference = false;
  Scene scene = built_in("one_way_drop");
  options.max_replay_steps = scene.steps;
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

  scene = built_in("uneven_flight");
  EXPECT_EQ(run_scene(scene, options).dt_list, scene.dt_list);
}

TEST(Contenders, that_share_a_reason_not_to_run_are_told_of_together) {
  RunOptions options = quick();
  options.steps = 1;
  EXPECT_TRUE(holds(run_scene(built_in("sweeping_paper"), options).sentence,
                    "mask and wind_back: each is for scenery that stands still."));
  options.contenders = {"mask"};
  EXPECT_TRUE(holds(run_scene(built_in("sweeping_paper"), options).sentence, "mask: mask is for scenery that stands"));
}

/// It would hold on another side each time.
TEST(Contenders, cannot_turn_what_is_one_way_and_say_so) {
  Scene scene = empty_sky(3);
  scene.movers = {{.id = "fan", .path = {{}}, .turns = {{.time = 0, .at = 0}, {.time = 1, .at = 1}}}};
  scene.scenery.colliders.push_back(
      {.shape = ColliderDef::Shape::chain, .points = {{50, 50}, {51, 50}}, .one_way = Vec2d(0, 1), .mover = 0});
  scene.ids.emplace_back("fan");
  for (const Row& row : run_scene(scene, quick()).rows) {
    EXPECT_EQ(row.verdict, Verdict::not_applicable) << row.contender;
    EXPECT_TRUE(holds(row.reason, "\"fan\"")) << row.contender;
  }
}

TEST(Contenders, are_given_the_same_random_input) {
  RunOptions options = quick();
  options.random_input = 7;
  options.max_replay_steps = 400;
  const ReportScene result = run_scene(empty_sky(400), options);
  const ReportRun& first = run_of(result, "octagon_sweep");
  ASSERT_EQ(first.steps.size(), 400U);
  int changes = 0;
  for (const std::string_view name : contender_names()) {
    if (row_of(result, name).verdict == Verdict::not_applicable) continue;
    const ReportRun& run = run_of(result, name);
    ASSERT_EQ(run.steps.size(), 400U) << name;
    for (std::size_t i = 0; i < 400; ++i) {
      const Vec2d off = run.steps[i].requested - first.steps[i].requested;
      if (is_reference(name))
        // Its velocity is read back from float after every step: each time half an ulp of less than 128 m/s.
        EXPECT_LE(off.cwiseAbs().maxCoeff(), static_cast<double>(i + 1) * 0x1p-18 / 60) << name << ", step " << i;
      else
        EXPECT_EQ(off, Vec2d(0, 0)) << name << ", step " << i;
      if (i > 0 && name == "octagon_sweep") changes += run.steps[i].requested.x() != run.steps[i - 1].requested.x();
    }
  }
  EXPECT_GE(changes, 20) << "the input must steer";
}

TEST(Respawn, puts_back_who_has_left_the_map_by_ten_metres) {
  Scene scene = empty_sky(400);
  scene.start.position = {1, 2};
  scene.start.velocity = {3, 0};
  scene.respawn_box = Box2<double>{{-4, -1}, {40, 6}};
  // It is below -1 - 10 m after n steps of g dt² n (n + 1) / 2 each, and put back before the next one.
  int lost_after = 1;
  while (2 - 10.0 / 3600 * lost_after * (lost_after + 1) / 2 >= -11) ++lost_after;
  RunOptions options = quick();
  options.max_replay_steps = 400;
  const ReportScene result = run_scene(scene, options);
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
  RunOptions options = quick();
  options.mode = Mode::lockstep;
  options.max_replay_steps = 200;
  const ReportScene result = run_scene(built_in("jump_into_corner"), options);
  ASSERT_EQ(result.rows.size(), 2U);
  const Row& mine = row_of(result, "octagon_sweep");
  for (const Row& row : result.rows) EXPECT_TRUE(row.mode == "lockstep" && row.steps == 180) << row.contender;
  // From the same start a contact is at most shifted into a neighbouring step by Box2D's skin, which counts as the
  // same.
  EXPECT_EQ(mine.contact_agreement_box2d, 1);
  for (const ReportRun& run : result.runs) EXPECT_EQ(run.header.mode, "lockstep") << run.header.contender;
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
  RunOptions options = quick();
  options.contenders = {"octagon_sweep", "nobody"};
  const ReportScene result = run_scene(built_in("article_bullet"), options);
  ASSERT_EQ(result.rows.size(), 3U);
  const Row& failed = row_of(result, "nobody");
  EXPECT_EQ(failed.verdict, Verdict::failed);
  EXPECT_TRUE(holds(failed.reason, "nobody"));
  EXPECT_FALSE(failed.steps != 0 || failed.tunnels) << "what did not run has no numbers";
  EXPECT_EQ(row_of(result, "octagon_sweep").verdict, Verdict::holds) << "the others run on";
}

TEST(Failures, to_search_a_whole_step_are_told_from_leaving_the_range) {
  Scene scene = empty_sky(2);
  scene.gravity = {0, 0};
  RunOptions options = quick();
  options.reference = false;
  for (const auto& [metres, reason] : {std::pair{4e4, "step 0: the motion needs more than 1,000,000 units of search"},
                                       std::pair{4e6, "step 0: the motion would leave the range of +-2e6 m"}}) {
    scene.start.velocity = {metres / scene.dt, 0};
    const ReportScene result = run_scene(scene, options);
    for (const char* contender : {"wind_back", "penetration_resolution", "speculative_march", "pixel_colour", "mask"}) {
      EXPECT_EQ(row_of(result, contender).verdict, Verdict::flagged) << contender;
      EXPECT_TRUE(row_of(result, contender).reason.starts_with(std::string("validity: ") + reason))
          << row_of(result, contender).reason;
    }
  }
}

TEST(Failures, of_box2d_to_express_a_scene_are_not_applicable) {
  // 20 x 40 px at 32,768 px/m: corners nearer to each other than Box2D keeps apart.
  const ReportScene result = run_scene(built_in("scaled_1e-3"), quick());
  for (const char* name : {"box2d", "box2d_pieces"}) {
    const Row& row = row_of(result, name);
    EXPECT_EQ(row.verdict, Verdict::not_applicable) << name;
    EXPECT_NE(row.reason, "") << name;
    EXPECT_FALSE(row.tunnels) << name;
  }
  const Row& ours = row_of(result, "octagon_sweep");
  EXPECT_EQ(ours.verdict, Verdict::holds) << ours.reason;
  EXPECT_FALSE(ours.contact_agreement_box2d) << "there is nothing to agree with";
}

TEST(Findings, say_that_a_run_begins_inside_a_solid) {
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  const ReportScene result = run_scene(built_in("start_overlapping_deep"), options);
  const std::vector<std::string>& findings = row_of(result, "octagon_sweep").findings;
  EXPECT_EQ(findings, std::vector<std::string>{"the run begins inside `floor`"});
  EXPECT_TRUE(holds(result.sentence, "the run begins inside `floor`"));
  EXPECT_EQ(run_scene(built_in("thin_platform"), options).sentence.find("begins inside"), std::string::npos);
}

}  // namespace
}  // namespace paperproof::compare
