#include "scenes/pixel_tile_file.hpp"

#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

namespace paperproof::compare {
namespace {

/// As of a picture.
constexpr std::int64_t max_level_pixels = std::int64_t{1} << 26;
/// As of `ArticleKnobs::pixels_per_tile`.
constexpr int max_tile_pixels = 4096;
/// Farther, and the pixels of large tiles leave the range of an int.
constexpr int max_tile_offset = 100'000;
constexpr char no_tile = '.';

struct Letter {
  char letter;
  PixelCollision collision;
};
constexpr std::array pixel_letters{
    Letter{'.', {PixelAction::nothing, PixelAction::nothing}}, Letter{'#', {PixelAction::block, PixelAction::block}},
    Letter{'L', {PixelAction::up, PixelAction::block}},        Letter{'R', {PixelAction::block, PixelAction::up}},
    Letter{'B', {PixelAction::up, PixelAction::up}},           Letter{'l', {PixelAction::down, PixelAction::nothing}},
    Letter{'r', {PixelAction::nothing, PixelAction::down}},    Letter{'b', {PixelAction::down, PixelAction::down}},
};

PixelCollision collision_at(const JsonCursor& row, std::size_t place, char letter) {
  const auto* known = std::find_if(pixel_letters.begin(), pixel_letters.end(),
                                   [letter](const Letter& l) { return l.letter == letter; });
  if (known == pixel_letters.end())
    row.refuse(fmt::format("expected pixels from . # L R B l r b; number {} is none of them", place + 1));
  return known->collision;
}

/// A row of so many characters.
std::string read_row(const JsonCursor& at, std::size_t length) {
  std::string row = at.text();
  if (row.size() != length)
    at.refuse(fmt::format("expected a row of {} characters of ASCII, not {}", length, row.size()));
  return row;
}

/// Rows come from the top, tiles are kept from the lowest row up.
PixelTileSet::Tile read_type(const JsonCursor& at, int size) {
  const auto length = static_cast<std::size_t>(size);
  if (at.size() != length) at.refuse(fmt::format("expected {} rows, one for each pixel, not {}", size, at.size()));
  PixelTileSet::Tile tile;
  tile.reserve(length * length);
  for (std::size_t row = length; row-- > 0;) {
    const JsonCursor entry = at.element(row);
    const std::string pixels = read_row(entry, length);
    for (std::size_t i = 0; i < length; ++i) tile.push_back(collision_at(entry, i, pixels[i]));
  }
  return tile;
}

/// Where the type with a name stands in the list.
using TypeNames = std::map<char, std::uint32_t>;

TypeNames read_types(const JsonCursor& at, PixelTileSet& set) {
  set.types.emplace_back(static_cast<std::size_t>(set.pixels_per_tile) * static_cast<std::size_t>(set.pixels_per_tile));
  TypeNames names{{no_tile, 0}};
  for (const std::string& key : at.keys()) {
    const JsonCursor entry = at.require(key);
    const bool is_name = key.size() == 1 && key[0] > ' ' && key[0] <= '~' && key[0] != no_tile;
    if (!is_name) entry.refuse("expected a tile named by one character of ASCII, and not by '.', which is no tile");
    names[key[0]] = static_cast<std::uint32_t>(set.types.size());
    set.types.push_back(read_type(entry, set.pixels_per_tile));
  }
  return names;
}

void check_level_size(const JsonCursor& at, std::size_t columns, std::size_t rows, int size) {
  // Rows of a file are no longer than it is, so that this stays far below 2^63.
  const std::int64_t width = static_cast<std::int64_t>(columns) * size;
  const std::int64_t height = static_cast<std::int64_t>(rows) * size;
  if (width > max_level_pixels || height > max_level_pixels || width * height > max_level_pixels)
    at.refuse(fmt::format("expected a map of at most {} pixels, not {} x {}", max_level_pixels, width, height));
}

void read_tile_map(const JsonCursor& at, const TypeNames& names, PixelTileSet& set) {
  if (at.size() == 0) at.refuse("expected at least one row of tiles");
  const std::size_t columns = at.element(0).text().size();
  check_level_size(at, columns, at.size(), set.pixels_per_tile);
  set.columns = static_cast<std::int64_t>(columns);
  for (std::size_t row = at.size(); row-- > 0;) {
    const JsonCursor entry = at.element(row);
    const std::string tiles = read_row(entry, columns);
    for (std::size_t i = 0; i < columns; ++i) {
      const auto named = names.find(tiles[i]);
      if (named == names.end())
        entry.refuse(fmt::format("expected names of tiles, and '.' for none; number {} is neither", i + 1));
      set.map.push_back(named->second);
    }
  }
}

bool has_solid_pixel(const PixelTileSet& set) {
  return std::any_of(set.map.begin(), set.map.end(), [&set](std::uint32_t type) {
    const PixelTileSet::Tile& tile = set.types[type];
    return std::any_of(tile.begin(), tile.end(), [](const PixelCollision& pixel) { return pixel.is_solid(); });
  });
}

std::int64_t row_count(const PixelTileSet& set) { return static_cast<std::int64_t>(set.map.size()) / set.columns; }

}  // namespace

PixelTileSet read_pixel_tiles(const std::string& path, const std::string& given) {
  const nlohmann::json document = parse_json(read_file(path, given), given);
  const JsonCursor root(document, given);
  const JsonCursor version = root.require("paperproof_pixel_tiles");
  if (version.integer(0, max_tile_offset) != 1) version.refuse("expected 1, the version of the format");
  root.refuse_other_keys({"$schema", "paperproof_pixel_tiles", "description", "pixels_per_tile", "tiles", "map", "at"});
  if (const auto description = root.find("description")) (void)description->text();
  PixelTileSet set;
  set.pixels_per_tile = root.require("pixels_per_tile").integer(1, max_tile_pixels);
  const TypeNames names = read_types(root.require("tiles"), set);
  const JsonCursor map = root.require("map");
  read_tile_map(map, names, set);
  if (!has_solid_pixel(set)) map.refuse("expected a solid pixel; no tile here has one");
  std::int64_t top = 0;
  if (const auto at = root.find("at")) {
    if (at->size() != 2) at->refuse("expected two whole numbers, [column, row]");
    set.first_column = at->element(0).integer(-max_tile_offset, max_tile_offset);
    top = at->element(1).integer(-max_tile_offset, max_tile_offset);
  }
  set.first_row = top - row_count(set);
  return set;
}

PixelScenery scenery_of(const PixelTileSet& tiles, double pixels_per_metre, const std::string& given) {
  const std::int64_t size = tiles.pixels_per_tile;
  const std::int64_t left = tiles.first_column * size;
  const std::int64_t top = (tiles.first_row + row_count(tiles)) * size;
  const auto is_solid = [&](int column, int row) { return tiles.at(left + column, top - 1 - row).is_solid(); };
  return scenery_of_pixels({.width = static_cast<int>(tiles.columns * size),
                            .height = static_cast<int>(row_count(tiles) * size),
                            .is_solid = is_solid,
                            .left = static_cast<int>(left),
                            .top = static_cast<int>(top)},
                           pixels_per_metre, given);
}

}  // namespace paperproof::compare
