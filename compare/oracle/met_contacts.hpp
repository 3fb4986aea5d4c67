/// Which contacts a step should have reported.
#pragma once

#include "contains.hpp"
#include "oracle/contacts.hpp"
#include "oracle/exemptions.hpp"

namespace paperproof::compare::detail {

/// Below this gap at the end of the motion the controller may call it a contact already [m]: its hit distance, with
/// room for the rounding of the comparison.
inline constexpr double hit_reach = 1.01e-7;

/// A step as the judges of its contacts see it.
struct ContactScene : StepView {
  /// Of an octagon that is larger by `least_clearance`; null for a contender that promises nothing.
  const ExactScenery* grown;
  bool promises = party_of(header) == Party::promising;
  /// Up to this gap the contender may hold a contact that it has [m].
  double touch = promises ? guaranteed_touch : own_reach(header);
  /// Below this gap at the end of the motion it may call it a contact already [m].
  double hit = promises ? hit_reach : std::max(hit_reach, tolerance_named(header, "unit"));

  /// The requested displacement relative to what a collider goes along with [m].
  [[nodiscard]] Vec2d wanted(ColliderIndex collider) const { return step.requested - moved(collider); }
  [[nodiscard]] double across(const Vec2d& v) const { return v.dot(right); }
  /// What is passed on purpose is no contact.
  [[nodiscard]] bool is_dropped_through(ColliderIndex collider) const {
    return contains(step.dropped_through, collider);
  }
};

/// Adds the contacts that the requested motion has, and the first impact of the step.
void add_met_contacts(const ContactScene& at, bool starts_free, StepJudgement& judgement);

}  // namespace paperproof::compare::detail
