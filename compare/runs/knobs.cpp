#include "runs/knobs.hpp"

#include "number_in.hpp"
#include "runs/contestant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

struct Knob {
  std::string_view name;
  std::string_view meaning;
  std::vector<TechniqueKind> kinds;  ///< Who has it.
  void (*turn)(const std::string& value, TechniqueDef& def);
};

double real_in(const std::string& text) {
  if (const std::optional<double> number = number_in<double>(text)) return *number;
  throw std::invalid_argument("expected a number");
}

int whole_in(const std::string& text) {
  if (const std::optional<int> number = number_in<int>(text)) return *number;
  throw std::invalid_argument("expected a whole number");
}

/// One of two words: false for the first.
bool second_of(const std::string& text, std::string_view first, std::string_view second) {
  if (text != first && text != second) throw std::invalid_argument(fmt::format("expected {} or {}", first, second));
  return text == second;
}

const std::vector<Knob>& all_knobs() {
  using enum TechniqueKind;
  static const std::vector<TechniqueKind> searching{penetration_resolution, speculative_march, speculative};
  static const std::vector<Knob> all{
      {"unit",
       "step of every search [m]; without it a pixel of the scene",
       {wind_back, penetration_resolution, speculative_march, speculative},
       [](const std::string& value, TechniqueDef& def) { def.article.unit = real_in(value); }},
      {"iterations",
       "rounds per step, at least 1",
       {bounding_box, discrete, penetration_resolution, speculative_march, speculative, octagon_sweep},
       [](const std::string& value, TechniqueDef& def) {
         (def.kind == octagon_sweep ? def.sweep_iterations : def.article.iterations) = whole_in(value);
       }},
      {"points",
       "8, or 4: the corners of the bounding box",
       {wind_back, penetration_resolution, speculative_march, speculative},
       [](const std::string& value, TechniqueDef& def) { def.article.points = whole_in(value); }},
      {"pairs", "direction, or all: points are tested whichever way it goes", searching,
       [](const std::string& value, TechniqueDef& def) {
         def.article.pairs =
             second_of(value, "direction", "all") ? ArticleKnobs::Pairs::all : ArticleKnobs::Pairs::direction;
       }},
      {"objects", "each, or all: penetration resolution looks at one object after the other, or at all at once",
       searching,
       [](const std::string& value, TechniqueDef& def) {
         def.article.objects =
             second_of(value, "each", "all") ? ArticleKnobs::Objects::all : ArticleKnobs::Objects::each;
       }},
      {"response",
       "component, or shorten: a hit shortens the whole vector",
       {mask, penetration_resolution, speculative_march, speculative},
       [](const std::string& value, TechniqueDef& def) {
         def.article.response = second_of(value, "component", "shorten") ? ArticleKnobs::Response::shorten
                                                                         : ArticleKnobs::Response::component;
       }},
      {"jump_rules", "on, or off: the article's two rules; else what the scene says, else off for octagon_sweep alone",
       std::vector<TechniqueKind>(all_techniques.begin(), all_techniques.end()),
       [](const std::string& value, TechniqueDef&) { static_cast<void>(second_of(value, "off", "on")); }},
      {"square",
       "side of a square [m]",
       {grid},
       [](const std::string& value, TechniqueDef& def) { def.article.square = real_in(value); }},
      {"raster_pixels_per_metre",
       "resolution of the level, at most 1000; without it the scene's",
       {pixel_colour, pixel_tile, mask},
       [](const std::string& value, TechniqueDef& def) { def.article.raster_pixels_per_metre = real_in(value); }},
      {"pixels_per_tile",
       "along a side of a tile: more take more memory, nothing else changes",
       {pixel_tile},
       [](const std::string& value, TechniqueDef& def) { def.article.pixels_per_tile = whole_in(value); }},
  };
  return all;
}

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
       [](const std::string& value, Def& def) { def.world.bullet = second_of(value, "off", "on"); }},
      {"continuous", "on, or off: no continuous collision at all",
       [](const std::string& value, Def& def) { def.world.continuous = second_of(value, "off", "on"); }},
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
             second_of(value, "velocity", "transform") ? box2d::MoverDrive::transform : box2d::MoverDrive::velocity;
       }},
  };
  return all;
}

const EngineKnob* find_engine_knob(std::string_view name) {
  const std::vector<EngineKnob>& all = engine_knobs();
  const auto found = std::find_if(all.begin(), all.end(), [&](const EngineKnob& knob) { return knob.name == name; });
  return found == all.end() ? nullptr : &*found;
}

const Knob* find_knob(std::string_view name) {
  const auto found =
      std::find_if(all_knobs().begin(), all_knobs().end(), [&](const Knob& knob) { return knob.name == name; });
  return found == all_knobs().end() ? nullptr : &*found;
}

bool is_of(const Knob& knob, TechniqueKind kind) {
  return std::find(knob.kinds.begin(), knob.kinds.end(), kind) != knob.kinds.end();
}

/// A level of one square metre: whatever a knob may be is tried on it.
Scenery<double> a_square() { return Scenery<double>({{{.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}}}); }

}  // namespace

KnobSetting parse_knob(std::string_view text) {
  const std::size_t equals = text.find('=');
  const std::string_view name = text.substr(0, equals);
  if (equals == std::string_view::npos || (find_knob(name) == nullptr && find_engine_knob(name) == nullptr)) {
    std::vector<std::string_view> names;
    for (const Knob& each : all_knobs()) names.push_back(each.name);
    for (const EngineKnob& each : engine_knobs()) names.push_back(each.name);
    throw std::invalid_argument(fmt::format("expected NAME=VALUE with a NAME of {}", fmt::join(names, ", ")));
  }
  return {std::string(name), std::string(text.substr(equals + 1))};
}

void check_knob(const KnobSetting& setting, std::string_view contender) {
  if (is_reference(contender)) {
    TwinDef def;
    turn_knobs(std::span(&setting, 1), def);
    return;
  }
  TechniqueDef def;
  def.kind = *technique_kind(contender);
  turn_knobs(std::span(&setting, 1), def);
  const Scenery<double> scenery = a_square();
  try {
    static_cast<void>(make_technique(def, scenery, CharacterDef{}));
  } catch (const NotExpressible&) {
    // Another level may do.
  }
}

std::vector<std::string> describe_knobs() {
  std::vector<std::string> lines;
  for (const Knob& knob : all_knobs()) {
    std::vector<std::string_view> names;
    for (const TechniqueKind kind : knob.kinds) names.push_back(paperproof::name_of(kind));
    lines.push_back(fmt::format("{:<24} {} ({})", knob.name, knob.meaning, fmt::join(names, ", ")));
  }
  for (const EngineKnob& knob : engine_knobs())
    lines.push_back(fmt::format("{:<24} {} (box2d, box2d_pieces)", knob.name, knob.meaning));
  return lines;
}

bool has_knob(std::string_view contender, std::string_view name) {
  if (is_reference(contender)) return find_engine_knob(name) != nullptr;
  const Knob* knob = find_knob(name);
  const std::optional<TechniqueKind> kind = technique_kind(contender);
  return knob != nullptr && kind && is_of(*knob, *kind);
}

void turn_knobs(std::span<const KnobSetting> knobs, TwinDef& def) {
  for (const KnobSetting& setting : knobs)
    if (const EngineKnob* knob = find_engine_knob(setting.name)) knob->turn(setting.value, def);
}

void turn_knobs(std::span<const KnobSetting> knobs, TechniqueDef& def) {
  for (const KnobSetting& setting : knobs)
    if (const Knob* knob = find_knob(setting.name); knob != nullptr && is_of(*knob, def.kind))
      knob->turn(setting.value, def);
}

std::optional<bool> turned_jump_rules(std::span<const KnobSetting> knobs) {
  std::optional<bool> turned;
  for (const KnobSetting& setting : knobs)
    if (setting.name == "jump_rules") turned = second_of(setting.value, "off", "on");
  return turned;
}

std::string turned_knobs(std::span<const KnobSetting> knobs, std::string_view contender) {
  std::string text;
  for (const KnobSetting& setting : knobs) {
    if (!has_knob(contender, setting.name)) continue;
    if (!text.empty()) text += ' ';
    text += setting.name + '=' + setting.value;
  }
  return text;
}

}  // namespace paperproof::compare
