/// Tiled maps: tiles, and what marks them.
#include "compare/tiled_maps.hpp"

namespace paperproof::compare {
namespace {

TEST(TiledTiles, each_solid_tile_is_a_box_of_its_own_below_zero) {
  const SceneFiles files;
  const Scene scene = files.load("map.tmx", tmx(csv_layer(floor_csv) + spawn));
  ASSERT_EQ(scene.ids, (std::vector<std::string>{"t0,2", "t1,2", "t2,2", "t3,2"}));
  // A tile is 1 m: column 1 of row 2 is x in [1, 2], y in [-3, -2].
  EXPECT_EQ(corners(collider(scene, "t1,2")), box_corners(1, -3, 2, -2));
  EXPECT_EQ(scene.pixels_per_metre, 16);
  ASSERT_TRUE(scene.respawn_box.has_value());
  EXPECT_EQ(scene.respawn_box->lower, Vec2d(0, -3));
  EXPECT_EQ(scene.respawn_box->upper, Vec2d(4, 0));
  EXPECT_EQ(scene.character.max_fall_speed, 25);
  EXPECT_EQ(scene.name, "map");
}

TEST(TiledTiles, every_encoding_gives_the_same_scene) {
  const SceneFiles files;
  const std::vector<TileNumber> tiles{2, 0, 0, 0, 0, 0, 0x80000003U, 0, 1, 1, 1, 1};
  std::string csv;
  std::string elements;
  for (const TileNumber tile : tiles) {
    csv += (csv.empty() ? "" : ",\n") + std::to_string(tile);
    elements += tile == 0 ? std::string("<tile/>") : "<tile gid=\"" + std::to_string(tile) + "\"/>";
  }
  const std::string bytes = little_endian(tiles);
  const auto encoded = [&](const std::string& attributes, const std::string& content) {
    return files.load("map.tmx",
                      tmx(tile_layer("Collision", "<data " + attributes + ">\n  " + content + "\n </data>") + spawn));
  };
  const Scene expected = encoded("encoding=\"csv\"", csv);
  ASSERT_EQ(expected.ids.size(), 6U);
  for (const Scene& scene : {encoded("", elements), encoded("encoding=\"base64\"", base64(bytes)),
                             encoded("encoding=\"base64\" compression=\"zlib\"", base64(deflated(bytes, 15))),
                             encoded("encoding=\"base64\" compression=\"gzip\"", base64(deflated(bytes, 31))),
                             encoded("encoding=\"base64\" compression=\"zstd\"", base64(zstd(bytes)))}) {
    ASSERT_EQ(scene.ids, expected.ids);
    for (std::size_t i = 0; i < scene.ids.size(); ++i) {
      EXPECT_EQ(scene.scenery.colliders[i].points, expected.scenery.colliders[i].points);
    }
  }
}

TEST(TiledTiles, neighbours_share_bits_where_the_tile_size_is_no_power_of_two) {
  const SceneFiles files;
  std::string map = tmx(csv_layer(floor_csv) + spawn);
  for (int i = 0; i < 2; ++i) {
    map = with(map, "tilewidth=\"16\" tileheight=\"16\"", "tilewidth=\"35\" tileheight=\"35\"");
  }
  const std::string scene_text = R"({"paperproof_scene": 1, "name": "n", "gravity": [0, -10], "dt": 0.01, "steps": 1,
    "pixels_per_metre": 70.5, "character": {"position": [0, 3]}, "scenery": [{"id": "m", "tiled": "map.tmx"}]})";
  files.write("map.tmx", map);
  const Scene scene = files.load("scene.json", scene_text);
  ASSERT_EQ(scene.ids.size(), 4U);
  EXPECT_EQ(scene.ids[0], "m/t0,2");
  const auto left = corners(scene.scenery.colliders[1]);
  const auto right = corners(scene.scenery.colliders[2]);
  EXPECT_EQ(left[3], right[1]);
  EXPECT_EQ(left[3].first, 2 * 35 / 70.5);
  EXPECT_EQ(left[3].second, -(2 * 35 / 70.5));
  EXPECT_TRUE(scene.respawn_box.has_value());
}

TEST(TiledTiles, a_tile_is_its_collision_shapes_flipped_as_the_number_says) {
  const SceneFiles files;
  // The triangle (0,0) (16,0) (0,8): asymmetric under every flip.
  const std::string set =
      R"(<tile id="0"><objectgroup><object id="1" x="0" y="0"><polygon points="0,0 16,0 0,8"/></object></objectgroup></tile>)";
  struct Case {
    TileNumber flips;
    std::vector<Vec2d> expected;  ///< Within the tile [px], y down.
  };
  const std::vector<Case> cases{
      {0, {{0, 0}, {16, 0}, {0, 8}}},
      {flipped_horizontally, {{16, 0}, {0, 0}, {16, 8}}},
      {flipped_vertically, {{0, 16}, {16, 16}, {0, 8}}},
      {flipped_diagonally, {{0, 0}, {0, 16}, {8, 0}}},
      // A quarter turn clockwise is the diagonal, then the horizontal flip: (x, y) -> (y, x) -> (16 - y, x).
      {flipped_diagonally | flipped_horizontally, {{16, 0}, {16, 16}, {8, 0}}},
      {flipped_horizontally | flipped_vertically, {{16, 16}, {0, 16}, {16, 8}}},
  };
  for (const Case& c : cases) {
    const std::string csv = "0,0,0,0, 0,0,0,0, 0," + std::to_string(1 | c.flips) + ",2,2";
    const Scene scene = files.load("map.tmx", tmx(csv_layer(csv) + spawn, set));
    std::vector<std::pair<double, double>> expected;
    for (const Vec2d& p : c.expected) expected.emplace_back((16 + p.x()) / 16, -(32 + p.y()) / 16);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(corners(collider(scene, "t1,2")), expected) << "flips " << std::hex << c.flips;
  }
}

TEST(TiledTiles, rectangles_polylines_and_several_shapes_of_a_tile_arrive) {
  const SceneFiles files;
  const std::string set = R"(<tile id="0"><objectgroup>
      <object id="1" x="4" y="8" width="8" height="4"/>
      <object id="2" x="0" y="0"><polyline points="0,0 16,16"/></object></objectgroup></tile>)";
  const Scene scene = files.load("map.tmx", tmx(csv_layer("1,0,0,0, 0,0,0,0, 2,2,2,2") + spawn, set));
  EXPECT_EQ(corners(collider(scene, "t0,0")), box_corners(0.25, -0.75, 0.75, -0.5));
  const ColliderDef& line = collider(scene, "t0,0.1");
  EXPECT_EQ(line.shape, ColliderDef::Shape::chain);
  EXPECT_FALSE(line.one_way.has_value());
  EXPECT_EQ(line.points, (std::vector<Vec2d>{{0, 0}, {1, -1}}));
}

TEST(TiledTiles, a_tile_larger_than_the_cell_stands_on_the_cells_lower_left_corner) {
  const SceneFiles files;
  const std::string map =
      with(tmx(csv_layer("0,0,0,0, 0,0,0,0, 1,0,0,0") + objects("x", R"(<object id="1" name="start" x="44" y="4"/>)")),
           "name=\"plain\" tilewidth=\"16\" tileheight=\"16\"", "name=\"plain\" tilewidth=\"32\" tileheight=\"40\"");
  EXPECT_EQ(corners(collider(files.load("map.tmx", map), "t0,2")), box_corners(0, -3, 2, -0.5));
}

TEST(TiledTiles, offsets_of_layers_and_groups_add_up) {
  const SceneFiles files;
  const std::string layer = with(csv_layer(floor_csv), "<layer ", "<layer offsetx=\"2\" offsety=\"3\" ");
  const Scene scene =
      files.load("map.tmx", tmx("<group name=\"g\" offsetx=\"10\" offsety=\"1\">" + layer + "</group>" + spawn));
  EXPECT_EQ(corners(collider(scene, "t0,2")),
            box_corners(12 / 16.0, -(48 + 4) / 16.0, (16 + 12) / 16.0, -(32 + 4) / 16.0));
}

TEST(TiledTiles, chunks_of_an_infinite_map_may_lie_anywhere) {
  const SceneFiles files;
  const std::string layer = tile_layer("Collision", R"(<data encoding="csv">
      <chunk x="-2" y="-1" width="2" height="1">1,1</chunk><chunk x="0" y="0" width="1" height="2">0,1</chunk></data>)");
  const Scene scene = files.load("map.tmx", with(tmx(layer), "<map ", "<map infinite=\"1\" "));
  EXPECT_EQ(scene.ids, (std::vector<std::string>{"t-2,-1", "t-1,-1", "t0,1"}));
  EXPECT_EQ(corners(collider(scene, "t-2,-1")), box_corners(-2, 0, -1, 1));
}

TEST(TiledTiles, one_way_layers_block_with_the_upper_edge_of_their_tiles) {
  const SceneFiles files;
  const std::string layer = with(csv_layer("0,0,0,0, 1,0,0,0, 0,0,0,0"), "Collision", "One-Way");
  const ColliderDef edge = collider(files.load("map.tmx", tmx(layer + csv_layer(floor_csv) + spawn)), "t0,1");
  EXPECT_EQ(edge.shape, ColliderDef::Shape::chain);
  EXPECT_EQ(edge.one_way, Vec2d(0, 1));
  EXPECT_EQ(edge.points, (std::vector<Vec2d>{{0, -1}, {1, -1}}));
}

TEST(TiledMarks, what_is_nearest_decides) {
  const SceneFiles files;
  const std::string set =
      R"(<tile id="1"><properties><property name="solid" type="bool" value="false"/></properties></tile>
                             <tile id="2" class="solid"/>)";
  const std::string decoration = with(csv_layer("0,0,0,0, 0,0,0,3, 0,0,0,0"), "Collision", "decoration");
  const Scene scene = files.load("map.tmx", tmx(decoration + csv_layer("0,0,0,0, 0,0,0,0, 1,2,1,1") + spawn, set));
  EXPECT_EQ(scene.ids, (std::vector<std::string>{"t3,1", "t0,2", "t2,2", "t3,2"}));
}

TEST(TiledMarks, names_classes_and_properties_of_layers_mark_what_is_in_them) {
  const SceneFiles files;
  const std::string plain = with(csv_layer(floor_csv), "Collision", "ground");
  EXPECT_TRUE(holds(files.complaint("map.tmx", tmx(plain + spawn)), ": expected at least one solid"));
  const std::string property = R"(<properties><property name="Collides" type="bool" value="true"/></properties>)";
  for (const std::string& layer :
       {with(plain, "ground", "SOLIDS"), with(plain, "ground", "Platforms"),
        with(plain, "<layer ", "<layer class=\"wall\" "), with(plain, "<data", property + "<data"),
        "<group name=\"walls\">" + plain + "</group>"}) {
    EXPECT_EQ(files.load("map.tmx", tmx(layer + spawn)).ids.size(), 4U) << layer;
  }
}

TEST(TiledMarks, without_any_mark_tiles_with_collision_shapes_are_solid) {
  const SceneFiles files;
  const std::string set =
      R"(<tile id="0"><objectgroup><object id="1" x="0" y="8" width="16" height="8"/></objectgroup></tile>)";
  const Scene scene =
      files.load("map.tmx", tmx(with(csv_layer("0,0,0,0, 2,2,0,0, 1,1,1,1"), "Collision", "picture") + spawn, set));
  EXPECT_EQ(scene.ids.size(), 4U);
  EXPECT_EQ(corners(collider(scene, "t0,2")), box_corners(0, -3, 1, -2.5));
  ASSERT_FALSE(scene.notes.empty());
}

}  // namespace
}  // namespace paperproof::compare
