/// What goes along with movers that turn, judged apart from the rest: between two bounds, for its places are no
/// fractions.
#pragma once

#include "oracle/convex_parts.hpp"
#include "oracle/depth.hpp"
#include "oracle/judge.hpp"
#include "oracle/rotation.hpp"

#include <set>

namespace paperproof::compare::detail {

/// Solids that turn about the point (0, 0) that they are written around while that point goes along with their mover,
/// both evenly during a step. Feed it every step of one run in order. Not thread-safe.
///
/// - **Overlap** at the end of a step, and a touch on the way, are what interval arithmetic is certain of.
/// - **Contact**: the wanted motion, less what the other contacts that were reported take from it, touches within the
///   step; its normal is that of the best axis there.
/// - **Time of impact**: where a contact begins, the reported fraction is held against the first touch of that motion
///   going on, at most four steps ahead: Box2D stops 20 mm away, so that the touch itself lies ahead.
/// - Depths, normals and distances are exact for the place rounded to double.
class TurningJudge {
 public:
  explicit TurningJudge(const TraceHeader& header);

  [[nodiscard]] bool any() const noexcept { return !solids_.empty(); }
  /// Of a collider that goes along with a mover that turns, a sensor or a solid.
  [[nodiscard]] bool turns(ColliderIndex collider) const;
  /// The scenery for the exact judge: what turns blocks nothing there.
  [[nodiscard]] static SceneryDef exact_part(const TraceHeader& header);
  /// The step without its contacts with and events of what turns.
  [[nodiscard]] TraceStep exact_part(const TraceStep& step) const;
  /// Whether something that turns is within so many metres at a corner of the way.
  [[nodiscard]] bool is_near(const TraceStep& step, double within) const;
  /// Adds what turns to the judgement of the rest.
  void judge(const TraceStep& step, StepJudgement& judgement);

 private:
  struct Solid {
    ColliderIndex collider = 0;
    MoverIndex mover = 0;
    std::vector<ConvexPart> parts;
  };
  /// Where a solid is at one moment, or how it goes from one to another.
  struct Pose {
    Vec2d offset{Vec2d::Zero()};
    double angle = 0;
  };

  [[nodiscard]] static Pose pose(const TraceStep& step, const Solid& solid, double fraction);
  [[nodiscard]] RotationTouch touch(const Solid& solid, const Pose& from, const Pose& to, const Vec2d& position,
                                    const Vec2d& displacement) const;
  [[nodiscard]] bool overlaps(const Solid& solid, const Pose& at, const Vec2d& position) const;
  [[nodiscard]] Axis nearest_axis(const Solid& solid, const Pose& at, const Vec2d& position) const;
  void judge_way(const Solid& solid, const TraceStep& step, StepJudgement& judgement) const;
  void judge_contacts(const Solid& solid, const TraceStep& step, StepJudgement& judgement);

  const TraceHeader& header_;
  std::vector<Solid> solids_;
  std::set<ColliderIndex> touched_;  ///< In the last step, as reported.
};

}  // namespace paperproof::compare::detail
