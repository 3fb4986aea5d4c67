/// What goes along with movers that turn, judged apart from the rest: what it overlaps, passes and touches, exactly.
#pragma once

#include "oracle/convex_parts.hpp"
#include "oracle/depth.hpp"
#include "oracle/first_meeting.hpp"
#include "oracle/judge.hpp"
#include "oracle/turning_room.hpp"

#include <set>

namespace paperproof::compare::detail {

/// What turns, gone on for some steps by the same rigid motion.
[[nodiscard]] VertexWay gone_on(const VertexWay& way, int steps);

/// The largest distance between two points [m].
[[nodiscard]] double extent_of(std::span<const Vec2d> points);

/// Solids that turn: their vertices go as `TraceStep::vertex_ways` says, and at every moment they are the hulls of
/// those that make up the convex parts of their definition. Feed it every step of one run in order. Not thread-safe.
///
/// - **Overlap** at the end of a step, **tunnelled** and **clipped** as of what does not turn (see `Judge`), but for
///   one that is left on another side in a later step than it was entered.
/// - **Crushed**: a solid that is named is excused if there is no room, and with room its overlap and passage are a
///   matter of `crush`, of who promises that: see `Judge`. The way to a place that is room leaves free what turns, too,
///   and ends 1e-7 m away from it. How far the mover goes is the longest way of a vertex.
/// - **Contact**: what was reported and is within 1e-6 m at a corner of the way, or what the requested motion touches
///   first in the step, or in its first part (Box2D: what the motion touches that is left by its contacts with the
///   rest). The normal is that of the face that is touched and most like the reported one, or of the best axis where
///   the motion touches.
/// - **Time of impact**: where a contact begins, the reported fraction is held against the first touch of the way that
///   was travelled until then, going on straight; less than 1e-6 m at the speed of approach is no error. Box2D stops 20
///   mm away, so that the touch itself lies ahead: there it is that of what it wants, which goes on for at most four
///   steps, and what turns goes on as in this one.
/// - **Undecided** is what comes so near that halving the time does not tell: it is counted, and `second_meeting`
///   decides it.
/// - **Two methods.** In every 8th step, and in each with a contact with what turns, `second_meeting` judges the way as
///   well. Where the two disagree the judge is wrong: `StepJudgement::methods_disagree`.
/// Distances, depths and normals are exact for places that are rounded to double.
class TurningJudge {
 public:
  /// @param header must outlive the judge.
  explicit TurningJudge(const TraceHeader& header);

  [[nodiscard]] bool any() const noexcept { return !solids_.empty() || !sensors_.empty(); }
  /// Whether the octagon overlaps a sensor that turns at any moment of the step.
  [[nodiscard]] bool meets_sensor(const TraceStep& step) const;
  /// Of a collider that goes along with a mover that turns, a sensor or a solid.
  [[nodiscard]] bool turns(ColliderIndex collider) const;
  /// The scenery for the exact judge: what turns blocks nothing there.
  [[nodiscard]] static SceneryDef exact_part(const TraceHeader& header);
  /// The step without its contacts with, events of and crushes by what turns.
  [[nodiscard]] TraceStep exact_part(const TraceStep& step) const;
  /// The solids that the octagon overlaps where a step begins.
  [[nodiscard]] std::vector<ColliderIndex> overlapped(const TraceStep& step) const;
  /// A step begins. @return whether it does inside of something that turns.
  [[nodiscard]] bool begin(const TraceStep& step);
  /// Whether there is a way out of that then.
  /// @param accept see `has_way_out`.
  [[nodiscard]] bool frees(const TraceStep& step, const std::function<bool(const Vec2d&)>& accept) const {
    return has_way_out(header_, step, sides_, accept);
  }
  /// Whether something that turns came over the octagon, and still overlaps it.
  [[nodiscard]] bool has_crushed() const noexcept { return !sides_.empty(); }
  /// Whether a way of the whole step meets nothing that turns but what it begins in, and ends 1e-7 m away from it.
  [[nodiscard]] bool left_free(const TraceStep& step, std::span<const PathPoint> way) const;
  /// The solids that are no farther than so many metres from where the step begins.
  [[nodiscard]] std::vector<ColliderIndex> near_at_begin(const TraceStep& step, double within) const;

  /// Whether nothing that turns comes near enough in the step to matter: boxes tell.
  [[nodiscard]] bool is_alone(const TraceStep& step, double within) const;
  /// The longest way of a vertex in the step [m].
  [[nodiscard]] double longest_way(const TraceStep& step) const;

  /// The parts within so many metres at a corner of the way, as they are at that instant. `moved` is how far the point
  /// nearest to the octagon goes in the step. By as much as `unsure` any point that the octagon may touch in the step
  /// comes farther along a face's normal than that:
  ///
  ///     turn (reach + |requested| + |moved|) + leaves
  ///
  /// where `reach` is the extent of the part, or of the octagon and `within` if that is less, and `leaves` how far the
  /// nearest point goes from an even straight way. All points of a straight face go equally fast along it, while it
  /// turns by nothing: so `unsure_along` has `turn` times the reach, and the gap, in place of the reach.
  [[nodiscard]] std::vector<NearPart> near(const TraceStep& step, const PathPoint& corner, double within) const;
  /// The same where the step ends, if everything went all the time as it does in the last stretch between two instants.
  [[nodiscard]] std::vector<NearPart> near_at_end(const TraceStep& step, double within) const;
  /// What a displacement from where the step ends meets first, of all that is within its length, while all stays.
  [[nodiscard]] std::vector<ExactImpact> impacts_at_end(const TraceStep& step, const Vec2d& displacement) const;
  /// How a solid stands to a motion.
  enum class Opposition : std::uint8_t {
    none,    ///< It is not met, or not against the motion's part across up.
    unsure,  ///< It is met if the octagon is wider by `unsure` on every side.
    met,
  };
  /// Whether something opposes a motion from a corner of the way, in the time of a whole step: what turns goes on as in
  /// this one. @param motion [m]
  [[nodiscard]] Opposition opposes(const TraceStep& step, const PathPoint& corner, const Vec2d& motion) const;
  /// Whether something farther away than `within` at a corner of the way is met in the rest of the step, if the octagon
  /// goes on by so much. @param way [m]
  [[nodiscard]] bool runs_into(const TraceStep& step, const PathPoint& corner, const Vec2d& way, double within) const;
  /// Who leaves what carried it, or rides a disc, goes on as that went in the step before. By so much what is touched
  /// carries otherwise in this one, as a conveyor too [m].
  [[nodiscard]] double carries_otherwise(const TraceStep& step) const;
  /// Whether a way leads out of what the octagon is inside of where the step ends: see `frees`.
  [[nodiscard]] bool frees_at_end(const TraceStep& step, const std::function<bool(const Vec2d&)>& accept) const;

  /// Adds what turns to the judgement of the rest.
  /// @param rest the scenery of `exact_part`.
  /// @param parts of the step: what was requested is what the first of them wants.
  void judge(const TraceStep& step, const ExactScenery& rest, int parts, StepJudgement& judgement);

 private:
  using Numbers = std::vector<std::size_t>;  ///< Of the vertices of a part.
  struct Solid {
    ColliderIndex collider = 0;
    std::vector<Numbers> parts;
    double radius = 0;  ///< Of a disc.
  };

  /// The first touch of all parts on a way.
  [[nodiscard]] Meeting meeting(const Solid& solid, const VertexWay& way, std::span<const PathPoint> path,
                                Asked asked = Asked::whether) const;
  /// Where a part stands at an instant, and how it goes in the step.
  struct Standing {
    ConvexPart part;
    Vec2d moved{Vec2d::Zero()};  ///< See `near`.
    double unsure = 0;
    double unsure_along = 0;
    double turn = 0;       ///< Of a disc: see `VertexWay::turn`.
    double requested = 0;  ///< [m]
  };
  [[nodiscard]] Standing standing(const Solid& solid, const Numbers& numbers, const VertexWay& way,
                                  const Vec2d& requested, const PathPoint& corner, double within) const;
  [[nodiscard]] std::optional<NearPart> near_part(const Solid& solid, const Standing& standing, const Vec2d& position,
                                                  double within) const;
  /// Adds the parts of a solid that are near. @param way that it goes in the last share of the step, or in all of it.
  void add_near(const Solid& solid, const VertexWay& way, const TraceStep& step, const PathPoint& corner, double within,
                double share, std::vector<NearPart>& found) const;
  /// @param across up, as long as the motion goes that way [m].
  [[nodiscard]] bool is_against(const Solid& solid, const VertexWay& way, const PathPoint& at, const Vec2d& across,
                                double within) const;
  [[nodiscard]] bool methods_agree(const Solid& solid, const TraceStep& step) const;
  [[nodiscard]] bool overlaps(const Solid& solid, const VertexWay& way, const PathPoint& at) const;
  /// @param vertices all of the solid, at one instant.
  [[nodiscard]] static ConvexPart part_at(const Solid& solid, const Numbers& numbers, std::span<const Vec2d> vertices);
  [[nodiscard]] Vec2d nearest_face(const Solid& solid, const TraceStep& step, const Vec2d& normal) const;
  [[nodiscard]] Axis nearest_axis(const Solid& solid, const VertexWay& way, const PathPoint& at) const;
  /// Over the corners of the way [m].
  [[nodiscard]] double nearest(const Solid& solid, const TraceStep& step) const;
  [[nodiscard]] bool is_said_as_crush(const Solid& solid, const TraceStep& step, const ExactScenery& rest,
                                      StepJudgement& judgement) const;
  void note_side(const Solid& solid, const TraceStep& step);
  void judge_way(const Solid& solid, const TraceStep& step, const ExactScenery& rest, StepJudgement& judgement);
  void judge_passage(const Solid& solid, const TraceStep& step, StepJudgement& judgement) const;
  [[nodiscard]] double depth_on(const Solid& solid, const TraceStep& step) const;
  void judge_contacts(const Solid& solid, const TraceStep& step, int parts, StepJudgement& judgement) const;
  [[nodiscard]] std::optional<double> touch_going_on(const Solid& solid, const TraceStep& step, double moment) const;

  const TraceHeader& header_;
  std::vector<Vec2d> octagon_;  ///< Counter-clockwise.
  std::vector<Solid> solids_;
  std::vector<Solid> sensors_;
  bool promises_ = false;            ///< See `Party::promising`.
  std::set<ColliderIndex> touched_;  ///< In the last step, as reported.
  std::set<ColliderIndex> pressed_;  ///< Overlapped since a crush that was excused.
  /// Of each solid that is overlapped, where it was last free of it, taken along since; none where the run began
  /// inside.
  Sides sides_;
  std::vector<ColliderIndex> inside_;           ///< What is overlapped when the present step begins.
  std::map<ColliderIndex, Vec2d> went_;         ///< How far what turns carries in the present step [m],
  std::map<ColliderIndex, Vec2d> went_before_;  ///< and in the one before.
};

}  // namespace paperproof::compare::detail
