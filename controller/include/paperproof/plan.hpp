/// Which stages of a step exist: what a scenery cannot need is left out before the first step.
#pragma once

namespace paperproof {

/// Stages that a step is made of; `false` leaves one out. The choice is made once, when a technique or a controller is
/// built: a stage that is left out is not asked for again. Where an omission is safe the step gives the same bits
/// without it; where the scenery or the character makes it unsafe, building refuses it (std::invalid_argument).
/// Keeping everything is always safe.
struct Stages {
  bool movers = true;   ///< Moving scenery and conveyors. Safe to leave out where nothing moves.
  bool one_way = true;  ///< Chains that block from one side. Safe to leave out where there are none.
  bool sensors = true;  ///< Colliders that only report. Safe to leave out where there are none.
  /// Edges that are parallel to no side of the character and of its box. Safe to leave out where there are none.
  bool slopes = true;
  bool jump = true;     ///< Safe to leave out where the jump button is never pressed; a press is then invalid input.
  bool gravity = true;  ///< Safe to leave out where gravity is zero; another one is then invalid input.
  bool snap = true;     ///< Following the ground downwards. Safe to leave out where `CharacterDef::snap` is zero.

  friend constexpr bool operator==(const Stages&, const Stages&) = default;
};

}  // namespace paperproof
