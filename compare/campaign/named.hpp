/// Enumerations whose values have names, in their order from 0 on.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace paperproof::compare {

template <class Enum, std::size_t count>
[[nodiscard]] constexpr std::array<Enum, count> all_of(const std::array<std::string_view, count>& /*names*/) {
  std::array<Enum, count> all{};
  for (std::size_t i = 0; i < count; ++i) all[i] = static_cast<Enum>(i);
  return all;
}

template <class Enum, std::size_t count>
[[nodiscard]] std::string name_among(const std::array<std::string_view, count>& names, Enum value) {
  return std::string(names[static_cast<std::size_t>(value)]);
}

}  // namespace paperproof::compare
