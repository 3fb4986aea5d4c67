#include "scenes/json_scenery.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <type_traits>

#include "scenes/input_error.hpp"
#include "scenes/json_joint.hpp"
#include "scenes/json_motion.hpp"
#include "scenes/load.hpp"
#include "scenes/picture.hpp"
#include "scenes/tiled.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {
namespace {

/// The one shape key of an entry. @throws InputError where there is none, or more than one.
std::string only_shape(const JsonCursor& entry, std::initializer_list<std::string_view> keys) {
  std::string shape;
  for (const std::string_view key : keys) {
    if (!entry.find(key)) continue;
    if (!shape.empty()) entry.refuse(fmt::format("expected exactly one shape; here are \"{}\" and \"{}\"", shape, key));
    shape = key;
  }
  if (shape.empty()) entry.refuse(fmt::format("expected exactly one shape: {}", fmt::join(keys, ", ")));
  return shape;
}

void refuse_key_beside(const JsonCursor& entry, std::string_view key, const std::string& shape,
                       std::string_view needed) {
  if (shape == needed) return;
  if (const auto found = entry.find(key)) found->refuse(fmt::format("expected only beside \"{}\"", needed));
}

/// @param step_seconds of the scene's longest step.
ColliderDef read_collider(const JsonCursor& entry, const std::string& shape, double step_seconds) {
  refuse_key_beside(entry, "holes", shape, "polygon");
  ColliderDef collider;
  if (const auto one_way = entry.find("one_way")) collider.one_way = one_way->point();
  collider.sensor = entry.flag("sensor");
  if (const auto speed = entry.find("surface_speed")) {
    if (collider.sensor) speed->refuse("expected only beside what blocks: nothing stands on a sensor");
    collider.surface_speed = speed->number();
    check_travel(*speed, std::abs(collider.surface_speed) * step_seconds, step_seconds);
  }
  if (shape == "circle") {
    const JsonCursor circle = entry.require("circle");
    if (circle.size() != 3) circle.refuse("expected [x, y, radius]");
    collider.shape = ColliderDef::Shape::circle;
    collider.points = {{circle.element(0).number(), circle.element(1).number()}};
    collider.radius = circle.element(2).number();
    return collider;
  }
  if (shape == "chain") {
    collider.shape = ColliderDef::Shape::chain;
    collider.points = entry.require("chain").points(2);
    return collider;
  }
  collider.points = entry.require("polygon").points(3);
  if (const auto holes = entry.find("holes")) {
    for (std::size_t i = 0; i < holes->size(); ++i) collider.holes.push_back(holes->element(i).points(3));
  }
  return collider;
}

/// @param file that the picture comes from.
PaletteIndex read_palette_index(const JsonCursor& at, const PngPicture& picture, const std::string& file) {
  if (picture.palette.empty())
    at.refuse(fmt::format("expected a colour like \"#00a0ff\": {} has no palette for an index", file));
  const std::size_t last = picture.palette.size() - 1;
  const double index = at.number();
  if (!(index >= 0 && index <= static_cast<double>(last) && std::floor(index) == index))
    at.refuse(fmt::format("expected an index from 0 to {}, the last in the palette of {}", last, file));
  return {static_cast<std::uint8_t>(index)};
}

/// White is solid where the scene says nothing, as in the article's masks.
PictureRule read_picture_rule(const JsonCursor& entry, const PngPicture& picture, const std::string& file) {
  const auto solid = entry.find("solid");
  const auto background = entry.find("background");
  if (solid && background) background->refuse("expected one of \"solid\" and \"background\", not both");
  if (!solid && !background) return {};
  const JsonCursor& at = solid ? *solid : *background;
  if (at.is_number()) return {read_palette_index(at, picture, file), background.has_value()};
  const std::optional<Colour> colour = at.is_text() ? colour_from(at.text()) : std::nullopt;
  if (!colour) at.refuse("expected a colour like \"#00a0ff\", or the index of one in the picture's palette");
  return {*colour, background.has_value()};
}

/// Reads everything that has an id.
class SceneryReader {
 public:
  /// @param step_seconds of the scene's longest step.
  SceneryReader(Scene& scene, std::string path, double step_seconds)
      : scene_(scene), path_(std::move(path)), step_seconds_(step_seconds) {}

  void read(const JsonScenery& lists) {
    for (std::size_t i = 0; i < lists.scenery.size(); ++i) read_entry(lists.scenery.element(i), i);
    for (std::size_t i = 0; lists.movers && i < lists.movers->size(); ++i) read_mover(lists.movers->element(i), i);
    for (std::size_t i = 0; lists.bodies && i < lists.bodies->size(); ++i) read_body(lists.bodies->element(i), i);
    for (std::size_t i = 0; lists.joints && i < lists.joints->size(); ++i) {
      const JsonCursor entry = lists.joints->element(i);
      scene_.joints.push_back(read_joint(entry, take_id(entry, "joints", i), scene_));
    }
    check_scenery(scene_.scenery, scene_.ids, [this](ColliderIndex index) { return where_[index]; });
  }

 private:
  std::string take_id(const JsonCursor& entry, const char* list, std::size_t index) {
    const auto at = entry.find("id");
    std::string id = at ? at->text() : fmt::format("{}/{}", list, index);
    claim(id, at ? *at : entry);
    return id;
  }

  void add(std::string id, ColliderDef collider, std::string where) {
    scene_.scenery.colliders.push_back(std::move(collider));
    scene_.ids.push_back(std::move(id));
    where_.push_back(std::move(where));
  }

  void read_entry(const JsonCursor& entry, std::size_t index) {
    if (entry.find("decoration")) return read_decoration(entry, index);
    entry.refuse_other_keys({"id", "polygon", "holes", "chain", "circle", "one_way", "sensor", "surface_speed", "tiled",
                             "picture", "solid", "background"});
    const std::string shape = only_shape(entry, {"polygon", "chain", "circle", "tiled", "picture"});
    refuse_key_beside(entry, "solid", shape, "picture");
    refuse_key_beside(entry, "background", shape, "picture");
    const std::string id = take_id(entry, "scenery", index);
    const JsonCursor at = entry.require(shape);
    if (shape == "polygon" || shape == "chain" || shape == "circle")
      return add(id, read_collider(entry, shape, step_seconds_), at.where());
    refuse_key_beside(entry, "holes", shape, "polygon");
    for (const char* key : {"one_way", "sensor", "surface_speed"}) {
      if (const auto found = entry.find(key))
        found->refuse("expected only beside \"polygon\", \"chain\" or \"circle\"");
    }
    if (shape == "tiled")
      add_map(id, at);
    else
      add_picture(id, entry, at);
  }

  void read_decoration(const JsonCursor& entry, std::size_t index) {
    entry.refuse_other_keys({"id", "decoration"});
    const std::string id = take_id(entry, "scenery", index);
    const JsonCursor at = entry.require("decoration");
    const ColliderDef drawn{.points = at.points(3)};
    check_scenery({{drawn}}, {id}, [&](ColliderIndex) { return at.where(); });
    scene_.decoration.push_back({id, drawn.points});
  }

  /// Of what the file named at `at` holds.
  void add_part(const std::string& id, ColliderDef collider, const JsonCursor& at) {
    claim(id, at);
    add(id, std::move(collider), at.where());
  }

  void add_map(const std::string& id, const JsonCursor& at) {
    const Scene map = read_beside(at, [this](const std::string& beside, const std::string& file) {
      return read_tiled_part(beside, file, scene_.pixels_per_metre);
    });
    const auto movers_before = static_cast<MoverIndex>(scene_.movers.size());
    for (std::size_t i = 0; i < map.ids.size(); ++i) {
      ColliderDef collider = map.scenery.colliders[i];
      if (collider.mover != no_mover) collider.mover += movers_before;
      add_part(id + "/" + map.ids[i], std::move(collider), at);
    }
    for (MoverDef mover : map.movers) {
      mover.id = id + "/" + mover.id;
      scene_.movers.push_back(std::move(mover));
    }
    for (const std::string& note : map.notes) scene_.notes.push_back(id + ": " + note);
    extend_respawn_box(*map.respawn_box);
  }

  void add_picture(const std::string& id, const JsonCursor& entry, const JsonCursor& at) {
    const PngPicture picture = read_beside(at, read_png);
    const PictureRule rule = read_picture_rule(entry, picture, at.text());
    const PixelScenery pixels = read_beside(at, [&](const std::string&, const std::string& file) {
      return scenery_of(picture, rule, scene_.pixels_per_metre, file);
    });
    for (std::size_t i = 0; i < pixels.ids.size(); ++i)
      add_part(id + "/" + pixels.ids[i], pixels.scenery.colliders[i], at);
    extend_respawn_box(pixels.box);
    scene_.has_pixels = true;
  }

  void extend_respawn_box(const Box2& box) {
    scene_.respawn_box = scene_.respawn_box ? scene_.respawn_box->merged(box) : box;
  }

  /// Reads the file named at `at`, which is beside the scene. Trouble inside it is reported at the place that names it.
  template <class Read>
  std::invoke_result_t<Read, std::string, std::string> read_beside(const JsonCursor& at, const Read& read) const {
    const std::string file = at.text();
    try {
      return read((std::filesystem::path(path_).parent_path() / file).string(), file);
    } catch (const InputError& error) {
      at.refuse(error.what());
    }
  }

  void claim(const std::string& id, const JsonCursor& at) {
    if (!ids_.insert(id).second) at.refuse(fmt::format("expected an id of its own; \"{}\" is taken", id));
  }

  void read_mover(const JsonCursor& entry, std::size_t index) {
    entry.refuse_other_keys(
        {"id", "polygon", "holes", "chain", "circle", "one_way", "sensor", "surface_speed", "path", "angle", "loop"});
    const std::string shape = only_shape(entry, {"polygon", "chain", "circle"});
    MoverDef mover;
    mover.id = take_id(entry, "movers", index);
    ColliderDef collider = read_collider(entry, shape, step_seconds_);
    collider.mover = static_cast<MoverIndex>(scene_.movers.size());
    if (const auto loop = entry.find("loop")) mover.loop = read_loop(*loop);
    const JsonCursor path = entry.require("path");
    mover.path = read_path(path);
    if (mover.loop == MoverDef::Loop::loop && mover.path.front().at != mover.path.back().at) {
      path.element(path.size() - 1)
          .require("at")
          .refuse("expected the place where the path begins: a loop never jumps");
    }
    if (const auto angle = entry.find("angle")) mover.turns = read_turns(*angle);
    add(mover.id, std::move(collider), entry.require(shape).where());
    scene_.movers.push_back(std::move(mover));
  }

  void read_body(const JsonCursor& entry, std::size_t index) {
    entry.refuse_other_keys({"id", "polygon", "holes", "mass", "friction", "restitution", "velocity"});
    MoverDef mover{.id = take_id(entry, "bodies", index), .path = {{}}};
    Body& body = mover.body.emplace();
    if (const auto mass = entry.find("mass")) body.mass = mass->number_within(1e-6, 1e9);
    if (const auto friction = entry.find("friction")) body.friction = friction->number_within(0, 1e6);
    if (const auto restitution = entry.find("restitution")) body.restitution = restitution->number_within(0, 1);
    if (const auto velocity = entry.find("velocity")) body.velocity = read_velocity(*velocity, step_seconds_);
    ColliderDef collider = read_collider(entry, "polygon", step_seconds_);
    collider.mover = static_cast<MoverIndex>(scene_.movers.size());
    add(mover.id, std::move(collider), entry.require("polygon").where());
    scene_.movers.push_back(std::move(mover));
  }

  /// @param read_at what stands under "at". One place of it is reached at one time, in ascending order.
  template <class Point, class ReadAt>
  static std::vector<Point> read_timed(const JsonCursor& at, const ReadAt& read_at) {
    if (at.size() == 0) at.refuse("expected at least one waypoint");
    std::vector<Point> points;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const JsonCursor entry = at.element(i);
      entry.refuse_other_keys({"t", "at"});
      const double time = entry.require("t").not_negative();
      if (!points.empty() && !(time > points.back().time))
        entry.require("t").refuse("expected a time after the one before");
      points.push_back({.time = time, .at = read_at(entry.require("at"))});
    }
    return points;
  }

  static std::vector<MoverDef::Waypoint> read_path(const JsonCursor& at) {
    return read_timed<MoverDef::Waypoint>(at, read_place);
  }

  static std::vector<MoverDef::Turn> read_turns(const JsonCursor& at) {
    return read_timed<MoverDef::Turn>(at, [](const JsonCursor& angle) { return angle.number(); });
  }

  static MoverDef::Loop read_loop(const JsonCursor& at) {
    const std::string word = at.text();
    if (word == "once") return MoverDef::Loop::once;
    if (word == "loop") return MoverDef::Loop::loop;
    if (word == "ping_pong") return MoverDef::Loop::ping_pong;
    at.refuse("expected \"once\", \"loop\" or \"ping_pong\"");
  }

  Scene& scene_;
  std::string path_;
  double step_seconds_;
  std::set<std::string> ids_;
  std::vector<std::string> where_;
};

}  // namespace

void read_json_scenery(const JsonScenery& lists, const std::string& path, Scene& scene) {
  SceneryReader(scene, path, lists.longest_step).read(lists);
}

}  // namespace paperproof::compare
