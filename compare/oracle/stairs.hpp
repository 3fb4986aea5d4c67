/// What a walker rests on that is too steep to walk on, and stands on: a stair.
#pragma once

#include "oracle/step_view.hpp"

namespace paperproof::compare::detail {

/// Whether a part that is near is a stair for a walker at a place. The walker touches a corner of it, or a side that
/// slopes, that nobody walks on, and one of these ways leads to walkable ground, at once and freely:
/// - Up, if the part is no higher than `step_height`. The way goes straight up and straight across, until the end of
///   the foot is over a vertex of the collider, or over the first place of a circle that is walkable. It ends at most
///   `step_height` above this place and above where the step began, and goes no farther across than a slope of the
///   climb limit would.
/// - Down, if the part is no higher than `snap`. The way goes straight back until the character is past the lowest
///   point that it touches, and straight down, to at most `snap` below this place and below where the step began. So
///   it stands only where the step has not risen.
///
/// Where the step began goes along with what is ridden. A walker stands there as on level ground. Of what turns this is
/// not asked.
/// @param carried how far the ground that it rode when the step began takes it in the step [m].
[[nodiscard]] bool is_stair(const StepView& step, const Vec2d& carried, const Place& at, const NearPart& part);

}  // namespace paperproof::compare::detail
