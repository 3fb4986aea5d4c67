/// Judges what the characters of one run do to each other.
#pragma once

#include "oracle/judge.hpp"
#include "oracle/pair.hpp"

#include <map>
#include <utility>

namespace paperproof::compare {

/// Where a way is at a fraction of its step, rounded; where a jump leads from one place to another the first one.
[[nodiscard]] Vec2d place_at(std::span<const PathPoint> way, double fraction);

/// Feed it every step of one run in order, after each character has been judged by itself. Not thread-safe.
///
/// **In turns.** Where steps have a `turn`, each goes along its way while the others stand: those before it where they
/// ended, those after it where they began. Passed is who is met so. All else that a character says of its step is asked
/// of a step among movers: see `InTurns`.
///
/// **At the same time.** Else two go along their ways together, and the way of their difference counts, exactly.
/// Whether they come to overlap is asked, and whether one passes the other. Their contacts are counted as they are
/// reported, and not judged: nothing is promised of them. Another that is near may have turned the motion aside, held
/// or pushed it. Then contacts with scenery, lost way and speed, the first impact, falls, ground and room count neither
/// way (exempted): see `Judge`. Two are near where, at a corner of either's way, they touch (within `own_reach`),
/// or the motion that was requested leads from there into the other.
///
/// **Inside.** Their open interiors overlap at the end of the step. It is new where they did not at its beginning.
///
/// **Passed.** They are apart at both ends, and overlap at some moment between; or they overlapped since an earlier
/// step, and the straight way of their difference from the last step without to the end of this one leads through
/// overlap: they left on other sides. No deeper than a rim (see `Judge`) on that way, they clip each other.
/// Where paths are sampled (Box2D) their moments are estimates that do not go together: of one step, too, the straight
/// way counts then.
class CompanyJudge {
 public:
  explicit CompanyJudge(const TraceHeader& header);

  /// The characters that one of them overlaps, exactly.
  /// @param positions of all of them.
  [[nodiscard]] std::vector<CharacterIndex> overlapped(std::span<const Vec2d> positions,
                                                       CharacterIndex character) const;

  /// Whether another is near one of them, and they go at the same time. @param steps of all of them.
  [[nodiscard]] bool is_beside_another(const TraceStep& one, std::span<const TraceStep> steps) const;

  /// @param steps,judgements one of each character, in order; what is found is written into the judgements.
  void judge(std::span<const TraceStep> steps, std::span<StepJudgement> judgements);

 private:
  using Way = std::span<const PathPoint>;
  /// Where two that overlap were last without; none where the run began with it.
  using FreeFrom = std::optional<std::pair<Vec2d, Vec2d>>;
  [[nodiscard]] bool continues(const TraceStep& step) const;
  void judge_pair(const TraceStep& one, const TraceStep& other, StepJudgement& judgement);
  void judge_apart(const TraceStep& one, const TraceStep& other, StepJudgement& judgement);
  void judge_ways(Way one, Way other, CharacterIndex whom, StepJudgement& judgement) const;
  [[nodiscard]] bool may_meet(const TraceStep& one, const TraceStep& other) const;

  TraceHeader header_;
  ExactPair pair_;
  Box2 box_;  ///< Around the shape, relative to the position [m].
  double rim_;
  std::vector<Vec2d> last_ends_;  ///< Empty before the first step.
  std::map<std::pair<CharacterIndex, CharacterIndex>, FreeFrom> inside_;
};

}  // namespace paperproof::compare
