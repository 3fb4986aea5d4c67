/// The swept step: whole, in parts for crowds, and the questions that it answers.
#pragma once

#include <paperproof/octagon_sweep.hpp>
#include <paperproof/report.hpp>
#include <paperproof/scratch.hpp>
#include <paperproof/up_frame.hpp>

#include <memory>
#include <optional>
#include <span>

namespace paperproof::octagon_sweep {

/// What a step wants, and what it knows of the steps before.
template <class Scalar>
struct StepRequest {
  Vec2<Scalar> position{Vec2<Scalar>::Zero()};      ///< Where the step begins [m].
  Vec2<Scalar> displacement{Vec2<Scalar>::Zero()};  ///< The wanted displacement [m].
  Vec2<Scalar> velocity{Vec2<Scalar>::Zero()};      ///< The velocity behind the displacement [m/s].
  /// The part of `velocity` across up that this step's steering added [m/s].
  Scalar steered = 0;
  Vec2<Scalar> last_free{Vec2<Scalar>::Zero()};  ///< See `CharacterState::last_free`.
  bool has_last_free = false;
  bool grounded = false;  ///< The last step ended on the ground, and this one does not begin with a jump.
  bool crushed = false;   ///< See `CharacterState::crushed`.
  bool drop = false;      ///< One-way chains do not block: see `Input::drop`.
  /// A motion leaves ground that it touches if it goes away from it faster than this [m/s]: by more than
  /// `Tolerances::touch` in one more step. Zero in a step that begins with a jump.
  Scalar leaves_ground_above = 0;
  std::span<const Crusher<Scalar>> crushers{};  ///< See `CharacterState::crushers`.
  /// One for each mover of the scenery.
  std::span<const MoverMotion<Scalar>> movers{};
  const ColliderFilter* filter = nullptr;  ///< Null: all colliders are there.
  Scalar dt = 0;                           ///< [s]
  UpFrame<Scalar> up{};                    ///< See `StepContext::up`.
  /// The ground that carries the character, if any: `displacement` and `velocity` are then relative to this ground, and
  /// the step adds the ground's motion.
  Ride<Scalar> ride{};
};

/// Which part of a step a move makes.
enum class Part : std::uint8_t {
  whole,  ///< All of it, or its beginning.
  rest,   ///< The step has begun. No way out of crushing movers is looked for: they may have come in this very step.
  stay,   ///< The character keeps its position in the world. Every mover that runs into it crushes it.
};

/// Const and shareable between threads; each thread brings its scratch. No call allocates or throws.
template <class Scalar>
class SweepInParts {
 public:
  virtual ~SweepInParts() = default;

  [[nodiscard]] virtual Scratch<Scalar> make_scratch() const = 0;

  /// @param scratch made by this sweep, which is not checked here.
  virtual void move_part(Part part, const StepRequest<Scalar>& request, Scratch<Scalar>& scratch,
                         MoveResult<Scalar>& result) const noexcept = 0;

  /// See the calls of these names in `Controller`.
  /// @param at its position and displacement, its movers and filter count.
  [[nodiscard]] virtual std::optional<Contact<Scalar>> cast(const StepRequest<Scalar>& at,
                                                            Scratch<Scalar>& scratch) const noexcept = 0;
  [[nodiscard]] virtual std::size_t overlaps(const StepRequest<Scalar>& at, Scratch<Scalar>& scratch,
                                             std::span<ColliderIndex> found) const noexcept = 0;
  [[nodiscard]] virtual std::size_t contacts_at(const StepRequest<Scalar>& at, Scalar within, Scratch<Scalar>& scratch,
                                                std::span<Contact<Scalar>> found) const noexcept = 0;
};

/// For one scenery and one character. `scenery` must outlive it.
/// @throws std::invalid_argument for iterations out of range; InvalidCharacter for an impossible character.
template <class Scalar>
[[nodiscard]] std::unique_ptr<SweepInParts<Scalar>> make_sweep_in_parts(const SweepDef& def,
                                                                        const Scenery<Scalar>& scenery,
                                                                        const CharacterDef& character);

}  // namespace paperproof::octagon_sweep
