#include "scenes/json_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <type_traits>

#include "embedded.hpp"
#include "near_names.hpp"
#include "records/collider_json.hpp"
#include "records/schema.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"
#include "scenes/picture.hpp"
#include "scenes/step_times.hpp"
#include "scenes/tiled.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {
namespace {

/// Box2D takes a shorter distance for as long [m], and nearer points have no direction.
constexpr double least_distance = 0.005;
constexpr double longest_distance = 2e6;  ///< [m]

/// One place is reached at one time. @param key of what ascends from entry to entry.
void check_order(const JsonCursor& list, std::string_view key, bool may_repeat) {
  for (std::size_t i = 1; i < list.size(); ++i) {
    const double before = list.element(i - 1).require(key).number();
    const JsonCursor at = list.element(i).require(key);
    if (!(may_repeat ? at.number() >= before : at.number() > before))
      at.refuse(may_repeat ? "expected events in the order of their steps" : "expected a time after the one before");
  }
}

/// @param file that the picture comes from.
PaletteIndex read_palette_index(const JsonCursor& at, const PngPicture& picture, const std::string& file) {
  if (picture.palette.empty())
    at.refuse(fmt::format("expected a colour like \"#00a0ff\": {} has no palette for an index", file));
  const std::size_t last = picture.palette.size() - 1;
  if (at.number() > static_cast<double>(last))
    at.refuse(fmt::format("expected an index from 0 to {}, the last in the palette of {}", last, file));
  return {static_cast<std::uint8_t>(at.integer())};
}

/// White is solid where the scene says nothing, as in the article's masks.
PictureRule read_picture_rule(const JsonCursor& entry, const PngPicture& picture, const std::string& file) {
  const auto background = entry.find("background");
  const auto at = background ? background : entry.find("solid");
  if (!at) return {};
  if (at->value().is_number()) return {read_palette_index(*at, picture, file), background.has_value()};
  return {*colour_from(at->get<std::string>()), background.has_value()};
}

/// Takes the values of a document that holds to the schema, and refuses what a schema cannot say.
class SceneReader {
 public:
  SceneReader(const JsonCursor& root, std::string path) : root_(root), path_(std::move(path)) {}

  Scene read() {
    root_.take("name", scene_.name);
    root_.take("description", scene_.description);
    root_.take("pixels_per_metre", scene_.pixels_per_metre);
    root_.take("dt", scene_.dt);
    root_.take("dt_list", scene_.dt_list);
    root_.take("steps", scene_.steps);
    root_.take("gravity", scene_.gravity);
    dt_ = StepTimes(scene_).longest();
    check_travel(root_.require("gravity"), scene_.gravity.cwiseAbs().maxCoeff() * dt_ * dt_);
    const JsonCursor character = root_.require("character");
    read_character(character);
    read_scenery();
    if (const auto input = root_.find("input")) scene_.input = read_input(*input);
    check_start_at(character, 0);
    for_each_entry(root_.find("characters"), [this](const JsonCursor& entry) {
      const auto input = entry.find("input");
      scene_.others.push_back({read_start(entry), input ? read_input(*input) : scene_.input});
      check_start_at(entry, scene_.others.size());
    });
    return std::move(scene_);
  }

 private:
  void check_start_at(const JsonCursor& character, std::size_t index) const {
    check_start(scene_, character.require("position").where(),
                "\"start_overlap\": \"resolve\" beside it asks to move it out", index);
  }

  /// Refuses what leaves in one step what a sweep can hold; later steps are watched by the run.
  /// @param per_step how far it moves the character in the longest step [m].
  void check_travel(const JsonCursor& at, double per_step) const {
    constexpr double most = 1e6;  // of the guarantee
    if (!(per_step <= most)) at.refuse(fmt::format("expected at most 1e6 m of motion in a step of {} s", dt_));
  }

  void take_speed(const JsonCursor& object, std::string_view key, double& speed) const {
    object.take(key, speed);
    if (const auto at = object.find(key)) check_travel(*at, std::abs(speed) * dt_);
  }

  void take_velocity(const JsonCursor& object, Vec2d& velocity) const {
    object.take("velocity", velocity);
    if (const auto at = object.find("velocity")) check_travel(*at, velocity.cwiseAbs().maxCoeff() * dt_);
  }

  [[nodiscard]] Start read_start(const JsonCursor& character) const {
    Start start;
    character.take("position", start.position);
    take_velocity(character, start.velocity);
    const auto overlap = character.find("start_overlap");
    start.resolve_overlap = overlap && overlap->value() == "resolve";
    return start;
  }

  void read_character(const JsonCursor& at) {
    CharacterDef& character = scene_.character;
    const auto points = at.find("points_px");
    character.shape = CharacterShape::article(scene_.pixels_per_metre);
    try {
      if (points)
        character.shape = CharacterShape::from_pixels(points->get<std::vector<Vec2d>>(), scene_.pixels_per_metre);
    } catch (const InvalidCharacter& error) {
      points->refuse(error.what());
    }
    scene_.start = read_start(at);
    take_speed(at, "walk_speed", character.walk_speed);
    at.take("acceleration", character.acceleration);
    at.take("air_acceleration", character.air_acceleration);
    take_speed(at, "jump_speed", character.jump_speed);
    at.take("max_fall_speed", character.max_fall_speed);
    at.take("max_climb_degrees", character.max_climb_degrees);
    at.take("snap", character.snap);
    at.take("step_height", character.step_height);
    at.take("no_jump_toward_wall", scene_.jump_rules.no_jump_toward_wall);
    at.take("side_hit_ends_rise", scene_.jump_rules.side_hit_ends_rise);
    at.take("sprite", scene_.sprite);
    if (const auto sprite = at.find("sprite")) check_sprite(*sprite);
    try {
      character.validate();
    } catch (const InvalidCharacter& error) {
      at.refuse(error.what());
    }
  }

  void check_sprite(const JsonCursor& at) const {
    const Box2& box = scene_.character.shape.box();
    const Vec2d size = (box.upper - box.lower) * scene_.pixels_per_metre;
    const Vec2d whole(std::round(size.x()), std::round(size.y()));
    const std::vector<std::string>& rows = scene_.sprite;
    if ((size - whole).cwiseAbs().maxCoeff() > 1e-6) at.refuse("expected a character as large as whole pixels");
    if (static_cast<double>(rows.size()) != whole.y())
      at.refuse(fmt::format("expected {} rows, as high as the character, not {}", whole.y(), rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (static_cast<double>(rows[i].size()) != whole.x())
        at.element(i).refuse(fmt::format("expected {} pixels, not {}", whole.x(), rows[i].size()));
    if (std::none_of(rows.begin(), rows.end(), [](const std::string& row) { return row.find('#') != row.npos; }))
      at.refuse("expected a pixel that collides, #");
  }

  static std::vector<InputEvent> read_input(const JsonCursor& at) {
    std::vector<InputEvent> events;
    for_each_entry(at, [&events](const JsonCursor& entry) {
      InputEvent& event = events.emplace_back();
      entry.take("step", event.step);
      entry.take("move", event.move);
      entry.take("jump", event.jump);
      entry.take("drop", event.drop);
    });
    check_order(at, "step", true);
    return events;
  }

  void read_scenery() {
    const JsonCursor scenery = root_.require("scenery");
    bool empty = false;
    root_.take("empty", empty);
    if (scenery.size() == 0 && !empty) scenery.refuse("expected at least one solid, or \"empty\": true beside it");
    if (scenery.size() > 0 && empty) root_.require("empty").refuse("expected false, as \"scenery\" is not empty");
    read_list("scenery", &SceneReader::read_entry);
    read_list("movers", &SceneReader::read_mover);
    read_list("bodies", &SceneReader::read_body);
    read_list("joints", &SceneReader::read_joint);
    check_scenery(scene_.scenery, scene_.ids, [this](ColliderIndex index) { return where_[index]; });
  }

  void read_list(const char* list, void (SceneReader::*take_entry)(const JsonCursor& entry, const std::string& id)) {
    const auto entries = root_.find(list);
    for (std::size_t i = 0; entries && i < entries->size(); ++i) {
      const JsonCursor entry = entries->element(i);
      std::string id = fmt::format("{}/{}", list, i);
      entry.take("id", id);
      claim(id, entry.find("id").value_or(entry));
      (this->*take_entry)(entry, id);
    }
  }

  void claim(const std::string& id, const JsonCursor& at) {
    if (!ids_.insert(id).second) at.refuse(fmt::format("expected an id of its own; \"{}\" is taken", id));
  }

  void add(std::string id, ColliderDef collider, std::string where) {
    scene_.scenery.colliders.push_back(std::move(collider));
    scene_.ids.push_back(std::move(id));
    where_.push_back(std::move(where));
  }

  void add_collider(const JsonCursor& entry, const std::string& id, MoverIndex mover = no_mover) {
    ColliderDef collider = collider_of(entry.value());
    collider.mover = mover;
    take_speed(entry, "surface_speed", collider.surface_speed);
    if (collider.sensor && entry.find("surface_speed"))
      entry.require("surface_speed").refuse("expected only beside what blocks: nothing stands on a sensor");
    const auto circle = entry.find("circle");
    const auto chain = entry.find("chain");
    add(id, std::move(collider), (circle ? *circle : chain ? *chain : entry.require("polygon")).where());
  }

  void read_entry(const JsonCursor& entry, const std::string& id) {
    if (const auto map = entry.find("tiled")) return add_map(id, *map);
    if (const auto picture = entry.find("picture")) return add_picture(id, entry, *picture);
    const auto decoration = entry.find("decoration");
    if (!decoration) return add_collider(entry, id);
    const ColliderDef drawn{.points = decoration->get<std::vector<Vec2d>>()};
    check_scenery({{drawn}}, {id}, [&](ColliderIndex) { return decoration->where(); });
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
    const PictureRule rule = read_picture_rule(entry, picture, at.get<std::string>());
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
    const auto file = at.get<std::string>();
    try {
      return read((std::filesystem::path(path_).parent_path() / file).string(), file);
    } catch (const InputError& error) {
      at.refuse(error.what());
    }
  }

  template <class Point>
  static std::vector<Point> read_timed(const JsonCursor& at) {
    std::vector<Point> points;
    for_each_entry(at, [&points](const JsonCursor& entry) {
      Point& point = points.emplace_back();
      entry.take("t", point.time);
      entry.take("at", point.at);
    });
    check_order(at, "t", false);
    return points;
  }

  void read_mover(const JsonCursor& entry, const std::string& id) {
    add_collider(entry, id, static_cast<MoverIndex>(scene_.movers.size()));
    const JsonCursor path = entry.require("path");
    MoverDef& mover = scene_.movers.emplace_back(MoverDef{.id = id, .path = read_timed<MoverDef::Waypoint>(path)});
    for (const auto loop : {MoverDef::Loop::loop, MoverDef::Loop::ping_pong})
      if (const auto at = entry.find("loop"); at && at->value() == name_of(loop)) mover.loop = loop;
    if (mover.loop == MoverDef::Loop::loop && mover.path.front().at != mover.path.back().at)
      path.element(path.size() - 1)
          .require("at")
          .refuse("expected the place where the path begins: a loop never jumps");
    if (const auto angle = entry.find("angle")) mover.turns = read_timed<MoverDef::Turn>(*angle);
  }

  void read_body(const JsonCursor& entry, const std::string& id) {
    add_collider(entry, id, static_cast<MoverIndex>(scene_.movers.size()));
    Body& body = scene_.movers.emplace_back(MoverDef{.id = id, .path = {{}}}).body.emplace();
    entry.take("mass", body.mass);
    entry.take("friction", body.friction);
    entry.take("restitution", body.restitution);
    take_velocity(entry, body.velocity);
  }

  [[nodiscard]] MoverIndex body_named(const JsonCursor& at) const {
    const auto id = at.get<std::string>();
    std::vector<std::string> bodies;
    for (MoverIndex i = 0; i < scene_.movers.size(); ++i) {
      if (!scene_.movers[i].body) continue;
      if (scene_.movers[i].id == id) return i;
      bodies.push_back(scene_.movers[i].id);
    }
    at.refuse(fmt::format("expected the id of one of \"bodies\"; \"{}\" is none{}", id, did_you_mean(id, bodies)));
  }

  void read_joint(const JsonCursor& entry, const std::string& id) {
    Joint& joint = scene_.joints.emplace_back();
    joint.id = id;
    const JsonCursor bodies = entry.require("bodies");
    joint.body = body_named(bodies.element(0));
    if (bodies.size() > 1) joint.other = body_named(bodies.element(1));
    if (const auto distance = entry.find("distance")) {
      joint.point = distance->element(0).get<Vec2d>();
      joint.end = distance->element(1).get<Vec2d>();
      joint.length = (joint.end - joint.point).norm();
      if (!(joint.length >= least_distance && joint.length <= longest_distance))
        distance->refuse(
            fmt::format("expected two points that are from {} to {} m apart", least_distance, longest_distance));
      entry.take("length", joint.length);
      entry.take("stiffness", joint.stiffness);
      entry.take("damping", joint.damping);
    } else if (entry.find("revolute")) {
      joint.kind = Joint::Kind::revolute;
      entry.take("revolute", joint.point);
    } else {
      joint.kind = Joint::Kind::prismatic;
      entry.take("prismatic", joint.axis);
      if (const double size = joint.axis.norm(); !(size >= 1e-6 && size <= 1e6))
        entry.require("prismatic").refuse("expected a direction: a vector 1e-6 to 1e6 long");
    }
  }

  JsonCursor root_;
  std::string path_;
  double dt_ = 0;  ///< Of the longest step [s].
  Scene scene_;
  std::set<std::string> ids_;
  std::vector<std::string> where_;
};

}  // namespace

Scene read_json_scene(const Json& document, const std::string& path, const std::string& given) {
  static const Schema schema(scene_schema.front().text);
  const JsonCursor root(document, given);
  static_cast<void>(root.require("paperproof_scene"));  // what has none is no scene, whatever its keys
  if (const std::optional<std::string> fault = schema.fault(document)) refuse(given, *fault);
  return SceneReader(root, path).read();
}

}  // namespace paperproof::compare
