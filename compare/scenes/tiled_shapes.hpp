/// Places the shapes of tiles and objects on the map, in pixels with y down.
#pragma once

#include "scenes/tiled_model.hpp"

#include <vector>

namespace paperproof::compare {

/// What is round becomes straight edges that lie at most this far inside of it [px]. Small: more corners than a level
/// needs. Large: the picture shows the gap.
inline constexpr double straight_within = 1.0 / 8;

/// On the map [px], y down.
struct PixelShape {
  bool closed = true;  ///< A polygon; otherwise a polyline.
  std::vector<Vec2d> points;
  std::string where;  ///< Of the shape's definition, for messages; empty where it is a whole tile.
  double radius = 0;  ///< Above 0: a circle around its one point.
  /// What it was drawn as: an ellipse or a capsule that is no circle has straight edges instead.
  TiledObject::Shape drawn_as = TiledObject::Shape::polygon;
};

/// A tile of a tileset; `tile` is null where nothing is said about it.
struct TileInfo {
  const TiledTileset* tileset = nullptr;
  const TiledTile* tile = nullptr;

  [[nodiscard]] Vec2d size() const {
    return tile != nullptr && tile->image_size ? *tile->image_size : tileset->tile_size;
  }
  [[nodiscard]] bool has_shapes() const { return tile != nullptr && !tile->shapes.empty(); }
};

/// @throws InputError at `where` for a number that belongs to no tileset.
[[nodiscard]] TileInfo find_tile(const TiledMap& map, TileNumber number, const std::string& where);

/// A tile in its cell: its collision shapes, or its whole rectangle. Larger tiles than cells stand on the cell's lower
/// left corner, as Tiled draws them.
[[nodiscard]] std::vector<PixelShape> shapes_in_cell(const TiledMap& map, const TileInfo& info, TileNumber number,
                                                     int column, int row, const Vec2d& offset,
                                                     const std::string& where);

/// An object: itself, or the shapes of the tile that it shows. Empty where it has none: points, texts, no size. An
/// ellipse or a capsule as wide as high is a circle.
/// @throws InputError for a tile of no tileset, and a round object too large for `straight_within`.
[[nodiscard]] std::vector<PixelShape> shapes_of_object(const TiledMap& map, const TiledObject& object,
                                                       const Vec2d& offset);

/// The upper left corner of an object that is not rotated [px].
[[nodiscard]] Vec2d upper_left(const TiledMap& map, const TiledObject& object, const Vec2d& offset);

/// The edges of a polygon or a circle that face upwards, in connected runs; of a polyline, itself.
[[nodiscard]] std::vector<PixelShape> upper_edges(PixelShape shape);

}  // namespace paperproof::compare
