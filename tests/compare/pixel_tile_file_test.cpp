/// Files of tiles whose pixels say what a collision does.
#include "scenes/pixel_tile_file.hpp"

#include "compare/scene_files.hpp"
#include "compare/tile_levels.hpp"
#include "scenes/describe.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

std::string scene_with_tiles(const std::string& scenery, double pixels_per_metre = 32) {
  return R"({ "paperproof_scene": 1, "name": "tiles", "gravity": [0, -30], "dt": 0.0078125, "steps": 120,
              "pixels_per_metre": )" +
         std::to_string(pixels_per_metre) + R"(, "character": { "position": [-300, 300] }, "scenery": [ )" + scenery +
         " ] }";
}

const std::string names_level = R"({ "id": "level", "pixel_tiles": "level.json" })";

/// A tile of two by two pixels with the given rows, once, at the origin.
std::string one_tile(const std::string& upper, const std::string& lower) {
  return R"({ "paperproof_pixel_tiles": 1, "pixels_per_tile": 2, "tiles": { "x": [")" + upper + "\", \"" + lower +
         R"("] }, "map": ["x"] })";
}

TEST(PixelTileFile, has_a_letter_for_everything_that_a_pixel_may_do) {
  using enum PixelAction;
  const SceneFiles files;
  const auto read = [&](const std::string& upper, const std::string& lower) {
    return read_pixel_tiles(files.write("level.json", one_tile(upper, lower)), "level.json");
  };
  const PixelTileSet solid = read("#L", "RB");
  EXPECT_EQ(solid.at(0, -1), (PixelCollision{.moving_left = block, .moving_right = block}));
  EXPECT_EQ(solid.at(1, -1), (PixelCollision{.moving_left = up, .moving_right = block}));
  EXPECT_EQ(solid.at(0, -2), (PixelCollision{.moving_left = block, .moving_right = up}));
  EXPECT_EQ(solid.at(1, -2), (PixelCollision{.moving_left = up, .moving_right = up}));
  const PixelTileSet free = read("#l", "rb");
  EXPECT_EQ(free.at(1, -1), (PixelCollision{.moving_left = down, .moving_right = nothing}));
  EXPECT_EQ(free.at(0, -2), (PixelCollision{.moving_left = nothing, .moving_right = down}));
  EXPECT_EQ(free.at(1, -2), (PixelCollision{.moving_left = down, .moving_right = down}));
  EXPECT_EQ(read("#.", "..").at(1, -1), PixelCollision{});
  for (const auto& [x, y] : {std::pair{-1, -1}, std::pair{2, -1}, std::pair{0, 0}, std::pair{0, -3}})
    EXPECT_EQ(solid.at(x, y), PixelCollision{}) << "outside is nothing";
}

TEST(PixelTileFile, of_a_hill_says_what_is_generated_from_its_solid_pixels) {
  const SceneFiles files;
  files.write("level.json", hill_of_tiles);
  const Scene scene = files.load("scene.json", scene_with_tiles(names_level));
  ASSERT_NE(scene.tile_level.tiles, nullptr);
  const PixelTileSet& written = *scene.tile_level.tiles;
  written.validate();
  const PixelTileSet generated = make_pixel_tiles(scene.scenery, 32, 32);
  int marked = 0;
  for (int y = -10; y < 40; ++y) {
    for (int x = -60; x < 60; ++x) {
      ASSERT_EQ(written.at(x, y), generated.at(x, y)) << x << ' ' << y;
      const bool inside = x >= -48 && x < 48 && y >= 0 && y <= hill_top(x);
      ASSERT_EQ(written.at(x, y).is_solid(), inside) << x << ' ' << y;
      marked += written.at(x, y).moving_left != written.at(x, y).moving_right ? 1 : 0;
    }
  }
  EXPECT_EQ(marked, 16 + 16) << "up and down on the slope's 16 columns";
}

TEST(PixelTileFile, becomes_scenery_as_a_picture_does) {
  const SceneFiles files;
  files.write("level.json", hill_of_tiles);
  const Scene scene = files.load("scene.json", scene_with_tiles(names_level, 4));
  EXPECT_TRUE(scene.has_pixels);
  EXPECT_EQ(scene.tile_level.colliders, scene.scenery.colliders.size());
  ASSERT_EQ(scene.ids.size(), 17U) << "a row for each of the slope's pixels, and the ground";
  EXPECT_EQ(scene.ids.front(), "level/79,8");
  EXPECT_EQ(scene.ids.back(), "level/0,24");
  EXPECT_EQ(scene.scenery.colliders.front().points[2], Vec2d(12, 6)) << "the plateau's right end";
  EXPECT_EQ(scene.scenery.colliders.back().points[0], Vec2d(-12, 0));
  ASSERT_TRUE(scene.respawn_box.has_value());
  EXPECT_EQ(scene.respawn_box->lower, Vec2d(-12, 0));
  EXPECT_EQ(scene.respawn_box->upper, Vec2d(12, 8));
  EXPECT_TRUE(holds(describe(scene), "5 types of 8 x 8 px, 12 x 4 in the map"));
}

TEST(PixelTileFile, lies_with_its_upper_left_corner_at_the_origin_unless_it_says_where) {
  const SceneFiles files;
  const auto box = [&](const std::string& text) {
    files.write("level.json", text);
    return files.load("scene.json", scene_with_tiles(names_level, 2)).respawn_box.value();
  };
  const std::string tile = one_tile("##", "##");
  EXPECT_EQ(box(tile).lower, Vec2d(0, -1));
  EXPECT_EQ(box(tile).upper, Vec2d(1, 0));
  const std::string placed = with(tile, R"("map")", R"("at": [3, -5], "map")");
  EXPECT_EQ(box(placed).lower, Vec2d(3, -6));
  EXPECT_EQ(box(placed).upper, Vec2d(4, -5));
}

TEST(PixelTileFile, that_cannot_be_used_is_refused_in_one_line_with_the_place) {
  const SceneFiles files;
  const std::string good = one_tile("##", "#.");
  const auto complaint = [&](const std::string& from, const std::string& to) {
    files.write("level.json", with(good, from, to));
    return files.complaint("scene.json", scene_with_tiles(names_level));
  };
  const std::string start = ": /scenery/0/pixel_tiles: level.json: ";
  const auto expect = [&](const std::string& from, const std::string& to, const std::string& said) {
    EXPECT_EQ(complaint(from, to), start + said);
  };
  expect(R"("##")", R"("#")", "/tiles/x/0: expected a row of 2 characters of ASCII, not 1");
  expect(R"("##")", R"("#\u00e9")", "/tiles/x/0: expected a row of 2 characters of ASCII, not 3");
  expect(R"("##")", R"("#?")", "/tiles/x/0: expected pixels from . # L R B l r b; number 2 is none of them");
  expect(R"("##")", "12", "/tiles/x/0: expected a text that is not empty and has no control characters");
  expect(R"("##", )", "", "/tiles/x: expected 2 rows, one for each pixel, not 1");
  expect(R"("x":)", R"("xy":)",
         "/tiles/xy: expected a tile named by one character of ASCII, and not by '.', which is no tile");
  expect(R"("x":)", R"(".":)",
         "/tiles/.: expected a tile named by one character of ASCII, and not by '.', which is no tile");
  expect(R"(["x"])", R"(["x", "xx"])", "/map/1: expected a row of 1 characters of ASCII, not 2");
  expect(R"(["x"])", R"([".y"])", "/map/0: expected names of tiles, and '.' for none; number 2 is neither");
  expect(R"(["x"])", "[]", "/map: expected at least one row of tiles");
  expect(R"(["x"])", R"(["."])", "/map: expected a solid pixel; no tile here has one");
  expect(R"("map")", R"("at": [0.5, 0], "map")", "/at/0: expected a whole number from -100000 to 100000");
  expect(R"("map")", R"("at": [1], "map")", "/at: expected two whole numbers, [column, row]");
  expect(R"("map": ["x"])", R"("maps": 1)",
         "/maps: unknown key; expected one of $schema, paperproof_pixel_tiles, description, pixels_per_tile, tiles, "
         "map, at");
  expect(R"(_tiles": 1)", R"(_tiles": 2)", "/paperproof_pixel_tiles: expected 1, the version of the format");
  expect(R"(_tile": 2)", R"(_tile": 0)", "/pixels_per_tile: expected a whole number from 1 to 4096");
  EXPECT_TRUE(begins(complaint("]", "}"), start.substr(0, start.size() - 2) + ":1:"));
  const auto repeated = [](int times, const std::string& text) {
    std::string all = text;
    for (int i = 1; i < times; ++i) all += ", " + text;
    return "[" + all + "]";
  };
  std::string large = with(good, R"(["##", "#."])", repeated(64, '"' + std::string(64, '#') + '"'));
  large = with(large, R"(_tile": 2)", R"(_tile": 64)");
  files.write("level.json", with(large, R"(["x"])", repeated(129, '"' + std::string(128, 'x') + '"')));
  EXPECT_EQ(files.complaint("scene.json", scene_with_tiles(names_level)),
            start + "/map: expected a map of at most 67108864 pixels, not 8192 x 8256");
}

TEST(PixelTileFile, stands_in_a_scene_once_and_by_itself) {
  const SceneFiles files;
  files.write("level.json", one_tile("##", "##"));
  const auto complaint = [&](const std::string& entry) {
    return files.complaint("scene.json", scene_with_tiles(entry));
  };
  EXPECT_EQ(complaint(names_level + R"(, { "pixel_tiles": "level.json" })"),
            ": /scenery/1/pixel_tiles: expected one file of tiles in a scene; this is the second");
  EXPECT_EQ(complaint(R"({ "pixel_tiles": "none.json" })"),
            ": /scenery/0/pixel_tiles: none.json: expected a file that exists; there is none");
  EXPECT_EQ(complaint(R"({ "pixel_tiles": "level.json", "solid": 1 })"),
            ": /scenery/0/solid: expected only beside \"picture\"");
  EXPECT_EQ(complaint(R"({ "pixel_tiles": "level.json", "sensor": true })"),
            ": /scenery/0/sensor: expected only beside \"polygon\", \"chain\" or \"circle\"");
  EXPECT_EQ(complaint(R"({ "pixel_tiles": "level.json", "picture": "a.png" })"),
            ": /scenery/0: expected exactly one shape; here are \"picture\" and \"pixel_tiles\"");
}

}  // namespace
}  // namespace paperproof::compare
