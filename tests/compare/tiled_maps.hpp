/// Maps of Tiled that tests write.
#pragma once

#include "compare/scene_files.hpp"

#include <string>

namespace paperproof::compare {

/// A map of 4 x 3 tiles of 16 px with one tileset of 10 tiles, which are plain where nothing is said of them.
/// @param layers from line 4 on. Like all text here it may have ' for ".
inline std::string tmx(const std::string& layers, const std::string& tiles = "") {
  return quoted(
      "<?xml version='1.0'?>\n"
      "<map orientation='orthogonal' width='4' height='3' tilewidth='16' tileheight='16'>\n"
      "<tileset firstgid='1' name='plain' tilewidth='16' tileheight='16' tilecount='10'>" +
      tiles + "</tileset>\n" + layers + "\n</map>\n");
}

inline std::string tile_layer(const std::string& name, const std::string& data) {
  return quoted("<layer name='" + name + "' width='4' height='3'>" + data + "</layer>");
}

inline std::string csv_layer(const std::string& tiles, const std::string& name = "Collision") {
  return tile_layer(name, "<data encoding='csv'>" + tiles + "</data>");
}

inline std::string objects(const std::string& layer, const std::string& content) {
  return quoted("<objectgroup name='" + layer + "'>" + content + "</objectgroup>");
}

inline const std::string floor_csv = "0,0,0,0, 0,0,0,0, 1,1,1,1";
inline const std::string spawn = objects("things", "<object id='1' name='Spawn' x='2' y='8'/>");

}  // namespace paperproof::compare
