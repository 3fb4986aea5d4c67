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
class TechniqueController {
 public:
  explicit TechniqueController(Controller sweep);
  /// @param technique made for the same scenery, which must outlive the controller, and for the same character.
  /// @param search of what belongs to the controller: sensors, and the one-way chains that are dropped through.
  /// @throws InvalidCharacter for an impossible character; std::invalid_argument where a collider has a filter.
  TechniqueController(const Scenery& scenery, const CharacterDef& character, std::unique_ptr<const Technique> technique,
                      PieceSearch search = PieceSearch::grid);

  /// See `Controller::step`. With another technique than `octagon_sweep`, a filter is invalid input, and any other up
  /// than (0, 1).
  StepStatus step(CharacterState& state, const Input& input, const StepContext& context, Scratch& scratch,
                  StepReport& report) const noexcept;

  [[nodiscard]] Scratch make_scratch() const;
  /// The controller that moves by `octagon_sweep`. Null: another technique does.
  [[nodiscard]] const Controller* sweep() const noexcept { return sweep_ ? &*sweep_ : nullptr; }
  /// Size of the technique's own copy of the level [bytes].
  [[nodiscard]] std::size_t memory_bytes() const noexcept;

 private:
  friend class TechniqueCrowd;

  /// A step without its move: intent and request before it, sensors and state after it.
  struct Driver;

  std::optional<Controller> sweep_;
  std::shared_ptr<const Driver> driver_;  ///< Of another technique; else null. Scratch memory refers to it.
};

/// Steps characters of one kind that block each other, as `Crowd` does in all but the way to move. Const and shareable
/// between threads.
class TechniqueCrowd {
 public:
  explicit TechniqueCrowd(Crowd sweep);
  /// @throws as `TechniqueController`.
  TechniqueCrowd(const Scenery& scenery, const CharacterDef& character, std::unique_ptr<const JointTechnique> technique,
                 PieceSearch search = PieceSearch::grid);

  [[nodiscard]] CrowdScratch make_scratch(std::size_t most_characters) const;
  /// See `Crowd::step`.
  StepStatus step(std::span<CharacterState> states, std::span<const Input> inputs, const StepContext& context,
                  CrowdScratch& scratch, CrowdReport& report) const noexcept;

 private:
  using Driver = TechniqueController::Driver;

  std::optional<Crowd> sweep_;
  const JointTechnique* technique_ = nullptr;  ///< The driver has it.
  std::shared_ptr<const Driver> driver_;
};

}  // namespace paperproof
