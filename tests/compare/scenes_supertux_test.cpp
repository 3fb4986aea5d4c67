/// Levels of SuperTux. tables/supertux.json has the other tests of them.
#include "scenes/supertux_level.hpp"

#include "compare/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace paperproof::compare {
namespace {

const bool table = table_tests("supertux.json", keys_of_scene_files, check_scene_file_alone);

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
