/// What a run leaves behind: traces and files.
#include "compare/scene_runs.hpp"
#include "records/output_file.hpp"
#include "records/trace_reader.hpp"
#include "records/trace_writer.hpp"
#include "scenes/input_error.hpp"

#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

/// trace_of_everything.jsonl has every key that there is, with a value that is not the usual one.
TEST(Traces, are_written_as_they_were_read) {
  const std::string path = PAPERPROOF_SOURCE_DIR "/tests/compare/trace_of_everything.jsonl";
  TraceReader reader(path);
  std::vector<TraceStep> steps;
  while (std::optional<TraceStep> step = reader.next()) steps.push_back(*std::move(step));
  const TraceLines lines(reader.header());
  std::string written = lines.header_line(reader.header(), colliders_in_json(reader.header()));
  for (const TraceStep& step : steps) written += lines.line_of(step);
  EXPECT_EQ(written, read_file(path, path));
  const std::string schema_path = PAPERPROOF_SOURCE_DIR "/compare/records/paperproof_trace.schema.json";
  const auto schema = nlohmann::json::parse(read_file(schema_path, schema_path));
  for (const char* part : {"header", "step", "ride"})
    for (const auto& [key, asked] : schema["$defs"][part]["properties"].items())
      EXPECT_TRUE(holds(written, '"' + key + "\":")) << key;
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
