/// What steps characters by any technique: `octagon_sweep`, which is `Controller` and `Crowd`, or one of the others.
#pragma once

#include <paperproof/controller.hpp>
#include <paperproof/crowd.hpp>
#include <paperproof/technique.hpp>

#include <memory>
#include <optional>
#include <span>

namespace paperproof {

/// Steps characters of one kind through one scenery, as `Controller` does in all but the way to move. Const and
/// shareable between threads.
template <class Scalar = double>
class TechniqueController {
 public:
  explicit TechniqueController(Controller<Scalar> sweep);
  /// @param technique made for the same scenery, which must outlive the controller, and for the same character.
  /// @param search of what belongs to the controller: sensors, and the one-way chains that are dropped through.
  /// @throws InvalidCharacter for an impossible character; std::invalid_argument where a collider has a filter.
  TechniqueController(const Scenery<Scalar>& scenery, const CharacterDef& character,
                      std::unique_ptr<const Technique<Scalar>> technique, PieceSearch search = PieceSearch::tree);

  /// See `Controller::step`. With another technique than `octagon_sweep`, a filter is invalid input, and any other up
  /// than (0, 1).
  StepStatus step(CharacterState<Scalar>& state, const Input& input, const StepContext<Scalar>& context,
                  Scratch<Scalar>& scratch, StepReport<Scalar>& report) const noexcept;

  [[nodiscard]] Scratch<Scalar> make_scratch() const;
  /// The controller that moves by `octagon_sweep`. Null: another technique does.
  [[nodiscard]] const Controller<Scalar>* sweep() const noexcept { return sweep_ ? &*sweep_ : nullptr; }
  /// Size of the technique's own copy of the level [bytes].
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  template <class>
  friend class TechniqueCrowd;

  /// A step without its move: intent and request before it, sensors and state after it.
  struct Driver;

  std::optional<Controller<Scalar>> sweep_;
  std::shared_ptr<const Driver> driver_;  ///< Of another technique; else null. Scratch memory refers to it.
};

/// Steps characters of one kind that block each other, as `Crowd` does in all but the way to move. Const and shareable
/// between threads.
template <class Scalar = double>
class TechniqueCrowd {
 public:
  explicit TechniqueCrowd(Crowd<Scalar> sweep);
  /// @throws as `TechniqueController`.
  TechniqueCrowd(const Scenery<Scalar>& scenery, const CharacterDef& character,
                 std::unique_ptr<const JointTechnique<Scalar>> technique, PieceSearch search = PieceSearch::tree);

  [[nodiscard]] CrowdScratch make_scratch(std::size_t most_characters) const;
  /// See `Crowd::step`.
  StepStatus step(std::span<CharacterState<Scalar>> states, std::span<const Input> inputs,
                  const StepContext<Scalar>& context, CrowdScratch& scratch,
                  CrowdReport<Scalar>& report) const noexcept;

 private:
  using Driver = typename TechniqueController<Scalar>::Driver;

  std::optional<Crowd<Scalar>> sweep_;
  const JointTechnique<Scalar>* technique_ = nullptr;  ///< The driver has it.
  std::shared_ptr<const Driver> driver_;
};

extern template class TechniqueController<float>;
extern template class TechniqueController<double>;
extern template class TechniqueCrowd<float>;
extern template class TechniqueCrowd<double>;

}  // namespace paperproof
