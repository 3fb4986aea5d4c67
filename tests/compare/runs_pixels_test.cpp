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
    contestant_->step_unrecorded(
        {.dt = scene_.dt, .players = players, .movers = {}, .turns = {}, .gravity = scene_.gravity});
    return contestant_->pose();
  }

 private:
  Scene scene_;
  Scenery<double> scenery_;
  std::unique_ptr<Contestant> contestant_;
};

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
      ASSERT_TRUE(one.position == other.position && one.velocity == other.velocity && one.grounded == other.grounded)
          << "seed " << seed << ", step " << step;
      grounded += one.grounded ? 1 : 0;
      lifted += one.grounded && one.position.y() > place_of(0, 8).y() ? 1 : 0;
    }
  }
  EXPECT_GT(grounded, 800) << "of 2400";
  EXPECT_GT(lifted, 100) << "on the slope or behind it";
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
