/// Runs over levels of pixels.
#include "compare/png_files.hpp"
#include "compare/scene_runs.hpp"

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
  EXPECT_EQ(row_of(too_fine, "wind_back").steps, 20) << "it draws nothing";
  EXPECT_EQ(row_of(too_fine, "octagon_sweep").verdict, Verdict::holds);
}

}  // namespace
}  // namespace paperproof::compare
