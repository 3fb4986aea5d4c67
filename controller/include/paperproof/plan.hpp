/// Which stages of a step exist: what a scenery cannot need is left out before the first step.
#pragma once

namespace paperproof {

/// Stages that a step is made of; `false` leaves one out. `octagon_sweep` is built without `movers`, `one_way`,
/// `slopes` and `snap`: the choice is made once, then, and the step does not ask again. Where an omission is safe the
/// step gives the same bits without it; where the scenery or the character makes it unsafe, building refuses it
/// (std::invalid_argument). Keeping everything is always safe.
struct Stages {
  bool movers = true;   ///< Moving scenery and conveyors. Safe to leave out where nothing moves.
  bool one_way = true;  ///< Chains that block from one side. Safe to leave out where there are none.
  bool sensors = true;  ///< Colliders that only report. Part of the plan only: nothing is built without it yet.
  /// Edges that are parallel to no side of the character and of its box. Safe to leave out where there are none.
  bool slopes = true;
  bool jump = true;     ///< Part of the plan only: a step costs the same without it.
  bool gravity = true;  ///< Part of the plan only: a step costs the same without it.
  bool snap = true;     ///< Following the ground downwards. Safe to leave out where `CharacterDef::snap` is zero.

  friend constexpr bool operator==(const Stages&, const Stages&) = default;
};

}  // namespace paperproof
