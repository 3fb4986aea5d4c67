#include "scenes/tiled_model.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "scenes/input_error.hpp"
#include "scenes/load.hpp"

namespace paperproof::compare {

TiledTileset read_external_tileset(const std::string& map_path, const std::string& file, const std::string& where) {
  const std::filesystem::path folder = std::filesystem::path(map_path).parent_path();
  std::filesystem::path path = folder / file;
  std::error_code error;
  const std::filesystem::path beside = folder / path.filename();
  if (!std::filesystem::exists(path, error) && std::filesystem::exists(beside, error)) path = beside;
  const bool is_json = path.extension() == ".json" || path.extension() == ".tsj";
  try {
    return is_json ? read_json_tileset(path.string(), file) : read_xml_tileset(path.string(), file);
  } catch (const InputError& problem) {
    refuse(where, std::string("tileset ") + problem.what());
  }
}

void check_map(const TiledMap& map, const std::string& orientation, const std::string& where) {
  if (orientation != "orthogonal") refuse(where, fmt::format("expected an orthogonal map, not \"{}\"", orientation));
  if (!(map.tile_size.minCoeff() > 0)) refuse(where, "expected a tile size greater than 0");
  if (!map.infinite && (map.width < 1 || map.height < 1)) refuse(where, "expected a map of at least one tile");
  if (!map.infinite && static_cast<double>(map.width) * map.height > most_tiles_of_a_map) {
    refuse(where, fmt::format("expected a map of at most {} tiles", most_tiles_of_a_map));
  }
  for (std::size_t i = 1; i < map.tilesets.size(); ++i) {
    if (map.tilesets[i].first <= map.tilesets[i - 1].first) {
      refuse(where, fmt::format("expected tilesets in ascending order; \"{}\" is not", map.tilesets[i].name));
    }
  }
}

void TileBudget::spend(const TiledChunk& chunk, const std::string& where) {
  if (chunk.width < 1 || chunk.height < 1) refuse(where, "expected a width and a height of at least one tile");
  spent_ += static_cast<double>(chunk.width) * chunk.height;
  if (spent_ > most_tiles_of_a_map)
    refuse(where, fmt::format("expected at most {} tiles in all layers", most_tiles_of_a_map));
}

}  // namespace paperproof::compare
