#include "scenes/json_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "scenes/json_motion.hpp"
#include "scenes/json_scenery.hpp"
#include "scenes/json_text.hpp"
#include "scenes/step_times.hpp"
#include "scenes/validate.hpp"

namespace paperproof::compare {

namespace {

constexpr int most_steps = std::numeric_limits<int>::max();

double read_not_negative(const JsonCursor& object, std::string_view key, double otherwise) {
  const auto found = object.find(key);
  return found ? found->not_negative() : otherwise;
}

CharacterShape read_shape(const JsonCursor& character, double pixels_per_metre) {
  const auto at = character.find("points_px");
  if (!at) return CharacterShape::article(pixels_per_metre);
  const std::vector<Vec2d> points = at->points(3);
  try {
    return CharacterShape::from_pixels(points, pixels_per_metre);
  } catch (const InvalidCharacter& error) {
    at->refuse(error.what());
  }
}

/// @param dt of the longest step [s].
Start read_start(const JsonCursor& character, double dt) {
  Start start;
  start.position = read_place(character.require("position"));
  if (const auto velocity = character.find("velocity")) start.velocity = read_velocity(*velocity, dt);
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

std::vector<std::string> read_sprite(const JsonCursor& at, const Scene& scene) {
  const Box2& box = scene.character.shape.box();
  const Vec2d size = (box.upper - box.lower) * scene.pixels_per_metre;
  const Vec2d whole(std::round(size.x()), std::round(size.y()));
  if ((size - whole).cwiseAbs().maxCoeff() > 1e-6) at.refuse("expected a character as large as whole pixels");
  if (static_cast<double>(at.size()) != whole.y())
    at.refuse(fmt::format("expected {} rows, as high as the character, not {}", whole.y(), at.size()));
  std::vector<std::string> rows;
  for (std::size_t i = 0; i < at.size(); ++i) {
    rows.push_back(at.element(i).text());
    if (static_cast<double>(rows.back().size()) != whole.x() ||
        rows.back().find_first_not_of(".#") != std::string::npos)
      at.element(i).refuse(fmt::format("expected {} pixels from . and #", whole.x()));
  }
  if (std::none_of(rows.begin(), rows.end(), [](const std::string& row) { return row.find('#') != row.npos; }))
    at.refuse("expected a pixel that collides, #");
  return rows;
}

/// @param dt of the longest step [s].
void read_character(const JsonCursor& at, double dt, Scene& scene) {
  at.refuse_other_keys({"points_px", "position", "velocity", "start_overlap", "walk_speed", "acceleration",
                        "air_acceleration", "jump_speed", "max_fall_speed", "max_climb_degrees", "snap", "step_height",
                        "no_jump_toward_wall", "side_hit_ends_rise", "sprite"});
  CharacterDef& character = scene.character;
  character.shape = read_shape(at, scene.pixels_per_metre);
  scene.start = read_start(at, dt);
  character.walk_speed = read_speed(at, "walk_speed", character.walk_speed, dt);
  character.acceleration = read_not_negative(at, "acceleration", character.acceleration);
  if (const auto air = at.find("air_acceleration")) character.air_acceleration = air->not_negative();
  character.jump_speed = read_speed(at, "jump_speed", character.jump_speed, dt);
  if (const auto limit = at.find("max_fall_speed")) character.max_fall_speed = limit->positive();
  if (const auto climb = at.find("max_climb_degrees")) {
    character.max_climb_degrees = climb->number();
    if (!(character.max_climb_degrees >= 0 && character.max_climb_degrees <= 89)) {
      climb->refuse("expected an angle from 0 to 89 degrees");
    }
  }
  if (const auto snap = at.find("snap")) character.snap = snap->number_within(0, 1e6);
  if (const auto height = at.find("step_height")) character.step_height = height->number_within(0, 1e6);
  if (const auto rule = at.find("no_jump_toward_wall")) scene.jump_rules.no_jump_toward_wall = rule->boolean();
  if (const auto rule = at.find("side_hit_ends_rise")) scene.jump_rules.side_hit_ends_rise = rule->boolean();
  if (const auto sprite = at.find("sprite")) scene.sprite = read_sprite(*sprite, scene);
  try {
    character.validate();
  } catch (const InvalidCharacter& error) {
    at.refuse(error.what());
  }
}

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
    if (const auto move = entry.find("move")) event.move = move->number_within(-1, 1);
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
    for (const char* key :
         {"points_px", "walk_speed", "acceleration", "air_acceleration", "jump_speed", "max_fall_speed",
          "max_climb_degrees", "snap", "step_height", "no_jump_toward_wall", "side_hit_ends_rise", "sprite"})
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

/// @param dt of the longest step [s].
void read_scenery(const JsonCursor& root, const std::string& path, double dt, Scene& scene) {
  const JsonCursor scenery = root.require("scenery");
  const bool empty = root.flag("empty");
  if (scenery.size() == 0 && !empty) scenery.refuse("expected at least one solid, or \"empty\": true beside it");
  if (scenery.size() > 0 && empty) root.require("empty").refuse("expected false, as \"scenery\" is not empty");
  read_json_scenery({scenery, root.find("movers"), root.find("bodies"), root.find("joints"), dt}, path, scene);
}

}  // namespace

Scene read_json_scene(const nlohmann::json& document, const std::string& path, const std::string& given) {
  const JsonCursor root(document, given);
  const JsonCursor version = root.require("paperproof_scene");
  if (version.integer(0, most_steps) != 1) version.refuse("expected 1, the version of the format");
  root.refuse_other_keys({"$schema", "paperproof_scene", "name", "description", "pixels_per_metre", "gravity", "dt",
                          "dt_list", "steps", "character", "characters", "scenery", "empty", "movers", "bodies",
                          "joints", "input"});
  Scene scene;
  scene.name = root.require("name").text();
  if (const auto description = root.find("description")) scene.description = description->text();
  if (const auto scale = root.find("pixels_per_metre")) scene.pixels_per_metre = scale->number_within(1e-3, 1e6);
  scene.dt = read_length(root.require("dt"));
  if (const auto list = root.find("dt_list")) scene.dt_list = read_lengths(*list);
  const double dt = StepTimes(scene).longest();
  const JsonCursor gravity = root.require("gravity");
  scene.gravity = gravity.point();
  check_travel(gravity, scene.gravity.cwiseAbs().maxCoeff() * dt * dt, dt);
  scene.steps = root.require("steps").integer(1, most_steps);
  const JsonCursor character = root.require("character");
  read_character(character, dt, scene);
  read_scenery(root, path, dt, scene);
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
