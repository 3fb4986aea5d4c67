/// What a step says of its end: that it stands, and how fast it goes.
#pragma once

#include "oracle/contacts.hpp"
#include "oracle/hanging.hpp"
#include "oracle/intent.hpp"
#include "oracle/judge.hpp"
#include "oracle/legs.hpp"

namespace paperproof::compare::detail {

/// Holds the end of one step against exact arithmetic and the law of motion, for a contender that promises both. Lives
/// for one step.
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
/// climb. `LegJudge` bounds how fast and how far it goes.
class EndJudge {
 public:
  /// @param grown_scenery the same for an octagon that is larger by 1e-6 m.
  EndJudge(const TraceHeader& header, const ExactScenery& scenery, const ExactScenery& grown_scenery,
           const TraceStep& step, const Wanted& wanted, const WhatTurns& turns, const LaterParts& later = {});

  /// @param starts_free the step begins inside nothing.
  void judge_ground(const HangingJudge& hanging, bool starts_free, StepJudgement& judgement) const;
  void judge_speed(bool starts_free, StepJudgement& judgement) const;
  /// Whether a walk leaves ground that it follows, and whether a kerb stops what climbs it.
  void judge_walk(bool starts_free, StepJudgement& judgement) const;

 private:
  [[nodiscard]] Place end() const { return {step_.path.back(), step_.movers}; }
  [[nodiscard]] std::vector<NearPart> near(std::size_t corner, double within) const {
    return parts_near(scenery_, step_, turns_, corner, within);
  }
  [[nodiscard]] std::vector<NearPart> near_at_end(double within) const;
  [[nodiscard]] bool meets_ground(const Vec2d& displacement) const;
  [[nodiscard]] bool stands_on_ground() const;
  [[nodiscard]] bool walks() const;
  [[nodiscard]] bool goes_freely() const;
  [[nodiscard]] double flight_error() const;
  [[nodiscard]] bool may_take_rise(const NearPart& part, const NearFace& face) const;
  [[nodiscard]] double rise_lost() const;
  [[nodiscard]] bool is_alone(double beyond = 0) const;
  [[nodiscard]] std::vector<ExactImpact> first_below(const ExactScenery& scenery, const Vec2d& from, double down) const;
  [[nodiscard]] bool is_followed(const ExactImpact& impact) const;
  [[nodiscard]] bool meets_ground_first(const Vec2d& from, double down) const;
  [[nodiscard]] bool is_free(const Vec2d& from, const Vec2d& to) const;
  [[nodiscard]] bool touches_riser(const Vec2d& ahead) const;
  [[nodiscard]] double headroom() const;
  [[nodiscard]] bool could_climb(double rise, const Vec2d& ahead) const;

  const TraceHeader& header_;
  const ExactScenery& scenery_;
  const ExactScenery& grown_scenery_;
  const TraceStep& step_;
  const Wanted wanted_;  ///< By all parts of the step, but for what later ones steer.
  const WhatTurns& turns_;
  const LaterParts later_;
  Vec2d up_;
  double dt_;  ///< [s]
};

}  // namespace paperproof::compare::detail
