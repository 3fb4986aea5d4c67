/// What a step says of its end: that it stands, and how fast it goes.
#pragma once

#include "oracle/judge.hpp"
#include "oracle/later_parts.hpp"
#include "oracle/step_view.hpp"

namespace paperproof::compare::detail {

/// Holds the end of one step against exact arithmetic and the law of motion, for a contender that promises both.
///
/// **Grounded** is right where a solid has a walkable face within `guaranteed_touch` that the velocity does not lead
/// into by more than that in one step (not asked of what turns), or where the unsteered motion points down and all that
/// is within it leaves no way down (a wedge), or a walk rests on a stair (`is_stair`). It hovers where no walkable face
/// is met by an exact motion straight down by the gap: the octagon only touches beside the face.
///
/// **Ground missed.** The octagon is met by a walkable face on a motion by `guaranteed_touch` against the face's
/// normal, no jump began, the unsteered motion leads into it, and the motion at the end goes along all such faces: in
/// one more step it would part them, or press in, by no more than that.
///
/// **Ground left.** With a `snap`, a walk follows its ground down. It does not end in the air if the first thing
/// straight below, nearer than `snap`, is walkable ground. That ground goes down no faster than the character may fall.
///
/// **Kerb missed.** No face at rest stops a walk that could climb it. The climb goes straight up by `step_height`, by a
/// half, a quarter or an eighth of it, or as far as there is room. It goes on by what is left of the way, if that is
/// more than 1e-5 m, and down to such ground, or to a stair, which is higher. Asked in runs of one character, of steps
/// without a stair.
///
/// Both are asked of steps in one part, without `drop`, and where nothing that turns is as near as the character would
/// go.
///
/// **Speed lost.** A step begins free, and its wanted motion comes within 1e-6 m of nothing: it goes exactly as wanted.
/// Else a character loses upward speed only below a ceiling, on ground that it follows, or at a wall that ends its
/// climb. `leg_faults` bounds how fast and how far it goes.
/// @param whole the same step, where its later parts are requested, too.
/// @param grown_scenery the solids for an octagon that is larger by 1e-6 m.
/// @param wanted by the first part of the step. @param starts_free the step begins inside nothing.
void judge_end(const StepView& at, const StepView& whole, const ExactScenery& grown_scenery, const Wanted& wanted,
               const LaterParts& later, bool starts_free, StepJudgement& judgement);

}  // namespace paperproof::compare::detail
