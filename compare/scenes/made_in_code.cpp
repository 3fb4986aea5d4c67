#include "scenes/made_in_code.hpp"

#include "scenes/pixel_rectangles.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace paperproof::compare {

namespace {

constexpr int tile_side = 32;  ///< Of a tile [px].

using Tile = PixelTileSet::Tile;

PixelCollision& pixel_at(Tile& pixels, int column, int row) {
  return pixels[static_cast<std::size_t>(row * tile_side + column)];
}

/// The article's tile: a hill of 45 degrees that slopes down from its upper left corner. A foot that comes from the
/// right goes up by one pixel at the top of each column, and one that comes from the left down by one beside it.
PixelTileSet hill_of_the_article() {
  constexpr PixelCollision solid{PixelAction::block, PixelAction::block};
  constexpr PixelCollision top{PixelAction::up, PixelAction::block};
  constexpr PixelCollision above{PixelAction::nothing, PixelAction::down};
  const Tile none(tile_side * tile_side);
  const Tile full(tile_side * tile_side, solid);
  Tile hill = none;
  Tile over = none;    // stands on the hill
  Tile beside = none;  // stands on its right
  for (int column = 0; column < tile_side; ++column) {
    const int height = tile_side - column;
    for (int row = 0; row < height; ++row) pixel_at(hill, column, row) = row + 1 < height ? solid : top;
    if (column > 1) pixel_at(hill, column, height + 1) = above;
  }
  pixel_at(over, 1, 0) = above;
  pixel_at(beside, 0, 1) = above;
  PixelTileSet set;
  set.pixels_per_tile = tile_side;
  set.types = {none, full, hill, over, beside};
  set.first_column = -3;
  set.first_row = -1;
  set.columns = 9;
  set.map = {1, 1, 1, 1, 1, 1, 1, 1, 1,  // the ground
             1, 1, 2, 4, 0, 0, 0, 0, 0,  // a plateau, the hill from x = -1 m to 0
             0, 0, 3, 0, 0, 0, 0, 0, 0};
  return set;
}

/// From x = -1 m to 0, between level ground. The solid pixels are the scenery of all contenders: a level written twice,
/// in tiles and in polygons, would have the judge call `pixel_tile` wrong where the two differ by mistake.
void put_pixel_hill(Scene& scene) {
  auto tiles = std::make_shared<const PixelTileSet>(hill_of_the_article());
  const auto rows = static_cast<std::int64_t>(tiles->map.size()) / tiles->columns;
  const std::int64_t left = tiles->first_column * tile_side;
  const std::int64_t top = (tiles->first_row + rows) * tile_side;
  PixelScenery pixels = scenery_of_pixels(
      {.width = static_cast<int>(tiles->columns * tile_side),
       .height = static_cast<int>(rows * tile_side),
       .is_solid = [&](int column, int row) { return tiles->at(left + column, top - 1 - row).is_solid(); },
       .left = static_cast<int>(left),
       .top = static_cast<int>(top)},
      scene.pixels_per_metre, scene.name);
  scene.tiles = std::move(tiles);
  scene.scenery = std::move(pixels.scenery);
  scene.ids = std::move(pixels.ids);
  scene.has_pixels = true;
}

/// Tiles of 1 m: `#` is solid, `/` and `\` are slopes of 45 degrees. @param rows from the top.
void put_tiles(const std::vector<std::string>& rows, Scene& scene) {
  for (std::size_t row = 0; row < rows.size(); ++row)
    for (std::size_t column = 0; column < rows[row].size(); ++column) {
      const auto x = static_cast<double>(column);
      const auto y = static_cast<double>(rows.size() - 1 - row);
      const char tile = rows[row][column];
      if (tile == '.') continue;
      std::vector<Vec2d> points{{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
      if (tile != '#') points.erase(points.begin() + (tile == '/' ? 3 : 2));
      scene.ids.push_back("tile_" + std::to_string(scene.ids.size()));
      scene.scenery.colliders.push_back({.points = std::move(points)});
    }
}

/// Steps of lengths that are drawn as often from one decade as from another, until a time is over.
void draw_steps(const Json& of, Scene& scene) {
  const double shortest = of.at("shortest");
  std::mt19937_64 random(of.at("seed").get<std::uint64_t>());
  double sum = 0;
  for (scene.steps = 0; sum < of.at("time"); ++scene.steps) {
    const double share = static_cast<double>(random() >> 11U) * 0x1p-53;
    scene.dt_list.push_back(shortest * std::pow(of.at("longest").get<double>() / shortest, share));
    sum += scene.dt_list.back();
  }
  scene.dt = sum / scene.steps;
}

void draw_input(std::uint64_t seed, Scene& scene) {
  Script script = random_script(scene, seed, scene.steps);
  scene.input = std::move(script.front());
  for (std::size_t k = 0; k < scene.others.size(); ++k) scene.others[k].input = std::move(script[k + 1]);
}

void put_movers_first(Scene& scene) {
  std::vector<ColliderDef>& all = scene.scenery.colliders;
  const auto first = std::find_if(all.begin(), all.end(), [](const ColliderDef& one) { return one.mover != no_mover; });
  std::rotate(scene.ids.begin(), scene.ids.begin() + (first - all.begin()), scene.ids.end());
  std::rotate(all.begin(), first, all.end());
}

}  // namespace

void make_in_code(const Json& what, Scene& scene) {
  if (what.contains("pixel_hill")) put_pixel_hill(scene);
  if (what.contains("tiles")) put_tiles(what["tiles"], scene);
  if (what.contains("movers_first")) put_movers_first(scene);
  if (what.contains("random_steps")) draw_steps(what["random_steps"], scene);
  if (what.contains("random_input")) draw_input(what["random_input"].get<std::uint64_t>(), scene);
}

}  // namespace paperproof::compare
