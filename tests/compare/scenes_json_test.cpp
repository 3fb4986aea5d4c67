/// Scenes as JSON: read, refused, written.
#include "scenes/write_json.hpp"

#include "compare/scene_files.hpp"
#include "scenes/describe.hpp"
#include "scenes/input_error.hpp"

#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

using JsonScene = SceneFilesTest;

using nlohmann::json;

/// One of everything.
const std::string full = read_file(PAPERPROOF_SOURCE_DIR "/tests/compare/one_of_everything.json", "");

const std::string least = R"({ "paperproof_scene": 1, "name": "void", "gravity": [0, 0], "dt": 1, "steps": 1,
  "character": { "position": [0, 0] }, "scenery": [ { "chain": [[5,0],[5,4]] } ] })";

TEST_F(JsonScene, every_key_arrives_and_is_written_as_it_was_read) {
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

TEST_F(JsonScene, what_is_left_out_has_the_defaults_of_the_types) {
  const Scene scene = files.load("least.json", least);
  const CharacterDef defaults;
  EXPECT_EQ(scene.pixels_per_metre, 32);
  EXPECT_EQ(scene.ids, std::vector<std::string>{"scenery/0"}) << "where the entry stands";
  EXPECT_EQ(scene.character.walk_speed, defaults.walk_speed);
  EXPECT_EQ(scene.character.jump_speed, defaults.jump_speed);
  EXPECT_EQ(scene.character.acceleration, defaults.acceleration);
  EXPECT_EQ(scene.character.max_climb_degrees, defaults.max_climb_degrees);
  EXPECT_FALSE(scene.character.max_fall_speed || scene.start.resolve_overlap || !scene.dt_list.empty());
  const Scene joined = files.load("joined.json", with(with(full, "\"id\": \"left\", ", ""), "\"length\": 2, ", ""));
  EXPECT_EQ(joined.joints[0].id, "joints/0");
  EXPECT_EQ(joined.joints[0].length, 2) << "as far as the points are apart";
}

TEST_F(JsonScene, characters_do_as_the_scene_unless_they_have_an_input_of_their_own) {
  const Scene scene = files.load("room.json", with(full, R"(, "input": [{ "step": 3, "move": -1 }])", ""));
  const Script script = script_of(scene);
  ASSERT_EQ(script.size(), 3U);
  EXPECT_EQ(script[1], scene.input);
  EXPECT_EQ(script[2], (std::vector<InputEvent>{{.step = 5, .move = {}, .jump = true}}));
  const Script random = random_script(scene, 5, 600);
  EXPECT_EQ(random[0], random_input(5, 600));
  EXPECT_NE(random[1], random[2]);
}

TEST_F(JsonScene, empty_scenery_is_fine_when_it_is_said_to_be) {
  const std::string empty = with(least, R"({ "chain": [[5,0],[5,4]] })", "");
  EXPECT_EQ(files.load("void.json", with(empty, "\"scenery\"", "\"empty\": true, \"scenery\"")).ids.size(), 0U);
  expect_refused("void.json", empty,
                 {{"'dt'", "'dt'", ": /scenery: expected at least one solid, or 'empty': true beside it"}});
}

TEST_F(JsonScene, a_start_touches_a_solid_and_is_an_ulp_inside_only_where_it_is_to_be_resolved) {
  // The paper is 0.25 m thick, and the feet are 0.375 m below the middle.
  const std::string inside = with(full, "[0, 3]", "[0, 0.62499999999999989]");
  EXPECT_EQ(files.load("room.json", with(full, "[0, 3]", "[0, 0.625]")).start.position.y(), 0.625);
  EXPECT_EQ(files.complaint("room.json", inside),
            ": /character/position: expected a start outside of every solid, but the character overlaps \"paper\"; "
            "\"start_overlap\": \"resolve\" beside it asks to move it out");
  EXPECT_TRUE(files.load("room.json", with(inside, "\"snap\"", "\"start_overlap\": \"resolve\", \"snap\""))
                  .start.resolve_overlap);
}

TEST_F(JsonScene, motion_of_a_million_metres_in_a_step_is_the_most) {
  // dt is 1/128 s, so 1e6 m in a step are 1.28e8 m/s.
  EXPECT_EQ(files.load("room.json", with(full, "[0, -40]", "[0, -1.28e8]")).start.velocity.y(), -1.28e8);
  expect_refused("room.json", full,
                 {{"[0, -40]", "[0, -1.2800001e8]", ": /character/velocity: expected at most 1e6 m of motion"}});
}

constexpr std::string_view wall = "'chain': [[5,0],[5,4]]";
const std::string overlaps =
    ": /character/position: expected a start outside of every solid, but the character overlaps ";
constexpr std::string_view paper = "[[-4,0],[4,0],[4,0.25],[-4,0.25]]";

/// What the schema says itself is asked for here only now and then: schema_test.cpp has its keywords.
TEST_F(JsonScene, is_refused_in_one_line_with_its_place) {
  expect_refused(
      "room.json", full,
      {
          {"'steps'", "'stepz'", ": /stepz: unknown key; did you mean steps?"},
          {"'velocity'", "'speed'", ": /character/speed: unknown key; did you mean walk_speed, jump_speed or "},
          {"'holes'", "'hole'", ": /scenery/3/hole: unknown key"},
          {"'dt'", "+'name': 'b'", ": /name: expected each key once"},
          {"'dt': 0.0078125, ", "", ": /dt: expected this key, which is missing"},
          {"'position': [0, 3], ", "", ": /character/position: expected this key"},
          {"_scene': 1", "_scene': 2", ": /paperproof_scene: expected 1"},
          {"'steps': 120,", "'steps': 120",
           ":4:13: expected JSON; syntax error while parsing object - unexpected string "},
          {"0.0078125", "1e999", ": /dt: expected a finite number, not "},
          {"0.0078125", "NaN", ":3:30: expected JSON; "},
          {"0.0078125", "0", ": /dt: expected more than 0, at most 10000, not 0"},
          {"'dt'", "+'dt_list': [0.1, 1e3]", ": /gravity: expected at most 1e6 m of motion in a step of 1000 s"},
          {"[0, -30]", "[0, -1e300]", ": /gravity: expected at most 1e6 m of motion"},
          {"'walk_speed': 1", "'walk_speed': 2e8", ": /character/walk_speed: expected at most 1e6 m of motion"},
          {"'jump_speed': 4", "'jump_speed': 2e8", ": /character/jump_speed: expected at most 1e6 m of motion"},
          {"'room'", "''", ": /name: expected a text"},
          {"[1,3]]", "[1,1],[1,3]]", ": /character/points_px: "},
          {"['##', '##', '.#']", "['##']", ": /character/sprite: expected 3 rows, as high as the character, not 1"},
          {"'.#'", "'.?'", ": /character/sprite/2: expected pixels from . and #, not '.?'"},
          {"'##', '##', '.#'", "'..', '..', '..'", ": /character/sprite: expected a pixel that collides, #"},
          {"'wall'", "'paper'", ": /scenery/1/id: expected an id of its own; 'paper' is taken"},
          {"'lift'", "'paper'", ": /movers/0/id: expected an id of its own"},
          {"'crate'", "'lift'", ": /bodies/1/id: expected an id of its own; 'lift' is taken"},
          {"'pin'", "'crate'", ": /joints/3/id: expected an id of its own; 'crate' is taken"},
          {wall, "+'polygon': []", ": /scenery/1: expected exactly one of polygon, chain, circle, tiled, picture, "},
          {wall, "'one_way': [0, 1]", ": /scenery/1: expected exactly one of polygon, chain, circle, tiled, picture, "},
          {"[30, 0, 2]", "[5, 0, 0]", ": /scenery/4/circle: 'disc': the radius of a circle must be above 0"},
          {"'circle'", "+'one_way': [0, 1]",
           ": /scenery/4/one_way: unknown key; expected one of id, circle, sensor or "},
          {wall, "+'holes': []", ": /scenery/1/holes: unknown key; expected one of id, chain, one_way, sensor "},
          {paper, "[[-4,0],[4,0],[-4,1],[4,1]]", ": /scenery/0/polygon: 'paper': "},
          {"[[5,0],[5,4]]", "[[5,0],[5,4e6]]", ": /scenery/1/chain: 'wall': "},
          {"[12,2],[18,2],[18,8],[12,8]", "[32,2],[38,2],[38,8]", ": /scenery/3/polygon: 'ring': "},
          {"'one_way': [0, 1]", "'one_way': [0, 0]", ": /scenery/2/chain: 'ledge': "},
          {"'holes': [[[12,2],[18,2],[18,8],[12,8]]]", "'one_way': [0, 0]", ": /scenery/3/polygon: 'ring': "},
          {"'one_way'", "+'sensor': true", ": /scenery/2/chain: 'ledge': "},
          {"'sensor'", "+'surface_speed': 1", ": /scenery/5/surface_speed: expected only beside what blocks"},
          {"'surface_speed': -2", "'surface_speed': -1.3e8", ": /scenery/3/surface_speed: expected at most 1e6 m"},
          {"'decoration'", "+" + std::string(wall),
           ": /scenery/6: expected exactly one of polygon, chain, circle, tiled, picture, "},
          {"[[0,9],[1,9],[1,8]]", "[[0,9],[1,9],[2,9]]", ": /scenery/6/decoration: "},
          {wall, "'picture': 'a.png'", ": /scenery/1/picture: a.png: expected a file that exists"},
          {wall, "'tiled': 'none.tmx'", ": /scenery/1/tiled: none.tmx: expected a file that exists"},
          {wall, "'sensor': true, 'picture': 'a'",
           ": /scenery/1/sensor: unknown key; expected one of id, picture, solid or "},
          {"[[0,0],[2,0],[2,0.25]", "[[0,0],[2,0],[0,1],[2,1]", ": /movers/0/polygon: 'lift': "},
          {"'t': 2", "'t': 0", ": /movers/0/path/1/t: expected a time after the one before"},
          {"'t': 1.5", "'t': 0.5", ": /movers/0/angle/1/t: expected a time after the one before"},
          {"'ping_pong'", "'loop'", ": /movers/0/path/1/at: expected the place where the path begins"},
          {"'step': 44", "'step': 39", ": /input/2/step: expected events in the order of their steps"},
          {"[0, 3]", "[30, 1.75]", overlaps + "'disc'"},
          {"[0, 3]", "[7, 0.125]", overlaps + "'lift'"},
          {"[0, 3]", "[51.75, 2]", overlaps + "'plank'"},
          {"'gravity'", "+'empty': true", ": /empty: "},
      });
}

TEST_F(JsonScene, is_refused_for_its_further_characters_bodies_and_joints) {
  expect_refused(
      "room.json", full,
      {
          {"'position': [0.5, 3], ", "", ": /characters/0/position: expected this key, which is missing"},
          {"'velocity': [1, 2]", "'velocity': [1e300, 2]",
           ": /characters/0/velocity: expected at most 1e6 m of motion"},
          {"[0.5, 3]", "[-2, 0.5]", ": /characters/0/position: expected a start outside of every solid, but "},
          {"[0.5, 3]", "[0.49, 3]",
           ": /characters/0/position: expected a start outside of every other character, but it "
           "overlaps character 0, which begins at (0, 3)"},
          {"[-3, 0]", "[0.6, 3]",
           ": /characters/1/position: expected a start outside of every other character, but it overlaps character 1"},
          {"'id': 'plank', 'polygon': [[48,2],[52,2],[52,2.25]], ", "", ": /bodies/0/polygon: expected this key"},
          {"'polygon': [[53", "'chain': [[53", ": /bodies/1/chain: unknown key; expected one of "},
          {"[54,2],[54,3]", "[54,2],[55,2]", ": /bodies/1/polygon: 'crate': "},
          {"'velocity': [1, -2]", "'velocity': [0, 1e300]", ": /bodies/1/velocity: expected at most 1e6 m of motion"},
          {"'damping'", "'dampening'", ": /joints/0/dampening: unknown key; did you mean damping?"},
          {"['plank'], 'pris", "['plonk'], 'pris",
           ": /joints/2/bodies/0: expected the id of one of 'bodies'; 'plonk' is none; did you mean plank?"},
          {"['plank'], 'pris", "['lift'], 'pris",
           ": /joints/2/bodies/0: expected the id of one of 'bodies'; 'lift' is none"},
          {"['crate', 'plank']", "['crate', 'crate']",
           ": /joints/3/bodies/1: expected another entry than those before, not 'crate'"},
          {", 'revolute': [52.5, 2]", "",
           ": /joints/3: expected exactly one of distance, revolute, prismatic; here is "},
          {"'revolute'", "+'prismatic': [1, 0]", ": /joints/3: expected exactly one of "},
          {"[[52,2],[53,2]]", "[[2,2],[2.004,2]]", ": /joints/1/distance: expected two points that are from 0.005 to "},
          {"'length': 1.5", "'damping': 1", ": /joints/1/damping: expected only beside stiffness"},
          {"1000", "0", ": /joints/0/stiffness: expected more than 0, at most 1000000000000, not 0"},
          {"'prismatic'", "+'stiffness': 3",
           ": /joints/2/stiffness: unknown key; expected one of id, bodies or prismatic"},
          {"'prismatic': [0, 1]", "'prismatic': [0, 0]", ": /joints/2/prismatic: expected a direction"},
      });
}

TEST(JsonFile, that_is_no_scene_is_refused_in_one_line) {
  const SceneFiles files;
  EXPECT_TRUE(begins(files.complaint("a.json", ""), ":1:1: expected JSON; "));
  EXPECT_TRUE(begins(files.complaint("a.json", "{\n\n  x"), ":3:3: "));
  EXPECT_TRUE(holds(files.complaint("a.json", std::string(200000, '[')), "expected at most 100 levels of nesting"));
  EXPECT_EQ(files.complaint("a.json", "{\"a\": 1}"), ": /paperproof_scene: expected this key, which is missing");
  EXPECT_EQ(files.complaint("a.json", "[]"), ": /: expected an object");
  const std::string bytes = files.complaint("a.json", "{\"name\": \"\xff\xfe\"}");
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
