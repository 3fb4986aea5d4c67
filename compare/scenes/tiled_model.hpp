/// A Tiled map as it is written, in TMX or in JSON. What counts as solid is decided elsewhere.
#pragma once

#include "scenes/tile_data.hpp"

#include <paperproof/types.hpp>

#include <nlohmann/json_fwd.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What a designer can write onto anything: its class (called type in older files) and its properties.
struct TiledMarks {
  std::string type;
  std::map<std::string, std::string> properties;  ///< Values as text: "true", "1.5".
};

struct TiledObject {
  enum class Shape : std::uint8_t { rectangle, polygon, polyline, ellipse, capsule, point, text, tile };
  int id = 0;
  std::string name;
  TiledMarks marks;
  Shape shape = Shape::rectangle;
  Vec2d at{Vec2d::Zero()};     ///< [px], y down; a tile object's `at` is a corner that its tileset chooses.
  Vec2d size{Vec2d::Zero()};   ///< [px]
  double rotation = 0;         ///< Clockwise about `at` [degrees].
  std::vector<Vec2d> points;   ///< Polygon, polyline: relative to `at` [px].
  TileNumber tile = 0;         ///< Tile objects.
  bool from_template = false;  ///< Its shape stands in another file, which is not read.
  std::string where;           ///< "file:line" or "file: /pointer"
};

struct TiledTile {
  TiledMarks marks;
  std::optional<Vec2d> image_size;  ///< Of an image collection [px].
  std::vector<TiledObject> shapes;  ///< Collision shapes, relative to the tile's top left corner.
};

struct TiledTileset {
  TileNumber first = 1;
  std::string name;
  Vec2d tile_size{Vec2d::Zero()};         ///< [px]
  Vec2d tile_offset{Vec2d::Zero()};       ///< [px]
  std::string object_alignment;           ///< "" means bottomleft.
  int tile_count = 0;                     ///< 0: not stated.
  std::map<TileNumber, TiledTile> tiles;  ///< Only those about which something is said.
};

/// Part of a tile layer; a finite map has one.
struct TiledChunk {
  int x = 0, y = 0, width = 0, height = 0;  ///< [tiles]
  std::vector<TileNumber> tiles{};          ///< Row by row.
};

struct TiledLayer {
  enum class Kind : std::uint8_t { tiles, objects, group, other };
  Kind kind = Kind::other;
  std::string name;
  TiledMarks marks;
  Vec2d offset{Vec2d::Zero()};  ///< Its own [px]; those of the groups around it come on top.
  std::vector<TiledChunk> chunks;
  std::vector<TiledObject> objects;
  std::vector<TiledLayer> layers;  ///< Of a group.
  std::string where;
};

struct TiledMap {
  int width = 0, height = 0;  ///< [tiles]; of an infinite map without meaning.
  bool infinite = false;
  Vec2d tile_size{Vec2d::Zero()};      ///< [px]
  std::vector<TiledTileset> tilesets;  ///< Ascending by `first`.
  std::vector<TiledLayer> layers;
};

/// Bits of a tile number.
inline constexpr TileNumber flipped_horizontally = 0x80000000U;
inline constexpr TileNumber flipped_vertically = 0x40000000U;
inline constexpr TileNumber flipped_diagonally = 0x20000000U;
inline constexpr TileNumber tile_number_mask = 0x0fffffffU;

/// Groups within groups deeper than this are refused.
inline constexpr int deepest_group = 32;

/// A map in either format, by the ending of its name. @throws InputError
[[nodiscard]] TiledMap read_tiled_map(const std::string& path, const std::string& given);
[[nodiscard]] TiledMap read_tiled_map(const nlohmann::ordered_json& document, const std::string& path,
                                      const std::string& given);

}  // namespace paperproof::compare
