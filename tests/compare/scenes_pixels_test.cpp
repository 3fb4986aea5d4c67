/// Levels of pixels: pictures, and tiles whose pixels say what a collision does.
#include "scenes/picture.hpp"
#include "scenes/pixel_tile_file.hpp"

#include "campaign/random.hpp"
#include "compare/png_files.hpp"
#include "compare/scene_files.hpp"
#include "compare/tile_levels.hpp"
#include "scenes/describe.hpp"

#include <cmath>
#include <map>
#include <set>

namespace paperproof::compare {
namespace {

using Picture = SceneFilesTest;
using PixelTileFile = SceneFilesTest;

/// White, black, grass, glass, and glass that is frosted.
const std::map<char, Rgba> colours{{'#', {255, 255, 255, 255}},
                                   {'.', {0, 0, 0, 255}},
                                   {'g', {0x20, 0xc0, 0x40, 255}},
                                   {'/', {255, 255, 255, 127}},
                                   {':', {255, 255, 255, 128}}};

/// Of a drawing in letters, one for each pixel.
std::string png_of(const std::vector<std::string>& rows) {
  PngFile file{.colour = PngColour::rgb_alpha, .width = int(rows[0].size()), .height = int(rows.size())};
  for (const std::string& row : rows) {
    for (const char letter : row) {
      const Rgba& colour = colours.at(letter);
      file.samples.insert(file.samples.end(), colour.begin(), colour.end());
    }
  }
  return file.bytes();
}

/// One row of four pixels, with the indices 0 to 3. Entries 1 and 2 look the same, and entry 3 is glass.
std::string four_entries() {
  const std::string palette =
      png_chunk("PLTE", std::string("\0\0\0ggggggwww", 12)) + png_chunk("tRNS", "\xff\xff\xff\x10");
  return PngFile{PngColour::indexed, 2, false, 4, 1, {0, 1, 2, 3}, palette}.bytes();
}

/// @param entry of the scenery, in ' for ".
std::string scene_with(const std::string& entry, double pixels_per_metre = 32) {
  return R"({ "paperproof_scene": 1, "name": "drawn", "gravity": [0, -30], "dt": 0.0078125, "steps": 120,
              "pixels_per_metre": )" +
         std::to_string(pixels_per_metre) + R"(, "character": { "position": [-300, 300] }, "scenery": [ )" +
         quoted(entry) + " ] }";
}

TEST_F(Picture, becomes_rectangles_of_its_solid_pixels) {
  files.write("level.png", png_of({"........",  //
                                   ".##..###",  //
                                   ".##..###",  //
                                   "#####..."}));
  const Scene scene = files.load("drawn.json", scene_with("{ 'id': 'level', 'picture': 'level.png' }", 4));
  EXPECT_EQ(solids_of(scene),
            "level/1,1: box 0.25 -0.75 0.75 -0.25; level/5,1: box 1.25 -0.75 2 -0.25; level/0,3: box 0 -1 1.25 -0.75");
  EXPECT_EQ(scene.respawn_box->lower, Vec2d(0, -1));
  EXPECT_EQ(scene.respawn_box->upper, Vec2d(2, 0));
}

std::set<std::pair<int, int>> pixels_of(const Scene& scene, double pixels_per_metre) {
  std::set<std::pair<int, int>> pixels;
  for (const ColliderDef& collider : scene.scenery.colliders) {
    const Vec2d lower = collider.points[0] * pixels_per_metre;
    const Vec2d upper = collider.points[2] * pixels_per_metre;
    for (double y = lower.y() + 0.5; y < upper.y(); ++y)
      for (double x = lower.x() + 0.5; x < upper.x(); ++x)
        EXPECT_TRUE(pixels.insert({int(std::floor(x)), int(-std::ceil(y))}).second)
            << "two rectangles have the pixel " << x << ' ' << y;
  }
  return pixels;
}

TEST_F(Picture, has_each_solid_pixel_in_exactly_one_rectangle_that_shares_its_bits_with_neighbours) {
  constexpr std::uint64_t seed = 12;
  Random random(seed);
  for (int i = 0; i < 30; ++i) {
    std::vector<std::string> rows(24, std::string(40, '.'));
    std::set<std::pair<int, int>> expected;
    for (int row = 0; row < 24; ++row) {
      for (int column = 0; column < 40; ++column) {
        if (random.chance(0.25)) continue;
        rows[std::size_t(row)][std::size_t(column)] = '#';
        expected.insert({column, row});
      }
    }
    files.write("level.png", png_of(rows));
    const double scale = 21.3;  // nothing is exact
    const Scene scene = files.load("drawn.json", scene_with("{ 'picture': 'level.png' }", scale));
    EXPECT_EQ(pixels_of(scene, scale), expected) << "seed " << seed << ", picture " << i;
    for (const ColliderDef& collider : scene.scenery.colliders) {
      for (const Vec2d& point : collider.points) {
        EXPECT_EQ(point.x(), std::round(point.x() * scale) / scale);
        EXPECT_EQ(point.y(), std::round(point.y() * scale) / scale);
        EXPECT_FALSE(std::signbit(point.x()));
        EXPECT_TRUE(point.y() != 0 || !std::signbit(point.y())) << "zero has one sign";
      }
    }
  }
}

TEST_F(Picture, is_solid_where_the_scene_says) {
  files.write("level.png", png_of({"#g./:"}));
  files.write("entries.png", four_entries());
  for (const auto& [entry, expected] : std::initializer_list<std::pair<std::string, std::set<int>>>{
           {"'level.png'", {0, 4}},  // white is solid, as in a mask; a pixel that is more than half transparent is air
           {"'level.png', 'solid': '#20C040'", {1}},
           {"'level.png', 'solid': '#000000'", {2}},
           {"'level.png', 'background': '#000000'", {0, 1, 4}},
           {"'level.png', 'background': '#ffffff'", {1, 2}},
           {"'entries.png', 'solid': '#676767'", {1, 2}},  // the two look alike
           {"'entries.png', 'solid': 0", {0}},
           {"'entries.png', 'solid': 1", {1}},
           {"'entries.png', 'solid': 2.0", {2}},
           {"'entries.png', 'background': 0", {1, 2}},  // glass never is
           {"'entries.png', 'background': 2", {0, 1}},
       }) {
    std::set<int> columns;
    const Scene scene = files.load("drawn.json", scene_with("{ 'picture': " + entry + " }"));
    for (const auto& [column, row] : pixels_of(scene, 32)) columns.insert(column);
    EXPECT_EQ(columns, expected) << entry;
  }
}

TEST_F(Picture, that_cannot_be_used_is_refused_in_one_line) {
  const std::string png = png_of({"#g./"});
  files.write("level.png", png);
  files.write("entries.png", four_entries());
  files.write("text.png", "This is no picture.");
  std::string spoilt = png;
  spoilt.replace(16, 8, std::string("\0\1\0\0\0\1\0\0", 8));  // 65536 x 65536, and the checksum does not fit
  files.write("spoilt.png", spoilt);
  files.write("huge.png", spoilt.substr(0, 8) + png_chunk("IHDR", spoilt.substr(16, 13)) + spoilt.substr(33));
  std::vector<std::string> chequers;  // each other pixel: 204,800 rectangles
  for (int row = 0; row < 640; ++row) {
    chequers.emplace_back(640, '.');
    for (std::size_t i = row % 2 == 0 ? 0 : 1; i < 640; i += 2) chequers.back()[i] = '#';
  }
  files.write("noise.png", png_of(chequers));
  const std::string no_colour =
      "/solid: expected a colour like '#00a0ff', or the index of one in the picture's palette";
  const std::string no_index = "/background: expected an index from 0 to 3, the last in the palette of entries.png";
  const auto expect_said = [&](const std::string& entry, const std::string& message) {
    // The message has ' in it, which is no quote.
    const std::string said = files.complaint("drawn.json", scene_with("{ 'picture': " + entry + " }"));
    EXPECT_TRUE(begins(quoted(said), quoted(": /scenery/0" + message))) << entry;
  };
  for (const std::string solid : {"'white'", "'#fff'", "'#00000g'", "'ffffff'", "'#ffffff0'"})
    expect_said("'level.png', 'solid': " + solid, no_colour);
  for (const std::string solid : {"true", "null", "[0]"}) expect_said("'entries.png', 'solid': " + solid, no_colour);
  for (const std::string index : {"4", "-1", "0.5", "256", "1e300"})
    expect_said("'entries.png', 'background': " + index, no_index);
  for (const auto& [entry, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {"'none.png'", "/picture: none.png: expected a file that exists; there is none"},
           {"'text.png'", "/picture: text.png: expected a PNG picture ("},
           {"'spoilt.png'", "/picture: spoilt.png: expected a PNG picture ("},
           {"'huge.png'", "/picture: huge.png: expected a picture of at most 67108864 pixels, not 65536 x 65536"},
           {"'noise.png'",
            "/picture: noise.png: expected a drawing; its solid pixels make more than 200000 rectangles"},
           {"'level.png', 'solid': '#123456'", "/picture: level.png: expected a solid pixel; none is #123456"},
           {"'entries.png', 'solid': 3",
            "/picture: entries.png: expected a solid pixel; none is colour 3 of the palette"},
           {"'level.png', 'solid': 0",
            "/solid: expected a colour like '#00a0ff': level.png has no palette for an index"},
           {"'level.png', 'solid': '#ffffff', 'background': '#000000'",
            "/background: expected one of 'solid' and 'background', not both"},
           {"'level.png', 'one_way': [0,1]", "/one_way: expected only beside 'polygon', 'chain' or 'circle'"},
           {"'level.png', 'tiled': 'a.tmx'", ": expected exactly one shape"}})
    expect_said(entry, message);
  EXPECT_EQ(files.complaint("drawn.json", scene_with("{ 'chain': [[0,0],[1,0]], 'solid': '#ffffff' }")),
            ": /scenery/0/solid: expected only beside \"picture\"");
}

const std::string names_level = "{ 'id': 'level', 'pixel_tiles': 'level.json' }";

/// A tile of two by two pixels with the given rows, once, at the origin.
std::string one_tile(const std::string& upper, const std::string& lower) {
  return R"({ "paperproof_pixel_tiles": 1, "pixels_per_tile": 2, "tiles": { "x": [")" + upper + "\", \"" + lower +
         R"("] }, "map": ["x"] })";
}

TEST_F(PixelTileFile, has_a_letter_for_everything_that_a_pixel_may_do) {
  using enum PixelAction;
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

TEST_F(PixelTileFile, of_a_hill_says_what_is_generated_from_its_solid_pixels_and_is_scenery_as_a_picture_is) {
  files.write("level.json", hill_of_tiles);
  const Scene scene = files.load("scene.json", scene_with(names_level));
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
  EXPECT_TRUE(scene.has_pixels);
  EXPECT_EQ(scene.tile_level.colliders, scene.scenery.colliders.size());
  ASSERT_EQ(scene.ids.size(), 17U) << "a row for each of the slope's pixels, and the ground";
  const std::string solids = solids_of(scene);
  EXPECT_TRUE(begins(solids, "level/79,8: box 0.96875 0.71875 1.5 0.75; ")) << "the plateau's top";
  EXPECT_TRUE(holds(solids, "; level/0,24: box -1.5 0 1.5 0.25"));
  EXPECT_EQ(scene.respawn_box->lower, Vec2d(-1.5, 0));
  EXPECT_EQ(scene.respawn_box->upper, Vec2d(1.5, 1));
  EXPECT_TRUE(holds(describe(scene), "5 types of 8 x 8 px, 12 x 4 in the map"));
}

TEST_F(PixelTileFile, lies_with_its_upper_left_corner_at_the_origin_unless_it_says_where) {
  const std::string tile = one_tile("##", "##");
  files.write("level.json", tile);
  EXPECT_EQ(solids_of(files.load("scene.json", scene_with(names_level, 2))), "level/0,0: box 0 -1 1 0");
  files.write("level.json", with(tile, R"("map")", R"("at": [3, -5], "map")"));
  EXPECT_EQ(solids_of(files.load("scene.json", scene_with(names_level, 2))), "level/0,0: box 3 -6 4 -5");
}

std::string repeated(int times, const std::string& text) {
  std::string all = "[" + text;
  for (int i = 1; i < times; ++i) all += ", " + text;
  return all + "]";
}

TEST_F(PixelTileFile, that_cannot_be_used_is_refused_in_one_line_with_the_place) {
  const std::string good = one_tile("##", "#.");
  const auto complaint = [&](const std::string& tiles, const std::string& entry = names_level) {
    files.write("level.json", tiles);
    return files.complaint("scene.json", scene_with(entry));
  };
  const std::string start = ": /scenery/0/pixel_tiles: level.json: ";
  const std::string no_name = ": expected a tile named by one character of ASCII, and not by '.', which is no tile";
  for (const auto& [from, to, said] : std::initializer_list<std::array<std::string, 3>>{
           {"'##'", "'#'", "/tiles/x/0: expected a row of 2 characters of ASCII, not 1"},
           {"'##'", "'#\\u00e9'", "/tiles/x/0: expected a row of 2 characters of ASCII, not 3"},
           {"'##'", "'#?'", "/tiles/x/0: expected pixels from . # L R B l r b; number 2 is none of them"},
           {"'##'", "12", "/tiles/x/0: expected a text that is not empty and has no control characters"},
           {"'##', ", "", "/tiles/x: expected 2 rows, one for each pixel, not 1"},
           {"'x':", "'xy':", "/tiles/xy" + no_name},
           {"'x':", "'.':", "/tiles/." + no_name},
           {"['x']", "['x', 'xx']", "/map/1: expected a row of 1 characters of ASCII, not 2"},
           {"['x']", "['.y']", "/map/0: expected names of tiles, and '.' for none; number 2 is neither"},
           {"['x']", "[]", "/map: expected at least one row of tiles"},
           {"['x']", "['.']", "/map: expected a solid pixel; no tile here has one"},
           {"'map'", "'at': [0.5, 0], 'map'", "/at/0: expected a whole number from -100000 to 100000"},
           {"'map'", "'at': [1], 'map'", "/at: expected two whole numbers, [column, row]"},
           {"'map'", "'maps'", "/maps: unknown key; expected one of $schema, paperproof_pixel_tiles, description, "},
           {"_tiles': 1", "_tiles': 2", "/paperproof_pixel_tiles: expected 1, the version of the format"},
           {"_tile': 2", "_tile': 0", "/pixels_per_tile: expected a whole number from 1 to 4096"}})
    EXPECT_TRUE(begins(complaint(with(good, quoted(from), quoted(to))), start + said));
  EXPECT_TRUE(begins(complaint(with(good, "]", "}")), start.substr(0, start.size() - 2) + ":1:"));
  std::string large = with(good, R"(["##", "#."])", repeated(64, '"' + std::string(64, '#') + '"'));
  large = with(large, R"(_tile": 2)", R"(_tile": 64)");
  EXPECT_EQ(complaint(with(large, R"(["x"])", repeated(129, '"' + std::string(128, 'x') + '"'))),
            start + "/map: expected a map of at most 67108864 pixels, not 8192 x 8256");
  for (const auto& [entry, said] : std::initializer_list<std::pair<std::string, std::string>>{
           {names_level + ", { 'pixel_tiles': 'level.json' }",
            "1/pixel_tiles: expected one file of tiles in a scene; this is the second"},
           {"{ 'pixel_tiles': 'none.json' }", "0/pixel_tiles: none.json: expected a file that exists; there is none"},
           {"{ 'pixel_tiles': 'level.json', 'solid': 1 }", "0/solid: expected only beside 'picture'"},
           {"{ 'pixel_tiles': 'level.json', 'sensor': true }",
            "0/sensor: expected only beside 'polygon', 'chain' or 'circle'"},
           {"{ 'pixel_tiles': 'level.json', 'picture': 'a.png' }",
            "0: expected exactly one shape; here are 'picture' and 'pixel_tiles'"}})
    EXPECT_EQ(complaint(good, entry), ": /scenery/" + quoted(said));
}

}  // namespace
}  // namespace paperproof::compare
