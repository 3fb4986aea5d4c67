#include "scenes/supertux_level.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <map>

#include "scenes/input_error.hpp"
#include "scenes/load.hpp"
#include "scenes/png_file.hpp"
#include "scenes/s_expression.hpp"

namespace paperproof::compare {

namespace {

constexpr double pixels_per_metre = 32;

constexpr std::uint32_t solid_bit = 0x01;
constexpr std::uint32_t one_way_bits = 0x02;
constexpr std::uint32_t slope_bit = 0x10;

/// Upper bits of a slope's data: which half of the tile the sloping line spans.
enum class Half : std::uint8_t { whole, bottom, top, left, right };

/// (tile (id 1) (solid #t) (data 0)): one tile, its attributes by name.
void read_tile(const SReader& reader, const SExpression& entry, SuperTuxTiles& tiles) {
  SuperTuxTile tile;
  if (reader.flag(entry, "solid", false)) tile.attributes |= solid_bit;
  if (reader.flag(entry, "unisolid", false)) tile.attributes |= solid_bit | one_way_bits;
  tile.data = static_cast<std::uint32_t>(reader.integer(entry, "data", 0));
  const int id = reader.integer(entry, "id", std::nullopt);
  if (id > 0) tiles[static_cast<std::uint32_t>(id)] = tile;
}

/// (tiles (ids ...) (attributes ...) (datas ...)): a picture with many tiles; 0 stands where there is none.
void read_tiles(const SReader& reader, const SExpression& entry, SuperTuxTiles& tiles) {
  const std::vector<std::uint32_t> ids = reader.numbers(entry, "ids");
  const std::vector<std::uint32_t> attributes = reader.numbers(entry, "attributes");
  const std::vector<std::uint32_t> datas = reader.numbers(entry, "datas");
  if (!attributes.empty() && attributes.size() != ids.size()) reader.refuse(entry, "expected one attribute per id");
  if (!datas.empty() && datas.size() != ids.size()) reader.refuse(entry, "expected one data entry per id");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == 0) continue;
    tiles[ids[i]] = {.attributes = attributes.empty() ? 0 : attributes[i], .data = datas.empty() ? 0 : datas[i]};
  }
}

/// The part of the unit square on the left of the directed line from a to b (seen with y down: its right).
std::vector<Vec2d> cut_square(const Vec2d& a, const Vec2d& b) {
  static const std::array<Vec2d, 4> square{Vec2d{0, 0}, Vec2d{1, 0}, Vec2d{1, 1}, Vec2d{0, 1}};
  const Vec2d along = b - a;
  const auto side = [&](const Vec2d& p) { return along.x() * (p.y() - a.y()) - along.y() * (p.x() - a.x()); };
  std::vector<Vec2d> kept;
  for (std::size_t i = 0; i < square.size(); ++i) {
    const Vec2d& p = square[i];
    const Vec2d& q = square[(i + 1) % square.size()];
    const double from = side(p);
    const double to = side(q);
    if (from >= 0) kept.push_back(p);
    // Every crossing is at a half or a whole: the arithmetic is exact.
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) kept.push_back(p + (q - p) * (from / (from - to)));
  }
  return kept;
}

/// @throws InputError "file:line: ..."
SuperTuxTiles read_supertux_tiles(const std::string& path, const std::string& given) {
  const std::string source = read_text(path, given);
  const SReader reader(given);
  const SExpression file = parse_s_expressions(source, given);
  const SExpression& root = file.items.front();
  if (root.head() != "supertux-tiles") reader.refuse(root, "expected (supertux-tiles ...)");
  SuperTuxTiles tiles;
  for (const SExpression& entry : root.items) {
    if (entry.head() == "tile") read_tile(reader, entry, tiles);
    if (entry.head() == "tiles") read_tiles(reader, entry, tiles);
  }
  if (tiles.empty()) reader.refuse(root, "expected at least one (tile ...) or (tiles ...)");
  return tiles;
}

/// The data root that a level belongs to: the nearest folder above it that holds images/tiles.strf, else where Debian's
/// package supertux-data puts it; none where neither exists.
std::optional<std::string> supertux_root(const std::string& level_path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto holds_tiles = [&](const fs::path& folder) { return fs::exists(folder / "images" / "tiles.strf", error); };
  for (fs::path folder = fs::absolute(level_path, error).parent_path(); folder != folder.parent_path();
       folder = folder.parent_path()) {
    if (holds_tiles(folder)) return folder.string();
  }
  const fs::path installed = "/usr/share/games/supertux2";
  if (holds_tiles(installed)) return installed.string();
  return std::nullopt;
}

class LevelReader {
 public:
  explicit LevelReader(const std::string& given) : reader_(given) {}

  std::vector<SuperTuxSector> sectors(const SExpression& root) {
    if (root.head() != "supertux-level") reader_.refuse(root, "expected (supertux-level ...)");
    std::vector<SuperTuxSector> out;
    for (const SExpression& entry : root.items) {
      if (entry.head() == "sector") out.push_back(sector(entry));
    }
    if (out.empty()) reader_.refuse(root, "expected at least one (sector ...)");
    return out;
  }

 private:
  SuperTuxSector sector(const SExpression& list) {
    SuperTuxSector sector;
    sector.name = reader_.text(list, "name");
    sector.where = reader_.where(list);
    paths_.clear();
    for (const SExpression& entry : list.items) {
      if (entry.head() != "path") continue;
      const SExpression* inner = entry.find("path");
      paths_[std::string(reader_.text(entry, "name"))] = inner == nullptr ? SuperTuxPath() : path(*inner);
    }
    for (const SExpression& entry : list.items) {
      if (entry.head() == "tilemap") sector.tilemaps.push_back(tilemap(entry));
      if (entry.head() == "platform" || entry.head() == "hurting_platform") sector.platforms.push_back(platform(entry));
      if (entry.head() == "spawnpoint") {
        sector.spawns.push_back({.name = std::string(reader_.text(entry, "name")),
                                 .at = {reader_.number(entry, "x", 0), reader_.number(entry, "y", 0)}});
      }
    }
    return sector;
  }

  SuperTuxPath path(const SExpression& list) const {
    SuperTuxPath path;
    const std::string_view mode = reader_.text(list, "mode");
    path.is_clear = mode != "unordered";
    if (mode == "oneshot") path.loop = MoverDef::Loop::once;
    if (mode == "pingpong") path.loop = MoverDef::Loop::ping_pong;
    Vec2d before = Vec2d::Zero();  // [px], y down
    double time = 0;
    double to_next = 0;
    double speed = 0;
    const auto add = [&](const Vec2d& at) {
      time += to_next;
      // Otherwise it would have to jump.
      path.is_clear = path.is_clear && (path.waypoints.empty() || time > path.waypoints.back().time);
      path.waypoints.push_back({.time = time, .at = at});
    };
    for (const SExpression& entry : list.items) {
      if (entry.head() != "node") continue;
      const Vec2d at{reader_.number(entry, "x", 0), reader_.number(entry, "y", 0)};
      if (speed > 0) to_next = (at - before).norm() / speed;
      add({at.x() / pixels_per_metre, 0 - at.y() / pixels_per_metre});
      to_next = reader_.number(entry, "time", 1);
      speed = reader_.number(entry, "speed", 0);
      for (const char* side : {"before", "after"}) {
        const Vec2d handle{reader_.number(entry, fmt::format("bezier_{}_x", side), at.x()),
                           reader_.number(entry, fmt::format("bezier_{}_y", side), at.y())};
        path.is_clear = path.is_clear && handle == at;  // of a curve it lies apart
      }
      before = at;
    }
    if (path.loop == MoverDef::Loop::loop && path.waypoints.size() > 1) add(Vec2d(path.waypoints.front().at));
    return path;
  }

  /// By name, or written inside the object itself.
  std::optional<SuperTuxPath> path_of(const SExpression& object) const {
    if (const SExpression* inner = object.find("path")) return path(*inner);
    const std::string name(reader_.text(object, "path-ref"));
    const auto found = paths_.find(name);
    if (found == paths_.end()) return std::nullopt;
    return found->second;
  }

  SuperTuxTilemap tilemap(const SExpression& list) const {
    SuperTuxTilemap map;
    map.solid = reader_.flag(list, "solid", false);
    map.width = reader_.integer(list, "width", std::nullopt);
    map.height = reader_.integer(list, "height", std::nullopt);
    map.path = path_of(list);
    map.tiles = reader_.numbers(list, "tiles");
    const double expected = static_cast<double>(map.width) * map.height;
    if (map.width < 1 || map.height < 1 || expected != static_cast<double>(map.tiles.size())) {
      reader_.refuse(list, fmt::format("expected {} x {} tiles, found {}", map.width, map.height, map.tiles.size()));
    }
    return map;
  }

  SuperTuxPlatform platform(const SExpression& list) const {
    SuperTuxPlatform platform;
    platform.sprite = reader_.text(list, "sprite");
    if (platform.sprite.empty()) platform.sprite = "images/objects/flying_platform/flying_platform.sprite";
    platform.running = reader_.flag(list, "running", true);
    platform.hurts = list.head() == "hurting_platform";
    platform.path = path_of(list);
    return platform;
  }

  SReader reader_;
  std::map<std::string, SuperTuxPath> paths_;  ///< Of the sector being read.
};

}  // namespace

SuperTuxTile::Kind SuperTuxTile::kind() const noexcept {
  if ((attributes & solid_bit) == 0) return Kind::nothing;
  if ((attributes & slope_bit) != 0) return Kind::slope;
  return (attributes & one_way_bits) != 0 ? Kind::one_way : Kind::solid;
}

const SuperTuxTile::Side& SuperTuxTile::side() const noexcept {
  static const std::array<Side, 4> sides{Side{{0, 0}, {1, 0}, {0, 1}},   // north
                                         Side{{0, 1}, {1, 1}, {0, -1}},  // south
                                         Side{{0, 0}, {0, 1}, {-1, 0}},  // west
                                         Side{{1, 0}, {1, 1}, {1, 0}}};  // east
  return sides[data & 3U];
}

std::vector<Vec2d> SuperTuxTile::solid_part() const {
  if (kind() == Kind::solid) return {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  const auto half = static_cast<Half>(data >> 4U & 7U);
  const double left = half == Half::right ? 0.5 : 0;
  const double right = half == Half::left ? 0.5 : 1;
  const double top = half == Half::bottom ? 0.5 : 0;
  const double bottom = half == Half::top ? 0.5 : 1;
  switch (data & 3U) {
    case 0:
      return cut_square({left, top}, {right, bottom});  // south-west is solid
    case 1:
      return cut_square({right, bottom}, {left, top});  // north-east
    case 2:
      return cut_square({left, bottom}, {right, top});  // south-east
    default:
      return cut_square({right, top}, {left, bottom});  // north-west
  }
}

SuperTuxLevel read_supertux_level(const std::string& path, const std::string& given) {
  const std::string source = read_text(path, given);
  const SExpression file = parse_s_expressions(source, given);
  SuperTuxLevel level;
  level.sectors = LevelReader(given).sectors(file.items.front());
  const std::optional<std::string> root = supertux_root(path);
  if (!root)
    refuse(given, "expected images/tiles.strf in a folder above the level (or Debian's package supertux-data)");
  level.root = *root;
  try {
    level.tiles = read_supertux_tiles((std::filesystem::path(*root) / "images" / "tiles.strf").string(), "tiles.strf");
  } catch (const InputError& error) {
    refuse(given, error.what());
  }
  return level;
}

std::optional<Vec2d> sprite_size(const std::string& root, const std::string& sprite) {
  namespace fs = std::filesystem;
  const fs::path sprite_path = fs::path(root) / fs::path(sprite).relative_path();
  try {
    const std::string source = read_text(sprite_path.string(), sprite);
    const SExpression file = parse_s_expressions(source, sprite);
    const SExpression* action = file.items.front().find("action");
    const SExpression* images = action == nullptr ? nullptr : action->find("images");
    if (images == nullptr || images->items.size() < 2) return std::nullopt;
    const PngPicture picture = read_png((sprite_path.parent_path() / images->items[1].text).string(), sprite);
    return Vec2d(picture.width, picture.height);
  } catch (const InputError&) {
    return std::nullopt;  // not clear what it looks like: the caller counts it
  }
}

}  // namespace paperproof::compare
