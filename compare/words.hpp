/// Numbers with their nouns.
#pragma once

#include <string>
#include <string_view>

namespace paperproof::compare {

/// "1 step", "2 steps": for nouns that take an s.
template <class Count>
[[nodiscard]] std::string counted(Count count, std::string_view noun) {
  return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

}  // namespace paperproof::compare
