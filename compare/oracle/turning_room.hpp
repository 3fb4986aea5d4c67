/// Whether the octagon had room where something that turns is said to have crushed it; and how that goes.
#pragma once

#include "oracle/exact.hpp"
#include "records/trace.hpp"

#include <complex>
#include <functional>
#include <map>
#include <span>

namespace paperproof::compare::detail {

/// Takes vertices from where they are before to where they are after, and every other point along.
class RigidMotion {
 public:
  RigidMotion(std::span<const Vec2d> before, std::span<const Vec2d> after);
  [[nodiscard]] Vec2d operator()(const Vec2d& at) const;
  /// Counter-clockwise, in (-pi, pi] [rad].
  [[nodiscard]] double angle() const { return std::arg(turn_); }

 private:
  [[nodiscard]] static std::complex<double> number(const Vec2d& v) { return {v.x(), v.y()}; }
  Vec2d from_;
  Vec2d to_;
  std::complex<double> turn_{1};
};

/// @throws std::invalid_argument where the step has none.
[[nodiscard]] const VertexWay& way_of(const TraceStep& step, ColliderIndex collider);
/// Where the vertices are at a fraction of the step, rounded [m].
[[nodiscard]] std::vector<Vec2d> vertices_at(const VertexWay& way, double fraction);
/// A collider that turns, standing where it is at a fraction of the step.
[[nodiscard]] ColliderDef standing_at(ColliderDef def, const VertexWay& way, double fraction);
/// The scenery in which what turns stands where it is at a fraction of the step; the rest goes as it does.
[[nodiscard]] SceneryDef standing_at(const SceneryDef& scenery, const TraceStep& step, double fraction);
/// The longest way of a vertex in the step [m]. A turn at once and what follows are one stretch of it.
[[nodiscard]] double largest_motion(const VertexWay& way);
/// Whether any vertex does not stay where it is.
[[nodiscard]] bool goes(const VertexWay& way);

/// Of what turns and is overlapped: where the octagon was when it was last free of it, taken along with it since.
using Sides = std::map<ColliderIndex, Vec2d>;

/// A free position at the end of the step, or none: see `Judge` for what counts as room.
/// @param rest the solids that do not turn. @param sides of what was overlapped when the step began, as things are when
///   it ends: room is on the same side.
/// @param left_free whether a way of the whole step leaves free what turns.
[[nodiscard]] std::optional<Vec2d> room_beside(const TraceHeader& header, const ExactScenery& rest,
                                               const TraceStep& step, const VertexWay& crusher, const Sides& sides,
                                               const std::function<bool(std::span<const PathPoint>)>& left_free);

/// A way out of what the octagon is inside of is looked for this far [m].
inline constexpr double farthest_way_out = 1e4;

/// Whether the shortest straight way out of what is overlapped where the step begins ends on the right side of it, as
/// things are then, and as they are when they have turned for the first time.
/// @param sides as things are when the step begins. @param accept whether it ends on the right side of the rest.
[[nodiscard]] bool has_way_out(const TraceHeader& header, const TraceStep& step, const Sides& sides,
                               const std::function<bool(const Vec2d&)>& accept);
/// The same at one fraction of the step. @param sides as things are then.
[[nodiscard]] bool has_way_out_at(const TraceHeader& header, const TraceStep& step, double moment, const Sides& sides,
                                  const std::function<bool(const Vec2d&)>& accept);

}  // namespace paperproof::compare::detail
