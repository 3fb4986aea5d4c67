/// Knobs of the contenders, as they stand on the command line.
#pragma once

#include "records/case.hpp"

#include <paperproof/box2d/reference_world.hpp>
#include <paperproof/techniques.hpp>

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// Of a Box2D twin: its world, and how often that is stepped.
struct TwinDef {
  box2d::ReferenceWorldDef world;
  int substeps = 1;  ///< Each step of the scene is so many of the world, of equal length, each as design §4 has a step.
};

/// `name=value`. A technique's knobs are in its registry entry, a twin's are fields of `TwinDef`.
using KnobSetting = Case::Setting;

/// @throws std::invalid_argument in words where there is no such knob.
[[nodiscard]] KnobSetting parse_knob(std::string_view text);

/// @throws std::invalid_argument in words for a value that the contender, which has the knob, cannot take.
void check_knob(const KnobSetting& setting, std::string_view contender);

/// In words, one line for each knob: its name, what it is, and whose it is.
[[nodiscard]] std::vector<std::string> describe_knobs();

[[nodiscard]] bool has_knob(std::string_view contender, std::string_view name);

/// Turns those of the knobs that the technique or the twin has; of two of the same name the later holds.
void turn_knobs(std::span<const KnobSetting> knobs, TechniqueDef& def);
void turn_knobs(std::span<const KnobSetting> knobs, TwinDef& def);

/// What the knob `jump_rules` says; nothing where it is not turned. It is of the character, whatever the technique.
[[nodiscard]] std::optional<bool> turned_jump_rules(std::span<const KnobSetting> knobs);

/// Those of the knobs that the contender has, as `name=value name=value`; empty for none.
[[nodiscard]] std::string turned_knobs(std::span<const KnobSetting> knobs, std::string_view contender);

}  // namespace paperproof::compare
