/// Judges what the characters of one run do to each other.
#pragma once

#include "oracle/judge.hpp"
#include "oracle/pair.hpp"

#include <map>
#include <utility>

namespace paperproof::compare {

/// Feed it every step of one run in order, after each character has been judged by itself. Not thread-safe.
///
/// Two characters go along their ways at the same time, so it is the way of their difference that counts, exactly.
///
/// **In turns.** Where steps have a `turn`, each goes along its way while the others stand: those before it where they
/// ended, those after it where they began. Passed is who is met so. All else that a character says of its step is asked
/// of a step among movers: see `InTurns`.
///
/// **Inside.** Their open interiors overlap at the end of the step. It is new where they did not at its beginning.
///
/// **Passed.** They are apart at both ends, and overlap at some moment between; or they overlapped since an earlier
/// step, and the straight way of their difference from the last step without to the end of this one leads through
/// overlap: they left on other sides. No deeper than the slop (see `Judge`) on that way it is a corner cut.
/// Where paths are sampled (Box2D) their moments are estimates that do not go together: of one step, too, the straight
/// way counts then.
///
/// **First impact.** Both go evenly along what they requested, apart where the step begins, and meet nothing before; it
/// then takes the place of the scenery's. It is comparable under the conditions of `Judge`, and if no third one that
/// comes near either has met something before: that one may have turned them aside.
///
/// **In company.** Two characters touch in a step where they come within 1e-6 m of each other at a corner of either's
/// way (float: within the gap at which it still touches; Box2D: its skin, 20 mm). What was requested then no longer
/// says what scenery is met, so contacts with scenery that are only reported, or only exact, count neither way
/// (exempted). Of octagon_sweep in double, which has no such exemption, two things are still compared: a reported
/// contact is right where a face is there, and an exact contact does not count where the other turns the motion aside
/// first: the requested motion enters the other no later than it touches the scenery; and the contact is exact only
/// from the start of the step, or what the other leaves of the motion does not lead into it. Horizontal speed is not
/// lost to nothing where the other opposes it, where it is or wants to go (within the step and the skin beyond, as for
/// solids).
class CompanyJudge {
 public:
  explicit CompanyJudge(const TraceHeader& header);

  /// The characters that one of them overlaps, exactly.
  /// @param positions of all of them.
  [[nodiscard]] std::vector<CharacterIndex> overlapped(std::span<const Vec2d> positions,
                                                       CharacterIndex character) const;

  /// The smallest separation of two characters at a corner of either's way [m].
  [[nodiscard]] double nearest(const TraceStep& one, const TraceStep& other) const;

  /// Whether a normal is of a face along which the one is apart from the other, and touches it, at a corner of either's
  /// way. @param normal towards the one.
  [[nodiscard]] bool has_face(const TraceStep& one, const TraceStep& other, const Vec2d& normal) const;

  /// Whether the one must say that it met the other: at a corner of either's way they are no farther than 1e-6 m from
  /// each other, and where the other goes from there is entered, in what is left of the step, by what was requested of
  /// the one and by all that its contacts with scenery may have left of that. Not asked where a character says that it
  /// is stuck, crushed or gives up its way, begins inside something, or met a third one. In its turn it says only whom
  /// its own motion meets: what comes over it is not asked for.
  [[nodiscard]] bool must_meet(const TraceStep& one, const TraceStep& other) const;

  /// How far the time at which they say that they met is off [m]: from a moment at which they are no farther than
  /// 1e-6 m from each other, along the normal, at the pace at which they come to it, or go on from it, or would go on:
  /// see `ways_at`. No more than the gap that there is at that time. Not told below 1e-6 m.
  [[nodiscard]] double off_at(const TraceStep& one, const TraceStep& other, const CrowdContact& met,
                              std::span<const TraceStep> steps) const;

  /// How far one would go in the time of a whole step, from a fraction of it on: as requested, or as its contacts with
  /// scenery, and the others that are near then, may leave that [m].
  [[nodiscard]] std::vector<Vec2d> ways_at(const TraceStep& one, std::span<const TraceStep> steps,
                                           double fraction) const;

  /// The steps as they act on one of them in its turn; empty where they take no turns. Another goes straight and evenly
  /// from where it began to where it ended, over the whole step, if
  /// - the one stands on it when the step begins: it touches a walkable face of the other within 1e-6 m;
  /// - the other went before, and that way led no nearer to where the one began;
  /// - or the other goes after, and that way leads into where the one began: it pushes the one, or follows it.
  ///
  /// Any other stands where it is in that turn. Its contacts are left out.
  [[nodiscard]] std::vector<TraceStep> acting_on(CharacterIndex character, std::span<const TraceStep> steps) const;

  /// What the others mean for one of them: see `Judge`.
  /// @param steps of all of them, in order; not copied, nor is @param acting what `acting_on` has of them.
  [[nodiscard]] Others others_of(CharacterIndex character, std::span<const TraceStep> steps,
                                 std::span<const TraceStep> acting = {}) const;

  /// @param steps,judgements one of each character, in order; what is found is written into the judgements.
  void judge(std::span<const TraceStep> steps, std::span<StepJudgement> judgements);

 private:
  using Way = std::span<const PathPoint>;
  /// Where two that overlap were last without; none where the run began with it.
  using FreeFrom = std::optional<std::pair<Vec2d, Vec2d>>;
  /// The first impacts that every one of them would have.
  struct Impact {
    CharacterIndex one;
    CharacterIndex other;
    double fraction = 0;
    bool comparable = false;
  };
  /// Calls `visit(mine, theirs, fraction)` for their places at the corners of either's way, until it returns true.
  template <class Visit>
  static bool any_moment(const TraceStep& one, const TraceStep& other, const Visit& visit);
  [[nodiscard]] std::vector<Vec2d> ways_of(const TraceStep& step) const;
  [[nodiscard]] bool continues(const TraceStep& step) const;
  void judge_pair(const TraceStep& one, const TraceStep& other, StepJudgement& judgement);
  void judge_apart(const TraceStep& one, const TraceStep& other, StepJudgement& judgement);
  void judge_ways(Way one, Way other, CharacterIndex whom, StepJudgement& judgement) const;
  [[nodiscard]] bool may_meet(const TraceStep& one, const TraceStep& other) const;
  [[nodiscard]] std::optional<Impact> first_impact(const TraceStep& one, const TraceStep& other) const;
  void judge_first_impacts(std::span<const TraceStep> steps, std::span<StepJudgement> judgements) const;
  void judge_first_impact(const TraceStep& one, const TraceStep& other, StepJudgement& judgement) const;
  [[nodiscard]] std::vector<NearPart> near_of(CharacterIndex character, std::span<const TraceStep> steps,
                                              const PathPoint& corner, double within) const;
  [[nodiscard]] double handed_on(CharacterIndex character, std::span<const TraceStep> steps) const;
  [[nodiscard]] bool touch(const TraceStep& one, const TraceStep& other) const;
  [[nodiscard]] bool turns_aside(const TraceStep& one, const TraceStep& other, const ExactContact& exact) const;
  void excuse(const TraceStep& one, const TraceStep& other, StepJudgement& judgement) const;

  TraceHeader header_;
  ExactPair pair_;
  Box2 box_;  ///< Around the shape, relative to the position [m].
  double slop_;
  double reach_;                  ///< What counts as touching [m].
  std::vector<Vec2d> last_ends_;  ///< Empty before the first step.
  std::map<std::pair<CharacterIndex, CharacterIndex>, FreeFrom> inside_;
};

}  // namespace paperproof::compare
