/// A run from scene to rows: verdicts, modes, failures, traces.
#include "compare/scene_files.hpp"
#include "runs/output_file.hpp"
#include "runs/rows_json.hpp"
#include "runs/run.hpp"
#include "runs/table.hpp"
#include "runs/trace_writer.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>

namespace paperproof::compare {
namespace {

Scene built_in(const std::string& name) { return load_scenes(name).front(); }

RunOptions quick() {
  RunOptions options;
  options.measure_cost = false;
  return options;
}

const Row* find_row(const ReportScene& result, std::string_view contender, std::string_view scalar = "") {
  for (const Row& row : result.rows)
    if (row.contender == contender && (scalar.empty() || row.scalar == scalar)) return &row;
  return nullptr;
}

const Row& row_of(const ReportScene& result, std::string_view contender) {
  static const Row none;
  const Row* found = find_row(result, contender);
  EXPECT_NE(found, nullptr) << contender;
  return found != nullptr ? *found : none;
}

const ReportRun& run_of(const ReportScene& result, std::string_view contender) {
  static const ReportRun none;
  for (const ReportRun& run : result.runs)
    if (run.header.contender == contender) return run;
  ADD_FAILURE() << contender << " has no replay";
  return none;
}

/// Nothing but a block that is never reached: whoever is here flies.
Scene empty_sky(int steps) {
  Scene scene;
  scene.name = "sky";
  scene.gravity = {0, -10};
  scene.steps = steps;
  scene.scenery.colliders.push_back({.points = {{500, 500}, {501, 500}, {501, 501}, {500, 501}}});
  scene.ids.emplace_back("far");
  return scene;
}

TEST(ArticleBullet, is_judged_as_the_article_says) {
  const ReportScene result = run_scene(built_in("article_bullet"), quick());
  EXPECT_EQ(result.rows.size(), contender_names().size());
  const Row& passed = row_of(result, "penetration_resolution");
  EXPECT_EQ(passed.verdict, Verdict::tunnels);
  EXPECT_EQ(passed.tunnels, 1);
  EXPECT_TRUE(holds(passed.reason, "platform"));
  for (const char* name : {"speculative_march", "speculative", "octagon_sweep", "box2d"}) {
    const Row& row = row_of(result, name);
    EXPECT_EQ(row.verdict, Verdict::holds) << name << ": " << row.reason;
    EXPECT_EQ(row.reason, "") << name;
    EXPECT_EQ(row.tunnels, 0) << name;
    EXPECT_EQ(row.steps_ending_inside, 0) << name;
    EXPECT_EQ(row.steps, 60) << name;
    EXPECT_EQ(row.first_contact_step, 0) << name;
  }
  const Row& ours = row_of(result, "octagon_sweep");
  ASSERT_TRUE(ours.first_contact_fraction && ours.max_contact_gap_m && ours.max_position_difference_box2d_m);
  EXPECT_NEAR(*ours.first_contact_fraction, 30.0 / 50, 1e-9);
  EXPECT_LE(*ours.max_contact_gap_m, 1e-6);
  EXPECT_LE(*ours.max_position_difference_box2d_m, 0.02) << "Box2D's skin";
  const std::string wrong = result.sentence.substr(0, result.sentence.find("wrong"));
  EXPECT_TRUE(holds(wrong, "penetration_resolution"));
  EXPECT_EQ(wrong.find("octagon_sweep"), std::string::npos) << result.sentence;
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

TEST(Contenders, that_cannot_turn_what_moves_say_so) {
  Scene scene = empty_sky(3);
  scene.movers = {{.id = "fan", .path = {{}}, .turns = {{.time = 0, .at = 0}, {.time = 1, .at = 1}}}};
  scene.scenery.colliders.push_back({.points = {{50, 50}, {51, 50}, {51, 51}}, .mover = 0});
  scene.ids.emplace_back("fan");
  const ReportScene result = run_scene(scene, quick());
  for (const Row& row : result.rows) {
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
  const Row& twin = row_of(result, "box2d");
  EXPECT_EQ(mine.mode, "lockstep");
  EXPECT_EQ(twin.mode, "lockstep");
  EXPECT_EQ(mine.steps, 180);
  EXPECT_EQ(twin.steps, 180);
  ASSERT_TRUE(mine.contact_agreement_box2d);
  EXPECT_GE(*mine.contact_agreement_box2d, 0.95);
  EXPECT_LE(*mine.contact_agreement_box2d, 1);
  // The controller does not notice that it is watched.
  options.mode = Mode::free;
  const ReportScene alone = run_scene(built_in("jump_into_corner"), options);
  const ReportRun& in_lockstep = run_of(result, "octagon_sweep");
  const ReportRun& freely = run_of(alone, "octagon_sweep");
  ASSERT_EQ(in_lockstep.steps.size(), freely.steps.size());
  for (std::size_t i = 0; i < freely.steps.size(); ++i)
    EXPECT_EQ(in_lockstep.steps[i].path.back().position, freely.steps[i].path.back().position) << "step " << i;
  // And the twin begins every step no further from it than Box2D's skin, along two contacts at once at most.
  const ReportRun& beside = run_of(result, "box2d");
  for (std::size_t i = 0; i < freely.steps.size(); ++i) {
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
  EXPECT_EQ(failed.steps, 0);
  EXPECT_FALSE(failed.tunnels) << "what did not run has no numbers";
  EXPECT_EQ(row_of(result, "octagon_sweep").verdict, Verdict::holds) << "the others run on";
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

std::vector<nlohmann::json> lines_of(const std::string& path) {
  std::vector<nlohmann::json> lines;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) lines.push_back(nlohmann::json::parse(line));
  return lines;
}

::testing::AssertionResult reads_back(const nlohmann::json& read, double value) {
  const auto bits = [](double number) { return std::bit_cast<std::uint64_t>(number); };
  if (bits(read.get<double>()) == bits(value)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << read << " is not " << value;
}

void expect_same(const nlohmann::json& line, const TraceStep& step, const std::vector<std::string>& ids) {
  EXPECT_EQ(line.at("step"), step.step);
  ASSERT_EQ(line.at("path").size(), step.path.size());
  for (std::size_t i = 0; i < step.path.size(); ++i) {
    EXPECT_TRUE(reads_back(line["path"][i][0], step.path[i].position.x()));
    EXPECT_TRUE(reads_back(line["path"][i][1], step.path[i].position.y()));
    EXPECT_TRUE(reads_back(line["path"][i][2], step.path[i].fraction));
  }
  for (const int k : {0, 1}) {
    const auto at = static_cast<std::size_t>(k);
    EXPECT_TRUE(reads_back(line.at("velocity")[at], step.velocity[k]));
    EXPECT_TRUE(reads_back(line.at("requested")[at], step.requested[k]));
  }
  EXPECT_EQ(line.at("grounded"), step.grounded);
  ASSERT_EQ(line.at("contacts").size(), step.contacts.size());
  for (std::size_t i = 0; i < step.contacts.size(); ++i) {
    const nlohmann::json& contact = line["contacts"][i];
    EXPECT_EQ(contact.at("collider"), ids[step.contacts[i].collider]);
    EXPECT_TRUE(reads_back(contact.at("normal")[0], step.contacts[i].normal.x()));
    EXPECT_TRUE(reads_back(contact.at("point")[1], step.contacts[i].point.y()));
    EXPECT_TRUE(reads_back(contact.at("fraction"), step.contacts[i].fraction));
    EXPECT_TRUE(reads_back(contact.at("separation"), step.contacts[i].separation));
  }
}

TEST(Traces, read_back_to_the_same_bits) {
  const SceneFiles files;
  RunOptions options = quick();
  options.contenders = {"octagon_sweep", "speculative"};
  options.scalars = {ScalarKind::binary64, ScalarKind::binary32};
  options.max_replay_steps = 1000;
  options.trace_stem = files.path("t");
  const ReportScene result = run_scene(built_in("jump_into_overhang"), options);
  ASSERT_EQ(result.runs.size(), 5U);
  int contacts = 0;
  for (const ReportRun& run : result.runs) {
    const auto lines =
        lines_of(files.path("t.jump_into_overhang." + run.header.contender + "." + run.header.scalar + ".jsonl"));
    ASSERT_EQ(lines.size(), 1 + run.steps.size()) << run.header.contender;
    const nlohmann::json& header = lines[0];
    EXPECT_EQ(header.at("paperproof_trace"), 1);
    EXPECT_EQ(header.at("contender"), run.header.contender);
    EXPECT_TRUE(reads_back(header.at("dt"), run.header.dt));
    ASSERT_EQ(header.at("points").size(), run.header.points.size());
    for (std::size_t i = 0; i < run.header.points.size(); ++i)
      EXPECT_TRUE(reads_back(header["points"][i][0], run.header.points[i].x()));
    ASSERT_EQ(header.at("colliders").size(), run.header.ids.size());
    for (std::size_t i = 0; i < run.steps.size(); ++i) {
      expect_same(lines[i + 1], run.steps[i], run.header.ids);
      contacts += static_cast<int>(run.steps[i].contacts.size());
    }
  }
  EXPECT_GT(contacts, 100);
}

TEST(Traces, mark_the_sampled_path_of_box2d) {
  const SceneFiles files;
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  options.trace_stem = files.path("t");
  (void)run_scene(built_in("article_bullet"), options);
  for (const nlohmann::json& line : lines_of(files.path("t.article_bullet.box2d.float.jsonl")))
    EXPECT_EQ(line.contains("path_exact"), line.contains("step")) << line;
  for (const nlohmann::json& line : lines_of(files.path("t.article_bullet.octagon_sweep.double.jsonl")))
    EXPECT_FALSE(line.contains("path_exact"));
}

TEST(Traces, hold_every_moving_collider_crushes_and_sensor_events_by_their_ids) {
  const SceneFiles files;
  TraceHeader header;
  header.scenery.colliders = {{.points = {{0, 0}, {1, 0}, {0, 1}}},
                              {.points = {{0, 0}, {1, 0}, {0, 1}}, .mover = 1},
                              {.points = {{0, 0}, {1, 0}, {0, 1}}, .mover = 0, .surface_speed = -2},
                              {.points = {{0, 0}, {1, 0}, {0, 1}}, .mover = 1},
                              {.points = {{0, 0}, {1, 0}, {0, 1}}, .sensor = true}};
  header.ids = {"floor", "saw/0", "belt", "saw/1", "zone"};
  TraceStep step;
  step.path = {{{0, 0}, 0}, {{0, 0}, 1}};
  step.movers = {{{0.1, -0.0}, {0.2, 1e-300}}, {{3, 4}, {5, 6}}};
  step.crushed = {2, 3};
  using Change = SensorEvent<double>::Change;
  step.sensors = {{4, Change::enter, 0.25}, {4, Change::exit, 1 / 3.0}};
  TraceWriter writer(files.path("t.jsonl"), header);
  writer.write(step);
  step.crushed.clear();
  step.sensors.clear();
  writer.write(step);
  writer.commit();

  const auto lines = lines_of(files.path("t.jsonl"));
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0]["colliders"][4].at("sensor"), true);
  EXPECT_FALSE(lines[0]["colliders"][0].contains("sensor"));
  EXPECT_EQ(lines[0]["colliders"][2].at("surface_speed"), -2);
  const nlohmann::json& movers = lines[1].at("movers");
  ASSERT_EQ(movers.size(), 3U);
  EXPECT_TRUE(reads_back(movers["belt"][0][0], 0.1) && reads_back(movers["belt"][0][1], -0.0));
  EXPECT_TRUE(reads_back(movers["belt"][1][0], 0.2) && reads_back(movers["belt"][1][1], 1e-300));
  for (const char* part : {"saw/0", "saw/1"}) EXPECT_EQ(movers.at(part), nlohmann::json::parse("[[3,4],[5,6]]"));
  EXPECT_EQ(lines[1].at("crush"), nlohmann::json::parse(R"(["belt","saw/1"])"));
  EXPECT_EQ(lines[1].at("sensors")[0], nlohmann::json::parse(R"({"id":"zone","change":"enter","fraction":0.25})"));
  EXPECT_EQ(lines[1].at("sensors")[1].at("change"), "exit");
  EXPECT_TRUE(reads_back(lines[1]["sensors"][1]["fraction"], 1 / 3.0));
  EXPECT_EQ(lines[2].at("movers"), movers);
  EXPECT_FALSE(lines[2].contains("crush") || lines[2].contains("sensors"));
}

TEST(Traces, that_cannot_be_written_end_the_run) {
  const SceneFiles files;
  RunOptions options = quick();
  options.trace_stem = files.path("no_such_folder/t");
  EXPECT_THROW((void)run_scene(built_in("article_bullet"), options), std::runtime_error);
}

TEST(RowsJson, lacks_what_does_not_apply) {
  Row row;
  row.scene = "s";
  row.contender = "c";
  row.tunnels = 0;
  const nlohmann::json sparse = nlohmann::json::parse(rows_json({row}).dump());
  EXPECT_EQ(sparse.at("paperproof_rows"), 1);
  EXPECT_TRUE(sparse.at("environment").contains("compiler"));
  const nlohmann::json expected{{"scene", "s"}, {"contender", "c"},   {"scalar", "double"}, {"mode", "free"},
                                {"steps", 0},   {"verdict", "holds"}, {"tunnels", 0}};
  EXPECT_EQ(sparse.at("rows").at(0), expected);

  row.verdict = Verdict::not_applicable;
  row.reason = "no slopes";
  row.max_contact_gap_m = 5e-7;
  row.rest_peak_to_peak_m = 0;
  const nlohmann::json more = nlohmann::json::parse(rows_json({row}).dump()).at("rows").at(0);
  EXPECT_EQ(more.at("verdict"), "not_applicable");
  EXPECT_EQ(more.at("reason"), "no slopes");
  EXPECT_TRUE(reads_back(more.at("max_contact_gap_m"), 5e-7));
  EXPECT_EQ(more.at("rest_peak_to_peak_m"), 0) << "zero is a result";
}

TEST(RowsJson, of_a_run_has_no_rest_where_nothing_rests_and_no_time_where_none_was_taken) {
  RunOptions options = quick();
  options.contenders = {"octagon_sweep"};
  const ReportScene flying = run_scene(empty_sky(50), options);
  for (const Row& row : flying.rows) {
    const nlohmann::json object = nlohmann::json::parse(rows_json({row}).dump()).at("rows").at(0);
    for (const char* key : {"rest_peak_to_peak_m", "contact_toggles", "ns_per_step", "first_contact_fraction",
                            "contact_precision", "max_contact_gap_m", "reason"})
      EXPECT_FALSE(object.contains(key)) << row.contender << " " << key;
    EXPECT_EQ(object.at("tunnels"), 0);
  }
  const nlohmann::json written = nlohmann::json::parse(rows_json(flying.rows).dump());
  for (const auto& [key, value] : written.at("rows").at(0).items()) EXPECT_FALSE(value.is_null()) << key;
}

TEST(Table, leaves_out_columns_that_no_row_has) {
  Row first;
  first.contender = "first";
  first.tunnels = 3;
  Row second;
  second.contender = "second";
  second.verdict = Verdict::failed;
  std::string text = table({first, second});
  EXPECT_TRUE(holds(text, "tunnels"));
  EXPECT_TRUE(holds(text, "failed"));
  EXPECT_EQ(text.find("rest"), std::string::npos);
  EXPECT_EQ(text.find("ns/step"), std::string::npos);
  second.rest_peak_to_peak_m = 0;
  text = table({first, second});
  EXPECT_TRUE(holds(text, "rest"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << "a heading and two rows:\n" << text;
}

TEST(OutputFile, appears_whole_or_not_at_all) {
  const SceneFiles files;
  const std::string path = files.write("out.json", "before");
  {
    OutputFile dropped(path);
    dropped.stream() << "half";
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(files.path("")), {}), 1) << "nothing is left beside it";
  std::string text;
  std::getline(std::ifstream(path), text);
  EXPECT_EQ(text, "before");
  OutputFile written(path);
  written.stream() << "whole";
  written.commit();
  std::getline(std::ifstream(path), text);
  EXPECT_EQ(text, "whole");
}

}  // namespace
}  // namespace paperproof::compare
