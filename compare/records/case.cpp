#include "records/case.hpp"

#include <fmt/format.h>

namespace paperproof::compare {

std::string command_of(const Case& one) {
  std::string text = fmt::format("paperproof compare {}", one.scene);
  for (const Case::Setting& each : one.parameters) text += fmt::format(" --set {}={}", each.key, each.value);
  text += fmt::format(" --contender {}", one.contender);
  if (one.scalar != "double") text += fmt::format(" --scalar {}", one.scalar);
  for (const Case::Setting& each : one.knobs) text += fmt::format(" --knob {}={}", each.key, each.value);
  if (one.seed) text += fmt::format(" --input random:{}", *one.seed);
  if (one.steps) text += fmt::format(" --steps {}", *one.steps);
  return text + " --no-reference";
}

/// Fowler, Noll, Vo (1991).
std::string id_of(const Case& one) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char letter : command_of(one)) {
    hash ^= static_cast<unsigned char>(letter);
    hash *= 1099511628211ULL;
  }
  return fmt::format("{:016x}", hash);
}

}  // namespace paperproof::compare
