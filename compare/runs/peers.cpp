#include "runs/peers.hpp"

#include "contains.hpp"
#include "runs/contender.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <sstream>
#include <stdexcept>

namespace paperproof::compare {
namespace {

std::vector<Peer> added;

bool is_name(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char letter) {
    return std::islower(letter) != 0 || std::isdigit(letter) != 0 || letter == '_';
  });
}

/// That of the first file that a command names: an interpreter stands before it, and is none.
std::string name_in(const std::string& command) {
  std::istringstream words(command);
  std::string first;
  words >> first;
  for (std::string word = first; !word.empty(); word.clear(), words >> word)
    if (word.find_first_of("./") != std::string::npos) return std::filesystem::path(word).stem();
  return first;
}

}  // namespace

Peer parse_peer(std::string_view text) {
  const std::size_t equals = text.find('=');
  Peer peer{"", std::string(text)};
  if (equals != std::string_view::npos && is_name(text.substr(0, equals)))
    peer = {std::string(text.substr(0, equals)), std::string(text.substr(equals + 1))};
  else
    peer.name = name_in(peer.command);
  if (!is_name(peer.name) || peer.command.find_first_not_of(' ') == std::string::npos)
    throw std::invalid_argument("expected NAME=COMMAND, with a name of small letters, digits and underscores");
  return peer;
}

void add_peer(const Peer& peer) {
  if (contains(contender_names(), peer.name))
    throw std::invalid_argument(fmt::format("expected another name, as NAME=COMMAND: {} is a contender", peer.name));
  added.push_back(peer);
}

const std::vector<Peer>& peers() { return added; }

const Peer* find_peer(std::string_view name) {
  const auto found = std::ranges::find(added, name, &Peer::name);
  return found == added.end() ? nullptr : &*found;
}

std::string peer_command(std::string_view name) {
  const Peer* peer = find_peer(name);
  return peer != nullptr ? peer->command : "";
}

bool is_our_failure(const Row& row) { return row.verdict == Verdict::failed && find_peer(row.contender) == nullptr; }

}  // namespace paperproof::compare
