/// TMX maps and TSX tilesets.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>

#include "records/input_file.hpp"
#include "scenes/input_error.hpp"
#include "scenes/tiled_model.hpp"

#include <paperproof/number_in.hpp>

namespace paperproof::compare {

namespace {

/// A parsed file with its lines. Not movable: nodes point into it.
class XmlFile {
 public:
  XmlFile(const std::string& path, const std::string& given) : given_(given), text_(read_text(path, given)) {
    if (text_.empty()) refuse(at_line(given_, 1), "expected XML; the file is empty");
    for (std::size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] == '\n') line_ends_.push_back(i);
    }
    const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size());
    if (!result) {
      refuse(at_line(given_, line_of(text_, static_cast<std::size_t>(result.offset))),
             fmt::format("expected XML; {}", result.description()));
    }
  }
  [[nodiscard]] pugi::xml_node root(const char* name) const {
    const pugi::xml_node node = document_.child(name);
    if (!node) refuse(where(document_.first_child()), fmt::format("expected <{}> as the outermost element", name));
    return node;
  }
  [[nodiscard]] std::string where(const pugi::xml_node& node) const {
    const std::ptrdiff_t offset = std::max<std::ptrdiff_t>(node.offset_debug(), 0);
    const auto before =
        std::lower_bound(line_ends_.begin(), line_ends_.end(), static_cast<std::size_t>(offset)) - line_ends_.begin();
    return at_line(given_, static_cast<std::size_t>(before) + 1);
  }

 private:
  std::string given_;
  std::string text_;
  std::vector<std::size_t> line_ends_;
  pugi::xml_document document_;
};

class XmlReader {
 public:
  XmlReader(const std::string& path, const std::string& given) : path_(path), file_(path, given) {}

  TiledMap map() const {
    const pugi::xml_node node = file_.root("map");
    TiledMap map;
    map.infinite = integer(node, "infinite", 0) != 0;
    map.width = integer(node, "width", 0);
    map.height = integer(node, "height", 0);
    map.tile_size = {number(node, "tilewidth", 0), number(node, "tileheight", 0)};
    for (const pugi::xml_node child : node.children("tileset")) map.tilesets.push_back(tileset_of_map(child));
    check_map(map, node.attribute("orientation").as_string("orthogonal"), file_.where(node));
    map.layers = layers(node, 0);
    return map;
  }

  TiledTileset tileset() const { return tileset(file_.root("tileset")); }

 private:
  double to_number(const pugi::xml_node& node, const char* what, std::string_view text) const {
    const std::optional<double> value = number_in<double>(text);
    if (!value) refuse(file_.where(node), fmt::format("expected a finite number in \"{}\", not \"{}\"", what, text));
    return *value;
  }
  double number(const pugi::xml_node& node, const char* name, double otherwise) const {
    const pugi::xml_attribute attribute = node.attribute(name);
    return attribute ? to_number(node, name, attribute.value()) : otherwise;
  }
  double whole(const pugi::xml_node& node, const char* name, double otherwise, double lowest, double highest) const {
    const double value = number(node, name, otherwise);
    if (!(value >= lowest && value <= highest && std::floor(value) == value)) {
      refuse(file_.where(node), fmt::format("expected a whole number in \"{}\"", name));
    }
    return value;
  }
  int integer(const pugi::xml_node& node, const char* name, int otherwise) const {
    constexpr int most = std::numeric_limits<int>::max();
    return static_cast<int>(whole(node, name, otherwise, -most, most));
  }
  TileNumber tile_number(const pugi::xml_node& node, const char* name, TileNumber otherwise) const {
    return static_cast<TileNumber>(whole(node, name, otherwise, 0, std::numeric_limits<TileNumber>::max()));
  }

  static TiledMarks marks(const pugi::xml_node& node) {
    TiledMarks marks;
    marks.type = node.attribute("class").as_string(node.attribute("type").as_string());
    for (const pugi::xml_node property : node.child("properties").children("property")) {
      const pugi::xml_attribute value = property.attribute("value");
      marks.properties[property.attribute("name").as_string()] = value ? value.as_string() : property.child_value();
    }
    return marks;
  }

  TiledTileset tileset_of_map(const pugi::xml_node& node) const {
    const std::string source = node.attribute("source").as_string();
    TiledTileset set = source.empty() ? tileset(node) : read_external_tileset(path_, source, file_.where(node));
    set.first = tile_number(node, "firstgid", 1);
    return set;
  }

  TiledTileset tileset(const pugi::xml_node& node) const {
    TiledTileset set;
    set.name = node.attribute("name").as_string();
    set.tile_size = {number(node, "tilewidth", 0), number(node, "tileheight", 0)};
    const pugi::xml_node offset = node.child("tileoffset");
    if (offset) set.tile_offset = {number(offset, "x", 0), number(offset, "y", 0)};
    set.object_alignment = node.attribute("objectalignment").as_string();
    set.tile_count = integer(node, "tilecount", 0);
    for (const pugi::xml_node child : node.children("tile")) {
      TiledTile& tile = set.tiles[tile_number(child, "id", 0)];
      tile.marks = marks(child);
      if (const pugi::xml_node image = child.child("image"); image && image.attribute("width")) {
        tile.image_size = Vec2d{number(image, "width", 0), number(image, "height", 0)};
      }
      tile.shapes = objects(child.child("objectgroup"));
    }
    return set;
  }

  std::vector<TiledLayer> layers(const pugi::xml_node& parent, int depth) const {
    if (depth > deepest_group) refuse(file_.where(parent), "expected fewer groups within groups");
    std::vector<TiledLayer> out;
    for (const pugi::xml_node node : parent.children()) {
      const std::string_view name = node.name();
      if (name != "layer" && name != "objectgroup" && name != "group") continue;
      TiledLayer layer;
      layer.name = node.attribute("name").as_string();
      layer.marks = marks(node);
      layer.offset = {number(node, "offsetx", 0), number(node, "offsety", 0)};
      layer.where = file_.where(node);
      if (name == "layer") {
        layer.kind = TiledLayer::Kind::tiles;
        layer.chunks = chunks(node);
      } else if (name == "objectgroup") {
        layer.kind = TiledLayer::Kind::objects;
        layer.objects = objects(node);
      } else {
        layer.kind = TiledLayer::Kind::group;
        layer.layers = layers(node, depth + 1);
      }
      out.push_back(std::move(layer));
    }
    return out;
  }

  std::vector<TiledChunk> chunks(const pugi::xml_node& layer) const {
    const pugi::xml_node data = layer.child("data");
    if (!data) refuse(file_.where(layer), "expected <data> in the tile layer");
    if (!data.child("chunk")) {
      TiledChunk whole_layer{
          .x = 0, .y = 0, .width = integer(layer, "width", 0), .height = integer(layer, "height", 0)};
      if (layer.parent().attribute("infinite").as_int() != 0) return {};
      fill(whole_layer, data, data);
      return {whole_layer};
    }
    std::vector<TiledChunk> out;
    for (const pugi::xml_node node : data.children("chunk")) {
      TiledChunk chunk{.x = integer(node, "x", 0),
                       .y = integer(node, "y", 0),
                       .width = integer(node, "width", 0),
                       .height = integer(node, "height", 0)};
      fill(chunk, data, node);
      out.push_back(std::move(chunk));
    }
    return out;
  }

  /// @param data says how the tiles are encoded. @param node holds them.
  void fill(TiledChunk& chunk, const pugi::xml_node& data, const pugi::xml_node& node) const {
    const std::string where = file_.where(node);
    tiles_.spend(chunk, where);
    const auto count = static_cast<std::size_t>(chunk.width) * static_cast<std::size_t>(chunk.height);
    const std::string_view encoding = data.attribute("encoding").as_string();
    if (encoding == "csv") {
      chunk.tiles = decode_csv(node.child_value(), count, where);
    } else if (encoding == "base64") {
      chunk.tiles = decode_base64(node.child_value(), data.attribute("compression").as_string(), count, where);
    } else if (encoding.empty()) {
      for (const pugi::xml_node tile : node.children("tile")) chunk.tiles.push_back(tile_number(tile, "gid", 0));
      if (chunk.tiles.size() != count) {
        refuse(where, fmt::format("expected {} tiles, found {}", count, chunk.tiles.size()));
      }
    } else {
      refuse(where, fmt::format("expected the encoding csv, base64 or none, not \"{}\"", encoding));
    }
  }

  std::vector<TiledObject> objects(const pugi::xml_node& group) const {
    std::vector<TiledObject> out;
    for (const pugi::xml_node node : group.children("object")) out.push_back(object(node));
    return out;
  }

  TiledObject object(const pugi::xml_node& node) const {
    TiledObject object;
    object.where = file_.where(node);
    object.from_template = !node.attribute("template").empty();
    object.id = integer(node, "id", 0);
    object.name = node.attribute("name").as_string();
    object.marks = marks(node);
    object.at = {number(node, "x", 0), number(node, "y", 0)};
    object.size = {number(node, "width", 0), number(node, "height", 0)};
    object.rotation = number(node, "rotation", 0);
    object.tile = tile_number(node, "gid", 0);
    if (object.tile != 0) {
      object.shape = TiledObject::Shape::tile;
    } else if (const pugi::xml_node polygon = node.child("polygon")) {
      object.shape = TiledObject::Shape::polygon;
      object.points = points(polygon);
    } else if (const pugi::xml_node polyline = node.child("polyline")) {
      object.shape = TiledObject::Shape::polyline;
      object.points = points(polyline);
    } else if (node.child("ellipse")) {
      object.shape = TiledObject::Shape::ellipse;
    } else if (node.child("capsule")) {
      object.shape = TiledObject::Shape::capsule;
    } else if (node.child("point")) {
      object.shape = TiledObject::Shape::point;
    } else if (node.child("text")) {
      object.shape = TiledObject::Shape::text;
    }
    return object;
  }

  /// "0,0 70,-70 70,70"
  std::vector<Vec2d> points(const pugi::xml_node& node) const {
    std::vector<Vec2d> out;
    std::string_view text = node.attribute("points").as_string();
    while (!text.empty()) {
      const std::size_t space = text.find(' ');
      const std::string_view pair = text.substr(0, space);
      text = space == std::string_view::npos ? std::string_view() : text.substr(space + 1);
      if (pair.empty()) continue;
      const std::size_t comma = pair.find(',');
      if (comma == std::string_view::npos) refuse(file_.where(node), "expected points as \"x,y x,y ...\"");
      out.push_back(
          {to_number(node, "points", pair.substr(0, comma)), to_number(node, "points", pair.substr(comma + 1))});
    }
    return out;
  }

  std::string path_;
  XmlFile file_;
  mutable TileBudget tiles_;  ///< Of the map that is read.
};

}  // namespace

TiledMap read_tmx_map(const std::string& path, const std::string& given) { return XmlReader(path, given).map(); }

TiledTileset read_xml_tileset(const std::string& path, const std::string& given) {
  return XmlReader(path, given).tileset();
}

}  // namespace paperproof::compare
