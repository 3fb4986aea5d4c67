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

using json = nlohmann::ordered_json;

/// Maps with more than this in all their layers are refused before memory is taken [tiles].
constexpr double most_tiles_of_a_map = 1 << 24;

/// A text that may be missing or empty.
std::string word(const JsonCursor& at, std::string_view key) {
  std::string word;
  at.take(key, word);
  return word;
}

bool flag(const JsonCursor& at, std::string_view key) {
  bool flag = false;
  at.take(key, flag);
  return flag;
}

Vec2d pair(const JsonCursor& at, std::string_view first, std::string_view second) {
  Vec2d pair = Vec2d::Zero();
  at.take(first, pair.x());
  at.take(second, pair.y());
  return pair;
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
  for (std::size_t i = 0; i < map.tilesets.size(); ++i)
    if (map.tilesets[i].first <= (i == 0 ? 0 : map.tilesets[i - 1].first))
      at.refuse(fmt::format("expected tilesets in ascending order from 1 on; \"{}\" is not", map.tilesets[i].name));
}

class MapReader {
 public:
  /// @param path of the map, which external tilesets are relative to.
  explicit MapReader(std::string path) : path_(std::move(path)) {}

  TiledMap map(const JsonCursor& at) const {
    TiledMap map;
    at.take("infinite", map.infinite);
    at.take("width", map.width);
    at.take("height", map.height);
    map.tile_size = pair(at, "tilewidth", "tileheight");
    for_each_entry(at.find("tilesets"), [&](const JsonCursor& set) { map.tilesets.push_back(tileset_of_map(set)); });
    check_map(map, word(at, "orientation"), at);
    map.layers = layers(at.require("layers"), map, 0);
    return map;
  }

  TiledTileset tileset(const JsonCursor& at) const {
    TiledTileset set;
    at.take("name", set.name);
    set.tile_size = {at.require("tilewidth").number(), at.require("tileheight").number()};
    if (const auto offset = at.find("tileoffset")) set.tile_offset = pair(*offset, "x", "y");
    at.take("objectalignment", set.object_alignment);
    at.take("tilecount", set.tile_count);
    const auto tiles = at.find("tiles");
    if (!tiles) return set;
    // Before version 1.2 of the format `tiles` was an object with the ids as keys.
    if (tiles->value().is_object()) {
      for (const auto& [key, value] : tiles->value().items())
        set.tiles[to_tile_number(json::parse(key, nullptr, false), *tiles, " as key")] = tile(*tiles->find(key));
      return set;
    }
    for_each_entry(tiles, [&set](const JsonCursor& entry) {
      const JsonCursor id = entry.require("id");
      set.tiles[to_tile_number(id.value(), id)] = tile(entry);
    });
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
    for_each_entry(properties, [&marks](const JsonCursor& property) {
      marks.properties[word(property, "name")] = as_text(property.require("value").value());
    });
    return marks;
  }

  static TiledTile tile(const JsonCursor& at) {
    TiledTile tile;
    tile.marks = marks(at);
    if (at.find("imagewidth")) tile.image_size = pair(at, "imagewidth", "imageheight");
    if (const auto group = at.find("objectgroup")) tile.shapes = objects(group->require("objects"));
    return tile;
  }

  TiledTileset tileset_of_map(const JsonCursor& at) const {
    const std::string source = word(at, "source");
    TiledTileset set = source.empty() ? tileset(at) : external_tileset(source, at.where());
    const JsonCursor first = at.require("firstgid");
    set.first = to_tile_number(first.value(), first);
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
    for_each_entry(list, [&](const JsonCursor& at) {
      const std::string type = word(at, "type");
      TiledLayer& layer = out.emplace_back();
      at.take("name", layer.name);
      layer.marks = marks(at);
      layer.marks.type = word(at, "class");  // `type` is the kind of the layer here
      layer.offset = pair(at, "offsetx", "offsety");
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
    });
    return out;
  }

  std::vector<TiledChunk> chunks(const JsonCursor& layer, bool infinite) const {
    std::vector<TiledChunk> out;
    const auto list = layer.find("chunks");
    for_each_entry(list, [&](const JsonCursor& at) {
      TiledChunk& part = out.emplace_back(chunk(at, layer));
      at.take("x", part.x);
      at.take("y", part.y);
    });
    if (!list && !infinite) out.push_back(chunk(layer, layer));
    return out;
  }

  /// @param at has a size and data. @param layer says how they are compressed.
  TiledChunk chunk(const JsonCursor& at, const JsonCursor& layer) const {
    TiledChunk chunk;
    at.take("width", chunk.width);
    at.take("height", chunk.height);
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
    for_each_entry(list, [&out](const JsonCursor& at) { out.push_back(object(at)); });
    return out;
  }

  static TiledObject object(const JsonCursor& at) {
    TiledObject object;
    object.from_template = at.find("template").has_value();
    object.where = at.where();
    at.take("id", object.id);
    at.take("name", object.name);
    object.marks = marks(at);
    object.at = pair(at, "x", "y");
    object.size = pair(at, "width", "height");
    at.take("rotation", object.rotation);
    if (const auto tile = at.find("gid")) object.tile = to_tile_number(tile->value(), *tile);
    if (object.tile != 0) {
      object.shape = TiledObject::Shape::tile;
    } else if (const auto polygon = at.find("polygon")) {
      object.shape = TiledObject::Shape::polygon;
      object.points = points(*polygon);
    } else if (const auto polyline = at.find("polyline")) {
      object.shape = TiledObject::Shape::polyline;
      object.points = points(*polyline);
    } else if (flag(at, "ellipse")) {
      object.shape = TiledObject::Shape::ellipse;
    } else if (flag(at, "capsule")) {
      object.shape = TiledObject::Shape::capsule;
    } else if (flag(at, "point")) {
      object.shape = TiledObject::Shape::point;
    } else if (at.find("text")) {
      object.shape = TiledObject::Shape::text;
    }
    return object;
  }

  static std::vector<Vec2d> points(const JsonCursor& list) {
    std::vector<Vec2d> out;
    for_each_entry(list, [&out](const JsonCursor& at) {
      out.push_back({at.require("x").number(), at.require("y").number()});
    });
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
