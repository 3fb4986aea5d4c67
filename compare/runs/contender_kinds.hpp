/// What makes each kind of contender: `make_contender` chooses.
#pragma once

#include "runs/contender.hpp"
#include "runs/peers.hpp"

#include <paperproof/box2d/reference_world.hpp>
#include <paperproof/techniques.hpp>

namespace paperproof::compare {

/// The Box2D twin.
[[nodiscard]] std::unique_ptr<Contender> make_box2d_contender(box2d::SceneryMode mode, const Scene& scene,
                                                              const Scenery& scenery,
                                                              std::span<const KnobSetting> knobs);

/// Our controller: with one of its techniques, in a level where something turns, as a crowd, and taking turns. All
/// movers of a scene where something turns stand in its trace with the ways of their vertices: in steps of several
/// parts what does not turn does not go evenly either.
/// @param scenery shared by all contenders of a scene, and must outlive them; one in float brings its own, rounded.
/// @throws NotApplicable where the technique, in these numbers and with these knobs, is not made for the scene.
[[nodiscard]] std::unique_ptr<Contender> make_own_contender(const TechniqueEntry& technique, ScalarKind scalar,
                                                            const Scene& scene, const Scenery& scenery,
                                                            const Planning& planning);

/// A process of its own: see compare/peers/README.md. Starts the peer and has it greet. What it is asked is the law of
/// intent that holds for Box2D's twin, too.
/// @throws NotApplicable where it refuses the scene, or says that it has not what the scene needs; std::runtime_error
/// where it cannot be started, says nothing for a minute, or nothing that it may say.
[[nodiscard]] std::unique_ptr<Contender> make_peer_contender(const Peer& peer, const Scene& scene,
                                                             const Scenery& scenery);

}  // namespace paperproof::compare
