/// The state of a character as plain numbers: for roll-back, the network, and files.
#pragma once

#include <paperproof/character.hpp>

#include <cstdint>
#include <type_traits>

namespace paperproof {

/// All of a `CharacterState`. It is trivially copyable and has no padding, so it may be copied and hashed by its bytes.
/// Equal states without NaN have the same bytes: a negative zero is saved as zero.
struct SavedState {
  static constexpr std::size_t crushers = Crushers::capacity();
  static constexpr std::size_t scalars = 18 + 4 * crushers;
  static constexpr std::size_t integers = 3 + crushers;
  static constexpr std::size_t flags = 12 + crushers;

  double numbers[scalars];          // NOLINT(*-avoid-c-arrays): plain memory
  std::uint32_t indices[integers];  // NOLINT(*-avoid-c-arrays)
  std::uint8_t marks[flags];        // NOLINT(*-avoid-c-arrays)
};

static_assert(std::is_trivially_copyable_v<SavedState>);
static_assert(sizeof(SavedState) == 8 * SavedState::scalars + 4 * SavedState::integers + SavedState::flags);

[[nodiscard]] SavedState save(const CharacterState& state) noexcept;
/// The state that was saved. Bytes that no `save` wrote give a state that a step may refuse, never undefined behaviour.
[[nodiscard]] CharacterState restored(const SavedState& saved) noexcept;

}  // namespace paperproof
