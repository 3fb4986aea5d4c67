/// Joints of JSON scenes: read, refused, written, turned.
#include "scene_files.hpp"
#include "scenes/describe.hpp"
#include "scenes/write_json.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

constexpr const char* joined = R"({
  "paperproof_scene": 1, "name": "joined", "gravity": [0, -10], "dt": 0.0078125, "steps": 120,
  "character": { "position": [0, 9] },
  "scenery": [ { "id": "floor", "polygon": [[-4,0],[4,0],[4,-1],[-4,-1]] } ],
  "bodies": [ { "id": "plank", "polygon": [[-2,2],[2,2],[2,2.25],[-2,2.25]] },
              { "id": "crate", "polygon": [[3,2],[4,2],[4,3],[3,3]] } ],
  "joints": [ { "id": "left", "bodies": ["plank"], "distance": [[-1.5,2],[-1.5,0]], "stiffness": 1000, "damping": 2 },
              { "bodies": ["plank", "crate"], "distance": [[2,2],[3,2]], "length": 1.5 },
              { "id": "rail", "bodies": ["plank"], "prismatic": [0, 1] },
              { "id": "pin", "bodies": ["crate", "plank"], "revolute": [2.5, 2] } ]
})";

TEST(JsonJoints, are_read_with_what_they_say_and_what_they_leave_out) {
  const SceneFiles files;
  const Scene scene = files.load("joined.json", joined);
  ASSERT_EQ(scene.joints.size(), 4U);
  const Joint& left = scene.joints[0];
  EXPECT_EQ(left.id, "left");
  EXPECT_EQ(left.kind, Joint::Kind::distance);
  EXPECT_EQ(left.body, 0U);
  EXPECT_EQ(left.other, no_mover);
  EXPECT_EQ(left.point, Vec2d(-1.5, 2));
  EXPECT_EQ(left.end, Vec2d(-1.5, 0));
  EXPECT_EQ(left.length, 2) << "as far as they are apart";
  EXPECT_EQ(left.stiffness, 1000);
  EXPECT_EQ(left.damping, 2);
  EXPECT_EQ(scene.joints[1].id, "joints/1");
  EXPECT_EQ(scene.joints[1].other, 1U);
  EXPECT_EQ(scene.joints[1].length, 1.5);
  EXPECT_EQ(scene.joints[1].stiffness, 0) << "a rod";
  EXPECT_EQ(scene.joints[2].kind, Joint::Kind::prismatic);
  EXPECT_EQ(scene.joints[2].axis, Vec2d(0, 1));
  EXPECT_EQ(scene.joints[3].kind, Joint::Kind::revolute);
  EXPECT_EQ(scene.joints[3].body, 1U);
  EXPECT_EQ(scene.joints[3].point, Vec2d(2.5, 2));
  const std::string text = describe(scene);
  for (const char* part :
       {"left: plank to the ground, a spring of 2 m, 1000 N/m, 2 N s/m", "joints/1: plank to crate, a rod of 1.5 m",
        "rail: plank to the ground, a rail along (0, 1)", "pin: crate to plank, a pin at (2.5, 2)"})
    EXPECT_TRUE(holds(text, part));
}

TEST(JsonJoints, are_written_as_they_were_read_wherever_they_are_and_however_large) {
  const SceneFiles files;
  const std::string path = files.write("joined.json", joined);
  for (const std::vector<ParameterSetting>& settings :
       {std::vector<ParameterSetting>{}, {{"scale", 4}}, {{"origin", 1000.25}}}) {
    const Scene scene = load_scene(path, settings);
    const nlohmann::ordered_json written = scene_json(scene);
    EXPECT_EQ(written["joints"].size(), 4U);
    const Scene read = load_scene(files.write("written.json", written.dump()), {});
    EXPECT_EQ(scene_json(read).dump(), written.dump());
  }
}

TEST(JsonJoints, grow_and_shift_with_the_scene) {
  const SceneFiles files;
  const std::string path = files.write("joined.json", joined);
  const std::vector<ParameterSetting> twice{{"scale", 2}};
  const Scene large = load_scene(path, twice);
  EXPECT_EQ(large.joints[0].point, Vec2d(-3, 4));
  EXPECT_EQ(large.joints[0].length, 4);
  EXPECT_EQ(large.joints[0].stiffness, 1000) << "forces grow as lengths do";
  const std::vector<ParameterSetting> aside{{"origin", 10}};
  const Scene shifted = load_scene(path, aside);
  EXPECT_EQ(shifted.joints[0].end, Vec2d(8.5, 0));
  EXPECT_EQ(shifted.joints[2].axis, Vec2d(0, 1));
}

struct Bad {
  const char* what;
  const char* from;
  const char* to;
  const char* message;
};
void PrintTo(const Bad& bad, std::ostream* stream) { *stream << bad.what; }

class BadJoint : public testing::TestWithParam<Bad> {};

TEST_P(BadJoint, is_refused_in_one_line_with_its_place) {
  const SceneFiles files;
  const Bad& bad = GetParam();
  EXPECT_TRUE(begins(files.complaint("joined.json", with(joined, bad.from, bad.to)), bad.message));
}

INSTANTIATE_TEST_SUITE_P(
    Each, BadJoint,
    testing::Values(
        Bad{"unknown_key", "\"damping\"", "\"dampening\"", ": /joints/0/dampening: unknown key; expected one of "},
        Bad{"unknown_body", "[\"plank\"], \"pris", "[\"plonk\"], \"pris",
            ": /joints/2/bodies/0: expected the id of one of \"bodies\"; \"plonk\" is none; did you mean plank?"},
        Bad{"a_solid_that_stands", "[\"plank\"], \"pris", "[\"floor\"], \"pris",
            ": /joints/2/bodies/0: expected the id of one of \"bodies\"; \"floor\" is none"},
        Bad{"the_same_body_twice", "[\"crate\", \"plank\"]", "[\"crate\", \"crate\"]",
            ": /joints/3/bodies/1: expected another body than the first"},
        Bad{"three_bodies", "[\"crate\", \"plank\"]", "[\"crate\", \"plank\", \"crate\"]",
            ": /joints/3/bodies: expected one body, which is held to the ground, or two"},
        Bad{"no_body", "[\"crate\", \"plank\"]", "[]", ": /joints/3/bodies: expected one body"},
        Bad{"no_kind", ", \"revolute\": [2.5, 2]", "",
            ": /joints/3: expected exactly one of \"distance\", \"revolute\" and \"prismatic\""},
        Bad{"two_kinds", "\"revolute\": [2.5, 2]", "\"revolute\": [2.5, 2], \"prismatic\": [1, 0]",
            ": /joints/3: expected exactly one of "},
        Bad{"one_point", "[[2,2],[3,2]]", "[[2,2]]", ": /joints/1/distance: expected two points"},
        Bad{"points_together", "[[2,2],[3,2]]", "[[2,2],[2.004,2]]",
            ": /joints/1/distance: expected two points that are from 0.005 to "},
        Bad{"no_length", "\"length\": 1.5", "\"length\": 0", ": /joints/1/length: expected a number from 0.005 to "},
        Bad{"damping_of_a_rod", "\"length\": 1.5", "\"damping\": 1",
            ": /joints/1/damping: expected only beside \"stiffness\""},
        Bad{"no_stiffness", "1000", "0", ": /joints/0/stiffness: expected a number greater than 0"},
        Bad{"too_stiff", "1000", "2e12", ": /joints/0/stiffness: expected at most "},
        Bad{"driving_damping", "\"damping\": 2", "\"damping\": -2",
            ": /joints/0/damping: expected a number from 0 to "},
        Bad{"stiff_rail", "\"prismatic\": [0, 1]", "\"prismatic\": [0, 1], \"stiffness\": 3",
            ": /joints/2/stiffness: expected only beside \"distance\""},
        Bad{"no_direction", "\"prismatic\": [0, 1]", "\"prismatic\": [0, 0]",
            ": /joints/2/prismatic: expected a direction"},
        Bad{"id_twice", "\"id\": \"pin\"", "\"id\": \"crate\"",
            ": /joints/3/id: expected an id of its own; \"crate\" is taken"}),
    [](const testing::TestParamInfo<Bad>& bad) { return bad.param.what; });

}  // namespace
}  // namespace paperproof::compare
