/// Runs over levels of pixels.
#include "compare/png_files.hpp"
#include "compare/scene_runs.hpp"
#include "compare/tile_levels.hpp"
#include "runs/contestant.hpp"

#include <algorithm>

namespace paperproof::compare {
namespace {

constexpr std::array drawn{"pixel_colour", "pixel_tile", "mask"};

std::string scene_over(const std::string& floor, double pixels_per_metre) {
  return R"({ "paperproof_scene": 1, "name": "fine", "gravity": [0, -30], "dt": 0.015625, "steps": 20,
              "pixels_per_metre": )" +
         std::to_string(pixels_per_metre) + R"(, "character": { "position": [0.1, 0.1] }, "scenery": [ )" + floor +
         " ] }";
}

TEST(PictureRuns, are_not_drawn_with_fewer_pixels_than_the_picture_has) {
  const SceneFiles files;
  PngFile line{.width = 400, .height = 1};
  line.samples.assign(400, 255);
  files.write("line.png", line.bytes());
  const auto run = [&](const std::string& floor, double pixels_per_metre) {
    return run_scene(files.load("fine.json", scene_over(floor, pixels_per_metre)), quick());
  };
  const std::string picture = R"({ "picture": "line.png" })";
  const ReportScene too_fine = run(picture, 2000);
  const ReportScene fine = run(picture, 1000);
  const ReportScene vectors = run(R"({ "polygon": [[0,-0.1],[0.2,-0.1],[0.2,0],[0,0]] })", 2000);
  for (const std::string name : drawn) {
    EXPECT_EQ(row_of(too_fine, name).verdict, Verdict::not_applicable) << name;
    EXPECT_EQ(row_of(too_fine, name).reason,
              name + " draws at most 1000 pixels per metre, and the scene's pixels are 2000 to the metre");
    EXPECT_EQ(row_of(fine, name).steps, 20) << name << ": " << row_of(fine, name).reason;
    EXPECT_EQ(row_of(vectors, name).verdict, Verdict::holds) << name << ": there the resolution is a knob";
  }
  RunOptions coarse = quick();
  coarse.knobs = {parse_knob("raster_pixels_per_metre=500")};
  const Scene scene = files.load("fine.json", scene_over(picture, 2000));
  EXPECT_EQ(row_of(run_scene(scene, coarse), "mask").steps, 20) << "who turns the knob has been asked";
  EXPECT_EQ(row_of(too_fine, "wind_back").steps, 20) << "it draws nothing";
  EXPECT_EQ(row_of(too_fine, "octagon_sweep").verdict, Verdict::holds);
}

/// The article's character is 20 px wide and 40 px high; its feet are in the sixth and the fifteenth of its columns.
constexpr int right_foot = 14;
constexpr int left_foot = 5;
constexpr int right_arm = 19;

/// Where the character is whose sprite has its lower left pixel there [m].
Vec2d place_of(int column, int row) { return Vec2d(column + 10, row + 20) / 32; }

/// A scene over `level.json`, without gravity: velocity alone says where it goes, 2 m/s is a pixel in each step.
std::string tile_scene(int column, int row, double velocity, const std::string& more = "") {
  const Vec2d at = place_of(column, row);
  return R"({ "paperproof_scene": 1, "name": "tiles", "gravity": [0, 0], "dt": 0.015625, "steps": 60, "character": {
              "position": [)" +
         std::to_string(at.x()) + ", " + std::to_string(at.y()) + R"(], "velocity": [)" + std::to_string(velocity) +
         R"(, 0] }, "scenery": [ { "id": "level", "pixel_tiles": "level.json" })" + more + " ] }";
}

/// Steps the contender through a scene by itself.
class Stepped {
 public:
  Stepped(const Scene& scene, std::string_view contender)
      : scene_(scene),
        scenery_(scene_.scenery),
        contestant_(make_contestant(contender, ScalarKind::binary64, scene_, scenery_)) {}

  /// @returns where it is then.
  Pose step(const Input& input = {}) {
    const std::array players{input};
    contestant_->step_unrecorded({.dt = scene_.dt, .players = players, .movers = {}, .turns = {}, .gravity = scene_.gravity});
    return contestant_->pose();
  }

 private:
  Scene scene_;
  Scenery<double> scenery_;
  std::unique_ptr<Contestant> contestant_;
};

TEST(TileFileRuns, go_up_and_down_a_slope_by_what_its_tiles_say) {
  const SceneFiles files;
  files.write("level.json", hill_of_tiles);
  for (const int way : {1, -1}) {
    const int start = way > 0 ? -40 : 27;
    const auto ground = [](int column) { return hill_top(column + right_foot) + 1; };  // the higher of the two feet
    Stepped run(files.load("scene.json", tile_scene(start, ground(start), 2 * way)), "pixel_tile");
    for (int step = 1; step <= 67; ++step) {
      const int column = start + way * step;
      ASSERT_EQ(run.step().position, place_of(column, ground(column))) << "way " << way << ", step " << step;
    }
  }
}

TEST(TileFileRuns, are_those_of_the_generated_tiles_bit_for_bit) {
  const SceneFiles files;
  files.write("level.json", hill_of_tiles);
  Scene written = files.load("scene.json", tile_scene(-20, 8, 0));
  written.gravity = {0, -30};
  written.character.walk_speed = 1;  // or it would be past the end of the ground at once
  written.character.jump_speed = 4;
  Scene generated = written;
  generated.tile_level = {};
  int grounded = 0;
  int lifted = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const std::vector<InputEvent> events = random_input(seed, 120);
    Stepped from_file(written, "pixel_tile");
    Stepped from_scenery(generated, "pixel_tile");
    for (int step = 0; step < 120; ++step) {
      const Input input = input_at(events, step);
      const Pose one = from_file.step(input);
      const Pose other = from_scenery.step(input);
      ASSERT_EQ(one.position, other.position) << "seed " << seed << ", step " << step;
      ASSERT_EQ(one.velocity, other.velocity) << "seed " << seed << ", step " << step;
      ASSERT_EQ(one.grounded, other.grounded) << "seed " << seed << ", step " << step;
      grounded += one.grounded ? 1 : 0;
      lifted += one.grounded && one.position.y() > place_of(0, 8).y() ? 1 : 0;
    }
  }
  EXPECT_GT(grounded, 800) << "of 2400";
  EXPECT_GT(lifted, 100) << "on the slope or behind it";
}

TEST(TileFileRuns, stop_at_a_slope_whose_tiles_only_block) {
  const SceneFiles files;
  std::string blocking = hill_of_tiles;
  std::replace(blocking.begin() + static_cast<std::ptrdiff_t>(blocking.find("\"/\"")),
               blocking.begin() + static_cast<std::ptrdiff_t>(blocking.find("\"a\"")), 'R', '#');
  files.write("level.json", blocking);
  Stepped run(files.load("scene.json", tile_scene(-40, 8, 2)), "pixel_tile");
  for (int step = 1; step <= 67; ++step) {
    const int column = std::min(-40 + step, 15 - right_foot);  // 16 is the slope's first
    ASSERT_EQ(run.step().position, place_of(column, 8)) << step;
  }
}

/// Level ground in tiles of 8 px, 8 px high from column -64 to 63, and a tile "x" above it at columns 0 to 7, `rows`
/// tiles up.
std::string with_one_tile(const std::string& pixels, const std::vector<bool>& rows) {
  std::string map;
  for (const bool here : rows) map += here ? R"("........x.......", )" : R"("................", )";
  return R"({ "paperproof_pixel_tiles": 1, "pixels_per_tile": 8, "at": [-8, )" + std::to_string(rows.size() + 1) +
         R"(], "map": [)" + map + R"("################"], "tiles": { "x": [)" + pixels +
         R"(], "#": ["########", "########", "########", "########", "########", "########", "########", "########"] } })";
}

std::string eight_rows(const std::string& row) {
  std::string all;
  for (int i = 0; i < 8; ++i) all += (i > 0 ? ", \"" : "\"") + row + "\"";
  return all;
}

TEST(TileFileRuns, climb_a_step_from_the_side_from_which_its_tile_takes_them_up) {
  const SceneFiles files;
  std::string ledge = eight_rows("........");
  ledge.replace(ledge.rfind("........"), 8, "LLLLLLLL");  // one pixel high
  files.write("level.json", with_one_tile(ledge, {true}));
  Stepped to_the_left(files.load("scene.json", tile_scene(20, 8, -2)), "pixel_tile");
  Stepped to_the_right(files.load("scene.json", tile_scene(-40, 8, 2)), "pixel_tile");
  for (int step = 1; step <= 50; ++step) {
    const int column = 20 - step;
    ASSERT_EQ(to_the_left.step().position, place_of(column, column + left_foot <= 7 ? 9 : 8)) << step;
    ASSERT_EQ(to_the_right.step().position, place_of(std::min(-40 + step, -1 - right_foot), 8)) << step;
  }
}

TEST(TileFileRuns, are_taken_down_by_air_that_says_so_and_only_in_its_direction) {
  const SceneFiles files;
  files.write("level.json",
              with_one_tile(eight_rows("rrrrrrrr"), {true, true, false, false, false}));  // 32 to 47 px up
  Stepped to_the_right(files.load("scene.json", tile_scene(-30, 47, 2)), "pixel_tile");
  Stepped to_the_left(files.load("scene.json", tile_scene(10, 47, -2)), "pixel_tile");
  for (int step = 1; step <= 45; ++step) {
    // One down for each of the tiles' eight columns that a foot enters, first the right one and later the left one.
    const int column = -30 + step;
    const int entered = std::clamp(column + right_foot + 1, 0, 8) + std::clamp(column + left_foot + 1, 0, 8);
    ASSERT_EQ(to_the_right.step().position, place_of(column, 47 - entered)) << step;
    ASSERT_EQ(to_the_left.step().position, place_of(10 - step, 47)) << step;
  }
}

TEST(TileFileRuns, pass_what_a_tile_leaves_free_and_nothing_else) {
  const SceneFiles files;
  files.write("wall.json", with_one_tile(eight_rows("########"), {true, true, true}));
  files.write("gap.json", with_one_tile(eight_rows("........"), {true, true, true}));
  const auto scene = [&](const std::string& level) {
    return files.load("scene.json", with(tile_scene(-40, 8, 2), "level.json", level));
  };
  for (const std::string name : drawn) {
    Stepped blocked(scene("wall.json"), name);
    Stepped free(scene("gap.json"), name);
    for (int step = 1; step <= 60; ++step) {
      ASSERT_EQ(blocked.step().position, place_of(std::min(-40 + step, -1 - right_arm), 8))
          << name << ", step " << step;
      ASSERT_EQ(free.step().position, place_of(-40 + step, 8)) << name << ", step " << step;
    }
  }
}

TEST(TileFileRuns, are_for_every_contender_and_pixel_tile_says_where_it_would_miss_something) {
  const SceneFiles files;
  files.write("level.json", hill_of_tiles);
  const ReportScene alone = run_scene(files.load("scene.json", tile_scene(-40, 8, 2)), quick());
  for (const Row& row : alone.rows) {
    EXPECT_EQ(row.verdict == Verdict::not_applicable, row.contender == "grid") << row.contender << ": " << row.reason;
    EXPECT_NE(row.verdict, Verdict::failed) << row.contender << ": " << row.reason;
  }
  EXPECT_EQ(row_of(alone, "octagon_sweep").verdict, Verdict::holds);
  EXPECT_EQ(row_of(alone, "pixel_tile").steps, 60);
  const auto beside = [&](const std::string& more) {
    RunOptions options = quick();
    options.contenders = {"pixel_tile"};
    return row_of(run_scene(files.load("scene.json", tile_scene(-40, 8, 2, more)), options), "pixel_tile");
  };
  const std::string block = R"({ "polygon": [[1,1],[2,1],[2,2]])";
  EXPECT_EQ(beside(", " + block + R"(, "sensor": true })").steps, 60) << "it is in nobody's way";
  const Row missed = beside(", " + block + "}");
  EXPECT_EQ(missed.verdict, Verdict::not_applicable);
  EXPECT_EQ(missed.reason,
            "pixel_tile sees the tiles of the scene's file alone, and 1 collider is in the way beside them");
}

TEST(TileFileRuns, have_the_pixels_of_the_file_whatever_a_knob_says) {
  const SceneFiles files;
  files.write("level.json", hill_of_tiles);
  const Scene scene = files.load("scene.json", tile_scene(-40, 8, 2));
  RunOptions options = quick();
  options.contenders = {"pixel_tile", "mask"};
  for (const std::string name : {"raster_pixels_per_metre", "pixels_per_tile"}) {
    options.knobs = {parse_knob(name + "=16")};
    const ReportScene result = run_scene(scene, options);
    EXPECT_EQ(row_of(result, "pixel_tile").reason,
              "pixel_tile has its tiles from the scene's file, where " + name + " is no knob");
    EXPECT_EQ(row_of(result, "mask").steps, 60) << "it draws the solid pixels";
  }
}

}  // namespace
}  // namespace paperproof::compare
