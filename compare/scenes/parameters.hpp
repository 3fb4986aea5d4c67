/// Typed parameters: the numbers by which a scene can be turned, each with its unit and range.
#pragma once

#include "scenes/scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

struct ParameterDef {
  std::string_view key;   ///< As typed: `speed`.
  std::string_view unit;  ///< As it ends the key in rows: `m_s`; empty for a number without one.
  double least = 0;
  double most = 0;
  double usual = 0;  ///< What a family takes where nothing is set.
  std::string_view meaning;
};

/// The key that a row has for it: `speed_m_s`.
[[nodiscard]] std::string row_key(const ParameterDef& parameter);

/// Null where there is none of that key.
[[nodiscard]] const ParameterDef* find_parameter(std::span<const ParameterDef> defs, std::string_view key);

/// One parameter that is turned.
struct ParameterSetting {
  std::string key;
  double value = 0;
};

/// A scene with parameters of its own.
struct SceneFamily {
  std::string name;
  std::string description;
  std::vector<ParameterDef> parameters{};
};

[[nodiscard]] const std::vector<SceneFamily>& scene_families();
/// Nothing where there is none of that name.
[[nodiscard]] std::optional<SceneFamily> find_family(std::string_view name);

/// Those that every scene has: dt, gravity, speed, scale, origin.
[[nodiscard]] std::span<const ParameterDef> common_parameters();

/// What can be turned on a scene: a family's own parameters first, then the common ones.
[[nodiscard]] std::vector<ParameterDef> parameters_of(std::string_view scene);

/// @throws InputError where the scene has no such parameter, or the value is out of its range.
void check_setting(std::string_view scene, const ParameterSetting& setting);

/// `KEY=VALUE`. @throws InputError for anything else.
[[nodiscard]] ParameterSetting parse_setting(std::string_view text);

/// Turns common parameters of a scene. Its answers are dropped where that changes them.
/// - `dt`: the scene lasts as long as before, and its input comes at the same times.
/// - `gravity`: straight down.
/// - `speed`: at the start, in the same direction; down where there is none.
/// - `scale`: every length, speed and acceleration.
/// - `origin`: everything is shifted along x.
void turn(Scene& scene, const ParameterSetting& setting);

}  // namespace paperproof::compare
