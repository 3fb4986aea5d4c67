/// The calls of `octagon_sweep` beside a whole step: parts of a step, for crowds, and questions.
#pragma once

#include <paperproof/octagon_sweep.hpp>

#include <optional>

namespace paperproof::octagon_sweep {

/// Which part of a step a move makes.
enum class Part : std::uint8_t {
  whole,  ///< All of it, or its beginning.
  rest,   ///< The step has begun. No way out of crushing movers is looked for: they may have come in this very step.
  stay,   ///< The character keeps its position in the world. Every mover that runs into it crushes it.
};

template <class Scalar>
class SweepInParts : public Technique<Scalar> {
 public:
  /// As `move`, which is a whole step.
  virtual void move_part(Part part, const MoveRequest<Scalar>& request, Scratch<Scalar>& scratch,
                         MoveResult<Scalar>& result) const noexcept = 0;

  /// See the calls of these names in `Controller`.
  /// @param at its position and displacement, its movers and filter count.
  [[nodiscard]] virtual std::optional<Contact<Scalar>> cast(const MoveRequest<Scalar>& at,
                                                            Scratch<Scalar>& scratch) const noexcept = 0;
  [[nodiscard]] virtual std::size_t overlaps(const MoveRequest<Scalar>& at, Scratch<Scalar>& scratch,
                                             std::span<ColliderIndex> found) const noexcept = 0;
  [[nodiscard]] virtual std::size_t contacts_at(const MoveRequest<Scalar>& at, Scalar within, Scratch<Scalar>& scratch,
                                                std::span<Contact<Scalar>> found) const noexcept = 0;
};

/// As `make_octagon_sweep`.
template <class Scalar>
[[nodiscard]] std::unique_ptr<SweepInParts<Scalar>> make_sweep_in_parts(const SweepDef& def,
                                                                        const Scenery<Scalar>& scenery,
                                                                        const CharacterDef& character);

}  // namespace paperproof::octagon_sweep
