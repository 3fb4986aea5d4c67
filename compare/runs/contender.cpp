#include "runs/contender.hpp"

#include "runs/box2d_contender.hpp"
#include "runs/crowd_contender.hpp"
#include "runs/level_contender.hpp"
#include "runs/technique_contender.hpp"
#include "runs/together_contender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace paperproof::compare {
namespace {

constexpr std::string_view box2d_name = "box2d";
constexpr std::string_view box2d_pieces_name = "box2d_pieces";
constexpr std::string_view sweep_name = "octagon_sweep";  ///< The one technique that takes what turns.

}  // namespace

std::span<const std::string_view> contender_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> all = technique_names();
    all.insert(all.end(), {box2d_name, box2d_pieces_name});
    return all;
  }();
  return names;
}

bool is_reference(std::string_view contender) { return contender == box2d_name || contender == box2d_pieces_name; }

std::string_view name_of(ScalarKind scalar) noexcept { return scalar == ScalarKind::binary32 ? "float" : "double"; }

void Contender::launch(const Vec2d& velocity, std::size_t character) {
  Pose launched = pose(character);
  launched.velocity = velocity;
  place(launched, character);
}

void place_at_start(Contender& contender, const Scene& scene) {
  for (std::size_t k = 0; k < character_count(scene); ++k)
    contender.place({.position = start_of(scene, k).position, .velocity = start_of(scene, k).velocity}, k);
}

std::unique_ptr<Contender> make_contender(std::string_view name, ScalarKind scalar, const Scene& scene,
                                          const Scenery& scenery, const Planning& planning) {
  if (is_reference(name)) {
    const auto mode = name == box2d_name ? box2d::SceneryMode::chain_loops : box2d::SceneryMode::pieces;
    try {
      return make_box2d_contender(mode, scene, scenery, planning.knobs);
    } catch (const box2d::InvalidDefinition& error) {
      throw NotApplicable(error.what());
    }
  }
  const auto turning = std::find_if(scene.movers.begin(), scene.movers.end(),
                                    [](const MoverDef& mover) { return !mover.turns.empty(); });
  const bool turns = turning != scene.movers.end();
  if (turns && (name != sweep_name || scalar != ScalarKind::binary64))
    throw NotApplicable(fmt::format("{}{} is for movers that do not turn, and \"{}\" does", name,
                                    name == sweep_name ? " in float" : "", turning->id));
  if (const TechniqueEntry* technique = find_technique(name)) {
    if (turns) return make_level_contender(*technique, scene, scenery, planning);
    const bool crowd = !scene.others.empty();
    if (crowd && scalar != ScalarKind::binary64) throw NotApplicable("several characters move in double alone");
    if (crowd && name == sweep_name) return make_together_contender(*technique, scene, scenery, planning);
    if (crowd && technique->moves_crowds) return make_crowd_contender(*technique, scene, scenery, planning);
    if (crowd)
      throw NotApplicable(fmt::format("{} knows one character, and here are {}", name, character_count(scene)));
    try {
      return make_technique_contender(*technique, scalar, scene, scenery, planning);
    } catch (const NotExpressible& error) {
      throw NotApplicable(error.what());
    }
  }
  throw std::invalid_argument("no contender is named " + std::string(name));
}

}  // namespace paperproof::compare
