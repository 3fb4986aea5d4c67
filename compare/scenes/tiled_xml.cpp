#include "scenes/tiled_xml.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "records/input_file.hpp"
#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"
#include "scenes/tiled_model.hpp"

#include <paperproof/number_in.hpp>

namespace paperproof::compare {

namespace {

using json = nlohmann::ordered_json;

/// The attributes that are numbers in JSON. `infinite` is true or false there, which needs the number first.
constexpr std::array<std::string_view, 14> numbers{"firstgid",  "gid",     "height",   "id",        "infinite",
                                                   "offsetx",   "offsety", "rotation", "tilecount", "tileheight",
                                                   "tilewidth", "width",   "x",        "y"};

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
  [[nodiscard]] std::size_t line(const pugi::xml_node& node) const {
    const std::ptrdiff_t offset = std::max<std::ptrdiff_t>(node.offset_debug(), 0);
    const auto before =
        std::lower_bound(line_ends_.begin(), line_ends_.end(), static_cast<std::size_t>(offset)) - line_ends_.begin();
    return static_cast<std::size_t>(before) + 1;
  }
  [[nodiscard]] std::string where(const pugi::xml_node& node) const { return at_line(given_, line(node)); }

 private:
  std::string given_;
  std::string text_;
  std::vector<std::size_t> line_ends_;
  pugi::xml_document document_;
};

class Converter {
 public:
  Converter(const std::string& path, const std::string& given) : file_(path, given) {}

  json map() const {
    const pugi::xml_node node = file_.root("map");
    json map = attributes(node);
    map["infinite"] = map.value("infinite", 0.0) != 0;
    map["tilesets"] = json::array();
    for (const pugi::xml_node child : node.children("tileset")) map["tilesets"].push_back(tileset(child));
    map["layers"] = layers(node, 0);
    return map;
  }

  json tileset() const { return tileset(file_.root("tileset")); }

 private:
  double number(const pugi::xml_node& node, const char* name, std::string_view text) const {
    const std::optional<double> value = number_in<double>(text);
    if (!value) refuse(file_.where(node), fmt::format("expected a finite number in \"{}\", not \"{}\"", name, text));
    return *value;
  }

  /// An object of an element's attributes and properties, with its line.
  json attributes(const pugi::xml_node& node) const {
    json out;
    out[line_key] = file_.line(node);
    for (const pugi::xml_attribute attribute : node.attributes()) {
      const char* name = attribute.name();
      if (std::find(numbers.begin(), numbers.end(), name) == numbers.end())
        out.emplace(name, attribute.value());
      else
        out.emplace(name, number(node, name, attribute.value()));
    }
    for (const pugi::xml_node property : node.child("properties").children("property")) {
      const pugi::xml_attribute value = property.attribute("value");  // a text of several lines is the content instead
      out["properties"].push_back(
          {{"name", property.attribute("name").value()}, {"value", value ? value.value() : property.child_value()}});
    }
    return out;
  }

  json tileset(const pugi::xml_node& node) const {
    json out = attributes(node);
    for (const auto& [name, usual] : {std::pair{"firstgid", 1}, {"tilewidth", 0}, {"tileheight", 0}})
      out.emplace(name, usual);
    if (const pugi::xml_node offset = node.child("tileoffset")) out["tileoffset"] = attributes(offset);
    out["tiles"] = json::array();
    for (const pugi::xml_node child : node.children("tile")) {
      json& tile = out["tiles"].emplace_back(attributes(child));
      tile.emplace("id", 0);
      if (const pugi::xml_node image = child.child("image"); image.attribute("width")) {
        const json size = attributes(image);
        tile["imagewidth"] = size["width"];
        tile["imageheight"] = size.value("height", 0.0);
      }
      tile["objectgroup"]["objects"] = objects(child.child("objectgroup"));
    }
    return out;
  }

  /// Groups that are too deep stay empty: the reader refuses them.
  json layers(const pugi::xml_node& parent, int depth) const {
    json out = json::array();
    for (const pugi::xml_node node : parent.children()) {
      const std::string_view name = node.name();
      if (name != "layer" && name != "objectgroup" && name != "imagelayer" && name != "group") continue;
      json& layer = out.emplace_back(attributes(node));
      layer["type"] = name == "layer" ? "tilelayer" : name;
      if (name == "layer") add_tiles(node, layer);
      if (name == "objectgroup") layer["objects"] = objects(node);
      if (name == "group") layer["layers"] = depth < deepest_group ? layers(node, depth + 1) : json::array();
    }
    return out;
  }

  void add_tiles(const pugi::xml_node& node, json& layer) const {
    const pugi::xml_node data = node.child("data");
    if (!data) refuse(file_.where(node), "expected <data> in the tile layer");
    layer["compression"] = data.attribute("compression").value();
    if (!data.child("chunk")) layer["data"] = tiles(data, data);
    for (const pugi::xml_node child : data.children("chunk")) {
      json& chunk = layer["chunks"].emplace_back(attributes(child));
      chunk["data"] = tiles(data, child);
    }
  }

  /// @param data says how the tiles are encoded. @param node holds them.
  json tiles(const pugi::xml_node& data, const pugi::xml_node& node) const {
    const std::string_view encoding = data.attribute("encoding").value();
    if (encoding == "csv") return csv(node.child_value());
    if (encoding == "base64") return node.child_value();
    if (!encoding.empty())
      refuse(file_.where(node), fmt::format("expected the encoding csv, base64 or none, not \"{}\"", encoding));
    json out = json::array();
    for (const pugi::xml_node tile : node.children("tile"))
      out.push_back(number(tile, "gid", tile.attribute("gid").as_string("0")));
    return out;
  }

  /// What is no tile number becomes null, which the reader refuses.
  static json csv(std::string_view text) {
    json out = json::array();
    constexpr std::string_view space = " \t\r\n";
    while (text.find_first_not_of(space) != std::string_view::npos) {
      const std::size_t comma = std::min(text.find(','), text.size());
      std::string_view entry = text.substr(0, comma);
      entry.remove_prefix(std::min(entry.find_first_not_of(space), entry.size()));
      entry = entry.substr(0, entry.find_last_not_of(space) + 1);
      const std::optional<TileNumber> number = number_in<TileNumber>(entry);
      out.push_back(number ? json(*number) : json());
      text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return out;
  }

  json objects(const pugi::xml_node& group) const {
    json out = json::array();
    for (const pugi::xml_node node : group.children("object")) {
      json& object = out.emplace_back(attributes(node));
      for (const char* shape : {"polygon", "polyline"})
        if (const pugi::xml_node child = node.child(shape)) object[shape] = points(child);
      for (const char* shape : {"ellipse", "capsule", "point"})
        if (node.child(shape)) object[shape] = true;
      if (node.child("text")) object["text"] = json::object();
    }
    return out;
  }

  /// "0,0 70,-70 70,70"
  json points(const pugi::xml_node& node) const {
    json out = json::array();
    std::string_view text = node.attribute("points").value();
    while (!text.empty()) {
      const std::size_t space = text.find(' ');
      const std::string_view pair = text.substr(0, space);
      text = space == std::string_view::npos ? std::string_view() : text.substr(space + 1);
      if (pair.empty()) continue;
      const std::size_t comma = pair.find(',');
      if (comma == std::string_view::npos) refuse(file_.where(node), "expected points as \"x,y x,y ...\"");
      out.push_back({{"x", number(node, "points", pair.substr(0, comma))},
                     {"y", number(node, "points", pair.substr(comma + 1))}});
    }
    return out;
  }

  XmlFile file_;
};

}  // namespace

json read_tmx(const std::string& path, const std::string& given) { return Converter(path, given).map(); }

json read_tsx(const std::string& path, const std::string& given) { return Converter(path, given).tileset(); }

}  // namespace paperproof::compare
