#include "scenes/parameters.hpp"

#include "near_names.hpp"
#include "scenes/input_error.hpp"
#include "scenes/load.hpp"

#include <paperproof/number_in.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace paperproof::compare {
namespace {

constexpr std::array<ParameterDef, 5> common{{
    {"dt", "s", 1e-9, 1e3, 1.0 / 60,
     "length of a step; the scene lasts as long, and its input comes at the same times"},
    {"gravity", "m_s2", 0, 1e9, 30, "straight down"},
    {"speed", "m_s", 0, 1e9, 0, "at the start, in the scene's direction; down where it starts at rest"},
    {"scale", "", 1e-6, 1e6, 1, "every length, speed and acceleration is multiplied by it"},
    {"origin", "m", -1e9, 1e9, 0, "everything is shifted along x"},
}};

void check_range(std::string_view scene, const ParameterDef& def, double value) {
  if (value >= def.least && value <= def.most) return;
  refuse(std::string(scene), fmt::format("expected {} from {:g} to {:g}{}{}, not {:g}", def.key, def.least, def.most,
                                         def.unit.empty() ? "" : " ", def.unit, value));
}

void set_dt(Scene& scene, double dt) {
  const double ratio = scene.dt / dt;
  const auto as_late = [ratio](int step) {
    return static_cast<int>(std::min(std::llround(step * ratio), 1'000'000'000LL));
  };
  const auto stretch = [&](std::vector<InputEvent>& events) {
    for (InputEvent& event : events) event.step = as_late(event.step);
  };
  stretch(scene.input);
  for (OtherCharacter& other : scene.others) stretch(other.input);
  scene.steps = std::max(1, as_late(scene.steps));
  scene.dt = dt;
  scene.dt_list.clear();
}

void set_speed(Start& start, double speed) {
  const double before = start.velocity.norm();
  start.velocity = before > 0 ? Vec2d(start.velocity * (speed / before)) : Vec2d(0, -speed);
}

template <class Change>
void for_each_point(ColliderDef& collider, const Change& change) {
  for (Vec2d& point : collider.points) change(point);
  for (std::vector<Vec2d>& hole : collider.holes)
    for (Vec2d& point : hole) change(point);
}

void scale_character(CharacterDef& character, double scale) {
  std::vector<Vec2d> points;
  for (const Vec2d& point : character.shape.points()) points.push_back(point * scale);
  character.shape = CharacterShape(points);
  for (double* length : {&character.walk_speed, &character.acceleration, &character.jump_speed, &character.snap,
                         &character.step_height, &character.wall_reach})
    *length *= scale;
  if (character.air_acceleration) *character.air_acceleration *= scale;
  if (character.max_fall_speed) *character.max_fall_speed *= scale;
}

/// Calls `change` with each place that a scene names, but for points of colliders and paths of movers.
template <class Change>
void for_each_place(Scene& scene, const Change& change) {
  change(scene.start.position);
  for (OtherCharacter& other : scene.others) change(other.start.position);
  for (Joint& joint : scene.joints) {
    change(joint.point);
    change(joint.end);
  }
  if (!scene.respawn_box) return;
  change(scene.respawn_box->lower);
  change(scene.respawn_box->upper);
}

void scale_by(Scene& scene, double scale) {
  const auto enlarge = [scale](auto& length) { length *= scale; };
  for_each_place(scene, enlarge);
  enlarge(scene.gravity);
  scene.pixels_per_metre /= scale;
  scale_character(scene.character, scale);
  enlarge(scene.start.velocity);
  for (OtherCharacter& other : scene.others) enlarge(other.start.velocity);
  for (ColliderDef& collider : scene.scenery.colliders) {
    for_each_point(collider, enlarge);
    enlarge(collider.surface_speed);
    enlarge(collider.radius);
  }
  for (MoverDef& mover : scene.movers) {
    for (MoverDef::Waypoint& waypoint : mover.path) enlarge(waypoint.at);
    if (mover.body) enlarge(mover.body->velocity);
  }
  for (Joint& joint : scene.joints) enlarge(joint.length);  // forces grow alike: stiffness and damping stay
}

void shift_by(Scene& scene, double along) {
  const auto shift = [along](Vec2d& place) { place += Vec2d(along, 0); };
  for_each_place(scene, shift);
  // What turns does so about the point that it is written around: its path is shifted instead.
  for (ColliderDef& collider : scene.scenery.colliders)
    if (collider.mover == no_mover || scene.movers[collider.mover].turns.empty()) for_each_point(collider, shift);
  for (MoverDef& mover : scene.movers)
    if (!mover.turns.empty())
      for (MoverDef::Waypoint& waypoint : mover.path) shift(waypoint.at);
}

}  // namespace

const ParameterDef* find_parameter(std::span<const ParameterDef> defs, std::string_view key) {
  const auto found = std::find_if(defs.begin(), defs.end(), [&](const ParameterDef& def) { return def.key == key; });
  return found == defs.end() ? nullptr : &*found;
}

std::string row_key(const ParameterDef& parameter) {
  return parameter.unit.empty() ? std::string(parameter.key) : fmt::format("{}_{}", parameter.key, parameter.unit);
}

std::span<const ParameterDef> common_parameters() { return common; }

std::vector<ParameterDef> parameters_of(std::string_view scene) {
  std::vector<ParameterDef> all;
  const std::optional<SceneFamily> family = find_family(family_of(scene));
  if (family) all = family->parameters;
  for (const ParameterDef& def : common)
    if (find_parameter(all, def.key) == nullptr) all.push_back(def);
  return all;
}

void check_setting(std::string_view scene, const ParameterSetting& setting) {
  const std::vector<ParameterDef> all = parameters_of(scene);
  if (const ParameterDef* def = find_parameter(all, setting.key)) return check_range(scene, *def, setting.value);
  std::vector<std::string> names;
  for (const ParameterDef& def : all) names.emplace_back(def.key);
  refuse(std::string(scene), fmt::format("expected a parameter of {}, not {}{}", fmt::join(names, ", "),
                                         shown(setting.key), did_you_mean(setting.key, names)));
}

ParameterSetting parse_setting(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals != std::string_view::npos && equals > 0)
    if (const std::optional<double> value = number_in<double>(text.substr(equals + 1)))
      return {std::string(text.substr(0, equals)), *value};
  refuse("--set " + std::string(text), "expected KEY=NUMBER");
}

void turn(Scene& scene, const ParameterSetting& setting) {
  scene.answers.clear();
  const std::string_view key = setting.key;
  if (key == "dt") return set_dt(scene, setting.value);
  if (key == "gravity") {
    scene.gravity = {0, -setting.value};
  } else if (key == "speed") {
    set_speed(scene.start, setting.value);
    for (OtherCharacter& other : scene.others) set_speed(other.start, setting.value);
  } else if (key == "scale" || key == "origin") {
    scene.parameters.emplace_back(row_key(*find_parameter(common, key)), setting.value);
    key == "scale" ? scale_by(scene, setting.value) : shift_by(scene, setting.value);
  }
}

}  // namespace paperproof::compare
