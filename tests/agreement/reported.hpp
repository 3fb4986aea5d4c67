/// What a step says about itself, held against the exact oracle: its contacts, and the one-way chains that it dropped
/// through.
#pragma once

#include "oracle/exact.hpp"

#include <span>
#include <vector>

namespace paperproof::test {

/// One scenery and one character, with `rounding` as what the numbers may be off [m]. Immutable after construction.
class Reported {
 public:
  /// @param scenery as run. @param hull of the character, in order.
  Reported(const SceneryDef& scenery, const std::vector<Vec2d>& hull, double rounding);

  /// At some corner of the way normal, point and separation of a contact agree, and there the separation is no more
  /// than the exact gap (of a collider that is one convex part), and not negative unless the collider is overlapped.
  [[nodiscard]] bool contact_holds(std::span<const compare::Place> path, const Contact<double>& contact) const;

  /// Each chain is named once, in order, is one-way, and is passed by some leg that begins above it, or missed by no
  /// more than two micrometres. (That none is passed and not named is for a judge to say.)
  [[nodiscard]] bool drops_hold(std::span<const compare::Place> path, std::span<const ColliderIndex> named) const;

 private:
  [[nodiscard]] bool nearly_passes(const compare::Place& from, const compare::Place& to, ColliderIndex chain) const;

  std::vector<Vec2d> hull_;
  double rounding_;
  std::vector<bool> is_one_part_;  ///< For each collider.
  compare::ExactScenery exact_;
  compare::ExactScenery both_ways_;  ///< For a character that is a little larger, and one-way chains as others.
};

}  // namespace paperproof::test
