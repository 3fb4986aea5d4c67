/// A contender in a process of its own: see compare/peers/README.md.
#pragma once

#include "runs/contender.hpp"
#include "runs/peers.hpp"

namespace paperproof::compare {

/// Starts the peer and has it greet. What it is asked is the law of intent that holds for Box2D's twin, too.
/// @throws NotApplicable where it refuses the scene, or says that it has not what the scene needs; std::runtime_error
/// where it cannot be started, says nothing for a minute, or nothing that it may say.
[[nodiscard]] std::unique_ptr<Contender> make_peer_contender(const Peer& peer, const Scene& scene,
                                                             const Scenery& scenery);

}  // namespace paperproof::compare
