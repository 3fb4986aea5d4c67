/// The replay in a report: its columns, number for number, and which steps are left out.
#include "compare/report_pages.hpp"
#include "report/run_json.hpp"
#include "report/scenery_json.hpp"

#include <limits>
#include <set>

namespace paperproof::compare {
namespace {

constexpr int bottom = static_cast<int>(Side::bottom);
constexpr int right = static_cast<int>(Side::right);

/// Everything that a step may say. The character goes to the right by 0.4 units a step, which must not be lost.
ReportRun run_of_everything() {
  ReportRun run;
  run.header.contender = "octagon_sweep";
  run.header.scalar = "double";
  run.header.dt = 1.0 / 64;
  run.header.box2d = "2.4.1";
  run.header.path_exact = true;
  run.header.points = {{-0.5, -1}, {0.5, -1}, {0, 1}};
  run.header.scenery.colliders = {box(0, 0, 1, 1), chain({{0, 0}, {1, 0}}, 0)};
  run.every = 3;
  const Contact ground{1, {0.00004, 0.5}, {0, 1}, 0.25, 5e-7, Side::bottom};
  TraceStep step = step_of(0, {{{0, 0}, 0}, {{0.00004, 1}, 1}}, {0.001, 64});
  step.grounded = true;
  step.contacts = {ground};
  step.movers = {{{3, 0}, {3, 0.00004}}, {{7, 7}, {7, 7}}};
  step.vertex_ways.resize(1);
  step.vertex_ways[0].collider = 1;
  step.vertex_ways[0].vertices = {{{0, 0}, {1, 0}}, {{0, 0}, {0, 1}}};
  run.steps = {step};
  step.step = 1;
  step.path = {{{0.00004, 1}, 0}, {{0.00008, 2}, 1}};
  step.grounded = false;
  step.jumping = step.respawn = true;
  step.contacts[0].point += Vec2d(0.00004, 1);
  step.contacts[0].fraction = 0;
  step.movers[0] = {{3, 0.00004}, {3, 0.00008}};
  step.start_overlap = {4, 0};
  run.steps.push_back(step);
  step = step_of(2, {{{0.00012, 2}, 0}, {{0.5, 2}, 0.25}, {{0.5, 2.5}, 1}}, {32, 0});
  step.stuck = step.dropped = step.capped = true;
  step.contacts = {{0, {1, 2.5}, {-1, 0}, 1, 0, Side::right}, ground};
  step.contacts[1].point = {0.5, 2};
  step.met = {{1, {0, 1}, 0.5, Side::bottom}};
  step.movers = {{{3, 0.00008}, {3, 0.00012}}, {{7, 7}, {7, 7}}};
  step.vertex_ways = run.steps[0].vertex_ways;
  step.dropped_through = {16};
  run.steps.push_back(step);
  step = step_of(7, {});
  step.remainder = {-0.2, 0};
  step.movers = {{{4, 0}, {4, 1}}, {{7, 7}, {7, 7}}};
  step.vertex_ways = run.steps[0].vertex_ways;
  step.crushed = {2, 5};
  run.steps.push_back(step);
  run.steps.push_back(step_of(8, {}, {0, std::numeric_limits<double>::quiet_NaN()}));
  run.others.resize(1);
  for (const double number : {0, 1, 2, 7, 8})
    run.others[0].push_back(step_of(int(number), {{{1, number}, 0}, {{1, number + 1}, 1}}));
  run.events = {{2, ReportEvent::Kind::tunnel, "through", 0, 1},
                {3, ReportEvent::Kind::note, "aside"},
                {7, ReportEvent::Kind::corner_cut, "cut", 1}};
  return run;
}

TEST(RunJson, has_a_column_for_each_part_of_a_step_in_whole_units) {
  const json side_kinds{1, bottom, 0, 10'000, 0, right, -10'000, 0};
  json expected = json::parse(R"({
    "contender": "octagon_sweep", "scalar": "double", "mode": "free", "dt": 0.015625, "box2d": "2.4.1",
    "path_exact": true, "plan_omitted": [], "every": 3, "hull": [-5000,-10000, 5000,-10000, 0,10000],
    "events": [[2,"tunnel","through",0,1], [3,"note","aside"], [7,"corner cut","cut",1]],
    "scenery": 5, "not_finite_from": 8,
    "step": [0,1,1,5], "flags": "16h0",
    "path": [0,0,10000, 0,1,10000, 3,0,0,0,4999,0,2500,0,5000,10000, -1],
    "velocity": [1,64000, 0,0, 31999,-64000, -32000,0],
    "contacts": [1,0,0,-5000,2500,5e-07, 1,0,0,0,0,5e-07, 2,1,5000,0,10000,0,0,0,0,2500,5e-07, 0],
    "start_overlap": {"1": [4,0]}, "crush": {"3": [2,5]}, "drop": {"2": [16]}, "remainder": {"3": [-2000,0]},
    "movers": [1,30000,0,0,0,70000,70000,0,0, 0,0,1,0,0, 0,0,-1,0,0, 1,10000,-1,0,10000,0,0,0,0],
    "turns": [0,15708,0,0, 0,15708,0,0, 0,15708,0,0, 0,15708,0,0],
    "others": [{"step": [0,1,1,5], "flags": "0000", "path": [2,10000,0,0,0,10000,10000, 0,0,10000, 0,0,10000,
                2,0,40000,0,0,10000,10000], "velocity": [0,0,0,0,0,0,0,0], "contacts": [0,0,0,0], "kinds": [],
                "start_overlap": {}}]})");
  expected["kinds"] = side_kinds;
  expected["met"] = {{"2", {1, bottom, 0, 10'000, 5000}}};
  EXPECT_EQ(json::parse(run_json(run_of_everything(), 5, Quantum(2, 10))), expected);
  ReportRun plain = walk_of(3).runs[0];
  const json columns = json::parse(run_json(plain, 0, Quantum(2, 10)));
  for (const char* key : {"movers", "turns", "crush", "drop", "met", "remainder", "others", "not_finite_from"})
    EXPECT_FALSE(columns.contains(key)) << key;
}

TEST(SceneryJson, writes_equal_shapes_once_and_says_where_each_is_what_moves_and_what_only_notices) {
  SceneryDef scenery;
  scenery.colliders = {box(0, 0, 1, 1), box(2, 0, 3, 1), box(2, 1, 3, 2, 1), box(4, 0, 5, 1)};
  scenery.colliders[3].holes = {{{4.25, 0.25}, {4.5, 0.25}, {4.5, 0.5}}};
  scenery.colliders.push_back(chain({{4, 3}, {5, 3.5}}, 0));
  scenery.colliders.back().one_way = Vec2d(0, 1);
  scenery.colliders.push_back(box(0, 0, 1, 1));
  scenery.colliders.back().sensor = true;
  const std::vector<std::string> ids{"a", "b", "c", "d", "ledge", "zone"};
  const json expected = json::parse(R"({
    "shapes": [[0, [[0,0,10000,0,0,10000,-10000,0]]],
               [0, [[0,0,10000,0,0,10000,-10000,0], [2500,2500,2500,0,0,2500]]],
               [1, [[0,0,10000,5000]], [0,1]]],
    "order": [0,3, 1,1, 2,1, 0,1], "unit": 10000, "at": [0,0, 2,0, 0,1, 2,-1, 0,3, -4,-3],
    "ids": {"1": "b", "4": "ledge"}, "movers": [0,2, 2,1, 0,1, 1,1, 0,1], "sensors": [5]})");
  EXPECT_EQ(json::parse(scenery_json(scenery, ids, {1, 4}, Quantum(2, 10))), expected);
  SceneryDef still;
  still.colliders = {circle({1, 2}, 0.5)};
  const json round = json::parse(scenery_json(still, {"disc"}, {}, Quantum(2, 10)));
  EXPECT_EQ(round["shapes"][0][1][0].size(), 2U * 64);
  EXPECT_FALSE(round.contains("movers") || round.contains("sensors"));
}

TEST(Quantum, is_a_ten_thousandth_of_the_character_or_finer_unless_the_scene_is_too_large_for_whole_numbers) {
  EXPECT_DOUBLE_EQ(Quantum(1.25, 10).metres(), 1e-4);
  EXPECT_DOUBLE_EQ(Quantum(1.25e-4, 10).metres(), 1e-8);
  EXPECT_DOUBLE_EQ(Quantum(1.25, 1e7).metres(), 1e-4);
  EXPECT_EQ(Quantum(1.25, 1e7).round(1e7), 100'000'000'000);
  EXPECT_DOUBLE_EQ(Quantum(1.25, 1e12).metres(), 1e-3);
}

TEST_F(ReportTest, a_replay_has_the_scenery_once_lengths_of_steps_and_disagreements_up_to_the_limit) {
  ReportScene scene = walk_of(5);
  scene.runs.push_back(scene.runs[0]);
  EXPECT_EQ(element(page(report_of(scene)), "replay-0")["sceneries"].size(), 1U);
  double& corner = scene.runs[1].header.scenery.colliders[0].points[0].x();
  corner += 1e-6;  // less than is shown, as rounding to float would do
  EXPECT_EQ(element(page(report_of(scene)), "replay-0")["sceneries"].size(), 1U);
  corner -= 0.5;
  scene.dt_list = {1.0 / 64, 31.0 / 1024};
  const std::vector<Contact> contacts{{0, {0.25, 0}, {0, 1}, 0.5, 1e-6, Side::bottom}};
  Disagreement disagreement;
  disagreement.step = 3;
  disagreement.statements = {{1, {0, 1}, {0.5, 1}, contacts}};
  disagreement.exact = contacts;
  disagreement.who_is_right = "Nobody.";
  scene.disagreements.assign(9, disagreement);
  const json replay = element(page(report_of(scene), {.max_disagreements = 4}), "replay-0");
  EXPECT_EQ(replay["sceneries"].size(), 2U);
  EXPECT_EQ(replay["runs"][0]["scenery"], 0);
  EXPECT_EQ(replay["runs"][1]["scenery"], 1);
  EXPECT_EQ(replay["sceneries"][0]["ids"], (json{{"0", "tile_0"}, {"2", "tile_2"}})) << "those that are spoken of";
  EXPECT_EQ(replay["dt_list"], (json{0.015625, 0.0302734375}));
  EXPECT_EQ(replay["disagreements_in_all"], 9);
  EXPECT_EQ(replay["disagreements"].size(), 4U);
  const json shown{{0, bottom, 2500, 0, 0, 10'000, 5000, 1e-6}};
  const json statement{{"run", 1}, {"from", {0, 10'000}}, {"to", {5000, 10'000}}, {"contacts", shown}};
  EXPECT_EQ(
      replay["disagreements"][0],
      (json{{"step", 3}, {"statements", json::array({statement})}, {"exact", shown}, {"who_is_right", "Nobody."}}));
}

TEST_F(ReportTest, a_step_takes_about_thirty_bytes_and_a_tile_a_few) {
  constexpr int steps = 1200;
  const std::size_t few = page(report_of(walk_of(steps / 2))).size();
  const std::size_t many = page(report_of(walk_of(steps))).size();
  EXPECT_LT(many - few, 32U * steps / 2);
  SceneryDef level;
  for (int i = 0; i < 5000; ++i) level.colliders.push_back(box(i % 250, i / 250, i % 250 + 1, i / 250 + 1));
  EXPECT_LT(scenery_json(level, {}, {}, Quantum(1, 250)).size(), 5U * 5000) << "\"1,0,\" and a little for each new row";
}

TEST_F(ReportTest, the_step_of_a_disagreement_survives_thinning) {
  ReportScene scene = walk_of(1000);
  scene.disagreements.resize(1);
  scene.disagreements[0].step = 777;
  const json run = element(page(report_of(scene), {.max_replay_steps = 50}), "replay-0")["runs"][0];
  std::set<int> kept;
  int number = 0;
  for (const json& difference : run["step"]) kept.insert(number += difference.get<int>());
  EXPECT_LE(kept.size(), 50U);
  for (const int step : {776, 777, 778}) EXPECT_TRUE(kept.contains(step)) << step;
}

TEST(ThinForReplay, keeps_ends_events_and_first_contact_within_the_limit) {
  for (const int steps : {5, 8, 9, 100, 1200, 1201, 3600}) {
    for (const int limit : {8, 20, 60, 1200}) {
      ReportRun run = walk_of(steps).runs[0];
      for (TraceStep& step : run.steps)
        if (step.step < steps / 2) step.contacts.clear();
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

TEST(ThinForReplay, says_how_many_steps_one_stands_for_and_keeps_the_same_of_every_character) {
  ReportRun run = pair_of(1000).runs[0];
  thin_for_replay(run, 1000);
  EXPECT_EQ(run.steps.size(), 1000U);
  EXPECT_EQ(run.every, 1);
  thin_for_replay(run, 100);
  EXPECT_GE(run.every, 10);
  EXPECT_LE(run.every, 12);
  thin_for_replay(run, 50);
  EXPECT_GE(run.every, 20) << "thinning twice multiplies";
  ASSERT_EQ(run.others[0].size(), run.steps.size());
  for (std::size_t i = 0; i < run.steps.size(); ++i) EXPECT_EQ(run.others[0][i].step, run.steps[i].step);
}

TEST(CutToExcerpt, leaves_the_step_that_matters_and_those_around_it) {
  const auto ends_of = [](const std::vector<ReportEvent>& events, int around) {
    ReportRun run = pair_of(100).runs[0];
    for (TraceStep& step : run.steps)
      if (step.step < 30) step.contacts.clear();
    run.others[0].front().contacts.clear();
    run.events = events;
    cut_to_excerpt(run, around);
    EXPECT_EQ(run.others[0].size(), run.steps.size());
    for (const ReportEvent& event : run.events) EXPECT_LE(std::abs(event.step - run.steps[0].step), 2 * around);
    return std::pair(run.steps.front().step, run.steps.back().step);
  };
  using Kind = ReportEvent::Kind;
  EXPECT_EQ(ends_of({}, 4), std::pair(26, 34)) << "the first contact";
  EXPECT_EQ(ends_of({{50, Kind::inside, ""}, {70, Kind::tunnel, ""}, {90, Kind::tunnel, ""}}, 4), std::pair(66, 74));
  EXPECT_EQ(ends_of({{20, Kind::note, ""}, {50, Kind::inside, ""}}, 3), std::pair(47, 53));
  EXPECT_EQ(ends_of({{1, Kind::inside, ""}}, 4), std::pair(0, 5));
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
