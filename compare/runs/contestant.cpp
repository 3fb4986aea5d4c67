#include "runs/contestant.hpp"

#include "runs/box2d_contestant.hpp"
#include "runs/crowd_contestant.hpp"
#include "runs/technique_contestant.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace paperproof::compare {
namespace {

constexpr std::string_view box2d_name = "box2d";
constexpr std::string_view box2d_pieces_name = "box2d_pieces";

}  // namespace

std::span<const std::string_view> contender_names() {
  static const auto names = [] {
    std::array<std::string_view, all_techniques.size() + 2> all;
    for (std::size_t i = 0; i < all_techniques.size(); ++i) all[i] = paperproof::name_of(all_techniques[i]);
    all[all_techniques.size()] = box2d_name;
    all[all_techniques.size() + 1] = box2d_pieces_name;
    return all;
  }();
  return names;
}

bool is_reference(std::string_view contender) { return contender == box2d_name || contender == box2d_pieces_name; }

std::optional<TechniqueKind> technique_kind(std::string_view contender) {
  const auto kind = std::find_if(all_techniques.begin(), all_techniques.end(),
                                 [&](TechniqueKind each) { return paperproof::name_of(each) == contender; });
  return kind == all_techniques.end() ? std::nullopt : std::optional(*kind);
}

std::string_view name_of(ScalarKind scalar) noexcept { return scalar == ScalarKind::binary32 ? "float" : "double"; }

void place_at_start(Contestant& contestant, const Scene& scene) {
  for (std::size_t k = 0; k < character_count(scene); ++k)
    contestant.place({.position = start_of(scene, k).position, .velocity = start_of(scene, k).velocity}, k);
}

std::unique_ptr<Contestant> make_contestant(std::string_view name, ScalarKind scalar, const Scene& scene,
                                            const Scenery<double>& scenery, const Planning& planning) {
  if (is_reference(name)) {
    const auto mode = name == box2d_name ? box2d::SceneryMode::chain_loops : box2d::SceneryMode::pieces;
    try {
      return make_box2d_contestant(mode, scene, scenery, planning.knobs);
    } catch (const box2d::InvalidDefinition& error) {
      throw NotApplicable(error.what());
    }
  }
  const auto turning = std::find_if(scene.movers.begin(), scene.movers.end(),
                                    [](const MoverDef& mover) { return !mover.turns.empty(); });
  if (turning != scene.movers.end())
    throw NotApplicable(std::string(name) + " is for movers that do not turn, and \"" + turning->id + "\" does");
  if (const std::optional<TechniqueKind> kind = technique_kind(name)) {
    const bool crowd = !scene.others.empty();
    if (crowd && moves_crowds(*kind)) return make_crowd_contestant(*kind, scalar, scene, scenery, planning);
    if (crowd)
      throw NotApplicable(fmt::format("{} knows one character, and here are {}", name, character_count(scene)));
    try {
      return make_technique_contestant(*kind, scalar, scene, scenery, planning);
    } catch (const NotExpressible& error) {
      throw NotApplicable(error.what());
    }
  }
  throw std::invalid_argument("no contender is named " + std::string(name));
}

}  // namespace paperproof::compare
