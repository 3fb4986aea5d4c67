/// Maps of Tiled that other people drew, and checks that compare more than numbers. tables/tiled.json has the others.
#include "compare/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

const bool table = table_tests("tiled.json", keys_of_scene_files, check_scene_file_alone);

/// A map of tiles of so many pixels, of which one is a circle of 8 px in the middle.
std::string map_of(const std::string& layers, const std::string& spawn, int pixels = 16) {
  const std::string size = " tilewidth='" + std::to_string(pixels) + "' tileheight='" + std::to_string(pixels) + "'";
  return quoted("<map orientation='orthogonal' width='20' height='20'" + size + "><tileset firstgid='1' name='a'" +
                size +
                " tilecount='1'><tile id='0'><objectgroup><object id='1' x='4' y='4' width='8' height='8'><ellipse/>"
                "</object></objectgroup></tile></tileset>" +
                layers + "<objectgroup name='spawn'>" + spawn + "</objectgroup></map>");
}

Scene with_solid(const std::string& object) {
  return SceneFiles().load("map.tmx", map_of("<objectgroup name='solid'><object id='9' " + object + "</objectgroup>",
                                             "<object id='1' name='Spawn' x='2' y='8'/>"));
}

TEST(TiledObjects, an_ellipse_is_a_polygon_on_its_curve_and_close_to_it) {
  const Scene scene = with_solid("x='28' y='2' width='36' height='10'><ellipse/></object>");
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"1 ellipse has straight edges, at most 0.125 px inside of the curve"});
  const std::vector<Vec2d>& points = scene.scenery.colliders[0].points;
  const Vec2d centre{46 / 16.0, -7 / 16.0};
  // How far a point is from the middle, as a factor: 1 is on the curve.
  const auto on_ellipse = [&](const Vec2d& p) { return (p - centre).cwiseQuotient(Vec2d(18 / 16.0, 5 / 16.0)).norm(); };
  // Edges of angle d on a circle of 18 px lie 18 (1 - cos d/2) px inside at most; the ellipse is flatter.
  EXPECT_EQ(points.size(), 28U) << "18 (1 - cos(90 / 7 / 2 degrees)) = 0.113, and with 6 edges 0.154";
  EXPECT_EQ(Box2::around(points).lower, Vec2d(28 / 16.0, -12 / 16.0));
  EXPECT_EQ(Box2::around(points).upper, Vec2d(64 / 16.0, -2 / 16.0));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2d& a = points[i];
    const Vec2d& b = points[(i + 1) % points.size()];
    EXPECT_NEAR(on_ellipse(a), 1, 1e-14);
    // In units of the radii the middle of an edge is 1 - cos d/2 inside.
    EXPECT_GE(on_ellipse((a + b) / 2), 1 - 0.125 / 18);
  }
  // A circle of a tile that is shown half as high: 8 x 4 px, from 4 px right of and 2 px above the lower left corner.
  const Scene flat = with_solid("gid='1' x='32' y='32' width='16' height='8'/>");
  const Box2 flat_box = Box2::around(flat.scenery.colliders[0].points);
  EXPECT_EQ(flat_box.lower, Vec2d(36 / 16.0, -30 / 16.0));
  EXPECT_EQ(flat_box.upper, Vec2d(44 / 16.0, -26 / 16.0));
}

TEST(TiledObjects, a_capsule_has_half_circles_at_its_ends) {
  const Scene scene = with_solid("x='28' y='2' width='32' height='8'><capsule/></object>");
  EXPECT_EQ(scene.notes,
            std::vector<std::string>{"1 capsule has straight edges, at most 0.125 px inside of the curve"});
  const std::vector<Vec2d>& points = scene.scenery.colliders[0].points;
  for (const Vec2d& point : points) {
    // 4 px from the middle line, which goes from 32 to 56 px.
    const Vec2d nearest{std::clamp(point.x(), 32 / 16.0, 56 / 16.0), -6 / 16.0};
    EXPECT_NEAR((point - nearest).norm(), 4 / 16.0, 1e-15);
  }
  for (const Vec2d& pixels : {Vec2d(32, 2), Vec2d(56, 2), Vec2d(32, 10), Vec2d(56, 10), Vec2d(28, 6), Vec2d(60, 6)})
    EXPECT_NE(std::find(points.begin(), points.end(), Vec2d(pixels.x() / 16, -pixels.y() / 16)), points.end())
        << pixels;
  const Scene upright = with_solid("x='28' y='0' width='8' height='28'><capsule/></object>");
  EXPECT_EQ(Box2::around(upright.scenery.colliders[0].points).upper, Vec2d(36 / 16.0, 0));
}

TEST(TiledStart, who_stands_on_the_ground_by_a_point_is_not_inside_by_a_rounding) {
  const SceneFiles files;
  // Grounds whose height in metres no double is, above the origin: where the sprite's middle is in a higher binade the
  // sum is rounded.
  int rounded_up = 0;
  for (int k = 1; k < 200; ++k) {
    const std::string y = std::to_string(-k);
    const Scene scene = files.load(
        "map.tmx",
        map_of("<objectgroup name='solid'><object id='2' x='0' y='" + y + "' width='90' height='9'/></objectgroup>",
               "<object id='1' name='Spawn' x='45' y='" + y + "'><point/></object>", 18));
    // It was loaded, so that by exact arithmetic it overlaps nothing.
    const double rounded = k / 18.0 + 0.625;
    const double place = scene.start.position.y();
    EXPECT_TRUE(place == rounded || place == std::nextafter(rounded, 100.0)) << k;
    rounded_up += place != rounded;
  }
  EXPECT_GT(rounded_up, 5) << "the rounding that this is about did not happen";
}

const std::filesystem::path levels = std::filesystem::path(PAPERPROOF_SOURCE_DIR) / ".." / "shared" / "levels";

TEST(TiledFamilies, each_has_the_solids_that_an_independent_reader_counted) {
  if (!std::filesystem::exists(levels)) GTEST_SKIP() << "../shared/levels is missing";
  using Counts = std::array<int, 3>;  // polygons, chains, and what blocks from one side
  for (const auto& [file, expected] : {std::pair{"sticker-knight/sandbox.tmx", Counts{16 + 2, 0, 0}},
                                       {"sticker-knight/sandbox2.tmx", {28 + 4, 0, 0}},
                                       {"melonjs/map1.tmx", {10 + 1, 2, 6}},
                                       {"melonjs/map2.json", {4, 2, 7}},
                                       {"haxeflixel/test2.tmx", {12, 0, 0}}}) {
    Counts counts{};
    const Scene scene = load_scenes((levels / file).string()).front();
    for (const ColliderDef& def : scene.scenery.colliders)
      ++counts[def.one_way ? 2U : def.shape == ColliderDef::Shape::polygon ? 0U : 1U];
    EXPECT_EQ(counts, expected) << file;
  }
}

}  // namespace
}  // namespace paperproof::compare
