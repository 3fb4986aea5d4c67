/// The stages of a step, and which of them a scenery cannot need.
#pragma once

#include <paperproof/broad_phase.hpp>
#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof {

/// What a scenery and its input may need; `false` says that they never do. Building `octagon_sweep` or the controller
/// refuses scenery that needs a stage which was left out (std::invalid_argument), and a step refuses such input. A step
/// gives the same bits without a stage that is not needed. It is always safe to keep every stage.
struct Stages {
  bool movers = true;   ///< Moving scenery and conveyors. Safe to leave out where nothing moves.
  bool one_way = true;  ///< Chains that block from one side. Safe to leave out where there are none.
  bool sensors = true;  ///< Colliders that only report. Safe to leave out where there are none.
  /// Circles, and edges that are parallel to no side of the character and of its box. Safe to leave out where there are
  /// none.
  bool slopes = true;
  bool jump = true;     ///< Safe to leave out where the jump button is never pressed; a press is then invalid input.
  bool gravity = true;  ///< Safe to leave out where gravity is zero; another one is then invalid input.

  friend constexpr bool operator==(const Stages&, const Stages&) = default;
};

/// The members of `Stages`, in their order.
enum class Stage : std::uint8_t { movers, one_way, sensors, slopes, jump, gravity };

inline constexpr std::array all_stages{Stage::movers, Stage::one_way, Stage::sensors,
                                       Stage::slopes, Stage::jump,    Stage::gravity};

[[nodiscard]] std::string_view name_of(Stage stage) noexcept;
[[nodiscard]] std::string_view name_of(BroadPhaseKind kind) noexcept;

/// A stage that is left out, and the reason why that is safe: the scenery, the character or the input cannot need the
/// stage. The speed of the character and the thickness of the scenery play no part.
struct Omission {
  Stage stage = Stage::movers;
  std::string reason;
};

/// Facts about all steps, known before the first one. A stage is kept if nothing is known about it.
struct Foreseen {
  bool gravity = true;   ///< False: gravity is zero in every step. Minus zero counts as gravity: it gives other bits.
  bool jump = true;      ///< False: the jump button is never pressed.
  bool company = false;  ///< True: several characters are stepped as a `Crowd`.
};

/// The broad phase and the stages for one scenery and one character.
struct Plan {
  BroadPhaseKind broad_phase = BroadPhaseKind::tree;
  std::string broad_phase_reason{};  ///< Number and spread of the pieces, in words.
  Stages stages{};
  std::vector<Omission> omitted{};  ///< One for each stage that is false in `stages`, in the order of `Stages`.
};

/// Finds the stages that a scenery can need. A plan never changes the precision: a planned controller
/// (`SweepDef::broad_phase` and `::stages` from here) gives the same bits as a controller with every stage.
///
/// The plan looks at the convex pieces (diagonals of concave polygons included) and at the conveyors. A slope is an
/// edge that is parallel to neither axis, or a circle.
template <class Scalar>
[[nodiscard]] Plan make_plan(const Scenery<Scalar>& scenery, const Foreseen& foreseen = {});

}  // namespace paperproof
