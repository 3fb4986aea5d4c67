#include "scenes/supertux_level.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "scenes/input_error.hpp"
#include "scenes/load.hpp"
#include "scenes/png_file.hpp"
#include "scenes/s_expression.hpp"

namespace paperproof::compare {

namespace {

constexpr double pixels_per_metre = 32;

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
    if (mode == "oneshot") path.mode = SuperTuxPath::Mode::one_shot;
    if (mode == "pingpong") path.mode = SuperTuxPath::Mode::ping_pong;
    if (mode == "unordered") path.mode = SuperTuxPath::Mode::unordered;
    double speed = 0;
    for (const SExpression& entry : list.items) {
      if (entry.head() != "node") continue;
      const Vec2d at{reader_.number(entry, "x", 0), reader_.number(entry, "y", 0)};
      if (speed > 0) path.nodes.back().time = (at - path.nodes.back().at).norm() / speed;
      path.nodes.push_back({.at = at, .time = reader_.number(entry, "time", 1)});
      speed = reader_.number(entry, "speed", 0);
      for (const char* side : {"before", "after"}) {
        const Vec2d handle{reader_.number(entry, fmt::format("bezier_{}_x", side), at.x()),
                           reader_.number(entry, fmt::format("bezier_{}_y", side), at.y())};
        if (handle != at) path.curved = true;
      }
    }
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
    platform.name = reader_.text(list, "name");
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

std::optional<SuperTuxWay> way_of(const SuperTuxPath& path) {
  if (path.nodes.empty() || path.curved || path.mode == SuperTuxPath::Mode::unordered) return std::nullopt;
  SuperTuxWay way;
  double time = 0;
  const auto add = [&](const SuperTuxPath::Node& node) {
    way.waypoints.push_back({.time = time, .at = {node.at.x() / pixels_per_metre, 0 - node.at.y() / pixels_per_metre}});
    time += node.time;
  };
  for (const SuperTuxPath::Node& node : path.nodes) add(node);
  switch (path.mode) {
    case SuperTuxPath::Mode::circular:
      if (path.nodes.size() > 1) add(path.nodes.front());
      way.loop = MoverDef::Loop::loop;
      break;
    case SuperTuxPath::Mode::ping_pong:
      way.loop = MoverDef::Loop::ping_pong;
      break;
    case SuperTuxPath::Mode::one_shot:
    case SuperTuxPath::Mode::unordered:
      break;
  }
  for (std::size_t i = 1; i < way.waypoints.size(); ++i) {
    if (!(way.waypoints[i].time > way.waypoints[i - 1].time)) return std::nullopt;  // it would have to jump
  }
  return way;
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
