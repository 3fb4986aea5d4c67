/// Levels of pixels: pictures, and the hill of tiles whose pixels say what a collision does.
#include "scenes/picture.hpp"

#include "campaign/random.hpp"
#include "compare/png_files.hpp"
#include "compare/table.hpp"
#include "scenes/describe.hpp"
#include "scenes/input_error.hpp"

#include <cmath>
#include <map>
#include <set>

namespace paperproof::compare {
namespace {

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

/// Each other pixel: 204,800 rectangles.
std::vector<std::string> chequers() {
  std::vector<std::string> rows(640, std::string(640, '.'));
  for (std::size_t row = 0; row < 640; ++row)
    for (std::size_t column = row % 2; column < 640; column += 2) rows[row][column] = '#';
  return rows;
}

/// The pictures that the rows of tables/pictures.json name.
void check_picture(const Json& row) {
  const SceneFiles files;
  files.write("tall.png", png_of({"........",  //
                                  ".##..###",  //
                                  ".##..###",  //
                                  "#####..."}));
  const std::string level = files.write("level.png", png_of({"#g./:"}));
  // The indices 0 to 3. Entries 1 and 2 look the same, and entry 3 is glass.
  files.write("entries.png", PngFile{LCT_PALETTE,
                                     2,
                                     false,
                                     4,
                                     1,
                                     {0, 1, 2, 3},
                                     {{0, 0, 0, 255}, {103, 103, 103, 255}, {103, 103, 103, 255}, {119, 119, 119, 16}}}
                                 .bytes());
  files.write("text.png", "This is no picture.");
  std::string spoilt = read_file(level, "");
  spoilt.replace(16, 8, std::string("\0\1\0\0\0\1\0\0", 8));  // 65536 x 65536, and the checksum does not fit
  files.write("spoilt.png", spoilt);
  files.write("huge.png", spoilt.substr(0, 8) + png_chunk("IHDR", spoilt.substr(16, 13)) + spoilt.substr(33));
  static const std::string noise = png_of(chequers());
  files.write("noise.png", noise);
  check_scene_file(files, row);
}

const bool table = table_tests("pictures.json", keys_of_scene_files, check_picture);

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

TEST(Picture, has_each_solid_pixel_in_exactly_one_rectangle_that_shares_its_bits_with_neighbours) {
  const SceneFiles files;
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
    const Scene scene = files.load(
        "drawn.json", quoted("{'paperproof_scene': 1, 'name': 'drawn', 'gravity': [0, 0], 'dt': 1, 'steps': 1, "
                             "'pixels_per_metre': 21.3, 'character': {'position': [-300, 300]}, "
                             "'scenery': [{'picture': 'level.png'}]}"));
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
