#include "runs/contender.hpp"

#include "runs/contender_kinds.hpp"

#include <stdexcept>

namespace paperproof::compare {
namespace {

constexpr std::string_view box2d_name = "box2d";
constexpr std::string_view box2d_pieces_name = "box2d_pieces";

}  // namespace

std::vector<std::string_view> contender_names() {
  std::vector<std::string_view> all = technique_names();
  all.insert(all.end(), {box2d_name, box2d_pieces_name});
  for (const Peer& peer : peers()) all.push_back(peer.name);
  return all;
}

bool is_reference(std::string_view contender) { return contender == box2d_name || contender == box2d_pieces_name; }

std::string_view name_of(ScalarKind scalar) noexcept { return scalar == ScalarKind::binary32 ? "float" : "double"; }

void Contender::launch(const Vec2d& velocity, std::size_t character) {
  Pose launched = pose(character);
  launched.state.velocity = velocity;
  place(launched, character);
}

Pose pose_at(const Start& start) { return {.position = start.position, .state = {.velocity = start.velocity}}; }

void place_at_start(Contender& contender, const Scene& scene) {
  for (std::size_t k = 0; k < character_count(scene); ++k) contender.place(pose_at(start_of(scene, k)), k);
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
  if (const TechniqueEntry* technique = find_technique(name))
    return make_own_contender(*technique, scalar, scene, scenery, planning);
  if (const Peer* peer = find_peer(name)) return make_peer_contender(*peer, scene, scenery);
  throw std::invalid_argument("no contender is named " + std::string(name));
}

}  // namespace paperproof::compare
