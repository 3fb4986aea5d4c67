/// Whether what moves goes as its script says, and how far what turns leaves its arc.
#pragma once

#include "oracle/exact.hpp"
#include "records/mover_script.hpp"
#include "records/trace.hpp"

#include <functional>
#include <map>
#include <span>

namespace paperproof::compare {

/// Where a mover is: a point v of its colliders is at offset + R(angle) v.
struct MoverPose {
  Vec2d offset{Vec2d::Zero()};  ///< [m]
  double angle = 0;             ///< Counter-clockwise [rad].
};

/// The law that scripts state, so many seconds after the start of the scene. Between two entries (a, s) and (b, t) it
/// is a + ((time - s) / (t - s)) (b - a), in double and in this order: the same bits on every machine.
/// @param script with at least one waypoint.
[[nodiscard]] MoverPose pose_at(const MoverScript& script, double time);

/// What is wrong with the ways of one step: each list is empty where it finds no fault.
struct MoverWayJudgement {
  std::vector<MoverIndex> off_script;     ///< Begins or ends elsewhere, or begins not where it ended before.
  std::vector<ColliderIndex> out_of_way;  ///< At an instant in between it is not where the law below has it.
  std::vector<ColliderIndex> coarse;      ///< Turned at once by more than is promised near the character.
  std::vector<ColliderIndex> off_arc;     ///< Leaves its arc by more than the bound.
  bool is_fine = false;                   ///< The step has more parts than it needs: see **Fine**.
  std::vector<double> turns;              ///< How far each mover turns in the step, as far as its script tells [rad].
  double arc_error = 0;                   ///< Largest distance of a vertex from its arc at the same instant [m].
  double arc_share = 0;                   ///< Largest share of its bound that the error of a vertex is.

  [[nodiscard]] bool broken() const {
    return !off_script.empty() || !out_of_way.empty() || !coarse.empty() || !off_arc.empty() || is_fine;
  }
};

/// Near a character is what is no farther from it when the step begins [m]: twice what turns at once there.
inline constexpr double near_what_turns = 0.1;
/// How far a point near the character goes at most where a mover turns at once [m].
inline constexpr double most_turned_at_once = 0.05;
/// Into so many parts a step is divided at most.
inline constexpr int most_turning_parts = 32;

/// Feed it every step of one run in order. Not thread-safe.
///
/// **Poses.** In a step a mover goes evenly from its script's pose at the begin of the step to that at its end: that is
/// its arc. (A script that has an entry within the step is met again at the end.) An offset is that of the script bit
/// for bit. Times are step × dt; where steps have lengths of their own, the sum of these, and an offset may be off by 4
/// roundings of that time at the mover's speed. A run in float has its dt rounded to float in the header, and offsets
/// as well: there both may be off by a rounding to float (2^-24). A vertex of what turns may be off
/// by 8 roundings (2^-53) of (1 + |angle|) |v| + |offset|: cosines differ in the last bit between compilers. Every step
/// begins where the step before ended, bit for bit.
///
/// **In between.** A part of a step may begin with a turn at once: a time shorter than 1e-5 of what follows. After it
/// the collider has the shape and the angle that it has at the end of that part. At every other instant it is on its
/// arc. (The centre of a circle goes straight from where it begins to where it ends.)
///
/// **Coarse.** Let S be the extent of the character (the diagonal of its box). What belongs to a mover of which
/// anything but a circle is near it turns at once by at most 0.05 m / S, or by 1/32 of the turn of the step where that
/// is more.
///
/// **Fine.** Let W be the longest way of a vertex in the step, and L how far the character's limits let it go besides
/// the wanted way. A step goes in n > 1 parts only where a mover turns by more than n / 2 times 0.05 m / S, and is no
/// farther from the character, when the step begins, than W, twice S, twice the wanted way, and 3 L together. What is
/// no farther than W, the wanted way and 0.1 m may be met. Beside it a step may go in any number of parts, and so it
/// may beside a mover without a script.
///
/// **Bound.** Let A be that angle (of what is not near, the turn of the whole step), r the distance of a vertex from
/// the point that its mover turns about, D that from the position of the character at any corner of its way, R the
/// largest distance of a corner of the character from its position. The point about which it turns at once is a corner
/// c of the character, or the vertex of the mover nearest to c, no farther from c than the vertex in question and 2 R.
/// So the turn takes the vertex by at most A (2 D + 4 R), or A r where the mover turns about its own point; a chord
/// leaves an arc by at most r A² / 8:
///
///     arc_error <= A max(r, 2 D + 4 R) + r A² / 8 + 1e-6 (way of the mover in the step + r |turn|)
///
/// and of the centre of a circle r turn² / 8 + 1e-6 (...). `arc_error` is looked at at 8 moments between two instants.
class MoverWayJudge {
 public:
  /// @param header must outlive the judge. @param scripts one for each mover; copied.
  MoverWayJudge(const TraceHeader& header, std::vector<MoverScript> scripts);
  /// The colliders that turn and are no farther from the octagon than so many metres when the step begins.
  using Near = std::function<std::vector<ColliderIndex>(double within)>;
  [[nodiscard]] MoverWayJudgement judge(const TraceStep& step, const Near& near);
  /// A step that left no ways, because it was refused: its time goes by.
  void pass_over(const TraceStep& step) { tell_time(step); }

 private:
  /// What the script says about one step.
  struct Course {
    MoverPose from;
    MoverPose to;
    double slack = 0;  ///< Of the time [s].
    [[nodiscard]] double turn() const { return to.angle - from.angle; }
    [[nodiscard]] MoverPose at(double fraction) const;
  };

  [[nodiscard]] Course course_of(MoverIndex mover) const;
  [[nodiscard]] bool is_fine(const TraceStep& step, const Near& near) const;
  void tell_time(const TraceStep& step);
  [[nodiscard]] bool is_on_script(const Vec2d& offset, const MoverPose& pose, MoverIndex mover, double slack) const;
  void judge_offsets(const TraceStep& step, MoverWayJudgement& judgement);
  void judge_way(const VertexWay& way, const TraceStep& step, double most, MoverWayJudgement& judgement);
  void measure_arc(const VertexWay& way, const TraceStep& step, double most, MoverWayJudgement& judgement) const;
  [[nodiscard]] double allowed(const MoverPose& pose, const Vec2d& v, MoverIndex mover, double slack) const;

  const TraceHeader& header_;
  std::vector<MoverScript> scripts_;
  bool is_float_ = false;
  double extent_ = 0;   ///< Of the character [m].
  double radius_ = 0;   ///< The largest distance of a corner from its position [m].
  int step_ = -1;       ///< The last one.
  ExactFraction time_;  ///< When the present step ends, where steps have lengths of their own [s].
  double begin_ = 0;    ///< Of the present step [s].
  double end_ = 0;
  bool vary_ = false;
  bool goes_on_ = false;  ///< The step before is known.
  /// Where everything is when a step ends.
  struct Ends {
    std::vector<Vec2d> offsets;
    std::map<ColliderIndex, std::vector<Vec2d>> vertices;
  };
  Ends before_;  ///< Of the step before.
  Ends now_;
};

}  // namespace paperproof::compare
