/// Runs over levels of pixels.
#include "compare/png_files.hpp"
#include "compare/scene_runs.hpp"

namespace paperproof::compare {
namespace {

constexpr std::array drawn{"pixel_colour", "pixel_tile", "mask"};

std::string scene_over(int pixels_per_metre) {
  return R"({ "paperproof_scene": 1, "name": "fine", "gravity": [0, -30], "dt": 0.015625, "steps": 20,
              "character": { "position": [0.1, 0.1] }, "scenery": [ { "picture": "line.png" } ], "pixels_per_metre": )" +
         std::to_string(pixels_per_metre) + "}";
}

TEST(PictureRuns, are_not_drawn_with_fewer_pixels_than_the_picture_has) {
  const SceneFiles files;
  PngFile line{.width = 400, .height = 1};
  line.samples.assign(400, 255);
  files.write("line.png", line.bytes());
  const Scene scene = files.load("fine.json", scene_over(2000));
  const ReportScene too_fine = run_scene(scene, quick());
  const ReportScene fine = run_scene(files.load("fine.json", scene_over(1000)), quick());
  for (const std::string name : drawn) {
    EXPECT_EQ(row_of(too_fine, name).verdict, Verdict::not_applicable) << name;
    EXPECT_EQ(row_of(too_fine, name).reason,
              name + " draws at most 1000 pixels per metre, and the scene's pixels are 2000 to the metre");
    EXPECT_EQ(row_of(fine, name).steps, 20) << name << ": " << row_of(fine, name).reason;
  }
  RunOptions coarse = quick();
  coarse.knobs = {parse_knob("raster_pixels_per_metre=500")};
  EXPECT_EQ(row_of(run_scene(scene, coarse), "mask").steps, 20) << "who turns the knob has been asked";
  EXPECT_EQ(row_of(too_fine, "wind_back").steps, 20) << "it draws nothing";
  EXPECT_EQ(row_of(too_fine, "octagon_sweep").verdict, Verdict::holds);
}

}  // namespace
}  // namespace paperproof::compare
