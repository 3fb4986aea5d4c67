/// Reads maps and tilesets from Tiled's JSON, or from what TMX and TSX are in it.
#include "scenes/tiled_model.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"
#include "scenes/load.hpp"
#include "scenes/tiled_xml.hpp"

namespace paperproof::compare {

namespace {

using nlohmann::json;

constexpr int most = std::numeric_limits<int>::max();
/// Maps with more than this in all their layers are refused before memory is taken [tiles].
constexpr double most_tiles_of_a_map = 1 << 24;

/// A text that may be missing or empty.
std::string word(const JsonCursor& at, std::string_view key) {
  const auto found = at.find(key);
  if (!found) return {};
  if (!found->value().is_string()) found->refuse("expected a text");
  return found->value().get<std::string>();
}

double number(const JsonCursor& at, std::string_view key, double otherwise) {
  const auto found = at.find(key);
  return found ? found->number() : otherwise;
}

int integer(const JsonCursor& at, std::string_view key, int otherwise) {
  const auto found = at.find(key);
  return found ? found->integer(-most, most) : otherwise;
}

/// @param at where it is, or the list that it is in. @param which of them, as " as entry 3".
TileNumber to_tile_number(const json& value, const JsonCursor& at, std::string_view which = {}) {
  if (value.is_number()) {
    const double number = value.get<double>();
    if (number >= 0 && number <= std::numeric_limits<TileNumber>::max() && std::floor(number) == number) {
      return static_cast<TileNumber>(number);
    }
  }
  at.refuse(fmt::format("expected a tile number{}", which));
}

std::string as_text(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// Refuses what no map may be: other projections, no size, tilesets that do not ascend.
void check_map(const TiledMap& map, const std::string& orientation, const JsonCursor& at) {
  if (!orientation.empty() && orientation != "orthogonal")
    at.refuse(fmt::format("expected an orthogonal map, not \"{}\"", orientation));
  if (!(map.tile_size.minCoeff() > 0)) at.refuse("expected a tile size greater than 0");
  if (!map.infinite && (map.width < 1 || map.height < 1)) at.refuse("expected a map of at least one tile");
  if (!map.infinite && static_cast<double>(map.width) * map.height > most_tiles_of_a_map)
    at.refuse(fmt::format("expected a map of at most {} tiles", most_tiles_of_a_map));
  for (std::size_t i = 1; i < map.tilesets.size(); ++i) {
    if (map.tilesets[i].first <= map.tilesets[i - 1].first)
      at.refuse(fmt::format("expected tilesets in ascending order; \"{}\" is not", map.tilesets[i].name));
  }
}

class MapReader {
 public:
  /// @param path of the map, which external tilesets are relative to.
  explicit MapReader(std::string path) : path_(std::move(path)) {}

  TiledMap map(const JsonCursor& at) const {
    TiledMap map;
    map.infinite = at.flag("infinite");
    map.width = integer(at, "width", 0);
    map.height = integer(at, "height", 0);
    map.tile_size = {number(at, "tilewidth", 0), number(at, "tileheight", 0)};
    if (const auto sets = at.find("tilesets")) {
      for (std::size_t i = 0; i < sets->size(); ++i) map.tilesets.push_back(tileset_of_map(sets->element(i)));
    }
    check_map(map, word(at, "orientation"), at);
    map.layers = layers(at.require("layers"), map, 0);
    return map;
  }

  TiledTileset tileset(const JsonCursor& at) const {
    TiledTileset set;
    set.name = word(at, "name");
    set.tile_size = {at.require("tilewidth").number(), at.require("tileheight").number()};
    if (const auto offset = at.find("tileoffset")) set.tile_offset = {number(*offset, "x", 0), number(*offset, "y", 0)};
    set.object_alignment = word(at, "objectalignment");
    set.tile_count = integer(at, "tilecount", 0);
    const auto tiles = at.find("tiles");
    if (!tiles) return set;
    // Before version 1.2 of the format `tiles` was an object with the ids as keys.
    if (tiles->value().is_object()) {
      for (const auto& [key, value] : tiles->value().items()) {
        set.tiles[to_tile_number(json::parse(key, nullptr, false), *tiles, " as key")] = tile(*tiles->find(key));
      }
    } else {
      for (std::size_t i = 0; i < tiles->size(); ++i) {
        const JsonCursor entry = tiles->element(i);
        const JsonCursor id = entry.require("id");
        set.tiles[to_tile_number(id.value(), id)] = tile(entry);
      }
    }
    return set;
  }

 private:
  static TiledMarks marks(const JsonCursor& at) {
    TiledMarks marks;
    marks.type = word(at, "class").empty() ? word(at, "type") : word(at, "class");
    const auto properties = at.find("properties");
    if (!properties) return marks;
    // Before version 1.2 of the format `properties` was an object.
    if (properties->value().is_object()) {
      for (const auto& [key, value] : properties->value().items()) marks.properties[key] = as_text(value);
      return marks;
    }
    for (std::size_t i = 0; i < properties->size(); ++i) {
      const JsonCursor property = properties->element(i);
      marks.properties[word(property, "name")] = as_text(property.require("value").value());
    }
    return marks;
  }

  static TiledTile tile(const JsonCursor& at) {
    TiledTile tile;
    tile.marks = marks(at);
    if (at.find("imagewidth")) tile.image_size = Vec2d{number(at, "imagewidth", 0), number(at, "imageheight", 0)};
    if (const auto group = at.find("objectgroup")) tile.shapes = objects(group->require("objects"));
    return tile;
  }

  TiledTileset tileset_of_map(const JsonCursor& at) const {
    const std::string source = word(at, "source");
    TiledTileset set = source.empty() ? tileset(at) : external_tileset(source, at.where());
    set.first = static_cast<TileNumber>(at.require("firstgid").integer(1, most));
    return set;
  }

  /// In either format: where the map says, else beside the map under the same file name (maps are passed on without
  /// their folders). @param where the map names it.
  TiledTileset external_tileset(const std::string& file, const std::string& where) const {
    const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
    std::filesystem::path path = folder / file;
    std::error_code error;
    const std::filesystem::path beside = folder / path.filename();
    if (!std::filesystem::exists(path, error) && std::filesystem::exists(beside, error)) path = beside;
    try {
      if (path.extension() == ".json" || path.extension() == ".tsj") {
        const json document = parse_json(read_file(path.string(), file), file);
        return tileset(JsonCursor(document, file));
      }
      const json document = read_tsx(path.string(), file);
      return tileset(JsonCursor::of_converted(document, file));
    } catch (const InputError& problem) {
      refuse(where, std::string("tileset ") + problem.what());
    }
  }

  std::vector<TiledLayer> layers(const JsonCursor& list, const TiledMap& map, int depth) const {
    if (depth > deepest_group) list.refuse("expected fewer groups within groups");
    std::vector<TiledLayer> out;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const JsonCursor at = list.element(i);
      const std::string type = word(at, "type");
      TiledLayer layer;
      layer.name = word(at, "name");
      layer.marks = marks(at);
      layer.marks.type = word(at, "class");  // `type` is the kind of the layer here
      layer.offset = {number(at, "offsetx", 0), number(at, "offsety", 0)};
      layer.where = at.where();
      if (type == "tilelayer") {
        layer.kind = TiledLayer::Kind::tiles;
        layer.chunks = chunks(at, map.infinite);
      } else if (type == "objectgroup") {
        layer.kind = TiledLayer::Kind::objects;
        layer.objects = objects(at.require("objects"));
      } else if (type == "group") {
        layer.kind = TiledLayer::Kind::group;
        layer.layers = layers(at.require("layers"), map, depth + 1);
      } else if (type != "imagelayer") {
        at.refuse("expected a layer whose \"type\" is tilelayer, objectgroup, group or imagelayer");
      }
      out.push_back(std::move(layer));
    }
    return out;
  }

  std::vector<TiledChunk> chunks(const JsonCursor& layer, bool infinite) const {
    std::vector<TiledChunk> out;
    const auto list = layer.find("chunks");
    for (std::size_t i = 0; list && i < list->size(); ++i) {
      const JsonCursor at = list->element(i);
      out.push_back(chunk(at, integer(at, "x", 0), integer(at, "y", 0), layer));
    }
    if (!list && !infinite) out.push_back(chunk(layer, 0, 0, layer));
    return out;
  }

  /// @param at has a size and data. @param layer says how they are compressed.
  TiledChunk chunk(const JsonCursor& at, int x, int y, const JsonCursor& layer) const {
    TiledChunk chunk{.x = x, .y = y, .width = integer(at, "width", 0), .height = integer(at, "height", 0)};
    const JsonCursor data = at.require("data");
    if (chunk.width < 1 || chunk.height < 1) data.refuse("expected a width and a height of at least one tile");
    tiles_ += static_cast<double>(chunk.width) * chunk.height;
    if (tiles_ > most_tiles_of_a_map)
      data.refuse(fmt::format("expected at most {} tiles in all layers", most_tiles_of_a_map));
    const auto count = static_cast<std::size_t>(chunk.width) * static_cast<std::size_t>(chunk.height);
    if (data.value().is_string()) {
      chunk.tiles =
          decode_base64(data.value().get_ref<const std::string&>(), word(layer, "compression"), count, data.where());
      return chunk;
    }
    if (data.size() != count) data.refuse(fmt::format("expected {} tiles, found {}", count, data.size()));
    chunk.tiles.reserve(count);
    for (const json& value : data.value()) {
      chunk.tiles.push_back(to_tile_number(value, data, fmt::format(" as entry {}", chunk.tiles.size())));
    }
    return chunk;
  }

  static std::vector<TiledObject> objects(const JsonCursor& list) {
    std::vector<TiledObject> out;
    for (std::size_t i = 0; i < list.size(); ++i) out.push_back(object(list.element(i)));
    return out;
  }

  static TiledObject object(const JsonCursor& at) {
    TiledObject object;
    object.from_template = at.find("template").has_value();
    object.where = at.where();
    object.id = integer(at, "id", 0);
    object.name = word(at, "name");
    object.marks = marks(at);
    object.at = {number(at, "x", 0), number(at, "y", 0)};
    object.size = {number(at, "width", 0), number(at, "height", 0)};
    object.rotation = number(at, "rotation", 0);
    if (const auto tile = at.find("gid")) object.tile = to_tile_number(tile->value(), *tile);
    if (object.tile != 0) {
      object.shape = TiledObject::Shape::tile;
    } else if (const auto polygon = at.find("polygon")) {
      object.shape = TiledObject::Shape::polygon;
      object.points = points(*polygon);
    } else if (const auto polyline = at.find("polyline")) {
      object.shape = TiledObject::Shape::polyline;
      object.points = points(*polyline);
    } else if (at.flag("ellipse")) {
      object.shape = TiledObject::Shape::ellipse;
    } else if (at.flag("capsule")) {
      object.shape = TiledObject::Shape::capsule;
    } else if (at.flag("point")) {
      object.shape = TiledObject::Shape::point;
    } else if (at.find("text")) {
      object.shape = TiledObject::Shape::text;
    }
    return object;
  }

  static std::vector<Vec2d> points(const JsonCursor& list) {
    std::vector<Vec2d> out;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const JsonCursor at = list.element(i);
      out.push_back({at.require("x").number(), at.require("y").number()});
    }
    return out;
  }

  std::string path_;
  mutable double tiles_ = 0;  ///< Of the map, so far. A packed layer of a few kilobytes could fill the memory.
};

}  // namespace

TiledMap read_tiled_map(const std::string& path, const std::string& given) {
  if (std::filesystem::path(path).extension() != ".tmx")
    return read_tiled_map(parse_json(read_file(path, given), given), path, given);
  const json document = read_tmx(path, given);
  return MapReader(path).map(JsonCursor::of_converted(document, given));
}

TiledMap read_tiled_map(const json& document, const std::string& path, const std::string& given) {
  return MapReader(path).map(JsonCursor(document, given));
}

}  // namespace paperproof::compare
