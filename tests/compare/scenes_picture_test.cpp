/// Pictures as levels.
#include "scenes/picture.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "png_files.hpp"
#include "scene_files.hpp"

namespace paperproof::compare {
namespace {

constexpr Rgba white{255, 255, 255, 255};
constexpr Rgba black{0, 0, 0, 255};
constexpr Rgba grass{0x20, 0xc0, 0x40, 255};
constexpr Rgba glass{255, 255, 255, 127};
constexpr Rgba frosted{255, 255, 255, 128};

/// A drawing in letters, one for each pixel.
struct Drawing {
  std::vector<std::string> rows;

  [[nodiscard]] static Rgba colour_of(char letter) {
    if (letter == '#') return white;
    if (letter == 'g') return grass;
    if (letter == ':') return frosted;
    return letter == '/' ? glass : black;
  }
  [[nodiscard]] std::string png() const {
    PngFile file{.colour = PngColour::rgb_alpha,
                 .width = static_cast<int>(rows[0].size()),
                 .height = static_cast<int>(rows.size())};
    for (const std::string& row : rows) {
      for (const char letter : row) {
        const Rgba colour = colour_of(letter);
        file.samples.insert(file.samples.end(), colour.begin(), colour.end());
      }
    }
    return file.bytes();
  }
};

std::string scene_with(const std::string& entry, double pixels_per_metre = 32) {
  return R"({ "paperproof_scene": 1, "name": "drawn", "gravity": [0, -30], "dt": 0.0078125, "steps": 120,
              "pixels_per_metre": )" +
         std::to_string(pixels_per_metre) + R"(, "character": { "position": [-30, 30] }, "scenery": [ )" + entry +
         " ] }";
}

TEST(Picture, becomes_rectangles_of_its_solid_pixels) {
  const SceneFiles files;
  files.write("level.png", Drawing{{"........",  //
                                    ".##..###",  //
                                    ".##..###",  //
                                    "#####..."}}
                               .png());
  const Scene scene = files.load("drawn.json", scene_with(R"({ "id": "level", "picture": "level.png" })", 4));
  EXPECT_EQ(scene.ids, (std::vector<std::string>{"level/1,1", "level/5,1", "level/0,3"}));
  const auto& colliders = scene.scenery.colliders;
  EXPECT_EQ(colliders[0].points[0], Vec2d(0.25, -0.75));
  EXPECT_EQ(colliders[0].points[2], Vec2d(0.75, -0.25));
  EXPECT_EQ(colliders[2].points[0], Vec2d(0, -1));
  EXPECT_EQ(colliders[2].points[2], Vec2d(1.25, -0.75));
  ASSERT_TRUE(scene.respawn_box.has_value());
  EXPECT_EQ(scene.respawn_box->lower, Vec2d(0, -1));
  EXPECT_EQ(scene.respawn_box->upper, Vec2d(2, 0));
}

std::set<std::pair<int, int>> pixels_of(const Scene& scene, double pixels_per_metre) {
  std::set<std::pair<int, int>> pixels;
  for (const ColliderDef& collider : scene.scenery.colliders) {
    const Vec2d lower = collider.points[0] * pixels_per_metre;
    const Vec2d upper = collider.points[2] * pixels_per_metre;
    for (double y = lower.y() + 0.5; y < upper.y(); ++y) {
      for (double x = lower.x() + 0.5; x < upper.x(); ++x) {
        const bool is_new = pixels.insert({int(std::floor(x)), int(-std::ceil(y))}).second;
        EXPECT_TRUE(is_new) << "two rectangles have the pixel " << x << ' ' << y;
      }
    }
  }
  return pixels;
}

TEST(Picture, has_each_solid_pixel_in_exactly_one_rectangle_that_shares_its_bits_with_neighbours) {
  constexpr std::uint64_t seed = 12;
  std::mt19937_64 random(seed);
  const SceneFiles files;
  for (int i = 0; i < 30; ++i) {
    Drawing drawing;
    std::set<std::pair<int, int>> expected;
    for (int row = 0; row < 24; ++row) {
      drawing.rows.emplace_back();
      for (int column = 0; column < 40; ++column) {
        const bool solid = (random() >> 33) % 4 != 0;
        drawing.rows.back() += solid ? '#' : '.';
        if (solid) expected.insert({column, row});
      }
    }
    files.write("level.png", drawing.png());
    const double scale = 21.3;  // nothing is exact
    const Scene scene = files.load("drawn.json", scene_with(R"({ "picture": "level.png" })", scale));
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

TEST(Picture, is_solid_where_the_scene_says) {
  const SceneFiles files;
  files.write("level.png", Drawing{{"#g./:"}}.png());
  const auto solid = [&](const std::string& rule) {
    return pixels_of(files.load("drawn.json", scene_with(R"({ "picture": "level.png")" + rule + "}")), 32);
  };
  using Columns = std::set<std::pair<int, int>>;
  EXPECT_EQ(solid(""), (Columns{{0, 0}, {4, 0}})) << "white, as in a mask; what is more than half transparent is air";
  EXPECT_EQ(solid(R"(, "solid": "#20C040")"), (Columns{{1, 0}}));
  EXPECT_EQ(solid(R"(, "solid": "#000000")"), (Columns{{2, 0}}));
  EXPECT_EQ(solid(R"(, "background": "#000000")"), (Columns{{0, 0}, {1, 0}, {4, 0}}));
  EXPECT_EQ(solid(R"(, "background": "#ffffff")"), (Columns{{1, 0}, {2, 0}}));
}

/// One row of four pixels, with the indices 0 to 3. Entries 1 and 2 look the same, and entry 3 is glass.
std::string four_entries() {
  return PngFile{PngColour::indexed,
                 2,
                 false,
                 4,
                 1,
                 {0, 1, 2, 3},
                 png_chunk("PLTE", std::string("\0\0\0ggggggwww", 12)) + png_chunk("tRNS", "\xff\xff\xff\x10")}
      .bytes();
}

TEST(Picture, with_a_palette_is_solid_by_index_where_colours_are_the_same) {
  const SceneFiles files;
  files.write("level.png", four_entries());
  const auto solid = [&](const std::string& rule) {
    return pixels_of(files.load("drawn.json", scene_with(R"({ "picture": "level.png", )" + rule + "}")), 32);
  };
  using Columns = std::set<std::pair<int, int>>;
  EXPECT_EQ(solid(R"("solid": "#676767")"), (Columns{{1, 0}, {2, 0}})) << "the two look alike";
  EXPECT_EQ(solid(R"("solid": 0)"), (Columns{{0, 0}}));
  EXPECT_EQ(solid(R"("solid": 1)"), (Columns{{1, 0}}));
  EXPECT_EQ(solid(R"("solid": 2.0)"), (Columns{{2, 0}}));
  EXPECT_EQ(solid(R"("background": 0)"), (Columns{{1, 0}, {2, 0}})) << "glass never is";
  EXPECT_EQ(solid(R"("background": 2)"), (Columns{{0, 0}, {1, 0}}));
}

TEST(Picture, is_not_given_an_index_that_its_palette_does_not_have) {
  const SceneFiles files;
  files.write("level.png", four_entries());
  files.write("colours.png", Drawing{{"#g./"}}.png());
  const auto complaint = [&](const std::string& entry) { return files.complaint("drawn.json", scene_with(entry)); };
  for (const std::string index : {"4", "-1", "0.5", "256", "1e300"}) {
    EXPECT_EQ(complaint(R"({ "picture": "level.png", "background": )" + index + "}"),
              ": /scenery/0/background: expected an index from 0 to 3, the last in the palette of level.png");
  }
  EXPECT_EQ(complaint(R"({ "picture": "colours.png", "solid": 0 })"),
            ": /scenery/0/solid: expected a colour like \"#00a0ff\": colours.png has no palette for an index");
  for (const std::string neither : {"true", "null", "[0]"}) {
    EXPECT_EQ(complaint(R"({ "picture": "level.png", "solid": )" + neither + "}"),
              ": /scenery/0/solid: expected a colour like \"#00a0ff\", or the index of one in the picture's palette");
  }
  EXPECT_EQ(complaint(R"({ "picture": "level.png", "solid": 3 })"),
            ": /scenery/0/picture: level.png: expected a solid pixel; none is colour 3 of the palette");
}

std::string chequers(std::size_t width, int row) {
  std::string text(width, '.');
  for (std::size_t i = row % 2 == 0 ? 0 : 1; i < width; i += 2) text[i] = '#';
  return text;
}

TEST(Picture, that_cannot_be_used_is_refused_in_one_line) {
  const SceneFiles files;
  const std::string png = Drawing{{"#g./"}}.png();
  files.write("level.png", png);
  files.write("text.png", "This is no picture.");
  files.write("half.png", png.substr(0, png.size() - 25));
  std::string spoilt = png;
  spoilt.replace(16, 8, std::string("\0\1\0\0\0\1\0\0", 8));  // 65536 x 65536, and the checksum does not fit
  files.write("spoilt.png", spoilt);
  files.write("huge.png", spoilt.substr(0, 8) + png_chunk("IHDR", spoilt.substr(16, 13)) + spoilt.substr(33));
  Drawing noise;
  for (int row = 0; row < 640; ++row) noise.rows.push_back(chequers(640, row));  // each other pixel: 204,800 rectangles
  files.write("noise.png", noise.png());
  const auto complaint = [&](const std::string& entry) { return files.complaint("drawn.json", scene_with(entry)); };
  EXPECT_EQ(complaint(R"({ "picture": "none.png" })"),
            ": /scenery/0/picture: none.png: expected a file that exists; there is none");
  for (const std::string name : {"text.png", "half.png", "spoilt.png"}) {
    const std::string start = ": /scenery/0/picture: " + name + ": expected a PNG picture (";
    EXPECT_EQ(complaint(R"({ "picture": ")" + name + R"(" })").substr(0, start.size()), start);
  }
  EXPECT_EQ(complaint(R"({ "picture": "huge.png" })"),
            ": /scenery/0/picture: huge.png: expected a picture of at most 67108864 pixels, not 65536 x 65536");
  EXPECT_EQ(complaint(R"({ "picture": "noise.png" })"),
            ": /scenery/0/picture: noise.png: expected a drawing; its solid pixels make more than 200000 rectangles");
  EXPECT_EQ(complaint(R"({ "picture": "level.png", "solid": "#123456" })"),
            ": /scenery/0/picture: level.png: expected a solid pixel; none is #123456");
  for (const std::string colour : {"white", "#fff", "#00000g", "ffffff", "#ffffff0"}) {
    EXPECT_EQ(complaint(R"({ "picture": "level.png", "solid": ")" + colour + R"(" })"),
              ": /scenery/0/solid: expected a colour like \"#00a0ff\", or the index of one in the picture's palette");
  }
  EXPECT_EQ(complaint(R"({ "picture": "level.png", "solid": "#ffffff", "background": "#000000" })"),
            ": /scenery/0/background: expected one of \"solid\" and \"background\", not both");
  EXPECT_EQ(complaint(R"({ "chain": [[0,0],[1,0]], "solid": "#ffffff" })"),
            ": /scenery/0/solid: expected only beside \"picture\"");
  EXPECT_EQ(complaint(R"({ "picture": "level.png", "one_way": [0,1] })"),
            ": /scenery/0/one_way: expected only beside \"polygon\", \"chain\" or \"circle\"");
  EXPECT_EQ(complaint(R"({ "picture": "level.png", "tiled": "a.tmx" })").substr(0, 30),
            std::string(": /scenery/0: expected exactly one shape").substr(0, 30));
}

}  // namespace
}  // namespace paperproof::compare
