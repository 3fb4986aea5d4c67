/// Maps of Tiled: what becomes solid, where the character begins, what is refused; and maps that nobody here drew.
#include "scenes/tiled_model.hpp"

#include "compare/tiled_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace paperproof::compare {
namespace {

using TiledTiles = SceneFilesTest;
using TiledStart = SceneFilesTest;
using TiledFiles = SceneFilesTest;
using Texts = std::vector<std::string>;

/// One solid tile, and what it is.
const std::string one_csv = "0,0,0,0, 0,0,0,0, 0,0,1,0";
const std::string one = "t2,2: box 2 -3 3 -2";

struct Map {
  const char* what;
  std::string layers;
  std::string solids;
  std::string tiles{};  ///< What the tileset says of its tiles.
  std::string note{};
};

void expect_read(const std::vector<Map>& maps) {
  const SceneFiles files;
  for (const Map& map : maps) {
    const Scene scene = files.load("map.tmx", tmx(map.layers + spawn, map.tiles));
    EXPECT_EQ(solids_of(scene), map.solids) << map.what;
    EXPECT_EQ(scene.notes, map.note.empty() ? Texts{} : Texts{map.note}) << map.what;
  }
}

std::string with_number(TileNumber number) {
  return csv_layer("0,0,0,0, 0,0,0,0, 0," + std::to_string(number) + ",0,0");
}

TEST_F(TiledTiles, are_boxes_or_their_own_shapes_where_their_cells_are) {
  constexpr TileNumber h = flipped_horizontally;
  constexpr TileNumber v = flipped_vertically;
  constexpr TileNumber d = flipped_diagonally;
  // Differs under every flip.
  const std::string triangle =
      "<tile id='0'><objectgroup><object id='1' x='0' y='0'><polygon points='0,0 16,0 0,8'/></object></objectgroup>"
      "</tile>";
  const std::string two = R"(<tile id='0'><objectgroup><object id='1' x='4' y='8' width='8' height='4'/>
      <object id='2' x='0' y='0'><polyline points='0,0 16,16'/></object></objectgroup></tile>)";
  const std::string low = with(csv_layer(one_csv), "<layer ", "<layer offsetx='2' offsety='3' ");
  expect_read({
      {"a tile of 16 px is a metre, below zero", csv_layer(one_csv), one},
      {"a shape", with_number(1), "t1,2: polygon 1 -2.5 1 -2 2 -2", triangle},
      {"mirrored across", with_number(1 | h), "t1,2: polygon 1 -2 2 -2.5 2 -2", triangle},
      {"mirrored upwards", with_number(1 | v), "t1,2: polygon 1 -3 2 -3 1 -2.5", triangle},
      {"mirrored at the diagonal", with_number(1 | d), "t1,2: polygon 1 -3 1.5 -2 1 -2", triangle},
      {"turned by a quarter: the diagonal first", with_number(1 | d | h), "t1,2: polygon 1.5 -2 2 -2 2 -3", triangle},
      {"turned by a half", with_number(1 | h | v), "t1,2: polygon 1 -3 2 -2.5 2 -3", triangle},
      {"several shapes", csv_layer("0,0,1,0, 0,0,0,0, 0,0,0,0"),
       "t2,0: box 2.25 -0.75 2.75 -0.5; t2,0.1: chain 2 0 3 -1", two},
      {"in two layers", csv_layer(one_csv) + csv_layer(one_csv), one + "; t2,2#2: box 2 -3 3 -2"},
      {"offsets of layers and groups add up", "<group name='g' offsetx='10' offsety='1'>" + low + "</group>",
       "t2,2: box 2.75 -3.25 3.75 -2.25"},
      {"one-way is the upper edge", csv_layer(one_csv, "One-Way"), "t2,2: chain 2 -2 3 -2 one-way 0 1"},
  });
}

TEST_F(TiledTiles, have_sizes_of_their_own_and_lie_anywhere_in_an_infinite_map) {
  const std::string large = with(tmx(csv_layer(one_csv) + spawn), "tilewidth=\"16\" tileheight=\"16\" tilecount",
                                 "tilewidth='32' tileheight='40' tilecount");
  EXPECT_EQ(solids_of(files.load("map.tmx", large)), "t2,2: box 2 -3 4 -0.5") << "on the cell's lower left corner";
  const std::string chunks = tile_layer("Collision", R"(<data encoding='csv'>
      <chunk x='-2' y='-1' width='2' height='1'>1,1</chunk><chunk x='2' y='0' width='1' height='2'>0,1</chunk></data>)");
  EXPECT_EQ(solids_of(files.load("map.tmx", with(tmx(chunks + spawn), "<map ", "<map infinite='1' "))),
            "t-2,-1: box -2 0 -1 1; t-1,-1: box -1 0 0 1; t2,1: box 2 -2 3 -1");
}

TEST_F(TiledTiles, every_encoding_gives_the_same_scene) {
  const auto solids = [&](const std::string& attributes, const std::string& content) {
    return solids_of(
        files.load("map.tmx", tmx(tile_layer("Collision", "<data " + attributes + ">\n  " + content + "\n </data>") +
                                  objects("start", "<object x='20' y='0'/>"))));
  };
  const std::string expected = solids("encoding='csv'", "2,0,0,0,\n0,0,2147483651,0,\n1,1,1,1");
  EXPECT_EQ(expected.substr(0, 42), "t0,0: box 0 -1 1 0; t2,1: box 2 -2 3 -1; t");
  std::string elements;
  for (const char* gid : {"2", "0", "0", "0", "0", "0", "2147483651", "0", "1", "1", "1", "1"})
    elements += std::string("<tile gid='") + gid + "'/>";
  EXPECT_EQ(solids("", with(elements, "<tile gid='0'/>", "<tile/>")), expected);
  // Written by Python and by the zstd command.
  const std::string base64 = "encoding='base64' ";
  EXPECT_EQ(solids(base64, "AgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAwAAgAAAAAABAAAAAQAAAAEAAAABAAAA"), expected);
  EXPECT_EQ(solids(base64 + "compression='zlib'", "eNpjYsAOmBkYGkA0IxoGAAuAAIo="), expected);
  EXPECT_EQ(solids(base64 + "compression='gzip'", "H4sIAAAAAAACA2NiwA6YGRgaQDQjGgYAo+SdojAAAAA="), expected);
  EXPECT_EQ(solids(base64 + "compression='zstd'", "KLUv/SAwjQAAOAIAAwAAgAEDALsWPC2iACw="), expected);
}

std::string scene_around_map(double pixels_per_metre) {
  return R"({"paperproof_scene": 1, "name": "n", "gravity": [0, -10], "dt": 0.01, "steps": 1, "pixels_per_metre": )" +
         std::to_string(pixels_per_metre) +
         R"(, "character": {"position": [0, 3]}, "scenery": [{"id": "m", "tiled": "map.tmx"}]})";
}

TEST_F(TiledTiles, neighbours_share_bits_where_the_tile_size_is_no_power_of_two) {
  files.write("map.tmx", with(with(tmx(csv_layer(floor_csv)), "tilewidth=\"16\" tileheight=\"16\"",
                                   "tilewidth='35' tileheight='35'"),
                              "tilewidth=\"16\" tileheight=\"16\"", "tilewidth='35' tileheight='35'"));
  const Scene scene = files.load("scene.json", scene_around_map(70.5));
  ASSERT_EQ(scene.ids, (Texts{"m/t0,2", "m/t1,2", "m/t2,2", "m/t3,2"}));
  const Box2 left = Box2::around(scene.scenery.colliders[1].points);
  const Box2 right = Box2::around(scene.scenery.colliders[2].points);
  EXPECT_EQ(left.upper, Vec2d(2 * 35 / 70.5, -(2 * 35 / 70.5)));
  EXPECT_EQ(right.lower.x(), left.upper.x());
  EXPECT_EQ(right.upper.y(), left.upper.y());
  EXPECT_TRUE(scene.respawn_box.has_value());
}

TEST(TiledMarks, say_what_is_solid_the_nearest_first) {
  const std::string plain = csv_layer(one_csv, "ground");
  const std::string property = "<properties><property name='Collides' type='bool' value='true'/></properties>";
  const std::string set =
      "<tile id='1'><properties><property name='solid' type='bool' value='false'/></properties></tile>"
      "<tile id='2' class='solid'/>";
  const std::string shape =
      "<tile id='0'><objectgroup><object id='1' x='0' y='8' width='16' height='8'/></objectgroup></tile>";
  expect_read({
      {"a name", csv_layer(one_csv, "SOLIDS"), one},
      {"another name", csv_layer(one_csv, "Platforms"), one},
      {"a class", with(plain, "<layer ", "<layer class='wall' "), one},
      {"a property", with(plain, "<data", property + "<data"), one},
      {"the group around", "<group name='walls'>" + plain + "</group>", one},
      {"a tile that is not, in a layer that is", csv_layer("0,0,0,0, 0,0,0,0, 0,2,1,0"), one, set},
      {"a tile that is, in a layer that is not", csv_layer("0,0,0,0, 0,0,0,0, 0,0,3,1", "decoration"), one, set},
      {"no mark: tiles with shapes", csv_layer("0,0,0,0, 0,0,0,0, 2,2,1,0", "picture"), "t2,2: box 2 -3 3 -2.5", shape,
       "nothing is marked; tiles with collision shapes are the solids"},
  });
}

std::string in_collision(const std::string& object) { return objects("collision", "<object id='5' " + object); }

/// A tile that is a circle of 8 px in its middle.
const std::string disc =
    "<tile id='0' class='solid'><objectgroup><object id='1' x='4' y='4' width='8' height='8'><ellipse/></object>"
    "</objectgroup></tile>";

TEST(TiledObjects, are_polygons_chains_and_tiles_where_they_are_and_as_they_are_turned) {
  const std::string tile_objects = R"(<object id='5' gid='1' x='16' y='48' width='32' height='24'>
      <properties><property name='bodyType' value='static'/></properties></object>
      <object id='6' gid='1' x='0' y='48' width='8' height='8'>
      <properties><property name='bodyType' value='dynamic'/></properties></object>)";
  const std::string is_circle = "1 object as wide as high and round is a circle";
  expect_read({
      {"a box", in_collision("x='0' y='32' width='64' height='16'/>"), "o5: box 0 -3 4 -2"},
      {"a polygon by its class",
       objects("a", "<object id='6' class='slope' x='32' y='32'><polygon points='0,0 16,-16 16,0'/></object>"),
       "o6: polygon 2 -2 3 -1 3 -2"},
      {"a chain", in_collision("x='0' y='0'><polyline points='0,0 0,32'/></object>"), "o5: chain 0 0 0 -2"},
      {"a one-way chain", in_collision("type='platform' x='16' y='16'><polyline points='0,0 16,0'/></object>"),
       "o5: chain 1 -1 2 -1 one-way 0 1"},
      {"a tile stands on its y and is stretched; what is dynamic is not solid", objects("things", tile_objects),
       "o5: box 1 -3 3 -1.5"},
      {"a quarter", in_collision("rotation='90' x='32' y='16' width='16' height='8'/>"), "o5: box 1.5 -2 2 -1"},
      {"a half", in_collision("rotation='180' x='32' y='16' width='16' height='8'/>"), "o5: box 1 -1 2 -0.5"},
      {"a quarter back", in_collision("rotation='-90' x='32' y='16' width='16' height='8'/>"), "o5: box 2 -1 2.5 0"},
      {"a round more", in_collision("rotation='450' x='32' y='16' width='16' height='8'/>"), "o5: box 1.5 -2 2 -1"},
      {"a tile about its lower left corner",
       in_collision("rotation='90' gid='1' x='16' y='16' width='16' height='16'/>"), "o5: box 1 -2 2 -1"},
      {"an ellipse as wide as high", in_collision("x='32' y='8' width='8' height='8'><ellipse/></object>"),
       "o5: circle 2.25 -0.75 radius 0.25", "", is_circle},
      {"a capsule as wide as high", in_collision("x='32' y='8' width='8' height='8'><capsule/></object>"),
       "o5: circle 2.25 -0.75 radius 0.25", "", is_circle},
      {"a circle turned about its corner",
       in_collision("x='40' y='8' width='8' height='8' rotation='90'><ellipse/></object>"),
       "o5: circle 2.25 -0.75 radius 0.25", "", is_circle},
      {"a tile with a circle, half as large",
       objects("things", "<object id='5' gid='1' x='32' y='32' width='8' height='8'/>"),
       "o5: circle 2.25 -1.75 radius 0.125", disc, is_circle},
      {"round and not marked",
       objects("coins", "<object x='9' y='2' width='8' height='6'><ellipse/></object>") + csv_layer(one_csv), one},
      {"a point", csv_layer(one_csv) + in_collision("x='1' y='1'><point/></object>"), one, "",
       "object 5 is left out: it has no area"},
      {"an empty box", csv_layer(one_csv) + in_collision("x='1' y='1'/>"), one, "",
       "object 5 is left out: it has no area"},
      {"a mover without an end of its way",
       csv_layer(one_csv) + objects("Moving Platforms", "<object id='5' gid='1'/>"), one, "",
       "mover 5 is left out: its path needs one speed and two boundaries"},
      {"from a template", csv_layer(one_csv) + objects("coins", "<object id='5' template='a.tx'/>"), one, "",
       "1 objects made from templates are left out: templates are not read"},
  });
}

Scene with_solid(const std::string& object, const std::string& layer = "solid", const std::string& tiles = "") {
  return SceneFiles().load("map.tmx",
                           tmx(objects(layer, "<object id='9' " + object) + csv_layer(floor_csv) + spawn, tiles));
}

TEST(TiledObjects, turn_clockwise_by_any_angle) {
  for (const double degrees : {1.0, 30.0, 44.9, 45.0, 45.1, 123.4, -77.7, 1000.3}) {
    const Scene scene = with_solid("rotation='" + std::to_string(degrees) + "' x='32' y='0' width='16' height='16'/>");
    const Vec2d corner = scene.scenery.colliders[0].points[1];
    const double angle = degrees * std::acos(-1.0) / 180;
    EXPECT_NEAR(corner.x(), 2 + std::cos(angle), 1e-12) << degrees;
    EXPECT_NEAR(corner.y(), -std::sin(angle), 1e-12) << degrees;
  }
}

TEST(TiledObjects, an_ellipse_is_a_polygon_on_its_curve_and_close_to_it) {
  const Scene scene = with_solid("x='28' y='2' width='36' height='10'><ellipse/></object>");
  EXPECT_EQ(scene.notes, Texts{"1 ellipse has straight edges, at most 0.125 px inside of the curve"});
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
  const Scene flat = with_solid("gid='1' x='32' y='32' width='16' height='8'/>", "things", disc);
  const Box2 flat_box = Box2::around(flat.scenery.colliders[0].points);
  EXPECT_EQ(flat_box.lower, Vec2d(36 / 16.0, -30 / 16.0));
  EXPECT_EQ(flat_box.upper, Vec2d(44 / 16.0, -26 / 16.0));
}

TEST(TiledObjects, a_capsule_has_half_circles_at_its_ends) {
  const Scene scene = with_solid("x='28' y='2' width='32' height='8'><capsule/></object>");
  EXPECT_EQ(scene.notes, Texts{"1 capsule has straight edges, at most 0.125 px inside of the curve"});
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

TEST(TiledObjects, round_ones_are_counted_and_block_from_above_as_platforms) {
  const std::string three = R"(x='16' y='2' width='8' height='6'><ellipse/></object>
      <object id='10' x='28' y='2' width='8' height='6'><ellipse/></object>
      <object id='11' x='40' y='2' width='8' height='8'><ellipse/></object>)";
  EXPECT_EQ(with_solid(three).notes, (Texts{"1 object as wide as high and round is a circle",
                                            "2 ellipses have straight edges, at most 0.125 px inside of the curve"}));
  const ColliderDef round = with_solid(three, "one_way").scenery.colliders[2];
  EXPECT_EQ(round.shape, ColliderDef::Shape::chain);
  EXPECT_EQ(round.one_way, Vec2d(0, 1));
  EXPECT_EQ(round.points.front(), Vec2d(40 / 16.0, -6 / 16.0)) << "its left end, half way down";
  EXPECT_EQ(round.points.back(), Vec2d(48 / 16.0, -6 / 16.0));
}

TEST(TiledObjects, a_moving_platform_goes_from_turning_point_to_turning_point_and_back) {
  const Scene scene = with_solid(R"(gid='1' x='48' y='32' width='16' height='16'><properties>
      <property name='change_y' type='float' value='2'/><property name='boundary_top' type='float' value='40'/>
      <property name='boundary_bottom' type='float' value='8'/></properties></object>)",
                                 "Moving Platforms");
  EXPECT_TRUE(begins(solids_of(scene), "m9: box 3 -2 4 -1 of mover 0; t0,2: box 0 -3 1 -2;")) << solids_of(scene);
  ASSERT_EQ(scene.movers.size(), 1U);
  const MoverDef& def = scene.movers[0];
  // The map is 48 px high: the platform begins with its lower edge at 16 px; up to 40 its upper edge has 8 px to go,
  // down to 8 its lower edge 8 px. 2 px per 1/60 s.
  ASSERT_EQ(def.path.size(), 4U);
  EXPECT_EQ(def.path[1].at, Vec2d(0, 8 / 16.0));
  EXPECT_EQ(def.path[2].at, Vec2d(0, -8 / 16.0));
  EXPECT_EQ(def.path[3].at, Vec2d(0, 0));
  EXPECT_EQ(def.path[1].time, 8 / 120.0);
  EXPECT_NEAR(def.path[3].time, 32 / 120.0, 1e-15);
  EXPECT_EQ(def.loop, MoverDef::Loop::loop);
}

TEST_F(TiledStart, is_at_a_marked_object_or_above_the_first_ground_with_room) {
  const auto start = [&](const std::string& layers) { return files.load("map.tmx", tmx(layers)).start.position; };
  // The sprite is 20 x 40 px at 32 px/m. Its upper left corner is the object's.
  EXPECT_EQ(start(csv_layer(floor_csv) + objects("a", "<object name='hero' x='2' y='8'/>")),
            Vec2d(2 / 16.0 + 10 / 32.0, -8 / 16.0 - 20 / 32.0));
  EXPECT_EQ(start(csv_layer(floor_csv) + objects("Player", "<object x='20' y='2'/><object x='40' y='2'/>")),
            Vec2d(20 / 16.0 + 10 / 32.0, -2 / 16.0 - 20 / 32.0));
  // At a point it stands.
  EXPECT_EQ(start(csv_layer(floor_csv) + objects("a", "<object name='Spawn' x='24' y='20'><point/></object>")),
            Vec2d(24 / 16.0, -20 / 16.0 + 20 / 32.0));
  EXPECT_EQ(start(csv_layer(floor_csv) + objects("a", "<object name='Spawn' x='24' y='32'><point/></object>")),
            Vec2d(24 / 16.0, -2 + 20 / 32.0))
      << "on the ground";
  // Column 0 is solid to the top: there is no room within the map. Column 1 has ground in row 2.
  EXPECT_EQ(start(csv_layer("1,0,0,0, 1,0,0,0, 1,1,1,1")), Vec2d(1.5, -2 + 1 / 16.0 + 20 / 32.0));
}

TEST_F(TiledStart, who_stands_on_the_ground_by_a_point_is_not_inside_by_a_rounding) {
  // Grounds whose height in metres no double is, above the origin: where the sprite's middle is in a higher binade the
  // sum is rounded.
  int rounded_up = 0;
  for (int k = 1; k < 200; ++k) {
    const std::string y = std::to_string(-k);
    const Scene scene =
        files.load("map.tmx", "<map orientation='orthogonal' width='20' height='20' tilewidth='18' tileheight='18'>" +
                                  objects("solid", "<object id='2' x='0' y='" + y + "' width='90' height='9'/>") +
                                  objects("spawn", "<object id='1' x='45' y='" + y + "'><point/></object>") + "</map>");
    // It was loaded, so that by exact arithmetic it overlaps nothing.
    const double rounded = k / 18.0 + 0.625;
    const double place = scene.start.position.y();
    EXPECT_TRUE(place == rounded || place == std::nextafter(rounded, 100.0)) << k;
    rounded_up += place != rounded;
  }
  EXPECT_GT(rounded_up, 5) << "the rounding that this is about did not happen";
}

TEST_F(TiledStart, the_character_of_a_map_climbs_a_pixel_and_that_of_a_scene_what_the_scene_says) {
  const Scene alone = files.load("map.tmx", tmx(csv_layer(floor_csv) + spawn));
  EXPECT_EQ(alone.name, "map");
  EXPECT_EQ(alone.pixels_per_metre, 16);
  EXPECT_EQ(alone.respawn_box->lower, Vec2d(0, -3));
  EXPECT_EQ(alone.respawn_box->upper, Vec2d(4, 0));
  EXPECT_EQ(alone.character.max_fall_speed, 25);
  EXPECT_EQ(alone.character.step_height, 1 / 16.0);
  EXPECT_EQ(alone.description, "its character climbs kerbs up to a pixel of the map (0.0625 m)");
  const Scene within = files.load("scene.json", scene_around_map(16));
  EXPECT_EQ(within.character.step_height, 0);
  EXPECT_EQ(within.description, "");
}

TEST_F(TiledFiles, external_tilesets_in_both_formats_are_found_relative_to_the_map_or_beside_it) {
  files.write("sets/a.tsx", R"(<tileset name='a' tilewidth='16' tileheight='16' tilecount='4'>
      <tile id='0'><objectgroup><object id='1' x='0' y='8' width='16' height='8'/></objectgroup></tile></tileset>)");
  files.write("b.json", R"({"type": "tileset", "name": "b", "tilewidth": 16, "tileheight": 16, "tilecount": 4,
      "tiles": [{"id": 1, "objectgroup": {"objects": [{"id": 1, "x": 0, "y": 12, "width": 16, "height": 4}]}}]})");
  const std::string sets =
      "<tileset firstgid='11' source='sets/a.tsx'/><tileset firstgid='15' source='../elsewhere/b.json'/>";
  const Scene scene = files.load("map.tmx", tmx(sets + csv_layer("0,0,0,0, 0,0,0,0, 1,11,16,0") + spawn));
  EXPECT_EQ(solids_of(scene), "t0,2: box 0 -3 1 -2; t1,2: box 1 -3 2 -2.5; t2,2: box 2 -3 3 -2.75");
}

TEST_F(TiledFiles, json_maps_mean_the_same) {
  const std::string text = R"({"type": "map", "orientation": "orthogonal", "width": 4, "height": 3, "tilewidth": 16,
    "tileheight": 16, "infinite": false,
    "tilesets": [{"firstgid": 1, "name": "a", "tilewidth": 16, "tileheight": 16, "tilecount": 4,
                  "tiles": {"1": {"objectgroup": {"objects": [{"id": 1, "x": 0, "y": 8, "width": 16, "height": 8}]}}}}],
    "layers": [{"type": "group", "name": "g", "offsetx": 16, "offsety": 0, "layers": [
                 {"type": "tilelayer", "name": "platforms", "width": 4, "height": 3, "data": [0,0,0,0, 0,0,0,0, 1,2,1,0]}]},
               {"type": "imagelayer", "name": "sky"},
               {"type": "objectgroup", "name": "collision", "objects": [
                 {"id": 3, "type": "platform", "properties": {"platform": "true"}, "x": 0, "y": 16,
                  "polyline": [{"x": 0, "y": 0}, {"x": 16, "y": 0}]},
                 {"id": 4, "properties": [{"name": "solid", "type": "bool", "value": false}], "width": 4, "height": 4},
                 {"id": 6, "x": 0, "y": 40, "width": 8, "height": 8, "ellipse": true},
                 {"id": 7, "x": 16, "y": 0, "width": 8, "height": 4, "rotation": 90},
                 {"id": 8, "x": 0, "y": 0, "polygon": [{"x": 0, "y": 0}, {"x": 8, "y": 0}, {"x": 0, "y": 8}]}]},
               {"type": "objectgroup", "name": "p", "objects": [{"id": 5, "name": "player", "x": 24, "y": 2}]}]})";
  for (const char* name : {"map.json", "map.tmj"})
    EXPECT_EQ(solids_of(files.load(name, text)),
              "t0,2: box 1 -3 2 -2; t1,2: box 2 -3 3 -2.5; t2,2: box 3 -3 4 -2; o3: chain 0 -1 1 -1 one-way 0 1; "
              "o6: circle 0.25 -2.75 radius 0.25; o7: box 0.75 -0.5 1 0; o8: polygon 0 -0.5 0 0 0.5 0");
  expect_refused("map.json", text,
                 {{"[0,0,0,0, 0,0,0,0, 1,2,1,0]", "[1,2]", ": /layers/0/layers/0/data: expected 12 tiles, found 2"},
                  {"1,2,1,0]", "1,2,1,-1]", ": /layers/0/layers/0/data: expected a tile number as entry 11"},
                  {"1,2,1,0]", "1,99,1,0]", ": /layers/0/layers/0: expected a tile of one of the tilesets; 99 belongs"},
                  {"'x': 24", "'x': '24'", ": /layers/3/objects/0/x: expected a number"}});
}

TEST_F(TiledFiles, bad_maps_are_refused_with_their_line) {
  const std::string map = tmx(csv_layer(floor_csv) + spawn);
  const auto base64 = [&](const std::string& compression, const std::string& text) {
    return tmx(
        tile_layer("Collision", "<data encoding='base64' compression='" + compression + "'>" + text + "</data>"));
  };
  std::string deep = csv_layer(floor_csv);
  for (int i = 0; i < 1000; ++i) deep = "<group>" + deep + "</group>";
  const std::string spawn_point = objects("things", "<object id='1' name='Spawn' x='24' y='33'><point/></object>");
  for (const auto& [text, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {"", ":1: expected XML; the file is empty"},
           {with(map, "</map>", ""), ":5: expected XML; "},
           {"<?xml version='1.0'?>\n<html/>", ":2: expected <map> as the outermost element"},
           {with(map, "\"orthogonal\"", "'isometric'"), ":2: expected an orthogonal map"},
           {with(map, " width=\"4\" height=\"3\"", " width='0' height='3'"), ":2: expected a map of at least one"},
           {with(map, "0,0,0,0,", "0,0,0,"), ":4: expected 12 tiles, found 11"},
           {with(map, "1,1,1,1", "1,x,1,1"), ":4: expected a tile number as entry 9"},
           {with(map, "1,1,1,1", "1,1,1,11"), ":4: expected a tile of one of the tilesets; 11 belongs to none"},
           {with(map, "<layer name=\"Collision\" width=\"4\"", "<layer name='Collision' width='4.5'"),
            ":4: expected a whole number from -2147483647 to 2147483647 in \"width\""},
           {tmx("<layer name='Collision' width='4' height='3'/>"), ":4: expected <data> in the tile layer"},
           {with(map, "\"csv\"", "'hex'"), ":4: expected the encoding csv, base64 or none"},
           {with(map, "<layer", "<tileset firstgid='11' source='none.tsx'/><layer"),
            ":4: tileset none.tsx: expected a file that exists"},
           {base64("", "AQAAAAEAAAABA"), ":4: expected base64; it is cut off"},
           {base64("", "AA*A"), ":4: expected base64; \"*\" does not belong there"},
           {base64("", "AQAAAAEAAAABAAAA"), ":4: expected 48 bytes for 12 tiles, found 12"},
           {base64("zlib", "eNpjN8AOmBkYGkA0IxoGAAuAAIo="), ":4: expected zlib or gzip data; it is corrupt"},
           {base64("zlib", "eNpjYsAOmBk="), ":4: expected zlib or gzip data; "},
           {base64("zlib", "eNpjYsAOmBkYGkA0IxpmIlE9ADCwARM="), ":4: expected 48 bytes for 12 tiles, found more"},
           {base64("gzip", "KLUv/SAwjQAAOAIAAwAAgAEDALsWPC2iACw="), ":4: expected zlib or gzip data"},
           {base64("zstd", "KLUv/SAwjQAAOAIAAwAA"), ":4: expected zstd data"},
           {base64("lzma", "AAAA"), ":4: expected the compression zlib, gzip, zstd or none"},
           {tmx(spawn), ": expected at least one solid"},
           {tmx(csv_layer(floor_csv, "ground")), ": expected at least one solid"},
           {tmx("\n" + in_collision("x='0' y='0'><polygon points='0,0 8,8 8,0 0,8'/></object>")), ":5: \"o5\": "},
           {tmx(in_collision("x='0' y='0'><polygon points='0 8,8 8,0'/></object>")), ":4: expected points as"},
           {tmx(in_collision("x='nan' y='0' width='4' height='4'/>")), ":4: expected a finite number in \"x\""},
           {tmx(in_collision("template='a.tx' x='0' y='0'/>")), ":4: expected a solid with its own shape"},
           {tmx(csv_layer(floor_csv) + "\n" + with(spawn, "y=\"8\"", "y='28'")),
            ":5: expected a start outside of every solid"},
           {tmx(csv_layer(floor_csv) + "\n" + spawn_point), ":5: expected a start outside of every solid"},
           {tmx(csv_layer("1,1,1,1, 1,1,1,1, 1,1,1,1")), ": expected a spawn object"},
           {tmx(deep), ":4: expected fewer groups within groups"}})
    EXPECT_TRUE(begins(files.complaint("map.tmx", text), message));
  files.write("map.tmx", tmx("\n" + in_collision("x='a' y='0'/>")));
  EXPECT_TRUE(begins(files.complaint("scene.json", scene_around_map(16)),
                     ": /scenery/0/tiled: map.tmx:5: expected a finite number in \"x\", not \"a\""));
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
