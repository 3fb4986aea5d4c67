#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "scene_files.hpp"
#include "scenes/input_error.hpp"
#include "scenes/supertux_level.hpp"

namespace paperproof::compare {
namespace {

const std::string tiles = R"((supertux-tiles ; comment with a ) in it
  (tiles (width 3) (height 1) (ids 1 2 3) (attributes 1 3 17) (datas 0 0 2) (image "a \" b.png"))
  (tile (id 4) (solid #t) (images "c.png"))
  (tile (id 5) (images "d.png"))
  (tiles (ids 6 0 7) (attributes 3 0 3) (datas 1 0 2))))";

/// A sector of 4 x 3 tiles with a floor.
const std::string level = R"((supertux-level
  (version 3)
  (sector (name "main")
    (tilemap (solid #t) (width 4) (height 3) (tiles 0 0 0 0 0 0 0 0 1 1 1 1))
    (tilemap (solid #f) (width 4) (height 3) (tiles 1 1 1 1 1 1 1 1 1 1 1 1))
    (spawnpoint (name "other") (x 64) (y 0))
    (spawnpoint (name "main") (x 32) (y 16)))))";

/// Writes a data root with a level in it.
std::string write_level(const SceneFiles& files, const std::string& text) {
  files.write("data/images/tiles.strf", tiles);
  return files.write("data/levels/world/a.stl", text);
}

Scene load_level(const std::string& text) { return load_scenes(write_level(SceneFiles(), text)).front(); }

const std::string floor_solids = "t0,2: box 0 -3 1 -2; t1,2: box 1 -3 2 -2; t2,2: box 2 -3 3 -2; t3,2: box 3 -3 4 -2";

TEST(SuperTux, tiles_are_boxes_slopes_and_chains_at_the_side_that_blocks) {
  struct Case {
    const char* what;
    std::string upper;  ///< The first two rows.
    std::string solids;
    std::string note{};
  };
  for (const Case& each : {
           Case{"a metre each", "0 0 0 0 0 0 0 0", ""},
           Case{"from above", "0 0 0 2 0 0 0 0", "t3,0: chain 3 0 4 0 one-way 0 1; "},
           Case{"from below", "0 0 0 0 0 0 0 6", "t3,1: chain 3 -2 4 -2 one-way 0 -1; "},
           Case{"from the left", "0 0 0 0 0 0 0 7", "t3,1: chain 3 -1 3 -2 one-way -1 0; "},
           Case{"of its own, and one that is a picture", "4 0 0 5 0 0 0 0", "t0,0: box 0 -1 1 0; "},
           Case{"data 2: the corner at the lower right is solid", "0 0 0 0 0 0 0 3", "t3,1: polygon 3 -2 4 -1 4 -2; "},
           Case{"unknown", "0 0 0 99 0 0 0 99", "", "2 placed tiles are unknown to tiles.strf and left out"},
       }) {
    const Scene scene = load_level(with(level, "0 0 0 0 0 0 0 0", each.upper));
    EXPECT_EQ(solids_of(scene), each.solids + floor_solids) << each.what;
    EXPECT_EQ(scene.notes, each.note.empty() ? std::vector<std::string>{} : std::vector{each.note}) << each.what;
    EXPECT_EQ(scene.name, "a");
    EXPECT_EQ(scene.respawn_box->lower, Vec2d(0, -3));
    EXPECT_EQ(scene.respawn_box->upper, Vec2d(4, 0));
  }
}

/// Twice the area of a polygon with y down; positive is clockwise on the screen.
double twice_area(const std::vector<Vec2d>& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2d& a = points[i];
    const Vec2d& b = points[(i + 1) % points.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

/// Rise in run, of the one edge that is neither level nor upright.
double steepness(const std::vector<Vec2d>& slope) {
  for (std::size_t i = 0; i < slope.size(); ++i) {
    const Vec2d edge = slope[(i + 1) % slope.size()] - slope[i];
    if (edge.x() != 0 && edge.y() != 0) return std::abs(edge.y() / edge.x());
  }
  return 0;
}

TEST(SuperTux, slopes_are_the_tile_cut_by_the_line_that_their_data_names) {
  // Corners of the tile with y down, by the number of the solid corner: SW, NE, SE, NW.
  const std::array<Vec2d, 4> solid_corner{Vec2d{0, 1}, Vec2d{1, 0}, Vec2d{1, 1}, Vec2d{0, 0}};
  for (std::uint32_t corner = 0; corner < 4; ++corner) {
    for (std::uint32_t half = 0; half <= 4; ++half) {
      const SuperTuxTile tile{.attributes = 0x11, .data = corner | half << 4U};
      const std::vector<Vec2d> part = tile.solid_part();
      const Vec2d solid = solid_corner[corner];
      const Vec2d empty = Vec2d{1, 1} - solid;
      EXPECT_EQ(std::count(part.begin(), part.end(), solid), 1) << corner << " " << half;
      EXPECT_EQ(std::count(part.begin(), part.end(), empty), 0) << corner << " " << half;
      // The half that holds the solid corner leaves a quarter of the tile, the other half cuts one off.
      const bool near = (half == 1 && solid.y() == 1) || (half == 2 && solid.y() == 0) ||
                        (half == 3 && solid.x() == 0) || (half == 4 && solid.x() == 1);
      EXPECT_EQ(twice_area(part), half == 0 ? 1.0 : near ? 0.5 : 1.5) << corner << " " << half;
      EXPECT_EQ(steepness(part), half == 0 ? 1.0 : half <= 2 ? 0.5 : 2.0) << corner << " " << half;
    }
  }
}

TEST(SuperTux, a_tilemap_with_a_path_is_made_of_movers_and_one_of_one_node_lies_elsewhere) {
  const std::string moving =
      R"((path (name "p") (path (mode "pingpong") (node (x 32) (y 0) (time 2)) (node (x 32) (y 64))))
    (tilemap (solid #t) (path-ref "p") (width 2) (height 1) (tiles 1 1)) (tilemap)";
  const Scene scene = load_level(with(level, "(tilemap", moving));
  EXPECT_EQ(solids_of(scene), "l0/t0,0: box 0 -1 1 0 of mover 0; l0/t1,0: box 1 -1 2 0 of mover 0; " + floor_solids);
  ASSERT_EQ(scene.movers.size(), 1U);
  EXPECT_EQ(scene.movers[0].id, "l0");
  EXPECT_EQ(scene.movers[0].loop, MoverDef::Loop::ping_pong);
  ASSERT_EQ(scene.movers[0].path.size(), 2U);
  EXPECT_EQ(scene.movers[0].path[0].at, Vec2d(1, 0));
  EXPECT_EQ(scene.movers[0].path[1].at, Vec2d(1, -2));
  EXPECT_EQ(scene.movers[0].path[1].time, 2);
  const Scene parked = load_level(with(level, "(tilemap", R"((path (name "p") (path (node (x 32) (y 32))))
    (tilemap (solid #t) (path-ref "p") (width 2) (height 1) (tiles 0 1)) (tilemap)"));
  EXPECT_TRUE(parked.movers.empty());
  EXPECT_TRUE(begins(solids_of(parked), "t1,0: box 2 -2 3 -1; l1/t0,2: box 0 -3 1 -2; ")) << solids_of(parked);
}

TEST(SuperTux, begins_at_the_spawn_named_main_else_the_first_and_above_a_solid_that_is_there) {
  // The upper left corner of the 20 x 40 px sprite is the spawn point.
  EXPECT_EQ(load_level(level).start.position, Vec2d((32 + 10) / 32.0, -(16 + 20) / 32.0));
  EXPECT_EQ(load_level(with(level, "(name \"main\") (x", "(name \"late\") (x")).start.position.x(), (64 + 10) / 32.0);
  // At y = 32 px the sprite's 40 px reach 8 px into the floor, which begins at 64 px.
  const Scene moved = load_level(with(level, "(x 32) (y 16)", "(x 32) (y 32)"));
  EXPECT_EQ(moved.start.position, Vec2d((32 + 10) / 32.0, -(24 + 20) / 32.0));
  ASSERT_EQ(moved.notes.size(), 1U);
  EXPECT_TRUE(holds(moved.notes[0], "8 px up"));
}

TEST(SuperTux, sectors_are_scenes_of_their_own) {
  const SceneFiles files;
  const std::string second =
      R"((sector (name "cave") (tilemap (solid #t) (width 1) (height 1) (tiles 1)) (spawnpoint (name "main") (x 64) (y 0)))
    (sector (name "empty") (tilemap (solid #t) (width 1) (height 1) (tiles 0)) (spawnpoint (name "main") (x 0) (y 0)))
    (sector)";
  const std::vector<Scene> scenes = load_scenes(write_level(files, with(level, "(sector", second)));
  ASSERT_EQ(scenes.size(), 2U);
  EXPECT_EQ(scenes[0].name, "a/cave");
  EXPECT_EQ(scenes[1].name, "a/main");
}

TEST(SuperTux, bad_levels_are_refused_with_their_line) {
  const SceneFiles files;
  for (const auto& [text, message] : std::initializer_list<std::pair<std::string, std::string>>{
           {"", ":1: expected an S-expression; the file is empty"},
           {level.substr(0, level.size() - 1), ":1: expected a \")\" for the \"(\" of this line before the file ends"},
           {level + "\n)", ":8: expected no \")\" here: nothing is open"},
           {with(level, "\"main\")\n", "\"main)\n"), ":7: expected the closing quote"},
           {"\n(supertux-worldmap)", ":2: expected (supertux-level ...)"},
           {"(supertux-level\n)", ":1: expected at least one (sector ...)"},
           {with(level, "(width 4)", ""), ":4: expected (width NUMBER) in (tilemap)"},
           {with(level, "(width 4)", "(width four)"), ":4: expected a finite number in (width)"},
           {with(level, "(width 4)", "(width 5)"), ":4: expected 5 x 3 tiles, found 12"},
           {with(level, "(solid #t)", "(solid yes)"), ":4: expected #t or #f in (solid)"},
           {with(level, "1 1 1 1", "1 -1 1 1"), ":4: expected a number in (tiles), not \"-1\""},
           {with(level, "(x 64)", "(x nan)"), ":6: expected a finite number in (x)"},
           {with(level, "(solid #t)", "(solid #f)"), ": expected a sector with solid tiles and a spawn point"},
           {std::string(100000, '('), ":1: expected at most 100 levels of nesting"}})
    EXPECT_TRUE(begins(SceneFiles::complaint_about(write_level(files, text)), message));
  const std::string path = write_level(files, level);
  files.write("data/images/tiles.strf", "(supertux-tiles\n (tiles (ids 1 2) (attributes 1)))");
  EXPECT_EQ(SceneFiles::complaint_about(path), ": tiles.strf:2: expected one attribute per id");
}

// --- the real levels ---

const std::filesystem::path installed = "/usr/share/games/supertux2/levels";

TEST(SuperTuxData, is_counted_as_by_an_independent_reader) {
  if (!std::filesystem::exists(installed)) GTEST_SKIP() << "Debian's package supertux-data is not installed";
  std::map<std::string, std::size_t> counts;
  using Kind = SuperTuxTile::Kind;
  std::map<Kind, std::size_t> kinds;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(installed)) {
    if (entry.path().extension() != ".stl") continue;
    const SuperTuxLevel read = read_supertux_level(entry.path().string(), entry.path().string());
    ++counts["levels"];
    counts["sectors"] += read.sectors.size();
    for (const SuperTuxSector& sector : read.sectors) {
      counts["platforms"] += sector.platforms.size();
      for (const SuperTuxTilemap& map : sector.tilemaps) {
        if (!map.solid) continue;
        counts["moving tilemaps"] += map.path ? 1 : 0;
        for (const std::uint32_t number : map.tiles) {
          const auto found = read.tiles.find(number);
          if (found != read.tiles.end()) ++kinds[found->second.kind()];
          counts["unknown tiles"] += found == read.tiles.end() && number != 0 ? 1 : 0;
        }
      }
    }
  }
  EXPECT_EQ(
      counts,
      (std::map<std::string, std::size_t>{
          {"levels", 221}, {"sectors", 274}, {"platforms", 340}, {"moving tilemaps", 43}, {"unknown tiles", 85}}));
  EXPECT_EQ(kinds[Kind::solid], 1226542U);
  EXPECT_EQ(kinds[Kind::slope], 6659U);
  EXPECT_EQ(kinds[Kind::one_way], 5717U);
}

}  // namespace
}  // namespace paperproof::compare
