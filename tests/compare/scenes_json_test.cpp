#include "scenes/write_json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "good_json_scene.hpp"
#include "scene_files.hpp"

namespace paperproof::compare {
namespace {

const std::string good = good_json_scene;

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

TEST(JsonScene, bodies_are_movers_after_those_with_paths_and_say_what_box2d_is_to_know) {
  const SceneFiles files;
  const Scene scene = files.load("room.json", with(good, R"("name")", R"("bodies": [
      { "polygon": [[40,0],[41,0],[41,1]] },
      { "id": "crate", "polygon": [[50,0],[51,0],[51,1]], "mass": 25, "friction": 0.5, "restitution": 0.25,
        "velocity": [1, -2] } ], "name")"));
  ASSERT_EQ(scene.movers.size(), 3U);
  EXPECT_FALSE(scene.movers[0].body.has_value());
  EXPECT_EQ(scene.movers[1].id, "bodies/0");
  ASSERT_TRUE(scene.movers[1].body && scene.movers[2].body);
  EXPECT_EQ(scene.movers[1].body->mass, 1);
  EXPECT_EQ(scene.movers[2].body->mass, 25);
  EXPECT_EQ(scene.movers[2].body->friction, 0.5);
  EXPECT_EQ(scene.movers[2].body->restitution, 0.25);
  EXPECT_EQ(scene.movers[2].body->velocity, Vec2d(1, -2));
  EXPECT_EQ(scene.ids.back(), "crate");
  EXPECT_EQ(scene.scenery.colliders.back().mover, 2U);
  EXPECT_EQ(offset_at(scene.movers[2], 7), Vec2d(0, 0));
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
                           "max_climb_degrees": 6, "snap": 7, "step_height": 8, "no_jump_toward_wall": true, "side_hit_ends_rise": true,
                           "start_overlap": "resolve")"));
  EXPECT_EQ(scene.character.walk_speed, 1);
  EXPECT_EQ(scene.character.acceleration, 2);
  EXPECT_EQ(scene.character.air_acceleration, 3);
  EXPECT_EQ(scene.character.jump_speed, 4);
  EXPECT_EQ(scene.character.max_fall_speed, 5);
  EXPECT_EQ(scene.character.max_climb_degrees, 6);
  EXPECT_EQ(scene.character.snap, 7);
  EXPECT_EQ(scene.character.step_height, 8);
  EXPECT_EQ(scene.jump_rules.no_jump_toward_wall, true);
  EXPECT_EQ(scene.jump_rules.side_hit_ends_rise, true);
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

/// Written, read, and written again.
TEST(WrittenScenes, read_back_as_they_were) {
  for (const char* name :
       {"article_bullet", "slope_joints", "zero_thickness_paper", "lift_up", "conveyor", "sensor_gate", "one_way_drop",
        "stack_10", "plank_on_springs", "random_steps", "characters_head_on", "uneven_lift", "turning_arm",
        "start_overlapping_deep", "crush70", "scaled_1e3", "jump_into_overhang", "painted_cloud", "legs_apart"}) {
    const SceneFiles files;
    const Scene scene = load_scene(name, {});
    const nlohmann::ordered_json written = scene_json(scene);
    const Scene read = load_scene(files.write("scene.json", written.dump()), {});
    EXPECT_EQ(scene_json(read).dump(), written.dump()) << name;
    EXPECT_EQ(read.steps, scene.steps);
    EXPECT_EQ(read.scenery.colliders.size(), scene.scenery.colliders.size());
    EXPECT_EQ(read.start.position, scene.start.position);
    EXPECT_EQ(read.decoration.size(), scene.decoration.size());
    EXPECT_EQ(read.sprite, scene.sprite);
    EXPECT_TRUE(std::equal(read.character.shape.points().begin(), read.character.shape.points().end(),
                           scene.character.shape.points().begin()))
        << name;
  }
}

}  // namespace
}  // namespace paperproof::compare
