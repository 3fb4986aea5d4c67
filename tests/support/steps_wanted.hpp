/// How long the random tests of a guarantee run.
#pragma once

#include <cstddef>
#include <cstdlib>

namespace paperproof::test {

/// Whether the libraries under test are compiled with the address sanitizer. Then its runtime is linked, which has this
/// symbol.
extern "C" void __asan_init() __attribute__((weak));
inline const bool sanitized = &__asan_init != nullptr;

/// The number in an environment variable, or `otherwise` where there is none.
[[nodiscard]] inline int steps_wanted(const char* variable, int otherwise) {
  const char* wanted = std::getenv(variable);
  return wanted != nullptr ? std::atoi(wanted) : otherwise;
}

/// Of each family, for octagon_sweep.
[[nodiscard]] inline int steps_per_family() { return steps_wanted("PAPERPROOF_GUARANTEE_STEPS", 2000); }

/// Who asks for fewer wants an answer soon.
inline constexpr int few_steps = 1000;
/// Who asks for as many wants all cases.
inline constexpr int many_steps = 4000;

/// A length as it is by default; a quarter where an answer is wanted soon, and a sixteenth where sanitizers look on, as
/// each step takes ten times as long there.
template <class Count>
[[nodiscard]] Count shortened(Count length) {
  const int of = sanitized ? 16 : steps_per_family() < few_steps ? 4 : 1;
  return (length + static_cast<Count>(of - 1)) / static_cast<Count>(of);
}

/// So many random cases, shortened; by default a third of them, and all from `many_steps` on.
template <class Count>
[[nodiscard]] Count sampled(Count cases) {
  const int steps = steps_per_family();
  const bool is_default = !sanitized && steps >= few_steps && steps < many_steps;
  return is_default ? (cases + 2) / 3 : shortened(cases);
}

/// All of a list, or the last of every `of` where sanitizers look on.
template <class Items>
[[nodiscard]] Items sampled_of(const Items& items, std::size_t of = 16) {
  Items some;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!sanitized || i % of == of - 1) some.push_back(items[i]);
  return some;
}

}  // namespace paperproof::test
