/// What steps characters by any technique: `octagon_sweep`, which is `Controller`, or one of the others.
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

/// Steps characters of one kind that block each other, all at once, by a joint technique. Const and shareable between
/// threads. (`octagon_sweep` has `step_together` for that.)
class TechniqueCrowd {
 public:
  /// @throws as `TechniqueController`.
  TechniqueCrowd(const Scenery& scenery, const CharacterDef& character, std::unique_ptr<const JointTechnique> technique,
                 PieceSearch search = PieceSearch::grid);

  [[nodiscard]] CrowdScratch make_scratch(std::size_t most_characters) const;
  /// One step for all characters. Never throws.
  /// @param states read and written; nothing else carries over. @param inputs one per state.
  /// @param scratch,report made for at least as many characters, the scratch by this crowd. Otherwise, or if one state,
  ///   input or step is refused (see `StepStatus`), no state changes.
  StepStatus step(std::span<CharacterState> states, std::span<const Input> inputs, const StepContext& context,
                  CrowdScratch& scratch, CrowdReport& report) const noexcept;

 private:
  using Driver = TechniqueController::Driver;

  const JointTechnique* technique_ = nullptr;  ///< The driver has it.
  std::shared_ptr<const Driver> driver_;
};

}  // namespace paperproof
