#include "techniques/registry.hpp"

#include "techniques/frame_of_reference.hpp"

#include <paperproof/number_in.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

/// Finer, and the whole range of positions would no longer have whole pixels in a double.
constexpr double max_raster_pixels_per_metre = 1000;
/// Larger, and one type of tile takes half of the memory that a level may.
constexpr int max_pixels_per_tile = 4096;

constexpr std::string_view sweep_name = "octagon_sweep";

SweepDef sweep_of(const TechniqueDef& def) { return {def.search, def.sweep_iterations}; }

void validate(const ArticleKnobs& knobs) {
  require(std::isfinite(knobs.unit) && knobs.unit > 0,
          "unit: must be a positive length, not " + std::to_string(knobs.unit));
  require(knobs.iterations >= 1, "iterations: must be at least 1, not " + std::to_string(knobs.iterations));
  require(knobs.points == 8 || knobs.points == 4, "points: must be 8 or 4, not " + std::to_string(knobs.points));
  require(std::isfinite(knobs.square) && knobs.square > Tolerances{}.touch,
          "square: must be longer than what counts as touching, not " + std::to_string(knobs.square));
  const double fineness = knobs.raster_pixels_per_metre;
  require(fineness > 0 && fineness <= max_raster_pixels_per_metre,
          "raster_pixels_per_metre: must be above 0 and at most 1000, not " + std::to_string(fineness));
  require(knobs.pixels_per_tile >= 1 && knobs.pixels_per_tile <= max_pixels_per_tile,
          "pixels_per_tile: must be from 1 to 4096, not " + std::to_string(knobs.pixels_per_tile));
}

std::vector<TechniqueEntry>& registry() {
#define PAPERPROOF_ENTRY(name) name##_entry(),
  static std::vector<TechniqueEntry> all{PAPERPROOF_TECHNIQUES(PAPERPROOF_ENTRY)};
#undef PAPERPROOF_ENTRY
  return all;
}

}  // namespace

double real_in(const std::string& text) {
  if (const std::optional<double> number = number_in<double>(text)) return *number;
  throw std::invalid_argument("expected a number");
}

int whole_in(const std::string& text) {
  if (const std::optional<int> number = number_in<int>(text)) return *number;
  throw std::invalid_argument("expected a whole number");
}

bool is_second(const std::string& text, std::string_view first, std::string_view second) {
  require(text == first || text == second, "expected " + std::string(first) + " or " + std::string(second));
  return text == second;
}

const std::vector<TechniqueEntry>& all_techniques() { return registry(); }

std::vector<std::string_view> technique_names() {
  std::vector<std::string_view> names;
  for (const TechniqueEntry& entry : all_techniques()) names.push_back(entry.name);
  return names;
}

const TechniqueEntry* find_technique(std::string_view name) {
  const std::vector<TechniqueEntry>& all = all_techniques();
  const auto found = std::find_if(all.begin(), all.end(), [name](const auto& entry) { return entry.name == name; });
  return found == all.end() ? nullptr : &*found;
}

bool register_technique(TechniqueEntry entry) {
  require(find_technique(entry.name) == nullptr, "technique: the name " + std::string(entry.name) + " is taken");
  registry().push_back(std::move(entry));
  return true;
}

std::unique_ptr<Technique> make_technique(const TechniqueDef& def, const Scenery& scenery,
                                          const CharacterDef& character) {
  character.validate();
  validate(def.article);
  const TechniqueEntry* entry = find_technique(def.name);
  require(entry != nullptr, "technique: there is none with the name " + std::string(def.name));
  require(entry->make != nullptr, "technique: " + std::string(def.name) + " is the controller itself");
  if (!entry->knows_movers && something_carries(scenery))
    throw NotExpressible(std::string(def.name) + " is for scenery that stands still");
  if (!entry->knows_circles && scenery.counts().circles > 0)
    throw NotExpressible(std::string(def.name) + " knows no circles: make a polygon of them");
  return entry->make(def, scenery, character);
}

TechniqueController make_controller(const Scenery& scenery, const CharacterDef& character, const TechniqueDef& def) {
  validate(def.article);
  CharacterDef with_reach = character;
  with_reach.wall_reach = def.article.unit;
  if (def.name != sweep_name)
    return TechniqueController(scenery, with_reach, make_technique(def, scenery, with_reach), def.search);
  return TechniqueController(Controller(scenery, with_reach, sweep_of(def)));
}

TechniqueCrowd make_crowd(const Scenery& scenery, const CharacterDef& character, const TechniqueDef& def) {
  std::unique_ptr<const Technique> made = make_technique(def, scenery, character);
  const auto* joint = dynamic_cast<const JointTechnique*>(made.get());
  require(joint != nullptr, "a crowd does not move by " + std::string(def.name) + ", which knows one character");
  static_cast<void>(made.release());
  return TechniqueCrowd(scenery, character, std::unique_ptr<const JointTechnique>(joint), def.search);
}

}  // namespace paperproof
