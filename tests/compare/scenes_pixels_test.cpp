/// Levels of pixels: pictures, and the hill of tiles whose pixels say what a collision does.
#include "scenes/picture.hpp"

#include "campaign/random.hpp"
#include "compare/png_files.hpp"
#include "compare/scene_files.hpp"
#include "scenes/describe.hpp"

#include <cmath>
#include <map>
#include <set>

namespace paperproof::compare {
namespace {

using Picture = SceneFilesTest;

/// White, black, grass, glass, and glass that is frosted.
const std::map<char, Rgba> colours{{'#', {255, 255, 255, 255}},
                                   {'.', {0, 0, 0, 255}},
                                   {'g', {0x20, 0xc0, 0x40, 255}},
                                   {'/', {255, 255, 255, 127}},
                                   {':', {255, 255, 255, 128}}};

/// Of a drawing in letters, one for each pixel.
std::string png_of(const std::vector<std::string>& rows) {
  PngFile file{.colour = LCT_RGBA, .width = int(rows[0].size()), .height = int(rows.size())};
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
  return PngFile{LCT_PALETTE,
                 2,
                 false,
                 4,
                 1,
                 {0, 1, 2, 3},
                 {{0, 0, 0, 255}, {103, 103, 103, 255}, {103, 103, 103, 255}, {119, 119, 119, 16}}}
      .bytes();
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
  const std::string no_colour = "/solid: expected a colour like #00a0ff, or the index of one in the picture's palette";
  const auto expect_said = [&](const std::string& entry, const std::string& message) {
    // The message has ' in it, which is no quote.
    const std::string said = files.complaint("drawn.json", scene_with("{ 'picture': " + entry + " }"));
    EXPECT_TRUE(begins(quoted(said), quoted(": /scenery/0" + message))) << entry;
  };
  for (const std::string solid : {"'white'", "'#fff'", "'#00000g'", "'ffffff'", "'#ffffff0'"})
    expect_said("'level.png', 'solid': " + solid, no_colour);
  for (const std::string solid : {"true", "null", "[0]", "0.5", "1e300"})
    expect_said("'entries.png', 'solid': " + solid,
                "/solid: expected a text or a whole number, not " + solid.substr(0, 2));
  for (const std::string index : {"-1", "256"})
    expect_said("'entries.png', 'background': " + index, "/background: expected 0 to 255, not " + index);
  for (const auto& [entry, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {"'none.png'", "/picture: none.png: expected a file that exists; there is none"},
           {"'text.png'", "/picture: text.png: expected a PNG picture ("},
           {"'spoilt.png'", "/picture: spoilt.png: expected a PNG picture ("},
           {"'huge.png'", "/picture: huge.png: expected a picture of at most 67108864 pixels, not 65536 x 65536"},
           {"'noise.png'",
            "/picture: noise.png: expected a drawing; its solid pixels make more than 200000 rectangles"},
           {"'entries.png', 'background': 4",
            "/background: expected an index from 0 to 3, the last in the palette of entries.png"},
           {"'level.png', 'solid': '#123456'", "/picture: level.png: expected a solid pixel; none is #123456"},
           {"'entries.png', 'solid': 3",
            "/picture: entries.png: expected a solid pixel; none is colour 3 of the palette"},
           {"'level.png', 'solid': 0",
            "/solid: expected a colour like '#00a0ff': level.png has no palette for an index"},
           {"'level.png', 'solid': '#ffffff', 'background': '#000000'",
            ": expected solid or background, and not both, not {'picture'"},
           {"'level.png', 'one_way': [0,1]", "/one_way: unknown key; expected one of id, picture, solid or background"},
           {"'level.png', 'tiled': 'a.tmx'",
            ": expected exactly one of polygon, chain, circle, tiled, picture, decoration; here are tiled, picture"}})
    expect_said(entry, message);
  EXPECT_EQ(files.complaint("drawn.json", scene_with("{ 'chain': [[0,0],[1,0]], 'solid': '#ffffff' }")),
            ": /scenery/0/solid: unknown key; expected one of id, chain, one_way, sensor or surface_speed");
}

TEST(PixelHill, is_solid_where_its_tiles_are_and_says_of_itself_what_is_generated_from_the_solid_pixels) {
  const Scene scene = load_scene("pixel_hill", {});
  ASSERT_NE(scene.tiles, nullptr);
  const PixelTileSet generated = make_pixel_tiles(scene.scenery, 32, 32);
  int marked = 0;
  for (int y = -40; y < 80; ++y) {
    for (int x = -110; x < 210; ++x) {
      ASSERT_EQ(scene.tiles->at(x, y), generated.at(x, y)) << x << ' ' << y;
      marked += generated.at(x, y).moving_left != generated.at(x, y).moving_right ? 1 : 0;
    }
  }
  EXPECT_EQ(marked, 32 + 32) << "up and down on the slope's 32 columns";
  EXPECT_TRUE(scene.has_pixels);
  EXPECT_TRUE(holds(describe(scene), "4 types of 32 x 32 px, 9 x 3 in the map"));
}

}  // namespace
}  // namespace paperproof::compare
