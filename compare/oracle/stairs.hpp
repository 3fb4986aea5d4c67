/// What a walker rests on that is too steep to walk on, and stands on: a stair.
#pragma once

#include "oracle/exact.hpp"
#include "records/trace.hpp"

namespace paperproof::compare::detail {

/// Whether a part that is near is a stair for a walker at a place. The walker touches a corner of it, or a side that
/// slopes, that nobody walks on, and one of these ways leads to walkable ground, at once and freely:
/// - Past what is no higher than `step_height`: straight up and straight across, to where a vertex of its collider is
///   met by the end of the foot; of a circle it is the first place that is no longer too steep. That is at most
///   `step_height` higher than here and than where the step began, and no farther across than a slope of the climb
///   limit would take it.
/// - Past what is no higher than `snap`: straight back until the character is past the lowest point that it touches,
///   and straight down, to at most `snap` below here and below where the step began.
///
/// Where the step began goes along with what is ridden. A walker stands there as on level ground. Of what turns this is
/// not asked.
[[nodiscard]] bool is_stair(const TraceHeader& header, const ExactScenery& scenery, const TraceStep& step,
                            const Place& at, const NearPart& part);

}  // namespace paperproof::compare::detail
