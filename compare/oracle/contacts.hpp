/// What a step should have reported as contacts, and what it lost to nothing.
#pragma once

#include "contains.hpp"
#include "oracle/judge.hpp"

namespace paperproof::compare::detail {

/// A contact is this near along its normal [m]: twice what the controller stops at.
inline constexpr double contact_reach = 1e-6;
/// §6 of the guarantee lets a contact be held up to this gap [m].
inline constexpr double guaranteed_touch = 7e-7;
/// Room for the rounding of a separation [m].
inline constexpr double touch_rounding = 1e-8;
/// See `Judge`: sine of the flattest approach whose fraction is compared.
inline constexpr double least_approach = 1e-3;

/// Of the character as it stands. What rounding leaves of a component that is zero is none.
[[nodiscard]] Side side_along(const Vec2d& normal, const Vec2d& up);

/// Whether a reported contact is among `StepJudgement::ghosts`.
[[nodiscard]] inline bool is_ghost(const StepJudgement& judgement, const Contact& reported) {
  return contains(judgement.ghosts, std::pair(reported.collider, reported.side));
}

/// Whether exact arithmetic has this contact, too: with the same collider, on the same side.
[[nodiscard]] bool is_exact(const StepJudgement& judgement, const Contact& reported);

/// Judges the contacts of one step: see `Judge` for what each answer means.
/// @param grown the solids for an octagon that is larger by `least_clearance`; null for a contender that promises
/// nothing.
void judge_contacts(const StepView& at, const ExactScenery* grown, bool starts_free, StepJudgement& judgement);
/// How much of the wanted horizontal motion of a step without contacts was lost to nothing.
void measure_motion(const StepView& at, bool starts_free, StepJudgement& judgement);

}  // namespace paperproof::compare::detail
