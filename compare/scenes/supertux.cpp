#include "scenes/supertux.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "scenes/input_error.hpp"
#include "scenes/map_defaults.hpp"
#include "scenes/supertux_level.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {

namespace {

constexpr double tile_pixels = 32;  // also the pixels of a metre

/// The collider of a tile in its cell, y up, or none where the tile blocks nothing.
std::optional<ColliderDef> collider_of(const SuperTuxTile& tile, int column, int row) {
  const auto at = [&](const Vec2d& point) { return Vec2d{column + point.x(), 0 - (row + point.y())}; };
  const SuperTuxTile::Kind kind = tile.kind();
  if (kind == SuperTuxTile::Kind::nothing) return std::nullopt;
  if (kind == SuperTuxTile::Kind::one_way) {
    const auto& [from, to, outwards] = tile.side();
    return ColliderDef{.shape = ColliderDef::Shape::chain, .points = {at(from), at(to)}, .one_way = outwards};
  }
  ColliderDef collider;
  for (const Vec2d& point : tile.solid_part()) collider.points.push_back(at(point));
  return collider;
}

class SectorBuilder {
 public:
  SectorBuilder(const SuperTuxLevel& level, const SuperTuxSector& sector, std::string name)
      : level_(level), sector_(sector) {
    scene_.name = std::move(name);
    set_map_defaults(scene_);
    scene_.character.walk_speed = 7;
    scene_.character.jump_speed = 14;
  }

  /// None where the sector has no solids or no spawn point.
  std::optional<Scene> build() {
    for (std::size_t i = 0; i < sector_.tilemaps.size(); ++i) {
      if (sector_.tilemaps[i].solid) add_tilemap(sector_.tilemaps[i], i);
    }
    for (const SuperTuxPlatform& platform : sector_.platforms) add_platform(platform);
    if (still_colliders_ == 0 || sector_.spawns.empty()) return std::nullopt;
    check_scenery(scene_.scenery, scene_.ids, [this](ColliderIndex) { return sector_.where; });
    scene_.respawn_box = Box2{{0, -size_.y()}, {size_.x(), 0}};
    add_counted_notes();
    place_start();
    return std::move(scene_);
  }

 private:
  void add_tilemap(const SuperTuxTilemap& map, std::size_t index) {
    const std::string own = fmt::format("l{}", index);
    if (!map.path || map.path->waypoints.empty()) {
      size_ = size_.cwiseMax(Vec2d(map.width, map.height));
      return add_still(map, own, Vec2d::Zero());
    }
    const auto& [waypoints, loop, is_clear] = *map.path;
    if (!is_clear) {
      ++unclear_tilemaps_;
    } else if (waypoints.size() == 1) {
      add_still(map, own, waypoints.front().at);
    } else if (add_tiles(map, own + "/", Vec2d::Zero(), static_cast<MoverIndex>(scene_.movers.size())) > 0) {
      scene_.movers.push_back({.id = own, .path = waypoints, .loop = loop});
    }
  }

  /// The first tilemap that stands still gives its tiles the short names.
  void add_still(const SuperTuxTilemap& map, const std::string& own, const Vec2d& offset) {
    still_colliders_ += add_tiles(map, still_colliders_ == 0 ? "" : own + "/", offset, no_mover);
  }

  /// @returns how many of them block.
  std::size_t add_tiles(const SuperTuxTilemap& map, const std::string& prefix, const Vec2d& offset, MoverIndex mover) {
    const std::size_t before = scene_.ids.size();
    for_each_tile(map, [&](ColliderDef collider, int column, int row) {
      check_collider_count(scene_.ids.size() + 1, sector_.where);
      for (Vec2d& point : collider.points) point += offset;
      collider.mover = mover;
      scene_.scenery.colliders.push_back(std::move(collider));
      scene_.ids.push_back(fmt::format("{}t{},{}", prefix, column, row));
    });
    return scene_.ids.size() - before;
  }

  template <class Function>
  void for_each_tile(const SuperTuxTilemap& map, const Function& function) {
    std::size_t next = 0;
    for (int row = 0; row < map.height; ++row) {
      for (int column = 0; column < map.width; ++column) {
        const std::uint32_t number = map.tiles[next++];
        if (number == 0) continue;
        const auto tile = level_.tiles.find(number);
        if (tile == level_.tiles.end()) {
          ++unknown_tiles_;
        } else if (const std::optional<ColliderDef> collider = collider_of(tile->second, column, row)) {
          function(*collider, column, row);
        }
      }
    }
  }

  void add_platform(const SuperTuxPlatform& platform) {
    if (platform.hurts) {
      ++hurting_platforms_;
      return;
    }
    auto [waypoints, loop, is_clear] = platform.path.value_or(SuperTuxPath());
    const std::optional<Vec2d> pixels = sprite_size(level_.root, platform.sprite);
    if (!is_clear || waypoints.empty() || !pixels) {
      ++unclear_platforms_;
      return;
    }
    // One that waits for a script stands where its path begins.
    if (!platform.running) waypoints.resize(1);
    const Vec2d size = *pixels / tile_pixels;
    ColliderDef collider;
    collider.points = {{0, -size.y()}, {size.x(), -size.y()}, {size.x(), 0}, {0, 0}};
    scene_.ids.push_back(fmt::format("platform{}", next_platform_++));
    if (waypoints.size() == 1) {
      for (Vec2d& point : collider.points) point += waypoints.front().at;
    } else {
      collider.mover = static_cast<MoverIndex>(scene_.movers.size());
      scene_.movers.push_back({.id = scene_.ids.back(), .path = std::move(waypoints), .loop = loop});
    }
    scene_.scenery.colliders.push_back(std::move(collider));
  }

  void note(int count, const char* what) {
    if (count > 0) scene_.notes.push_back(fmt::format("{} {}", count, what));
  }

  void add_counted_notes() {
    note(unknown_tiles_, "placed tiles are unknown to tiles.strf and left out");
    note(unclear_tilemaps_, "moving tilemaps are left out: their path is not clear");
    note(unclear_platforms_, "platforms are left out: their path or picture is not clear");
    note(hurting_platforms_, "hurting platforms are left out: they are not solid");
  }

  void place_start() {
    const auto main =
        std::find_if(sector_.spawns.begin(), sector_.spawns.end(), [](const auto& s) { return s.name == "main"; });
    const SuperTuxSpawn& spawn = main == sector_.spawns.end() ? sector_.spawns.front() : *main;
    const Box2& body = scene_.character.shape.box();
    const Vec2d wanted{spawn.at.x() / tile_pixels - body.lower.x(), 0 - spawn.at.y() / tile_pixels - body.upper.y()};
    const std::optional<Vec2d> found = free_place_near(scene_, *scene_.respawn_box, wanted);
    if (!found)
      refuse(sector_.where, fmt::format("expected room for the character near the spawn point \"{}\"", spawn.name));
    scene_.start.position = *found;
    const Vec2d moved = *found - wanted;
    if (moved == Vec2d::Zero()) return;
    scene_.notes.push_back(
        fmt::format("the spawn point \"{}\" is inside a solid for this character: moved by {} px right, "
                    "{} px up",
                    spawn.name, moved.x() * tile_pixels, moved.y() * tile_pixels));
  }

  const SuperTuxLevel& level_;
  const SuperTuxSector& sector_;
  Scene scene_;
  Vec2d size_{Vec2d::Zero()};  ///< Of the largest solid tilemap that stands still [m].
  std::size_t still_colliders_ = 0;
  int unknown_tiles_ = 0;
  int unclear_tilemaps_ = 0;
  int unclear_platforms_ = 0;
  int hurting_platforms_ = 0;
  int next_platform_ = 0;
};

}  // namespace

std::vector<Scene> read_supertux(const std::string& path, const std::string& given) {
  const SuperTuxLevel level = read_supertux_level(path, given);
  const std::string name = std::filesystem::path(given).stem().string();
  std::vector<Scene> scenes;
  std::set<std::string> names;
  for (const SuperTuxSector& sector : level.sectors) {
    const std::string own = level.sectors.size() == 1 ? name : name + "/" + sector.name;
    std::string unused = own;
    for (int i = 2; !names.insert(unused).second; ++i) unused = fmt::format("{}#{}", own, i);
    if (std::optional<Scene> scene = SectorBuilder(level, sector, unused).build()) scenes.push_back(*std::move(scene));
  }
  if (scenes.empty()) refuse(given, "expected a sector with solid tiles and a spawn point");
  return scenes;
}

}  // namespace paperproof::compare
