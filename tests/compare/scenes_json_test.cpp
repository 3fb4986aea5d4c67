#include <gtest/gtest.h>

#include "scene_files.hpp"

namespace paperproof::compare {
namespace {

const std::string good = R"({
  "paperproof_scene": 1,
  "name": "room",
  "gravity": [0, -30], "dt": 0.0078125, "steps": 120,
  "character": { "position": [0, 3], "velocity": [0, -40] },
  "scenery": [ { "id": "paper", "polygon": [[-4,0],[4,0],[4,0.01],[-4,0.01]] },
               { "id": "wall", "chain": [[5,0],[5,4]] },
               { "id": "ledge", "chain": [[-2,1],[0,1]], "one_way": [0, 1] },
               { "id": "ring", "polygon": [[10,0],[20,0],[20,10],[10,10]], "holes": [[[12,2],[18,2],[18,8],[12,8]]] } ],
  "movers": [ { "id": "lift", "polygon": [[0,0],[2,0],[2,0.25],[0,0.25]],
                "path": [ { "t": 0, "at": [6,0] }, { "t": 2, "at": [6,3] } ], "loop": "ping_pong" } ],
  "input": [ { "step": 0, "move": 1 }, { "step": 40, "jump": true }, { "step": 44, "jump": false, "drop": true } ]
})";

TEST(JsonScene, every_key_arrives) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", good);
  EXPECT_EQ(scene.name, "room");
  EXPECT_EQ(scene.gravity, Vec2d(0, -30));
  EXPECT_EQ(scene.dt, 1.0 / 128);
  EXPECT_EQ(scene.steps, 120);
  EXPECT_EQ(scene.start.position, Vec2d(0, 3));
  EXPECT_EQ(scene.start.velocity, Vec2d(0, -40));
  EXPECT_EQ(scene.ids, (std::vector<std::string>{"paper", "wall", "ledge", "ring", "lift"}));
  const auto& colliders = scene.scenery.colliders;
  EXPECT_EQ(colliders[0].shape, ColliderDef::Shape::polygon);
  EXPECT_EQ(colliders[0].points[2], Vec2d(4, 0.01));
  EXPECT_EQ(colliders[1].shape, ColliderDef::Shape::chain);
  EXPECT_FALSE(colliders[1].one_way.has_value());
  EXPECT_EQ(colliders[2].one_way, Vec2d(0, 1));
  ASSERT_EQ(colliders[3].holes.size(), 1U);
  EXPECT_EQ(colliders[3].holes[0][1], Vec2d(18, 2));
  ASSERT_EQ(scene.movers.size(), 1U);
  EXPECT_EQ(colliders[3].mover, no_mover);
  EXPECT_EQ(colliders[4].mover, 0U);
  EXPECT_EQ(colliders[4].points[2], Vec2d(2, 0.25));
  EXPECT_EQ(scene.movers[0].id, "lift");
  EXPECT_EQ(scene.movers[0].loop, MoverDef::Loop::ping_pong);
  EXPECT_EQ(scene.movers[0].path[1].time, 2);
  EXPECT_EQ(scene.movers[0].path[1].at, Vec2d(6, 3));
  ASSERT_EQ(scene.input.size(), 3U);
  EXPECT_EQ(scene.input[1].jump, true);
  EXPECT_FALSE(scene.input[1].move.has_value());
  EXPECT_FALSE(scene.input[1].drop.has_value());
  EXPECT_EQ(scene.input[2].drop, true);
  EXPECT_FALSE(input_at(scene.input, 43).drop);
  EXPECT_TRUE(input_at(scene.input, 119).drop) << "until an event changes it";
  EXPECT_FALSE(scene.respawn_box.has_value());
}

TEST(JsonScene, sensors_conveyors_and_angles_arrive_standing_and_moving) {
  const SceneFiles files;
  const Scene scene = files.load(
      "room.json",
      with(with(with(good, "\"chain\": [[5,0],[5,4]]", R"("chain": [[5,0],[5,4]], "sensor": true)"), R"("holes": [)",
                R"("surface_speed": -2, "holes": [)"),
           "\"loop\"", R"("surface_speed": 3, "angle": [ { "t": 0.5, "at": 0 }, { "t": 1.5, "at": -2 } ], "loop")"));
  const auto& colliders = scene.scenery.colliders;
  EXPECT_FALSE(colliders[0].sensor);
  EXPECT_TRUE(colliders[1].sensor);
  EXPECT_EQ(colliders[0].surface_speed, 0);
  EXPECT_EQ(colliders[3].surface_speed, -2);
  EXPECT_EQ(colliders[4].surface_speed, 3);
  ASSERT_EQ(scene.movers[0].turns.size(), 2U);
  EXPECT_EQ(scene.movers[0].turns[0].time, 0.5);
  EXPECT_EQ(scene.movers[0].turns[1].at, -2);
}

TEST(JsonScene, the_colliders_of_several_movers_know_their_own) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", with(good, R"("movers": [)", R"("movers": [
      { "id": "saw", "chain": [[0,8],[1,8]], "path": [ { "t": 0, "at": [0,0] } ] },)"));
  ASSERT_EQ(scene.movers.size(), 2U);
  EXPECT_EQ(scene.movers[1].id, "lift");
  EXPECT_EQ(scene.ids[4], "saw");
  EXPECT_EQ(scene.scenery.colliders[4].mover, 0U);
  EXPECT_EQ(scene.ids[5], "lift");
  EXPECT_EQ(scene.scenery.colliders[5].mover, 1U);
}

TEST(JsonScene, a_start_is_held_against_movers_where_they_begin_and_never_against_sensors) {
  const SceneFiles files;
  // The lift is written around (0, 0) to (2, 0.25) and begins 6 m to the right of that.
  EXPECT_EQ(files.complaint("in.json", with(good, "\"position\": [0, 3]", "\"position\": [7, 0.125]")),
            ": /character/position: expected a start outside of every solid, but the character overlaps \"lift\"; "
            "\"start_overlap\": \"resolve\" beside it asks to move it out");
  const Scene sensor = files.load("sensor.json", with(with(good, "\"position\": [0, 3]", "\"position\": [7, 0.125]"),
                                                      "\"loop\"", "\"sensor\": true, \"loop\""));
  EXPECT_EQ(sensor.start.position, Vec2d(7, 0.125));
}

TEST(JsonScene, lengths_of_steps_arrive_and_dt_is_still_asked_for) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", with(good, "\"steps\"", "\"dt_list\": [0.01, 0.02], \"steps\""));
  EXPECT_EQ(scene.dt_list, (std::vector<double>{0.01, 0.02}));
  EXPECT_EQ(scene.dt, 1.0 / 128);
  EXPECT_TRUE(files.load("room.json", good).dt_list.empty());
}

TEST(JsonScene, what_is_left_out_has_the_defaults_of_the_types) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", good);
  const CharacterDef defaults;
  EXPECT_EQ(scene.pixels_per_metre, 32);
  EXPECT_EQ(scene.character.walk_speed, defaults.walk_speed);
  EXPECT_EQ(scene.character.jump_speed, defaults.jump_speed);
  EXPECT_EQ(scene.character.acceleration, defaults.acceleration);
  EXPECT_EQ(scene.character.max_climb_degrees, defaults.max_climb_degrees);
  EXPECT_FALSE(scene.character.max_fall_speed.has_value());
  EXPECT_FALSE(scene.start.resolve_overlap);
}

TEST(JsonScene, the_characters_keys_arrive) {
  const SceneFiles files;
  const Scene scene = files.load(
      "room.json",
      with(good, "\"velocity\": [0, -40]",
           R"("walk_speed": 1, "acceleration": 2, "air_acceleration": 3, "jump_speed": 4, "max_fall_speed": 5,
                           "max_climb_degrees": 6, "snap": 7, "no_jump_toward_wall": true, "side_hit_ends_rise": true,
                           "start_overlap": "resolve")"));
  EXPECT_EQ(scene.character.walk_speed, 1);
  EXPECT_EQ(scene.character.acceleration, 2);
  EXPECT_EQ(scene.character.air_acceleration, 3);
  EXPECT_EQ(scene.character.jump_speed, 4);
  EXPECT_EQ(scene.character.max_fall_speed, 5);
  EXPECT_EQ(scene.character.max_climb_degrees, 6);
  EXPECT_EQ(scene.character.snap, 7);
  EXPECT_TRUE(scene.character.no_jump_toward_wall);
  EXPECT_TRUE(scene.character.side_hit_ends_rise);
  EXPECT_TRUE(scene.start.resolve_overlap);
}

TEST(JsonScene,
     further_characters_begin_where_they_are_put_and_do_as_the_scene_unless_they_have_an_input_of_their_own) {
  const SceneFiles files;
  // 0.625 m is the width: the second touches the first.
  const Scene scene = files.load("room.json", with(good, "\"scenery\"", R"("characters": [
      { "position": [0.625, 3], "velocity": [1, 2] },
      { "position": [-2, 0.5], "start_overlap": "resolve", "input": [ { "step": 3, "move": -1 } ] }], "scenery")"));
  ASSERT_EQ(character_count(scene), 3U);
  EXPECT_EQ(start_of(scene, 0).position, Vec2d(0, 3));
  EXPECT_EQ(start_of(scene, 1).position, Vec2d(0.625, 3));
  EXPECT_EQ(start_of(scene, 1).velocity, Vec2d(1, 2));
  EXPECT_EQ(start_of(scene, 2).velocity, Vec2d(0, 0));
  EXPECT_TRUE(start_of(scene, 2).resolve_overlap);
  const Script script = script_of(scene);
  EXPECT_EQ(script[1], scene.input);
  EXPECT_EQ(script[2], (std::vector<InputEvent>{{.step = 3, .move = -1, .jump = std::nullopt}}));
  const Script random = random_script(scene, 5, 600);
  EXPECT_EQ(random[0], random_input(5, 600));
  EXPECT_NE(random[1], random[2]);
}

TEST(JsonScene, pixels_become_metres_about_the_centre_of_the_sprite) {
  const SceneFiles files;
  const Scene scene =
      files.load("room.json", with(with(good, "\"velocity\": [0, -40]", R"("points_px": [[0,0],[8,0],[4,16]])"),
                                   "\"name\"", "\"pixels_per_metre\": 16, \"name\""));
  // The sprite is 8 x 16 px: the centre is (4, 8), y turns over, 16 px are 1 m.
  const auto points = scene.character.shape.points();
  ASSERT_EQ(points.size(), 3U);
  EXPECT_EQ(points[0], Vec2d((0 - 4) / 16.0, (8 - 0) / 16.0));
  EXPECT_EQ(points[1], Vec2d((8 - 4) / 16.0, (8 - 0) / 16.0));
  EXPECT_EQ(points[2], Vec2d((4 - 4) / 16.0, (8 - 16) / 16.0));
}

TEST(JsonScene, ids_that_are_left_out_say_where_the_entry_stands) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", with(good, "\"id\": \"wall\", ", ""));
  EXPECT_EQ(scene.ids[1], "scenery/1");
}

TEST(JsonScene, empty_scenery_is_fine_when_it_is_said_to_be) {
  const SceneFiles files;
  const std::string text = R"({"paperproof_scene": 1, "name": "void", "gravity": [0, 0], "dt": 1, "steps": 1,
                               "character": {"position": [0, 0]}, "scenery": []})";
  EXPECT_EQ(files.complaint("void.json", text),
            ": /scenery: expected at least one solid, or \"empty\": true beside it");
  EXPECT_EQ(files.load("void.json", with(text, "\"scenery\"", "\"empty\": true, \"scenery\"")).ids.size(), 0U);
  EXPECT_TRUE(begins(files.complaint("room.json", with(good, "\"name\"", "\"empty\": true, \"name\"")), ": /empty: "));
}

TEST(JsonScene, a_start_inside_a_solid_is_refused_unless_it_is_to_be_resolved) {
  const SceneFiles files;
  const std::string inside = with(good, "[0, 3]", "[0, 0.5]");
  const std::string message = files.complaint("room.json", inside);
  EXPECT_TRUE(begins(message, ": /character/position: expected a start outside of every solid")) << message;
  EXPECT_TRUE(holds(message, "\"paper\""));
  const std::string resolved = with(inside, "\"velocity\"", "\"start_overlap\": \"resolve\", \"velocity\"");
  EXPECT_TRUE(files.load("room.json", resolved).start.resolve_overlap);
  // Feet exactly on the paper touch it and are not inside: 0.01 + 20 px, as the doubles add up.
  EXPECT_NO_THROW((void)files.load("room.json", with(good, "[0, 3]", "[0, 0.63500000000000012]")));
}

TEST(JsonScene, motion_of_a_million_metres_in_a_step_is_the_most) {
  const SceneFiles files;
  // dt is 1/128 s, so 1e6 m in a step are 1.28e8 m/s.
  EXPECT_NO_THROW((void)files.load("room.json", with(good, "[0, -40]", "[0, -1.28e8]")));
  EXPECT_TRUE(holds(files.complaint("room.json", with(good, "[0, -40]", "[0, -1.2800001e8]")), "/velocity"));
}

struct Bad {
  const char* what;
  const char* from;
  const char* to;
  const char* message;  ///< What it begins with, behind the file's name.
};

void PrintTo(const Bad& bad, std::ostream* stream) { *stream << bad.what; }

class BadJsonScene : public testing::TestWithParam<Bad> {};

TEST_P(BadJsonScene, is_refused_in_one_line_with_its_place) {
  const SceneFiles files;
  const Bad& bad = GetParam();
  const std::string message = files.complaint("room.json", with(good, bad.from, bad.to));
  EXPECT_TRUE(begins(message, bad.message));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadJsonScene,
    testing::Values(
        Bad{"unknown_key", "\"steps\"", "\"stepz\"", ": /stepz: unknown key; expected one of "},
        Bad{"unknown_key_in_character", "\"velocity\"", "\"speed\"",
            ": /character/speed: unknown key; expected one of "},
        Bad{"unknown_key_in_scenery", "\"holes\"", "\"hole\"", ": /scenery/3/hole: unknown key"},
        Bad{"key_twice", "\"dt\"", "\"name\": \"b\", \"dt\"", ": /name: expected each key once"},
        Bad{"inner_key_twice", "\"chain\": [[5,0],[5,4]]", "\"id\": \"x\", \"chain\": [[5,0],[5,4]]",
            ": /scenery/1/id: expected each key once"},
        Bad{"missing_key", "\"dt\": 0.0078125, ", "", ": /dt: expected this key, which is missing"},
        Bad{"missing_position", "\"position\": [0, 3], ", "", ": /character/position: expected this key"},
        Bad{"other_version", "\"paperproof_scene\": 1", "\"paperproof_scene\": 2", ": /paperproof_scene: expected 1"},
        Bad{"broken_json", "\"steps\": 120,", "\"steps\": 120", ":5:3: expected JSON; "},
        Bad{"infinite_number", "0.0078125", "1e999", ":4:30: expected a finite number, not 1e999"},
        Bad{"nan", "0.0078125", "NaN", ":4:30: expected JSON; "},
        Bad{"zero_dt", "0.0078125", "0", ": /dt: expected a number greater than 0"},
        Bad{"negative_dt", "0.0078125", "-0.01", ": /dt: expected a number greater than 0"},
        Bad{"dt_of_hours", "0.0078125", "1e300", ": /dt: expected at most 10000 s"},
        Bad{"gravity_beyond_a_step", "[0, -30]", "[0, -1e300]", ": /gravity: expected at most 1e6 m of motion"},
        Bad{"velocity_beyond_a_step", "[0, -40]", "[0, -1e300]",
            ": /character/velocity: expected at most 1e6 m of motion"},
        Bad{"walk_beyond_a_step", "\"velocity\"", "\"walk_speed\": 2e8, \"velocity\"",
            ": /character/walk_speed: expected at most 1e6 m of motion"},
        Bad{"jump_beyond_a_step", "\"velocity\"", "\"jump_speed\": 2e8, \"velocity\"",
            ": /character/jump_speed: expected at most 1e6 m of motion"},
        Bad{"scale_too_large", "\"dt\"", "\"pixels_per_metre\": 1e300, \"dt\"",
            ": /pixels_per_metre: expected a number from 0.001 to 1000000"},
        Bad{"scale_too_small", "\"dt\"", "\"pixels_per_metre\": 1e-300, \"dt\"",
            ": /pixels_per_metre: expected a number from 0.001 to 1000000"},
        Bad{"no_steps", "\"steps\": 120", "\"steps\": 0", ": /steps: expected a whole number from 1 to "},
        Bad{"half_a_step", "\"steps\": 120", "\"steps\": 1.5", ": /steps: expected a whole number"},
        Bad{"text_for_number", "\"steps\": 120", "\"steps\": \"120\"", ": /steps: expected a whole number"},
        Bad{"point_of_three", "[0, -30]", "[0, -30, 0]", ": /gravity: expected two numbers, [x, y]"},
        Bad{"empty_name", "\"room\"", "\"\"", ": /name: expected a text"},
        Bad{"control_character", "\"room\"", "\"ro\\nom\"", ": /name: expected a text"},
        Bad{"steep", "\"velocity\"", "\"max_climb_degrees\": 89.5, \"velocity\"",
            ": /character/max_climb_degrees: expected an angle from 0 to 89"},
        Bad{"negative_speed", "\"velocity\"", "\"walk_speed\": -1, \"velocity\"",
            ": /character/walk_speed: expected a number that is not negative"},
        Bad{"far_start", "[0, 3]", "[0, 3e6]", ": /character/position: expected coordinates within 2e6 m"},
        Bad{"overlap_word", "\"velocity\"", "\"start_overlap\": \"ignore\", \"velocity\"",
            ": /character/start_overlap: expected \"resolve\" or \"refuse\""},
        Bad{"concave_character", "\"velocity\"", "\"points_px\": [[0,0],[10,0],[5,1],[5,10]], \"velocity\"",
            ": /character/points_px: "},
        Bad{"two_points", "\"velocity\"", "\"points_px\": [[0,0],[10,0]], \"velocity\"",
            ": /character/points_px: expected an array of at least 3 points"},
        Bad{"id_twice", "\"wall\"", "\"paper\"", ": /scenery/1/id: expected an id of its own; \"paper\" is taken"},
        Bad{"mover_id_twice", "\"lift\"", "\"paper\"", ": /movers/0/id: expected an id of its own"},
        Bad{"two_shapes", "\"chain\": [[5,0],[5,4]]", "\"chain\": [[5,0],[5,4]], \"polygon\": [[0,0],[1,0],[0,1]]",
            ": /scenery/1: expected exactly one shape; here are \"polygon\" and \"chain\""},
        Bad{"no_shape", "\"chain\": [[5,0],[5,4]]", "\"one_way\": [0, 1]",
            ": /scenery/1: expected exactly one shape: polygon, chain, tiled"},
        Bad{"one_way_polygon", "\"holes\": [[[12,2],[18,2],[18,8],[12,8]]]", "\"one_way\": [0, 1]",
            ": /scenery/3/one_way: expected only beside \"chain\""},
        Bad{"holes_in_chain", "\"chain\": [[5,0],[5,4]]", "\"chain\": [[5,0],[5,4]], \"holes\": []",
            ": /scenery/1/holes: expected only beside \"polygon\""},
        Bad{"self_intersecting", "[[-4,0],[4,0],[4,0.01],[-4,0.01]]", "[[-4,0],[4,0],[-4,1],[4,1]]",
            ": /scenery/0/polygon: \"paper\": "},
        Bad{"zero_area", "[[-4,0],[4,0],[4,0.01],[-4,0.01]]", "[[-4,0],[4,0],[0,0]]",
            ": /scenery/0/polygon: \"paper\": "},
        Bad{"repeated_point", "[[-4,0],[4,0],[4,0.01],[-4,0.01]]", "[[-4,0],[4,0],[4,0],[0,1]]",
            ": /scenery/0/polygon: \"paper\": "},
        Bad{"far_point", "[[5,0],[5,4]]", "[[5,0],[5,4e6]]", ": /scenery/1/chain: \"wall\": "},
        Bad{"hole_outside", "[12,2],[18,2],[18,8],[12,8]", "[32,2],[38,2],[38,8],[32,8]",
            ": /scenery/3/polygon: \"ring\": "},
        Bad{"zero_one_way", "\"one_way\": [0, 1]", "\"one_way\": [0, 0]", ": /scenery/2/chain: \"ledge\": "},
        Bad{"two_corners", "[[-4,0],[4,0],[4,0.01],[-4,0.01]]", "[[-4,0],[4,0]]",
            ": /scenery/0/polygon: expected an array of at least 3 points"},
        Bad{"bad_mover", "[[0,0],[2,0],[2,0.25],[0,0.25]]", "[[0,0],[2,0],[0,1],[2,1]]",
            ": /movers/0/polygon: \"lift\": "},
        Bad{"no_path", "[ { \"t\": 0, \"at\": [6,0] }, { \"t\": 2, \"at\": [6,3] } ]", "[]",
            ": /movers/0/path: expected at least one waypoint"},
        Bad{"path_back_in_time", "\"t\": 2", "\"t\": 0", ": /movers/0/path/1/t: expected a time after the one before"},
        Bad{"unknown_loop", "\"ping_pong\"", "\"forever\"",
            ": /movers/0/loop: expected \"once\", \"loop\" or \"ping_pong\""},
        Bad{"input_out_of_order", "\"step\": 44", "\"step\": 39",
            ": /input/2/step: expected events in the order of their steps"},
        Bad{"too_much_move", "\"move\": 1", "\"move\": 2", ": /input/0/move: expected a number from -1 to 1"},
        Bad{"negative_step", "\"step\": 0", "\"step\": -1", ": /input/0/step: expected a whole number from 0"},
        Bad{"missing_picture", "\"chain\": [[5,0],[5,4]]", "\"picture\": \"a.png\"",
            ": /scenery/1/picture: a.png: expected a file that exists"},
        Bad{"one_way_sensor", "\"one_way\": [0, 1]", "\"one_way\": [0, 1], \"sensor\": true",
            ": /scenery/2/chain: \"ledge\": "},
        Bad{"sensor_with_speed", "\"chain\": [[5,0],[5,4]]",
            "\"sensor\": true, \"surface_speed\": 1, \"chain\": [[5,0],[5,4]]",
            ": /scenery/1/surface_speed: expected only beside what blocks"},
        Bad{"sensor_picture", "\"chain\": [[5,0],[5,4]]", "\"sensor\": true, \"picture\": \"a.png\"",
            ": /scenery/1/sensor: expected only beside \"polygon\" or \"chain\""},
        Bad{"angle_is_a_number", "\"loop\"", "\"angle\": 1, \"loop\"", ": /movers/0/angle: expected an array"},
        Bad{"angle_back_in_time", "\"loop\"",
            "\"angle\": [ { \"t\": 1, \"at\": 0 }, { \"t\": 1, \"at\": 2 } ], \"loop\"",
            ": /movers/0/angle/1/t: expected a time after the one before"},
        Bad{"loop_that_jumps", "\"ping_pong\"", "\"loop\"",
            ": /movers/0/path/1/at: expected the place where the path begins"},
        Bad{"far_path", "\"at\": [6,3]", "\"at\": [6,3e6]", ": /movers/0/path/1/at: expected coordinates within 2e6 m"},
        Bad{"step_height", "\"velocity\"", "\"step_height\": 1, \"velocity\"", ": /character/step_height: "},
        Bad{"bodies", "\"name\"", "\"bodies\": [], \"name\"",
            ": /bodies: \"bodies\" needs dynamic bodies, which this version does not have"},
        Bad{"characters_are_a_list", "\"name\"", "\"characters\": {}, \"name\"", ": /characters: expected an array"},
        Bad{"character_without_a_place", "\"name\"", "\"characters\": [{}], \"name\"",
            ": /characters/0/position: expected this key, which is missing"},
        Bad{"character_of_another_kind", "\"name\"",
            "\"characters\": [{\"position\": [0,6], \"walk_speed\": 3}], \"name\"",
            ": /characters/0/walk_speed: expected only in \"character\": all characters of a scene are of one kind"},
        Bad{"unknown_key_of_a_character", "\"name\"",
            "\"characters\": [{\"position\": [0,6], \"speed\": [0,1]}], \"name\"",
            ": /characters/0/speed: unknown key; expected one of "},
        Bad{"characters_that_overlap", "\"name\"",
            "\"characters\": [{\"position\": [9,6]}, {\"position\": [9.5,6]}], \"name\"",
            ": /characters/1/position: expected a start outside of every other character, but it overlaps character 1, "
            "which begins at (9, 6)"},
        Bad{"a_character_on_the_first", "\"name\"", "\"characters\": [{\"position\": [0,4]}], \"name\"",
            ": /characters/0/position: expected a start outside of every other character, but it overlaps character 0"},
        Bad{"a_character_in_a_solid", "\"name\"", "\"characters\": [{\"position\": [-2,0.5]}], \"name\"",
            ": /characters/0/position: expected a start outside of every solid, but the character overlaps \"paper\""},
        Bad{"a_fast_character", "\"name\"",
            "\"characters\": [{\"position\": [0,6], \"velocity\": [1e300,0]}], \"name\"",
            ": /characters/0/velocity: expected at most 1e6 m of motion"},
        Bad{"input_of_a_character", "\"name\"",
            "\"characters\": [{\"position\": [0,6], \"input\": [{\"step\": 0, \"move\": 2}]}], \"name\"",
            ": /characters/0/input/0/move: expected a number from -1 to 1"},
        Bad{"no_lengths", "\"name\"", "\"dt_list\": [], \"name\"", ": /dt_list: expected at least one length"},
        Bad{"lengths_are_a_list", "\"name\"", "\"dt_list\": 0.1, \"name\"", ": /dt_list: expected an array"},
        Bad{"length_of_zero", "\"name\"", "\"dt_list\": [0.1, 0], \"name\"",
            ": /dt_list/1: expected a number greater than 0"},
        Bad{"length_of_hours", "\"name\"", "\"dt_list\": [0.1, 1e5], \"name\"",
            ": /dt_list/1: expected at most 10000 s"},
        Bad{"gravity_beyond_the_longest_step", "\"name\"", "\"dt_list\": [0.1, 1e3, 0.1], \"name\"",
            ": /gravity: expected at most 1e6 m of motion in a step of 1000 s"},
        Bad{"drop_is_a_flag", "\"drop\": true", "\"drop\": 1", ": /input/2/drop: expected true or false"},
        Bad{"missing_map", "\"chain\": [[5,0],[5,4]]", "\"tiled\": \"none.tmx\"",
            ": /scenery/1/tiled: none.tmx: expected a file that exists"}),
    [](const testing::TestParamInfo<Bad>& bad) { return bad.param.what; });

TEST(JsonFile, empty_missing_and_directory_are_refused) {
  const SceneFiles files;
  EXPECT_TRUE(begins(files.complaint("empty.json", ""), ":1:1: expected JSON; "));
  EXPECT_EQ(SceneFiles::complaint_about(files.path("none.json")), ": expected a file that exists; there is none");
  std::filesystem::create_directories(files.path("folder.json"));
  EXPECT_EQ(SceneFiles::complaint_about(files.path("folder.json")), ": expected a file; this is a directory");
}

TEST(JsonFile, nesting_without_end_is_refused) {
  const SceneFiles files;
  EXPECT_TRUE(holds(files.complaint("deep.json", std::string(200000, '[')), "expected at most 100 levels of nesting"));
}

TEST(JsonFile, something_else_in_json_is_refused) {
  const SceneFiles files;
  EXPECT_EQ(files.complaint("other.json", "{\"a\": 1}"), ": /paperproof_scene: expected this key, which is missing");
  EXPECT_EQ(files.complaint("list.json", "[]"), ": /: expected an object");
  EXPECT_TRUE(begins(files.complaint("bytes.json", "{\"name\": \"\xff\xfe\"}"), ":1:"));
}

TEST(JsonFile, line_and_column_count_from_one) {
  const SceneFiles files;
  EXPECT_TRUE(begins(files.complaint("a.json", "]"), ":1:1: "));
  EXPECT_TRUE(begins(files.complaint("a.json", "{\n\n  x"), ":3:3: "));
}

}  // namespace
}  // namespace paperproof::compare
