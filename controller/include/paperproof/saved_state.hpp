/// The state of a character as plain numbers: for roll-back, the network, and files.
#pragma once

#include <paperproof/character.hpp>

#include <cstdint>
#include <type_traits>

namespace paperproof {

/// All of a `CharacterState`. It is trivially copyable and has no padding, so it may be copied and hashed by its bytes.
/// Equal states without NaN have the same bytes: a negative zero is saved as zero.
template <class Scalar = double>
struct SavedState {
  static constexpr std::size_t crushers = Crushers<Scalar>::capacity();
  static constexpr std::size_t scalars = 18 + 4 * crushers;
  static constexpr std::size_t integers = 3 + crushers;
  static constexpr std::size_t flags = 12 + crushers;

  Scalar numbers[scalars];          // NOLINT(*-avoid-c-arrays): plain memory
  std::uint32_t indices[integers];  // NOLINT(*-avoid-c-arrays)
  std::uint8_t marks[flags];        // NOLINT(*-avoid-c-arrays)
};

static_assert(std::is_trivially_copyable_v<SavedState<double>> && std::is_trivially_copyable_v<SavedState<float>>);
static_assert(sizeof(SavedState<double>) ==
              8 * SavedState<double>::scalars + 4 * SavedState<double>::integers + SavedState<double>::flags);

template <class Scalar>
[[nodiscard]] SavedState<Scalar> save(const CharacterState<Scalar>& state) noexcept;
/// The state that was saved. Bytes that no `save` wrote give a state that a step may refuse, never undefined behaviour.
template <class Scalar>
[[nodiscard]] CharacterState<Scalar> restored(const SavedState<Scalar>& saved) noexcept;

extern template SavedState<float> save(const CharacterState<float>&) noexcept;
extern template SavedState<double> save(const CharacterState<double>&) noexcept;
extern template CharacterState<float> restored(const SavedState<float>&) noexcept;
extern template CharacterState<double> restored(const SavedState<double>&) noexcept;

}  // namespace paperproof
