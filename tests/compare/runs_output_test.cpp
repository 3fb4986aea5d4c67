/// What a run leaves behind: traces, rows as JSON, tables, files.
#include "compare/scene_runs.hpp"
#include "records/commit.hpp"
#include "records/output_file.hpp"
#include "records/rows_json.hpp"
#include "records/trace_writer.hpp"
#include "runs/environment.hpp"
#include "runs/table.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

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
  EXPECT_TRUE(lines_of(files.path("t.article_bullet.box2d.float.jsonl")).front().contains("box2d"));
  EXPECT_FALSE(lines_of(files.path("t.article_bullet.octagon_sweep.double.jsonl")).front().contains("box2d"));
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

TEST(Traces, say_where_a_character_is_drawn_between_two_squares) {
  const SceneFiles files;
  Scene scene = empty_sky(64);
  scene.gravity = {0, 0};
  scene.dt = 1.0 / 64;
  scene.start.position = {0.5, 0.625};
  scene.start.velocity = {4, 0};
  RunOptions options = quick();
  options.contenders = {"grid", "speculative"};
  options.reference = false;
  options.trace_stem = files.path("t");
  EXPECT_EQ(run_scene(scene, options).rows.size(), 2U);
  const auto grid = lines_of(files.path("t.sky.grid.double.jsonl"));
  const auto other = lines_of(files.path("t.sky.speculative.double.jsonl"));
  ASSERT_EQ(grid.size(), 65U);
  int between = 0;
  for (std::size_t i = 1; i < grid.size(); ++i) {
    EXPECT_FALSE(other[i].contains("remainder")) << "it is drawn where it is";
    const double end = grid[i].at("path").back()[0];
    EXPECT_EQ(end - 0.5, std::floor(end)) << "the middle of a square";
    const bool drawn_elsewhere = grid[i].contains("remainder");
    const double drawn = end + (drawn_elsewhere ? grid[i]["remainder"][0].get<double>() : 0);
    EXPECT_EQ(drawn, 0.5 + static_cast<double>(i) / 16) << "a sixteenth of a metre per step";
    EXPECT_EQ(drawn_elsewhere, i % 16 != 0);
    between += drawn_elsewhere ? 1 : 0;
  }
  EXPECT_EQ(between, 60);
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
  const nlohmann::json sparse = nlohmann::json::parse(rows_json({row}, environment()).dump());
  EXPECT_EQ(sparse.at("paperproof_rows"), 1);
  for (const char* key : {"compiler", "box2d", "box2d_build", "box2d_asserts"})
    EXPECT_TRUE(sparse.at("environment").contains(key)) << key;
  nlohmann::json expected{{"scene", "s"}, {"contender", "c"},   {"scalar", "double"}, {"mode", "free"},
                          {"steps", 0},   {"verdict", "holds"}, {"tunnels", 0}};
  if (!built_commit().empty()) expected["commit"] = built_commit();
  EXPECT_EQ(sparse.at("rows").at(0), expected);

  row.verdict = Verdict::not_applicable;
  row.reason = "no slopes";
  row.max_contact_gap_m = 5e-7;
  row.rest_peak_to_peak_m = 0;
  const nlohmann::json more = nlohmann::json::parse(rows_json({row}, {}).dump()).at("rows").at(0);
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
    const nlohmann::json object = nlohmann::json::parse(rows_json({row}, {}).dump()).at("rows").at(0);
    for (const char* key : {"rest_peak_to_peak_m", "contact_toggles", "ns_per_step", "first_contact_fraction",
                            "contact_precision", "max_contact_gap_m", "reason"})
      EXPECT_FALSE(object.contains(key)) << row.contender << " " << key;
    EXPECT_EQ(object.at("tunnels"), 0);
  }
  const nlohmann::json written = nlohmann::json::parse(rows_json(flying.rows, environment()).dump());
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

TEST(Table, leaves_out_a_depth_that_nobody_has) {
  Row row;
  row.contender = "one";
  row.max_penetration_m = 0;
  EXPECT_EQ(table({row}).find("depth"), std::string::npos);
  Row other = row;
  other.max_penetration_m = 0.25;
  EXPECT_TRUE(holds(table({row, other}), "depth"));
}

TEST(Table, has_a_column_for_memory_where_a_row_has_any) {
  std::vector<Row> rows(4);
  EXPECT_EQ(table(rows).find("memory"), std::string::npos);
  rows[1].memory_bytes = 640;
  rows[2].memory_bytes = 12'345;
  rows[3].memory_bytes = 67'108'864;
  const std::string text = table(rows);
  for (const char* wanted : {"memory", " 640 B\n", " 12.3 kB\n", " 67.1 MB\n", " -\n"})
    EXPECT_TRUE(holds(text, wanted));
  RunOptions options = quick();
  options.contenders = {"mask", "octagon_sweep"};
  // A square of 32 px and a sprite of 20 x 40, with the border pixel of their boxes one word wide: 33 + 41 rows.
  EXPECT_TRUE(holds(table(run_scene(empty_sky(5), options).rows), "592 B"));
}

TEST(OutputFile, keeps_a_link_and_what_it_points_to) {
  const SceneFiles files;
  const std::string real = files.write("real.json", "before");
  std::filesystem::create_symlink(real, files.path("link.json"));
  OutputFile file(files.path("link.json"));
  file.write("after");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(files.path("link.json")));
  std::string text;
  std::getline(std::ifstream(real), text);
  EXPECT_EQ(text, "after");
}

TEST(OutputFile, is_refused_where_a_directory_is) {
  const SceneFiles files;
  EXPECT_THROW(OutputFile file(files.path("")), std::runtime_error);
  EXPECT_NO_THROW(OutputFile("/dev/null").commit());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null")) << "it was replaced";
}

TEST(OutputFile, appears_whole_or_not_at_all) {
  const SceneFiles files;
  const std::string path = files.write("out.json", "before");
  {
    OutputFile dropped(path);
    dropped.write("half");
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(files.path("")), {}), 1) << "nothing is left beside it";
  std::string text;
  std::getline(std::ifstream(path), text);
  EXPECT_EQ(text, "before");
  OutputFile written(path);
  written.write("whole");
  written.commit();
  std::getline(std::ifstream(path), text);
  EXPECT_EQ(text, "whole");
}

}  // namespace
}  // namespace paperproof::compare
