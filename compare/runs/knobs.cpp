#include "runs/knobs.hpp"

#include "contains.hpp"
#include "runs/contender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

/// Everybody but the twins has it: it is of the character.
const Knob jump_rules{
    "jump_rules", "on, or off: the article's two rules; else what the scene says, else off for octagon_sweep alone",
    [](const std::string& value, TechniqueDef&) { static_cast<void>(is_second(value, "off", "on")); }};

/// Of the Box2D twins.
struct EngineKnob {
  std::string_view name;
  std::string_view meaning;
  void (*turn)(const std::string& value, TwinDef& def);
};

int iterations_in(const std::string& text) {
  const int count = whole_in(text);
  if (count < 1 || count > 1000) throw std::invalid_argument("expected a whole number from 1 to 1000");
  return count;
}

const std::vector<EngineKnob>& engine_knobs() {
  using Def = TwinDef;
  static const std::vector<EngineKnob> all{
      {"bullet", "on, or off: continuous collision against dynamic bodies, too",
       [](const std::string& value, Def& def) { def.world.bullet = is_second(value, "off", "on"); }},
      {"continuous", "on, or off: no continuous collision at all",
       [](const std::string& value, Def& def) { def.world.continuous = is_second(value, "off", "on"); }},
      {"velocity_iterations", "of its solver, 8 where not turned",
       [](const std::string& value, Def& def) { def.world.velocity_iterations = iterations_in(value); }},
      {"position_iterations", "of its solver, 3 where not turned",
       [](const std::string& value, Def& def) { def.world.position_iterations = iterations_in(value); }},
      {"substeps", "steps of its world in one step of the scene, each with its share of the time; 1 where not turned",
       [](const std::string& value, Def& def) { def.substeps = iterations_in(value); }},
      {"solids", "static, kinematic or dynamic: what the solids that stand are for it",
       [](const std::string& value, Def& def) {
         if (value != "static" && value != "kinematic" && value != "dynamic")
           throw std::invalid_argument("expected static, kinematic or dynamic");
         def.world.solids = value == "static"      ? box2d::SolidBody::fixed
                            : value == "kinematic" ? box2d::SolidBody::kinematic
                                                   : box2d::SolidBody::dynamic;
       }},
      {"movers", "velocity, or transform: movers are put where they should be by SetTransform",
       [](const std::string& value, Def& def) {
         def.world.drive =
             is_second(value, "velocity", "transform") ? box2d::MoverDrive::transform : box2d::MoverDrive::velocity;
       }},
  };
  return all;
}

/// Null where none has that name.
template <class One>
const One* named(const std::vector<One>& knobs, std::string_view name) {
  const auto found = std::ranges::find(knobs, name, &One::name);
  return found == knobs.end() ? nullptr : &*found;
}

const EngineKnob* find_engine_knob(std::string_view name) { return named(engine_knobs(), name); }

const Knob* find_knob(const TechniqueEntry& technique, std::string_view name) {
  return name == jump_rules.name ? &jump_rules : named(technique.knobs, name);
}

/// A knob of techniques, and who has it.
struct SharedKnob {
  Knob knob;
  std::vector<std::string_view> techniques;
};

/// Each name once, in the order of the techniques.
std::vector<SharedKnob> technique_knobs() {
  std::vector<SharedKnob> all;
  for (const TechniqueEntry& technique : all_techniques()) {
    for (const Knob& knob : technique.knobs) {
      auto known = std::ranges::find(all, knob.name, [](const SharedKnob& each) { return each.knob.name; });
      if (known == all.end()) known = all.insert(all.end(), {knob, {}});
      known->techniques.push_back(technique.name);
    }
  }
  all.push_back({jump_rules, technique_names()});
  return all;
}

}  // namespace

KnobSetting parse_knob(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  std::vector<std::string_view> names;
  for (const SharedKnob& each : technique_knobs()) names.push_back(each.knob.name);
  for (const EngineKnob& each : engine_knobs()) names.push_back(each.name);
  if (equals == std::string_view::npos || !contains(names, name))
    throw std::invalid_argument(fmt::format("expected NAME=VALUE with a NAME of {}", fmt::join(names, ", ")));
  return {std::string(name), std::string(text.substr(equals + 1))};
}

void check_knob(const KnobSetting& setting, std::string_view contender) {
  if (is_reference(contender)) {
    TwinDef def;
    turn_knobs(std::span(&setting, 1), def);
    return;
  }
  TechniqueDef def;
  def.name = contender;
  turn_knobs(std::span(&setting, 1), def);
  const Scenery a_square({{{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}});  // whatever it may be is tried there
  try {
    static_cast<void>(make_controller(a_square, CharacterDef{}, def));
  } catch (const NotExpressible&) {
    // Another level may do.
  }
}

std::vector<std::string> describe_knobs() {
  std::vector<std::string> lines;
  for (const SharedKnob& each : technique_knobs())
    lines.push_back(fmt::format("{:<24} {} ({})", each.knob.name, each.knob.meaning, fmt::join(each.techniques, ", ")));
  for (const EngineKnob& knob : engine_knobs())
    lines.push_back(fmt::format("{:<24} {} (box2d, box2d_pieces)", knob.name, knob.meaning));
  return lines;
}

bool has_knob(std::string_view contender, std::string_view name) {
  if (is_reference(contender)) return find_engine_knob(name) != nullptr;
  const TechniqueEntry* technique = find_technique(contender);
  return technique != nullptr && find_knob(*technique, name) != nullptr;
}

void turn_knobs(std::span<const KnobSetting> knobs, TwinDef& def) {
  for (const KnobSetting& setting : knobs)
    if (const EngineKnob* knob = find_engine_knob(setting.key)) knob->turn(setting.value, def);
}

void turn_knobs(std::span<const KnobSetting> knobs, TechniqueDef& def) {
  const TechniqueEntry* technique = find_technique(def.name);
  if (technique == nullptr) return;
  for (const KnobSetting& setting : knobs)
    if (const Knob* knob = find_knob(*technique, setting.key)) knob->turn(setting.value, def);
}

std::optional<bool> turned_jump_rules(std::span<const KnobSetting> knobs) {
  std::optional<bool> turned;
  for (const KnobSetting& setting : knobs)
    if (setting.key == "jump_rules") turned = is_second(setting.value, "off", "on");
  return turned;
}

std::string turned_knobs(std::span<const KnobSetting> knobs, std::string_view contender) {
  std::string text;
  for (const KnobSetting& setting : knobs) {
    if (!has_knob(contender, setting.key)) continue;
    if (!text.empty()) text += ' ';
    text += setting.key + '=' + setting.value;
  }
  return text;
}

}  // namespace paperproof::compare
