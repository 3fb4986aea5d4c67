/// Contenders that are programs of somebody else's, as the command line names them.
#pragma once

#include "records/row.hpp"

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof::compare {

/// An engine may have to be loaded, and compiled, before it greets.
inline constexpr std::chrono::seconds longest_greeting{60};

struct Peer {
  std::string name;     ///< As a contender: letters, digits and underscores.
  std::string command;  ///< For a shell.
};

/// `NAME=COMMAND`, or `COMMAND`: then its name is that of the first file in it, as `rapier` of `node peers/rapier.mjs`.
/// @throws std::invalid_argument in words where no name can be had.
[[nodiscard]] Peer parse_peer(std::string_view text);

/// From now on it is a contender. To be called before anything runs.
/// @throws std::invalid_argument in words where another contender has the name.
void add_peer(const Peer& peer);

[[nodiscard]] const std::vector<Peer>& peers();
/// Null where no peer has that name.
[[nodiscard]] const Peer* find_peer(std::string_view name);

/// Its command; empty where no peer has that name.
[[nodiscard]] std::string peer_command(std::string_view name);

/// Whether a run failed, and not by the fault of a peer.
[[nodiscard]] bool is_our_failure(const Row& row);

}  // namespace paperproof::compare
