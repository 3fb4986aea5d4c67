#include "scenes/tiled.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include "scenes/input_error.hpp"
#include "scenes/map_defaults.hpp"
#include "scenes/tiled_model.hpp"
#include "scenes/tiled_rule.hpp"
#include "scenes/tiled_shapes.hpp"
#include "scenes/validate.hpp"
#include "words.hpp"

#include <paperproof/number_in.hpp>

namespace paperproof::compare {

namespace {

TiledRole first_mark(TiledRole own, TiledRole around) { return own == TiledRole::unmarked ? around : own; }

/// Where the character is when its lowest point, `lower` from there, is at `ground` or above by a rounding: who stands
/// on the edge of a solid is not inside.
double place_above(double ground, double lower) {
  // The rounded sum and what its rounding left out (Knuth's TwoSum): exact together.
  const auto is_below = [=](double place) {
    const double sum = place + lower;
    const double part = sum - place;
    const double left_out = (place - (sum - part)) + (lower - part);
    return sum < ground || (sum == ground && left_out < 0);
  };
  double place = ground - lower;
  while (is_below(place)) place = std::nextafter(place, std::numeric_limits<double>::infinity());
  return place;
}

/// Turns a map into scenery, by the rule in tiled.hpp.
class MapBuilder {
 public:
  MapBuilder(const TiledMap& map, std::string given, double pixels_per_metre)
      : map_(map), given_(std::move(given)), scale_(pixels_per_metre) {
    scene_.name = std::filesystem::path(given_).stem().string();
    scene_.pixels_per_metre = pixels_per_metre;
  }

  Scene part() {
    add_layers(map_.layers, TiledRole::unmarked, Vec2d::Zero());
    if (!has_still_solids()) {
      only_shapes_ = true;
      add_layers(map_.layers, TiledRole::solid, Vec2d::Zero());
      if (has_still_solids())
        scene_.notes.emplace_back("nothing is marked; tiles with collision shapes are the solids");
    }
    if (!has_still_solids()) {
      refuse(given_,
             "expected at least one solid: a layer named collision, solid or platforms, or things with the class "
             "or property solid (the README has the rule)");
    }
    check_scenery(scene_.scenery, scene_.ids, [this](ColliderIndex index) { return where_[index]; });
    if (templates_ > 0) {
      scene_.notes.push_back(
          fmt::format("{} objects made from templates are left out: templates are not read", templates_));
    }
    note_round_objects();
    scene_.respawn_box = box();
    return std::move(scene_);
  }

  Scene whole() {
    scene_ = part();
    set_map_defaults(scene_);
    place_start();
    return std::move(scene_);
  }

 private:
  [[nodiscard]] bool has_still_solids() const {
    const std::vector<ColliderDef>& colliders = scene_.scenery.colliders;
    return std::any_of(colliders.begin(), colliders.end(), [](const auto& each) { return each.mover == no_mover; });
  }

  void note_round_objects() {
    const auto note = [this](std::size_t count, const std::string& thing, const std::string& one,
                             const std::string& many) {
      if (count > 0) scene_.notes.push_back(fmt::format("{} {}", counted(count, thing), count == 1 ? one : many));
    };
    note(circles_, "object", "as wide as high and round is a circle", "as wide as high and round are circles");
    const std::string inside = fmt::format("straight edges, at most {} px inside of the curve", straight_within);
    note(ellipses_, "ellipse", "has " + inside, "have " + inside);
    note(capsules_, "capsule", "has " + inside, "have " + inside);
  }

  Vec2d to_metres(const Vec2d& pixels) const { return {pixels.x() / scale_, 0 - pixels.y() / scale_}; }

  std::string unused(const std::string& id) {
    std::string name = id;
    for (int i = 2; !ids_.insert(name).second; ++i) name = fmt::format("{}#{}", id, i);
    return name;
  }

  ColliderDef collider_of(const PixelShape& shape, bool one_way) const {
    ColliderDef collider;
    collider.shape = shape.closed ? ColliderDef::Shape::polygon : ColliderDef::Shape::chain;
    if (shape.radius > 0) collider.shape = ColliderDef::Shape::circle;
    collider.radius = shape.radius / scale_;
    for (const Vec2d& point : shape.points) collider.points.push_back(to_metres(point));
    if (one_way) collider.one_way = Vec2d{0, 1};
    return collider;
  }

  void add(const std::vector<PixelShape>& shapes, TiledRole role, const std::string& id) {
    std::vector<PixelShape> pieces;
    for (const PixelShape& shape : shapes) {
      if (role == TiledRole::one_way) {
        for (PixelShape& edge : upper_edges(shape)) pieces.push_back(std::move(edge));
      } else {
        pieces.push_back(shape);
      }
    }
    add_colliders(pieces, role == TiledRole::one_way, id, no_mover);
  }

  void add_colliders(const std::vector<PixelShape>& shapes, bool one_way, const std::string& id, MoverIndex mover) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      check_collider_count(scene_.ids.size() + 1, given_);
      ColliderDef collider = collider_of(shapes[i], one_way);
      collider.mover = mover;
      scene_.scenery.colliders.push_back(std::move(collider));
      scene_.ids.push_back(unused(i == 0 ? id : fmt::format("{}.{}", id, i)));
      where_.push_back(shapes[i].where);
      if (shapes[i].radius > 0)
        ++circles_;
      else if (shapes[i].drawn_as == TiledObject::Shape::ellipse)
        ++ellipses_;
      else if (shapes[i].drawn_as == TiledObject::Shape::capsule)
        ++capsules_;
    }
  }

  void add_layers(const std::vector<TiledLayer>& layers, TiledRole around, const Vec2d& offset) {
    for (const TiledLayer& layer : layers) {
      const TiledRole role = only_shapes_ ? around : first_mark(role_of_layer(layer), around);
      const Vec2d at = offset + layer.offset;
      switch (layer.kind) {
        case TiledLayer::Kind::tiles:
          add_tiles(layer, role, at);
          break;
        case TiledLayer::Kind::objects:
          add_objects(layer, role, at);
          break;
        case TiledLayer::Kind::group:
          add_layers(layer.layers, role, at);
          break;
        case TiledLayer::Kind::other:
          break;
      }
    }
  }

  void add_tiles(const TiledLayer& layer, TiledRole around, const Vec2d& offset) {
    for (const TiledChunk& chunk : layer.chunks) {
      std::size_t next = 0;
      for (int row = chunk.y; row < chunk.y + chunk.height; ++row) {
        for (int column = chunk.x; column < chunk.x + chunk.width; ++column) {
          const TileNumber number = chunk.tiles[next++];
          if (number != 0) add_tile(layer, around, offset, number, column, row);
        }
      }
    }
  }

  void add_tile(const TiledLayer& layer, TiledRole around, const Vec2d& offset, TileNumber number, int column,
                int row) {
    const TileInfo info = find_tile(map_, number, layer.where);
    if (only_shapes_ && !info.has_shapes()) return;
    const TiledRole own = info.tile == nullptr ? TiledRole::unmarked : role_of(info.tile->marks);
    const TiledRole role = first_mark(own, around);
    if (role != TiledRole::solid && role != TiledRole::one_way) return;
    add(shapes_in_cell(map_, info, number, column, row, offset, layer.where), role, fmt::format("t{},{}", column, row));
  }

  void add_objects(const TiledLayer& layer, TiledRole around, const Vec2d& offset) {
    if (only_shapes_) return;
    for (const TiledObject& object : layer.objects) {
      if (names_movers(layer.name)) {
        add_mover(object, offset);
        continue;
      }
      TiledRole role = role_of(object.marks);
      if (role == TiledRole::unmarked && object.shape == TiledObject::Shape::tile) {
        const TileInfo info = find_tile(map_, object.tile, object.where);
        if (info.tile != nullptr) role = role_of(info.tile->marks);
      }
      role = first_mark(role, around);
      if (object.from_template) ++templates_;
      if (role != TiledRole::solid && role != TiledRole::one_way) continue;
      if (object.from_template) refuse(object.where, "expected a solid with its own shape; templates are not read");
      const std::vector<PixelShape> shapes = shapes_of_object(map_, object, offset);
      if (shapes.empty()) scene_.notes.push_back(fmt::format("object {} is left out: it has no area", object.id));
      add(shapes, role, fmt::format("o{}", object.id));
    }
  }

  static std::optional<double> number_property(const TiledObject& object, const std::string& name) {
    const auto found = object.marks.properties.find(name);
    if (found == object.marks.properties.end()) return std::nullopt;
    const std::optional<double> value = number_in<double>(found->second);
    if (!value) refuse(object.where, fmt::format("expected a number in the property \"{}\"", name));
    return value;
  }

  void add_mover(const TiledObject& object, const Vec2d& offset) {
    const std::optional<double> x_speed = number_property(object, "change_x");
    const std::optional<double> y_speed = number_property(object, "change_y");
    const bool vertical = y_speed.value_or(0) != 0;
    const auto low = number_property(object, vertical ? "boundary_bottom" : "boundary_left");
    const auto high = number_property(object, vertical ? "boundary_top" : "boundary_right");
    const bool both = vertical && x_speed.value_or(0) != 0;
    const double speed = (vertical ? y_speed : x_speed).value_or(0);
    if (both || speed == 0 || !low || !high) {
      scene_.notes.push_back(
          fmt::format("mover {} is left out: its path needs one speed and two boundaries", object.id));
      return;
    }
    // Where the object's lower left corner is, from the map's lower left corner, y up.
    const Vec2d corner = upper_left(map_, object, offset);
    const double at = vertical ? map_.height * map_.tile_size.y() - (corner.y() + object.size.y()) : corner.x();
    const double size = vertical ? object.size.y() : object.size.x();
    const std::vector<MoverDef::Waypoint> path = back_and_forth(*low - at, *high - size - at, speed, vertical);
    const std::vector<PixelShape> shapes = shapes_of_object(map_, object, offset);
    if (path.empty() || shapes.empty()) {
      scene_.notes.push_back(fmt::format("mover {} is left out: {}", object.id,
                                         path.empty() ? "its boundaries leave it no way" : "it has no area"));
      return;
    }
    const std::string id = fmt::format("m{}", object.id);
    add_colliders(shapes, false, id, static_cast<MoverIndex>(scene_.movers.size()));
    scene_.movers.push_back({.id = id, .path = path, .loop = MoverDef::Loop::loop});
  }

  /// From 0 to one end of the way, to the other and back to 0. @param low, high [px] relative to the start.
  std::vector<MoverDef::Waypoint> back_and_forth(double low, double high, double speed, bool vertical) const {
    low = std::min(low, 0.0);  // one that begins beyond a turning point turns where it began
    high = std::max(high, 0.0);
    if (!(low < high)) return {};
    constexpr double steps_per_second = 60;
    const double per_second = std::abs(speed) * steps_per_second;
    std::vector<MoverDef::Waypoint> path{{.time = 0, .at = Vec2d::Zero()}};
    double before = 0;
    for (const double next : {speed > 0 ? high : low, speed > 0 ? low : high, 0.0}) {
      if (next == before) continue;
      const Vec2d at = vertical ? Vec2d{0, next / scale_} : Vec2d{next / scale_, 0};
      path.push_back({.time = path.back().time + std::abs(next - before) / per_second, .at = at});
      before = next;
    }
    return path;
  }

  Box2 box() const {
    if (!map_.infinite) {
      const Vec2d size{map_.width * map_.tile_size.x(), map_.height * map_.tile_size.y()};
      return {to_metres({0, size.y()}), to_metres({size.x(), 0})};
    }
    const std::vector<ColliderDef>& colliders = scene_.scenery.colliders;
    const auto still =
        std::find_if(colliders.begin(), colliders.end(), [](const auto& each) { return each.mover == no_mover; });
    Box2 all = box_of(*still);
    for (const ColliderDef& collider : colliders) {
      if (collider.mover == no_mover) all = all.merged(box_of(collider));
    }
    return all.inflated(map_.tile_size.y() / scale_);
  }

  struct Marked {
    const TiledObject* object = nullptr;
    Vec2d offset{Vec2d::Zero()};
  };

  /// The first object that `is_spawn` accepts, in the order of the file.
  template <class Predicate>
  static Marked find_object(const std::vector<TiledLayer>& layers, const Vec2d& offset, const Predicate& is_spawn) {
    for (const TiledLayer& layer : layers) {
      const Vec2d at = offset + layer.offset;
      if (const Marked inner = find_object(layer.layers, at, is_spawn); inner.object != nullptr) return inner;
      for (const TiledObject& object : layer.objects) {
        if (!object.from_template && is_spawn(layer, object)) return {&object, at};
      }
    }
    return {};
  }

  void place_start() {
    const auto by_object = [](const TiledLayer&, const TiledObject& object) {
      return names_spawn(object.name) || names_spawn(object.marks.type);
    };
    const auto by_layer = [](const TiledLayer& layer, const TiledObject&) { return names_spawn(layer.name); };
    Marked marked = find_object(map_.layers, Vec2d::Zero(), by_object);
    if (marked.object == nullptr) marked = find_object(map_.layers, Vec2d::Zero(), by_layer);
    if (marked.object == nullptr) {
      const auto found = first_ground(scene_, *scene_.respawn_box, map_.tile_size.x() / scale_);
      if (!found) refuse(given_, "expected a spawn object, or ground with room above it to begin on");
      scene_.start.position = *found;
      scene_.notes.emplace_back("no spawn is marked; the character begins above the first ground");
      return;
    }
    const Box2& body = scene_.character.shape.box();
    const Vec2d at = to_metres(upper_left(map_, *marked.object, marked.offset));
    if (marked.object->shape == TiledObject::Shape::point)
      scene_.start.position = {at.x() - (body.lower.x() + body.upper.x()) / 2, place_above(at.y(), body.lower.y())};
    else
      scene_.start.position = {at.x() - body.lower.x(), at.y() - body.upper.y()};
    check_start(scene_, marked.object->where);
  }

  const TiledMap& map_;
  std::string given_;
  double scale_;
  bool only_shapes_ = false;  ///< Nothing is marked: tiles with collision shapes are what is solid.
  int templates_ = 0;
  std::size_t circles_ = 0;
  std::size_t ellipses_ = 0;  ///< That have straight edges.
  std::size_t capsules_ = 0;  ///< The same.
  Scene scene_;
  std::vector<std::string> where_;
  std::set<std::string> ids_;
};

Scene whole_scene(const TiledMap& map, const std::string& given) {
  return MapBuilder(map, given, map.tile_size.y()).whole();
}

}  // namespace

Scene read_tiled(const std::string& path, const std::string& given) {
  return whole_scene(read_tiled_map(path, given), given);
}

Scene read_tiled_json(const nlohmann::ordered_json& document, const std::string& path, const std::string& given) {
  return whole_scene(read_tiled_map(document, path, given), given);
}

Scene read_tiled_part(const std::string& path, const std::string& given, double pixels_per_metre) {
  return MapBuilder(read_tiled_map(path, given), given, pixels_per_metre).part();
}

}  // namespace paperproof::compare
