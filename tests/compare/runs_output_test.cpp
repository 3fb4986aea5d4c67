/// What a run leaves behind: traces and files.
#include "compare/same_steps.hpp"
#include "compare/scene_runs.hpp"
#include "records/output_file.hpp"
#include "records/trace_reader.hpp"

namespace paperproof::compare {
namespace {

/// The reader refuses what the schema refuses, and check_trace.py reads what the schema says.
TEST(Traces, read_back_to_the_same_bits) {
  const SceneFiles files;
  RunOptions options = quick({"octagon_sweep", "speculative"}, 1000);
  options.scalars = {ScalarKind::binary64, ScalarKind::binary32};
  options.trace_stem = files.path("t");
  std::size_t contacts = 0;
  std::size_t sensors = 0;
  std::size_t crushes = 0;
  std::size_t turns = 0;
  for (const std::string scene : {"jump_into_overhang", "closing_ceiling", "sensor_gate", "conveyor", "turning_arm"}) {
    const ReportScene result = run_scene(built_in(scene), options);
    ASSERT_EQ(result.runs.size(), scene == "turning_arm" ? 2U : 4U) << "float is of octagon_sweep alone";
    for (const ReportRun& run : result.runs) {
      TraceReader reader(files.path("t." + scene + "." + run.header.contender + "." + run.header.scalar + ".jsonl"));
      const TraceHeader& read = reader.header();
      EXPECT_TRUE(read.contender == run.header.contender && read.ids == run.header.ids && read.dt == run.header.dt);
      EXPECT_EQ(read.points, run.header.points);
      EXPECT_EQ(read.box2d.empty(), !is_reference(run.header.contender));
      for (std::size_t i = 0; i < read.ids.size(); ++i) {
        EXPECT_EQ(read.scenery.colliders[i].sensor, run.header.scenery.colliders[i].sensor) << read.ids[i];
        EXPECT_EQ(read.scenery.colliders[i].surface_speed, run.header.scenery.colliders[i].surface_speed);
      }
      for (const TraceStep& step : run.steps) {
        const std::optional<TraceStep> back = reader.next();
        ASSERT_TRUE(back && same_step(*back, step)) << scene << " " << read.contender << ", step " << step.step;
        contacts += step.contacts.size();
        sensors += step.sensors.size();
        crushes += step.crushed.size();
        turns += step.vertex_ways.size();
      }
      EXPECT_FALSE(reader.next());
      EXPECT_EQ(read.path_exact, !is_reference(run.header.contender));
    }
  }
  EXPECT_GT(contacts, 100U);
  EXPECT_TRUE(sensors > 0 && crushes > 0 && turns > 0);
}

TEST(OutputFile, keeps_a_link_and_what_it_points_to) {
  const SceneFiles files;
  const std::string real = files.write("real.json", "before");
  std::filesystem::create_symlink(real, files.path("link.json"));
  OutputFile file(files.path("link.json"));
  file.write("after");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(files.path("link.json")));
  std::string line;
  std::getline(std::ifstream(real) >> std::ws, line);
  EXPECT_EQ(line, "after");
}

}  // namespace
}  // namespace paperproof::compare
