/// Where a claim of the article about one technique shows: pictures, tiles, boxes, corners, the order of impact.
#include "scenes/built_in.hpp"

#include "scenes/pixel_rectangles.hpp"

#include <cmath>
#include <memory>

namespace paperproof::compare {

namespace {

constexpr int tile = 32;                         ///< Pixels along one side.
constexpr double one_pixel_a_step = 60 * pixel;  ///< [m/s]

using Tile = PixelTileSet::Tile;

PixelCollision& pixel_at(Tile& pixels, int column, int row) {
  return pixels[static_cast<std::size_t>(row * tile + column)];
}

/// The article's tile: a hill of 45 degrees that slopes down from its upper left corner. A foot that comes from the
/// right goes up by one pixel at the top of each column, and one that comes from the left down by one beside it.
PixelTileSet hill_of_the_article() {
  constexpr PixelCollision solid{PixelAction::block, PixelAction::block};
  constexpr PixelCollision top{PixelAction::up, PixelAction::block};
  constexpr PixelCollision above{PixelAction::nothing, PixelAction::down};
  const Tile none(tile * tile);
  const Tile full(tile * tile, solid);
  Tile hill = none;
  Tile over = none;    // stands on the hill
  Tile beside = none;  // stands on its right
  for (int column = 0; column < tile; ++column) {
    const int height = tile - column;
    for (int row = 0; row < height; ++row) pixel_at(hill, column, row) = row + 1 < height ? solid : top;
    if (column > 1) pixel_at(hill, column, height + 1) = above;
  }
  pixel_at(over, 1, 0) = above;
  pixel_at(beside, 0, 1) = above;
  PixelTileSet set;
  set.pixels_per_tile = tile;
  set.types = {none, full, hill, over, beside};
  set.first_column = -3;
  set.first_row = -1;
  set.columns = 9;
  set.map = {1, 1, 1, 1, 1, 1, 1, 1, 1,  // the ground
             1, 1, 2, 4, 0, 0, 0, 0, 0,  // a plateau, the hill from x = -1 m to 0
             0, 0, 3, 0, 0, 0, 0, 0, 0};
  return set;
}

/// The solid pixels are the scenery of all contenders. A level written twice, in tiles and in polygons, would have the
/// judge call `pixel_tile` wrong where the two differ by mistake. So everybody is judged against the pixels.
PixelScenery scenery_of(const PixelTileSet& tiles, double pixels_per_metre) {
  const auto rows = static_cast<std::int64_t>(tiles.map.size()) / tiles.columns;
  const std::int64_t left = tiles.first_column * tile;
  const std::int64_t top = (tiles.first_row + rows) * tile;
  const auto is_solid = [&](int column, int row) { return tiles.at(left + column, top - 1 - row).is_solid(); };
  return scenery_of_pixels({.width = static_cast<int>(tiles.columns * tile),
                            .height = static_cast<int>(rows * tile),
                            .is_solid = is_solid,
                            .left = static_cast<int>(left),
                            .top = static_cast<int>(top)},
                           pixels_per_metre, "pixel_hill");
}

Scene on_the_hill(double x, double y, double move, int steps) {
  Scene scene = walk(x, y, move, steps, 30);
  scene.character.walk_speed = one_pixel_a_step;
  scene.character.acceleration = 60 * one_pixel_a_step;
  auto tiles = std::make_shared<const PixelTileSet>(hill_of_the_article());
  PixelScenery pixels = scenery_of(*tiles, scene.pixels_per_metre);
  scene.tiles = std::move(tiles);
  scene.scenery = std::move(pixels.scenery);
  scene.ids = std::move(pixels.ids);
  scene.has_pixels = true;
  return scene;
}

Scene pixel_hill() {
  Scene scene = on_the_hill(-2, 1 + half_height, 1, 110);
  ends_at(scene, -2 + walked(scene, scene.steps), half_height);
  return scene;
}

/// The octagon has no step height: the edge of the first pixel meets its side between foot and arm, half a pixel before
/// the foot would.
Scene pixel_hill_up() {
  Scene scene = on_the_hill(2, half_height, -1, 110);
  scene.answers = {x_is(foot + pixel / 2).law(), y_is(half_height).law()};
  return scene;
}

/// A post as high as 8 px under a character whose picture has legs apart.
Scene legs_apart() {
  Scene scene = flight(0, 2, 0, 0, 90, 30);
  add_box(scene, "floor", -4, -1, 4, 0);
  add_box(scene, "post", -2 * pixel, 0, 2 * pixel, 8 * pixel);
  for (int row = 0; row < 28; ++row) scene.sprite.emplace_back("....############....");
  for (int row = 28; row < 40; ++row) scene.sprite.emplace_back(".....##......##.....");
  ends_at(scene, 0, 8 * pixel + half_height);
  return scene;
}

/// A cloud is painted in the colour of the floor, at the height of the head.
Scene painted_cloud() {
  Scene scene = walk(0, half_height, 1, 90);
  add_box(scene, "floor", -4, -1, 12, 0);
  scene.decoration = {{"cloud", {{2, 0.75}, {4, 0.75}, {3.5, 1.5}, {2.5, 1.5}}}};
  ends_at(scene, walked(scene, scene.steps), half_height);
  return scene;
}

/// Flies along the edge between its head and its right arm, past the corner of a block that is 4/√5 px beside that
/// edge: only the corner of the bounding box meets the block, and its left side.
Scene false_wall() {
  Scene scene = flight(0, 0, 3, -6, 60);
  add_box(scene, "block", 19 * pixel, -4 * pixel, 2, 1);
  scene.answers = {count(Answer::Of::contacts, 0)};
  ends_at(scene, 3, -6);
  return scene;
}

/// A box comes at 2 m/s to a character that walks against it.
Scene enemy_box() {
  Scene scene = walk(0, half_height, 1, 120);
  add_box(scene, "floor", -20, -1, 20, 0);
  add_box(scene, "enemy", 4, 0.05, 4.8, 1.05);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 3, .at = {-6, 0}}});
  ends_at(scene, 4 - 2 * scene.dt * scene.steps - half_width, half_height);
  return scene;
}

/// A ball of half a metre comes past the shoulder of a character that stands: 0.02 m are between them, but their boxes
/// overlap.
Scene round_enemy() {
  Scene scene = flight(0, half_height, 0, 0, 60, 30);
  add_box(scene, "floor", -20, -1, 20, 0);
  constexpr double radius = 0.5;
  constexpr int corners = 32;
  const double along = (2 * foot + half_height + std::sqrt(5.0) * (radius + 0.02));  // 2 x + y of its middle
  const double y = -1;
  std::vector<Vec2d> ball;
  for (int k = 0; k < corners; ++k)
    ball.emplace_back((along - y) / 2 + radius * std::cos(2 * pi * k / corners),
                      half_height + y + radius * std::sin(2 * pi * k / corners));
  add_polygon(scene, "ball", std::move(ball));
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = 1, .at = {-2, 4}}});
  scene.answers = {count(Answer::Of::contacts, 0).to("ball")};
  ends_at(scene, 0, half_height);
  return scene;
}

/// A lift comes from below and meets the feet after 0.4 of the first step; it has taken them 0.48 m up when, after 0.8,
/// a paper that is named first would meet the arm. Later it goes by underneath.
Scene order_of_impact() {
  constexpr int steps = 6;
  Scene scene = flight(0, 0, 30, 0, steps);
  const double step_x = 30 * scene.dt;
  const double rise = 72 * scene.dt;
  const double end = steps * scene.dt;
  const double arm = -10 * pixel;  // the lower end of it
  add_chain(scene, "paper", {{half_width + 0.8 * 2 * step_x, arm - 0.3}, {half_width + 0.8 * 2 * step_x, arm + 0.05}});
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = end, .at = {-steps * step_x, 0}}});
  const double top = -half_height - 0.4 * rise;
  add_box(scene, "lift", -4, top - 0.25, 8, top);
  move_last(scene, {{.time = 0, .at = {0, 0}}, {.time = end, .at = {0, steps * rise}}});
  scene.answers = {contact(0.4, rise).to("lift"), count(Answer::Of::contacts, 0).to("paper")};
  ends_at(scene, steps * step_x, (steps - 0.4) * rise);
  return scene;
}

}  // namespace

std::vector<BuiltInScene> claim_scenes() {
  return {
      {"pixel_hill",
       "down the article's tile of 32 x 32 px with a hill of 45 degrees: a pixel down for each pixel right",
       pixel_hill},
      {"pixel_hill_up",
       "up the same hill: pixel_tile goes a pixel up for each pixel left, the others meet a step of one",
       pixel_hill_up},
      {"legs_apart", "falls onto a post between its legs: the octagon stands on it, a picture with legs does not",
       legs_apart},
      {"painted_cloud", "walks past a cloud that is only painted: who reads colours is stopped by it", painted_cloud},
      {"false_wall", "past a block's corner: four corners meet a wall that is none, eight points and octagon do not",
       false_wall},
      {"enemy_box", "walks against a box that comes at 2 m/s: it is met, and pushes back", enemy_box},
      {"round_enemy", "a ball passes the shoulder without touching it: their boxes overlap", round_enemy},
      {"order_of_impact",
       "a lift at t = 0.4 takes it over a paper that would come at t = 0.8: in order of impact, the paper is never met",
       order_of_impact},
  };
}

}  // namespace paperproof::compare
