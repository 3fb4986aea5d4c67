/// Tiled maps and tilesets written as JSON.
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"
#include "scenes/tiled_model.hpp"

namespace paperproof::compare {

namespace {

using nlohmann::json;

constexpr int most = std::numeric_limits<int>::max();

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

bool flag(const JsonCursor& at, std::string_view key) {
  const auto found = at.find(key);
  return found && found->boolean();
}

TileNumber to_tile_number(const json& value, const JsonCursor& at, std::string_view what) {
  if (value.is_number()) {
    const double number = value.get<double>();
    if (number >= 0 && number <= std::numeric_limits<TileNumber>::max() && std::floor(number) == number) {
      return static_cast<TileNumber>(number);
    }
  }
  at.refuse(fmt::format("expected a tile number as {}", what));
}

std::string as_text(const json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

class JsonReader {
 public:
  explicit JsonReader(std::string path) : path_(std::move(path)) {}

  TiledMap map(const JsonCursor& at) const {
    TiledMap map;
    map.infinite = flag(at, "infinite");
    map.width = integer(at, "width", 0);
    map.height = integer(at, "height", 0);
    map.tile_size = {number(at, "tilewidth", 0), number(at, "tileheight", 0)};
    if (const auto sets = at.find("tilesets")) {
      for (std::size_t i = 0; i < sets->size(); ++i) map.tilesets.push_back(tileset_of_map(sets->element(i)));
    }
    const std::string orientation = word(at, "orientation");
    check_map(map, orientation.empty() ? "orthogonal" : orientation, at.where());
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
        set.tiles[to_tile_number(json::parse(key, nullptr, false), *tiles, "key")] = tile(*tiles->find(key));
      }
    } else {
      for (std::size_t i = 0; i < tiles->size(); ++i) {
        const JsonCursor entry = tiles->element(i);
        const JsonCursor id = entry.require("id");
        set.tiles[to_tile_number(id.value(), id, "id")] = tile(entry);
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
    TiledTileset set = source.empty() ? tileset(at) : read_external_tileset(path_, source, at.where());
    set.first = static_cast<TileNumber>(at.require("firstgid").integer(1, most));
    return set;
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
    if (!list && infinite) return out;
    if (!list) {
      TiledChunk chunk{.x = 0, .y = 0, .width = integer(layer, "width", 0), .height = integer(layer, "height", 0)};
      fill(chunk, layer, layer.require("data"));
      out.push_back(std::move(chunk));
      return out;
    }
    for (std::size_t i = 0; i < list->size(); ++i) {
      const JsonCursor at = list->element(i);
      TiledChunk chunk{.x = integer(at, "x", 0),
                       .y = integer(at, "y", 0),
                       .width = integer(at, "width", 0),
                       .height = integer(at, "height", 0)};
      fill(chunk, layer, at.require("data"));
      out.push_back(std::move(chunk));
    }
    return out;
  }

  /// @param layer says how the tiles are encoded.
  void fill(TiledChunk& chunk, const JsonCursor& layer, const JsonCursor& data) const {
    tiles_.spend(chunk, data.where());
    const auto count = static_cast<std::size_t>(chunk.width) * static_cast<std::size_t>(chunk.height);
    if (data.value().is_string()) {
      chunk.tiles =
          decode_base64(data.value().get_ref<const std::string&>(), word(layer, "compression"), count, data.where());
      return;
    }
    if (data.size() != count) data.refuse(fmt::format("expected {} tiles, found {}", count, data.size()));
    chunk.tiles.reserve(count);
    for (const json& value : data.value()) {
      chunk.tiles.push_back(to_tile_number(value, data, fmt::format("entry {}", chunk.tiles.size())));
    }
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
    if (const auto tile = at.find("gid")) {
      object.tile = to_tile_number(tile->value(), *tile, "gid");
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
    for (std::size_t i = 0; i < list.size(); ++i) {
      const JsonCursor at = list.element(i);
      out.push_back({at.require("x").number(), at.require("y").number()});
    }
    return out;
  }

  std::string path_;
  mutable TileBudget tiles_;  ///< Of the map that is read.
};

}  // namespace

TiledMap read_json_map(const json& document, const std::string& path, const std::string& given) {
  return JsonReader(path).map(JsonCursor(document, given));
}

TiledTileset read_json_tileset(const std::string& path, const std::string& given) {
  const json document = parse_json(read_file(path, given), given);
  return JsonReader(path).tileset(JsonCursor(document, given));
}

}  // namespace paperproof::compare
