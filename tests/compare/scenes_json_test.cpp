/// Scenes as JSON: read, refused (tables/json_scenes.json), written.
#include "scenes/write_json.hpp"

#include "compare/table.hpp"
#include "scenes/describe.hpp"
#include "scenes/input_error.hpp"

namespace paperproof::compare {
namespace {

using nlohmann::json;

/// One of everything.
const std::string full = read_file(PAPERPROOF_SOURCE_DIR "/tests/compare/one_of_everything.json", "");

const bool table = table_tests("json_scenes.json", keys_of_scene_files, check_scene_file_alone);

TEST(JsonScene, every_key_arrives_and_is_written_as_it_was_read) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", full);
  EXPECT_EQ(json(scene_json(scene)), json::parse(full));
  EXPECT_EQ(scene.ids, (std::vector<std::string>{"paper", "wall", "ledge", "ring", "disc", "gate", "lift", "saw",
                                                 "plank", "crate"}));
  const std::vector<ColliderDef>& colliders = scene.scenery.colliders;
  for (std::size_t i = 0; i < colliders.size(); ++i)
    EXPECT_EQ(colliders[i].mover, i < 6 ? no_mover : static_cast<MoverIndex>(i - 6)) << scene.ids[i];
  // The sprite is 2 x 3 px: the centre is (1, 1.5), y turns over, 4 px are 1 m.
  const auto points = scene.character.shape.points();
  EXPECT_EQ(std::vector(points.begin(), points.end()),
            (std::vector<Vec2d>{{-0.25, 0.375}, {0.25, 0.375}, {0, -0.375}}));
  EXPECT_EQ(scene.joints[0].body, 0U + 2U) << "bodies are movers after those with paths";
  EXPECT_EQ(scene.joints[0].other, no_mover);
  EXPECT_EQ(scene.joints[3].other, 2U);
  EXPECT_EQ(offset_at(scene.movers[3], 7), Vec2d(0, 0));
  EXPECT_FALSE(scene.respawn_box.has_value());
  const Scene timed = files.load("timed.json", with(full, "\"steps\"", "\"dt_list\": [0.01, 0.02], \"steps\""));
  EXPECT_EQ(timed.dt_list, (std::vector<double>{0.01, 0.02}));
  EXPECT_EQ(timed.dt, 1.0 / 128);
  EXPECT_EQ(scene_json(timed)["dt_list"].dump(), "[0.01,0.02]");
  const std::string text = describe(scene);
  for (const char* part :
       {"left: plank to the ground, a spring of 2 m, 1000 N/m, 8 N s/m", "rod: plank to crate, a rod of 1.5 m",
        "rail: plank to the ground, a rail along (0, 1)", "pin: crate to plank, a pin at (52.5, 2)"})
    EXPECT_TRUE(holds(text, part));
}

TEST(JsonScene, characters_do_as_the_scene_unless_they_have_an_input_of_their_own) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", with(full, R"(, "input": [{ "step": 3, "move": -1 }])", ""));
  const Script script = script_of(scene);
  ASSERT_EQ(script.size(), 3U);
  EXPECT_EQ(script[1], scene.input);
  EXPECT_EQ(script[2], (std::vector<InputEvent>{{.step = 5, .move = {}, .jump = true}}));
  const Script random = random_script(scene, 5, 600);
  EXPECT_EQ(random[0], random_input(5, 600));
  EXPECT_NE(random[1], random[2]);
}

TEST(JsonFile, with_bytes_that_are_no_text_is_refused_in_plain_letters) {
  const std::string bytes = SceneFiles().complaint("a.json", "{\"name\": \"\xff\xfe\"}");
  EXPECT_TRUE(begins(bytes, ":1:"));
  EXPECT_TRUE(std::all_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c < 0x80; })) << bytes;
}

TEST(JsonJoints, grow_and_shift_with_the_scene_and_are_written_there) {
  const SceneFiles files;
  const std::string path = files.write("room.json", full);
  const Scene large = load_scene(path, std::vector<ParameterSetting>{{"scale", 2}});
  EXPECT_EQ(large.joints[0].point, Vec2d(97, 4));
  EXPECT_EQ(large.joints[0].length, 4);
  EXPECT_EQ(large.joints[0].stiffness, 1000) << "forces grow as lengths do";
  const Scene shifted = load_scene(path, std::vector<ParameterSetting>{{"origin", 10.25}});
  EXPECT_EQ(shifted.joints[0].end, Vec2d(58.75, 0));
  EXPECT_EQ(shifted.joints[2].axis, Vec2d(0, 1));
  for (const Scene& scene : {large, shifted})
    EXPECT_EQ(scene_json(files.load("written.json", scene_json(scene).dump())).dump(), scene_json(scene).dump());
}

/// Written, read, and written again.
TEST(WrittenScenes, read_back_as_they_were) {
  for (const BuiltInScene& entry : built_in_scenes()) {
    const SceneFiles files;
    const Scene scene = load_scene(entry.name, {});
    const nlohmann::ordered_json written = scene_json(scene);
    const Scene read = files.load("scene.json", written.dump());
    EXPECT_EQ(scene_json(read).dump(), written.dump()) << entry.name;
    EXPECT_TRUE(std::equal(read.character.shape.points().begin(), read.character.shape.points().end(),
                           scene.character.shape.points().begin()))
        << entry.name;
  }
}

}  // namespace
}  // namespace paperproof::compare
