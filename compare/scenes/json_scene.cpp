#include "scenes/json_scene.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <type_traits>

#include "scenes/input_error.hpp"
#include "scenes/json_text.hpp"
#include "scenes/load.hpp"
#include "scenes/picture.hpp"
#include "scenes/step_times.hpp"
#include "scenes/tiled.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {

namespace {

constexpr int most_steps = std::numeric_limits<int>::max();
/// [m], of the sweep: see Tolerances<double>::range
constexpr double largest_coordinate = 2e6;

/// A key of the format that this version does not run. Refused in words: ignoring it would run another scene.
void refuse_unsupported(const JsonCursor& object, std::string_view key, const char* needs) {
  if (const auto found = object.find(key)) {
    found->refuse(fmt::format("\"{}\" needs {}, which this version does not have", key, needs));
  }
}

double not_negative(const JsonCursor& at) {
  const double value = at.number();
  if (!(value >= 0)) at.refuse("expected a number that is not negative");
  return value;
}

double read_not_negative(const JsonCursor& object, std::string_view key, double otherwise) {
  const auto found = object.find(key);
  return found ? not_negative(*found) : otherwise;
}

bool read_flag(const JsonCursor& object, std::string_view key) {
  const auto found = object.find(key);
  return found && found->boolean();
}

std::vector<Vec2d> read_points(const JsonCursor& at, std::size_t at_least) {
  if (at.size() < at_least) at.refuse(fmt::format("expected an array of at least {} points", at_least));
  std::vector<Vec2d> points;
  points.reserve(at.size());
  for (std::size_t i = 0; i < at.size(); ++i) points.push_back(at.element(i).point());
  return points;
}

CharacterShape read_shape(const JsonCursor& character, double pixels_per_metre) {
  const auto at = character.find("points_px");
  if (!at) return CharacterShape::article(pixels_per_metre);
  const std::vector<Vec2d> points = read_points(*at, 3);
  try {
    return CharacterShape::from_pixels(points, pixels_per_metre);
  } catch (const InvalidCharacter& error) {
    at->refuse(error.what());
  }
}

/// A number in [lowest, highest].
double within(const JsonCursor& at, double lowest, double highest) {
  const double value = at.number();
  if (!(value >= lowest && value <= highest))
    at.refuse(fmt::format("expected a number from {} to {}", lowest, highest));
  return value;
}

/// Refuses speeds that leave in one step what a sweep can hold; later steps are watched by the run.
/// @param per_step how far it moves the character in a step [m].
void check_travel(const JsonCursor& at, double per_step, double dt) {
  constexpr double most = 1e6;  // of the guarantee
  if (!(per_step <= most)) at.refuse(fmt::format("expected at most 1e6 m of motion in a step of {} s", dt));
}

double largest(const Vec2d& v) { return v.cwiseAbs().maxCoeff(); }

/// @param dt of the longest step [s].
Start read_start(const JsonCursor& character, double dt) {
  Start start;
  const JsonCursor position = character.require("position");
  start.position = position.point();
  if (!(start.position.cwiseAbs().maxCoeff() <= largest_coordinate))
    position.refuse("expected coordinates within 2e6 m");
  if (const auto velocity = character.find("velocity")) {
    start.velocity = velocity->point();
    check_travel(*velocity, largest(start.velocity) * dt, dt);
  }
  if (const auto overlap = character.find("start_overlap")) {
    const std::string word = overlap->text();
    if (word != "resolve" && word != "refuse") overlap->refuse("expected \"resolve\" or \"refuse\"");
    start.resolve_overlap = word == "resolve";
  }
  return start;
}

double read_speed(const JsonCursor& object, std::string_view key, double otherwise, double dt) {
  const double speed = read_not_negative(object, key, otherwise);
  if (const auto found = object.find(key)) check_travel(*found, speed * dt, dt);
  return speed;
}

/// @param dt of the longest step [s].
void read_character(const JsonCursor& at, double dt, Scene& scene) {
  refuse_unsupported(at, "step_height", "stepping up");
  at.refuse_other_keys({"points_px", "position", "velocity", "start_overlap", "walk_speed", "acceleration",
                        "air_acceleration", "jump_speed", "max_fall_speed", "max_climb_degrees", "snap",
                        "no_jump_toward_wall", "side_hit_ends_rise"});
  CharacterDef& character = scene.character;
  character.shape = read_shape(at, scene.pixels_per_metre);
  scene.start = read_start(at, dt);
  character.walk_speed = read_speed(at, "walk_speed", character.walk_speed, dt);
  character.acceleration = read_not_negative(at, "acceleration", character.acceleration);
  if (const auto air = at.find("air_acceleration")) character.air_acceleration = not_negative(*air);
  character.jump_speed = read_speed(at, "jump_speed", character.jump_speed, dt);
  if (const auto limit = at.find("max_fall_speed")) character.max_fall_speed = limit->positive();
  if (const auto climb = at.find("max_climb_degrees")) {
    character.max_climb_degrees = climb->number();
    if (!(character.max_climb_degrees >= 0 && character.max_climb_degrees <= 89)) {
      climb->refuse("expected an angle from 0 to 89 degrees");
    }
  }
  if (const auto snap = at.find("snap")) character.snap = within(*snap, 0, 1e6);
  character.no_jump_toward_wall = read_flag(at, "no_jump_toward_wall");
  character.side_hit_ends_rise = read_flag(at, "side_hit_ends_rise");
  try {
    character.validate();
  } catch (const InvalidCharacter& error) {
    at.refuse(error.what());
  }
}

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

ColliderDef read_collider(const JsonCursor& entry, const std::string& shape) {
  refuse_key_beside(entry, "holes", shape, "polygon");
  refuse_key_beside(entry, "one_way", shape, "chain");
  ColliderDef collider;
  collider.sensor = read_flag(entry, "sensor");
  if (const auto speed = entry.find("surface_speed")) {
    if (collider.sensor) speed->refuse("expected only beside what blocks: nothing stands on a sensor");
    collider.surface_speed = speed->number();
  }
  if (shape == "chain") {
    collider.shape = ColliderDef::Shape::chain;
    collider.points = read_points(entry.require("chain"), 2);
    if (const auto one_way = entry.find("one_way")) collider.one_way = one_way->point();
    return collider;
  }
  collider.points = read_points(entry.require("polygon"), 3);
  if (const auto holes = entry.find("holes")) {
    for (std::size_t i = 0; i < holes->size(); ++i) collider.holes.push_back(read_points(holes->element(i), 3));
  }
  return collider;
}

/// White is solid where the scene says nothing, as in the article's masks.
PictureRule read_picture_rule(const JsonCursor& entry) {
  const auto solid = entry.find("solid");
  const auto background = entry.find("background");
  if (solid && background) background->refuse("expected one of \"solid\" and \"background\", not both");
  if (!solid && !background) return {};
  const JsonCursor& at = solid ? *solid : *background;
  const std::optional<Colour> colour = colour_from(at.text());
  if (!colour) at.refuse("expected a colour like \"#00a0ff\"");
  return {*colour, background.has_value()};
}

/// Reads everything that has an id.
class SceneryReader {
 public:
  SceneryReader(Scene& scene, std::string path) : scene_(scene), path_(std::move(path)) {}

  void read(const JsonCursor& scenery, const std::optional<JsonCursor>& movers) {
    for (std::size_t i = 0; i < scenery.size(); ++i) read_entry(scenery.element(i), i);
    for (std::size_t i = 0; movers && i < movers->size(); ++i) read_mover(movers->element(i), i);
    check_scenery(scene_.scenery, scene_.ids, [this](ColliderIndex index) { return where_[index]; });
  }

 private:
  std::string take_id(const JsonCursor& entry, const char* list, std::size_t index) {
    const auto at = entry.find("id");
    std::string id = at ? at->text() : fmt::format("{}/{}", list, index);
    if (!ids_.insert(id).second)
      (at ? *at : entry).refuse(fmt::format("expected an id of its own; \"{}\" is taken", id));
    return id;
  }

  void add(std::string id, ColliderDef collider, std::string where) {
    scene_.scenery.colliders.push_back(std::move(collider));
    scene_.ids.push_back(std::move(id));
    where_.push_back(std::move(where));
  }

  void read_entry(const JsonCursor& entry, std::size_t index) {
    entry.refuse_other_keys({"id", "polygon", "holes", "chain", "one_way", "sensor", "surface_speed", "tiled",
                             "picture", "solid", "background"});
    const std::string shape = only_shape(entry, {"polygon", "chain", "tiled", "picture"});
    refuse_key_beside(entry, "solid", shape, "picture");
    refuse_key_beside(entry, "background", shape, "picture");
    const std::string id = take_id(entry, "scenery", index);
    const JsonCursor at = entry.require(shape);
    if (shape == "tiled" || shape == "picture") {
      refuse_key_beside(entry, "holes", shape, "polygon");
      refuse_key_beside(entry, "one_way", shape, "chain");
      for (const char* key : {"sensor", "surface_speed"}) {
        if (const auto found = entry.find(key)) found->refuse("expected only beside \"polygon\" or \"chain\"");
      }
      if (shape == "tiled")
        add_map(id, at);
      else
        add_picture(id, at, read_picture_rule(entry));
    } else {
      add(id, read_collider(entry, shape), at.where());
    }
  }

  void add_map(const std::string& id, const JsonCursor& at) {
    const Scene map = read_beside(at, [this](const std::string& beside, const std::string& file) {
      return read_tiled_part(beside, file, scene_.pixels_per_metre);
    });
    const auto movers_before = static_cast<MoverIndex>(scene_.movers.size());
    for (std::size_t i = 0; i < map.ids.size(); ++i) {
      const std::string own = id + "/" + map.ids[i];
      claim(own, at);
      ColliderDef collider = map.scenery.colliders[i];
      if (collider.mover != no_mover) collider.mover += movers_before;
      add(own, std::move(collider), at.where());
    }
    for (MoverDef mover : map.movers) {
      mover.id = id + "/" + mover.id;
      scene_.movers.push_back(std::move(mover));
    }
    for (const std::string& note : map.notes) scene_.notes.push_back(id + ": " + note);
    extend_respawn_box(*map.respawn_box);
  }

  void add_picture(const std::string& id, const JsonCursor& at, const PictureRule& rule) {
    const PictureScenery picture = read_beside(at, [&](const std::string& beside, const std::string& file) {
      return read_picture(beside, file, rule, scene_.pixels_per_metre);
    });
    for (std::size_t i = 0; i < picture.ids.size(); ++i) {
      const std::string own = id + "/" + picture.ids[i];
      claim(own, at);
      add(own, picture.scenery.colliders[i], at.where());
    }
    extend_respawn_box(picture.box);
  }

  void extend_respawn_box(const Box2<double>& box) {
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
        {"id", "polygon", "holes", "chain", "one_way", "sensor", "surface_speed", "path", "angle", "loop"});
    const std::string shape = only_shape(entry, {"polygon", "chain"});
    MoverDef mover;
    mover.id = take_id(entry, "movers", index);
    ColliderDef collider = read_collider(entry, shape);
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

  /// @param read_at what stands under "at". One place of it is reached at one time, in ascending order.
  template <class Point, class ReadAt>
  static std::vector<Point> read_timed(const JsonCursor& at, const ReadAt& read_at) {
    if (at.size() == 0) at.refuse("expected at least one waypoint");
    std::vector<Point> points;
    for (std::size_t i = 0; i < at.size(); ++i) {
      const JsonCursor entry = at.element(i);
      entry.refuse_other_keys({"t", "at"});
      const double time = not_negative(entry.require("t"));
      if (!points.empty() && !(time > points.back().time))
        entry.require("t").refuse("expected a time after the one before");
      points.push_back({.time = time, .at = read_at(entry.require("at"))});
    }
    return points;
  }

  static std::vector<MoverDef::Waypoint> read_path(const JsonCursor& at) {
    return read_timed<MoverDef::Waypoint>(at, [](const JsonCursor& offset) {
      const Vec2d value = offset.point();
      if (!(value.cwiseAbs().maxCoeff() <= largest_coordinate)) offset.refuse("expected coordinates within 2e6 m");
      return value;
    });
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
  std::set<std::string> ids_;
  std::vector<std::string> where_;
};

std::vector<InputEvent> read_input(const JsonCursor& at) {
  std::vector<InputEvent> events;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const JsonCursor entry = at.element(i);
    entry.refuse_other_keys({"step", "move", "jump", "drop"});
    InputEvent event;
    event.step = entry.require("step").integer(0, most_steps);
    if (!events.empty() && event.step < events.back().step) {
      entry.require("step").refuse("expected events in the order of their steps");
    }
    if (const auto move = entry.find("move")) {
      event.move = move->number();
      if (!(*event.move >= -1 && *event.move <= 1)) move->refuse("expected a number from -1 to 1");
    }
    if (const auto jump = entry.find("jump")) event.jump = jump->boolean();
    if (const auto drop = entry.find("drop")) event.drop = drop->boolean();
    events.push_back(event);
  }
  return events;
}

/// Further characters. They are of the kind that "character" describes, and do what the scene's input says unless they
/// have one of their own.
/// @param dt of the longest step [s].
void read_others(const JsonCursor& at, double dt, Scene& scene) {
  constexpr std::size_t most = 255;  // pairs are judged one by one
  if (at.size() > most) at.refuse(fmt::format("expected at most {} further characters", most));
  for (std::size_t i = 0; i < at.size(); ++i) {
    const JsonCursor entry = at.element(i);
    for (const char* key : {"points_px", "walk_speed", "acceleration", "air_acceleration", "jump_speed",
                            "max_fall_speed", "max_climb_degrees", "snap", "no_jump_toward_wall", "side_hit_ends_rise"})
      if (const auto found = entry.find(key))
        found->refuse("expected only in \"character\": all characters of a scene are of one kind");
    entry.refuse_other_keys({"position", "velocity", "start_overlap", "input"});
    const auto input = entry.find("input");
    scene.others.push_back({read_start(entry, dt), input ? read_input(*input) : scene.input});
  }
}

constexpr double longest_step = 1e4;  // [s]; in more a walk leaves the range of a step

double read_length(const JsonCursor& at) {
  const double length = at.positive();
  if (!(length <= longest_step)) at.refuse(fmt::format("expected at most {} s", longest_step));
  return length;
}

std::vector<double> read_lengths(const JsonCursor& at) {
  if (at.size() == 0) at.refuse("expected at least one length of a step");
  std::vector<double> lengths;
  for (std::size_t i = 0; i < at.size(); ++i) lengths.push_back(read_length(at.element(i)));
  return lengths;
}

void refuse_unsupported_keys(const JsonCursor& root) { refuse_unsupported(root, "bodies", "dynamic bodies"); }

void read_scenery(const JsonCursor& root, const std::string& path, Scene& scene) {
  const JsonCursor scenery = root.require("scenery");
  const bool empty = read_flag(root, "empty");
  if (scenery.size() == 0 && !empty) scenery.refuse("expected at least one solid, or \"empty\": true beside it");
  if (scenery.size() > 0 && empty) root.require("empty").refuse("expected false, as \"scenery\" is not empty");
  SceneryReader(scene, path).read(scenery, root.find("movers"));
}

}  // namespace

Scene read_json_scene(const nlohmann::json& document, const std::string& path, const std::string& given) {
  const JsonCursor root(document, given);
  const JsonCursor version = root.require("paperproof_scene");
  if (version.integer(0, most_steps) != 1) version.refuse("expected 1, the version of the format");
  refuse_unsupported_keys(root);
  root.refuse_other_keys({"$schema", "paperproof_scene", "name", "description", "pixels_per_metre", "gravity", "dt",
                          "dt_list", "steps", "character", "characters", "scenery", "empty", "movers", "input"});
  Scene scene;
  scene.name = root.require("name").text();
  if (const auto description = root.find("description")) scene.description = description->text();
  if (const auto scale = root.find("pixels_per_metre")) scene.pixels_per_metre = within(*scale, 1e-3, 1e6);
  scene.dt = read_length(root.require("dt"));
  if (const auto list = root.find("dt_list")) scene.dt_list = read_lengths(*list);
  const double dt = StepTimes(scene).longest();
  const JsonCursor gravity = root.require("gravity");
  scene.gravity = gravity.point();
  check_travel(gravity, largest(scene.gravity) * dt * dt, dt);
  scene.steps = root.require("steps").integer(1, most_steps);
  const JsonCursor character = root.require("character");
  read_character(character, dt, scene);
  read_scenery(root, path, scene);
  if (const auto input = root.find("input")) scene.input = read_input(*input);
  const auto others = root.find("characters");
  if (others) read_others(*others, dt, scene);
  const std::string remedy = "\"start_overlap\": \"resolve\" beside it asks to move it out";
  check_start(scene, character.require("position").where(), remedy);
  for (std::size_t i = 0; i < scene.others.size(); ++i)
    check_start(scene, others->element(i).require("position").where(), remedy, i + 1);
  return scene;
}

}  // namespace paperproof::compare
