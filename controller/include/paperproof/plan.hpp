/// Which stages of a step exist: what a scenery cannot need is left out before the first step.
#pragma once

#include <paperproof/broad_phase.hpp>
#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof {

/// Stages that a step is made of; `false` leaves one out. `octagon_sweep` is built without `movers`, `one_way`
/// and `slopes`, the controller without `sensors`, `jump` and `gravity`: the choice is made once, then, and the
/// step does not ask again. Where an omission is safe the step gives the same bits without it; where the scenery makes
/// it unsafe, building refuses it (std::invalid_argument). Keeping everything is always safe.
struct Stages {
  bool movers = true;   ///< Moving scenery and conveyors. Safe to leave out where nothing moves.
  bool one_way = true;  ///< Chains that block from one side. Safe to leave out where there are none.
  bool sensors = true;  ///< Colliders that only report. Safe to leave out where there are none.
  /// Edges that are parallel to no side of the character and of its box. Safe to leave out where there are none.
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

/// A stage that is left out, and what makes that safe: that the scenery, the character or the input cannot need it. How
/// fast the character is and how thick the scenery plays no part.
struct Omission {
  Stage stage = Stage::movers;
  std::string reason;
};

/// What is known of the steps before the first one. Where nothing is known the stage is kept.
struct Foreseen {
  bool gravity = true;   ///< False: gravity is zero in every step. Minus zero counts as some: it leaves another bit.
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

/// Reads what a scenery can need. Precision is never the plan's choice: a planned controller
/// (`TechniqueDef::broad_phase` and `::stages` from here) gives the same bits as one with everything.
///
/// Of the scenery the convex pieces count, diagonals of concave polygons included, and conveyors; a slope is what is
/// parallel to neither axis.
template <class Scalar>
[[nodiscard]] Plan make_plan(const Scenery<Scalar>& scenery, const Foreseen& foreseen = {});

}  // namespace paperproof
