/// What JSON scenes are refused, and in which words.
#include <gtest/gtest.h>

#include <algorithm>

#include "good_json_scene.hpp"
#include "scene_files.hpp"

namespace paperproof::compare {
namespace {

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
  const std::string message = files.complaint("room.json", with(good_json_scene, bad.from, bad.to));
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
            ": /scenery/1: expected exactly one shape: polygon, chain, circle, tiled"},
        Bad{"zero_one_way_of_a_polygon", "\"holes\": [[[12,2],[18,2],[18,8],[12,8]]]", "\"one_way\": [0, 0]",
            ": /scenery/3/polygon: \"ring\": "},
        Bad{"circle_of_two_numbers", "\"chain\": [[5,0],[5,4]]", "\"circle\": [5, 0]",
            ": /scenery/1/circle: expected [x, y, radius]"},
        Bad{"circle_of_no_size", "\"chain\": [[5,0],[5,4]]", "\"circle\": [5, 0, 0]",
            ": /scenery/1/circle: \"wall\": the radius of a circle must be above 0"},
        Bad{"one_way_circle", "\"chain\": [[5,0],[5,4]]", "\"circle\": [5, 0, 1], \"one_way\": [0, 1]",
            ": /scenery/1/circle: \"wall\": a circle cannot be one-way"},
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
            ": /scenery/1/sensor: expected only beside \"polygon\", \"chain\" or \"circle\""},
        Bad{"fast_belt", "\"chain\": [[5,0],[5,4]]", "\"chain\": [[5,0],[5,4]], \"surface_speed\": -1.3e8",
            ": /scenery/1/surface_speed: expected at most 1e6 m of motion"},
        Bad{"angle_is_a_number", "\"loop\"", "\"angle\": 1, \"loop\"", ": /movers/0/angle: expected an array"},
        Bad{"angle_back_in_time", "\"loop\"",
            "\"angle\": [ { \"t\": 1, \"at\": 0 }, { \"t\": 1, \"at\": 2 } ], \"loop\"",
            ": /movers/0/angle/1/t: expected a time after the one before"},
        Bad{"loop_that_jumps", "\"ping_pong\"", "\"loop\"",
            ": /movers/0/path/1/at: expected the place where the path begins"},
        Bad{"far_path", "\"at\": [6,3]", "\"at\": [6,3e6]", ": /movers/0/path/1/at: expected coordinates within 2e6 m"},
        Bad{"step_height", "\"velocity\"", "\"step_height\": -1, \"velocity\"", ": /character/step_height: "},
        Bad{"sprite_too_low", "\"velocity\"", "\"sprite\": [\"#\"], \"velocity\"",
            ": /character/sprite: expected 40 rows, as high as the character, not 1"},
        Bad{"solid_decoration", "\"chain\": [[5,0],[5,4]]",
            "\"chain\": [[5,0],[5,4]], \"decoration\": [[0,9],[1,9],[1,8]]",
            ": /scenery/1/chain: unknown key; expected one of "},
        Bad{"flat_decoration", "\"chain\": [[5,0],[5,4]]", "\"decoration\": [[0,9],[1,9],[2,9]]",
            ": /scenery/1/decoration: "},
        Bad{"bodies_are_a_list", "\"name\"", "\"bodies\": {}, \"name\"", ": /bodies: expected an array"},
        Bad{"body_without_a_shape", "\"name\"", "\"bodies\": [{\"mass\": 1}], \"name\"",
            ": /bodies/0/polygon: expected this key, which is missing"},
        Bad{"body_of_a_chain", "\"name\"", "\"bodies\": [{\"chain\": [[0,9],[1,9]]}], \"name\"",
            ": /bodies/0/chain: unknown key; expected one of "},
        Bad{"body_of_no_area", "\"name\"", "\"bodies\": [{\"polygon\": [[0,9],[1,9],[2,9]]}], \"name\"",
            ": /bodies/0/polygon: \"bodies/0\": "},
        Bad{"weightless_body", "\"name\"", "\"bodies\": [{\"polygon\": [[0,9],[1,9],[1,8]], \"mass\": 0}], \"name\"",
            ": /bodies/0/mass: expected a number from 1e-06 to 1000000000"},
        Bad{"rough_body", "\"name\"", "\"bodies\": [{\"polygon\": [[0,9],[1,9],[1,8]], \"friction\": -1}], \"name\"",
            ": /bodies/0/friction: expected a number from 0 to "},
        Bad{"body_that_gains", "\"name\"",
            "\"bodies\": [{\"polygon\": [[0,9],[1,9],[1,8]], \"restitution\": 1.5}], \"name\"",
            ": /bodies/0/restitution: expected a number from 0 to 1"},
        Bad{"fast_body", "\"name\"",
            "\"bodies\": [{\"polygon\": [[0,9],[1,9],[1,8]], \"velocity\": [0, 1e300]}], \"name\"",
            ": /bodies/0/velocity: expected at most 1e6 m of motion"},
        Bad{"body_id_twice", "\"name\"", "\"bodies\": [{\"polygon\": [[0,9],[1,9],[1,8]], \"id\": \"lift\"}], \"name\"",
            ": /bodies/0/id: expected an id of its own; \"lift\" is taken"},
        Bad{"start_in_a_body", "\"name\"", "\"bodies\": [{\"polygon\": [[-1,2],[1,2],[1,4],[-1,4]]}], \"name\"",
            ": /character/position: expected a start outside of every solid, but the character overlaps \"bodies/0\""},
        Bad{"start_in_the_rim_of_a_circle", "{ \"id\": \"wall\"",
            "{ \"id\": \"round\", \"circle\": [0, 0, 2.5] }, { \"id\": \"wall\"",
            ": /character/position: expected a start outside of every solid, but the character overlaps \"round\""},
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
  const std::string bytes = files.complaint("bytes.json", "{\"name\": \"\xff\xfe\"}");
  EXPECT_TRUE(begins(bytes, ":1:"));
  EXPECT_TRUE(std::all_of(bytes.begin(), bytes.end(), [](unsigned char c) { return c < 0x80; })) << bytes;
}

TEST(JsonFile, line_and_column_count_from_one) {
  const SceneFiles files;
  EXPECT_TRUE(begins(files.complaint("a.json", "]"), ":1:1: "));
  EXPECT_TRUE(begins(files.complaint("a.json", "{\n\n  x"), ":3:3: "));
}

}  // namespace
}  // namespace paperproof::compare
