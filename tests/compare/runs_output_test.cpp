/// What a run leaves behind: traces, rows as JSON, tables, files.
#include "compare/same_steps.hpp"
#include "compare/scene_runs.hpp"
#include "records/commit.hpp"
#include "records/output_file.hpp"
#include "records/rows_json.hpp"
#include "records/trace_reader.hpp"
#include "records/trace_writer.hpp"
#include "runs/environment.hpp"
#include "runs/table.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

/// The reader refuses what the schema refuses, and check_trace.py reads what the schema says.
TEST(Traces, read_back_to_the_same_bits) {
  const SceneFiles files;
  RunOptions options = quick();
  options.contenders = {"octagon_sweep", "speculative"};
  options.scalars = {ScalarKind::binary64, ScalarKind::binary32};
  options.max_replay_steps = 1000;
  options.trace_stem = files.path("t");
  const ReportScene result = run_scene(built_in("jump_into_overhang"), options);
  ASSERT_EQ(result.runs.size(), 5U);
  std::size_t contacts = 0;
  for (const ReportRun& run : result.runs) {
    TraceReader reader(files.path("t.jump_into_overhang." + run.header.contender + "." + run.header.scalar + ".jsonl"));
    EXPECT_EQ(reader.header().contender, run.header.contender);
    EXPECT_EQ(reader.header().points, run.header.points);
    EXPECT_EQ(reader.header().ids, run.header.ids);
    EXPECT_EQ(reader.header().dt, run.header.dt);
    EXPECT_EQ(reader.header().box2d.empty(), !is_reference(run.header.contender));
    for (const TraceStep& step : run.steps) {
      const std::optional<TraceStep> read = reader.next();
      ASSERT_TRUE(read && same_step(*read, step)) << run.header.contender << ", step " << step.step;
      contacts += step.contacts.size();
    }
    EXPECT_FALSE(reader.next());
    EXPECT_EQ(reader.header().path_exact, !is_reference(run.header.contender));
  }
  EXPECT_GT(contacts, 100U);
}

TEST(Traces, hold_every_moving_collider_crushes_and_sensor_events_by_their_ids) {
  const SceneFiles files;
  const auto triangle = [](MoverIndex mover) {
    return ColliderDef{.points = {{0, 0}, {1, 0}, {0, 1}}, .mover = mover};
  };
  TraceHeader header;
  header.scenery.colliders = {triangle(no_mover), triangle(1), triangle(0), triangle(1), triangle(no_mover)};
  header.scenery.colliders[2].surface_speed = -2;
  header.scenery.colliders[4].sensor = true;
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
  const nlohmann::json movers =
      nlohmann::json::parse(R"({"belt":[[0.1,-0.0],[0.2,1e-300]],"saw/0":[[3,4],[5,6]],"saw/1":[[3,4],[5,6]]})");
  EXPECT_EQ(lines[1].at("movers"), movers);
  EXPECT_TRUE(reads_back(lines[1]["movers"]["belt"][0][1], -0.0));
  EXPECT_EQ(lines[1].at("crush"), nlohmann::json::parse(R"(["belt","saw/1"])"));
  EXPECT_EQ(lines[1].at("sensors")[0], nlohmann::json::parse(R"({"id":"zone","change":"enter","fraction":0.25})"));
  EXPECT_EQ(lines[1].at("sensors")[1].at("change"), "exit");
  EXPECT_TRUE(reads_back(lines[1]["sensors"][1]["fraction"], 1 / 3.0));
  EXPECT_EQ(lines[2].at("movers"), movers);
  EXPECT_FALSE(lines[2].contains("crush") || lines[2].contains("sensors"));
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

TEST(Table, leaves_out_columns_that_no_row_has) {
  std::vector<Row> rows(2);
  rows[0].contender = "first";
  rows[0].tunnels = 3;
  rows[0].max_penetration_m = 0;
  rows[1].contender = "second";
  rows[1].verdict = Verdict::failed;
  const std::string few = table(rows);
  for (const char* here : {"tunnels", "failed"}) EXPECT_TRUE(holds(few, here));
  for (const char* nowhere : {"rest", "ns/step", "depth", "memory"}) EXPECT_FALSE(holds(few, nowhere)) << nowhere;
  rows[1].rest_peak_to_peak_m = 0;
  rows[1].max_penetration_m = 0.25;
  const std::string more = table(rows);
  for (const char* here : {"rest", "depth"}) EXPECT_TRUE(holds(more, here));
  EXPECT_EQ(std::count(more.begin(), more.end(), '\n'), 3) << "a heading and two rows:\n" << more;
}

TEST(Table, has_a_column_for_memory_where_a_row_has_any) {
  std::vector<Row> rows(4);
  rows[1].memory_bytes = 640;
  rows[2].memory_bytes = 12'345;
  rows[3].memory_bytes = 67'108'864;
  for (const char* wanted : {"memory", " 640 B\n", " 12.3 kB\n", " 67.1 MB\n", " -\n"})
    EXPECT_TRUE(holds(table(rows), wanted));
  RunOptions options = quick();
  options.contenders = {"mask", "octagon_sweep"};
  // A square of 32 px and a sprite of 20 x 40, with the border pixel of their boxes one word wide: 33 + 41 rows.
  EXPECT_TRUE(holds(table(run_scene(empty_sky(5), options).rows), "592 B"));
}

std::string first_line(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

TEST(OutputFile, keeps_a_link_and_what_it_points_to) {
  const SceneFiles files;
  const std::string real = files.write("real.json", "before");
  std::filesystem::create_symlink(real, files.path("link.json"));
  OutputFile file(files.path("link.json"));
  file.write("after");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(files.path("link.json")));
  EXPECT_EQ(first_line(real), "after");
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
  EXPECT_EQ(first_line(path), "before");
  OutputFile written(path);
  written.write("whole");
  written.commit();
  EXPECT_EQ(first_line(path), "whole");
}

}  // namespace
}  // namespace paperproof::compare
