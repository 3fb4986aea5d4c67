/// Whether the octagon had room where a contender says that it was crushed.
#pragma once

#include "oracle/step_view.hpp"

#include <map>

namespace paperproof::compare::detail {

/// The solids that a step meets on its way.
struct Meetings {
  /// Met first on the leg that begins at this corner.
  std::map<ColliderIndex, std::size_t> within_step;
  /// Overlapped when the step began, with the last place free of it as far as there is one.
  std::map<ColliderIndex, std::optional<Place>> before;
};

/// Half of the narrowest opening that is asked for [m].
inline constexpr double least_clearance = 1e-7;
/// How much farther than what crushes goes a way to a free place may be, and the place still is room [m]: what pushes
/// may push as far. Zero: a press that is not quite level crushes beside free space. Large: it is promised that a
/// character is thrown aside by metres.
inline constexpr double push_beyond_motion = 0.25;

/// A convex shape with every side moved out.
/// @param hull its corners in order. @param by so far [m].
[[nodiscard]] std::vector<Vec2d> grown(std::span<const Vec2d> hull, double by);

/// A free position at the end of the step, or none. `Judge` states what counts as room.
/// @param scenery for the octagon, and @param grown_scenery for one that is grown by `least_clearance`.
/// @param path the way of the step, corner by corner, up to its end.
/// @param crushed the colliders of movers that are said to crush. @param pushed see `pushed_by`.
[[nodiscard]] std::optional<Vec2d> find_room(const ExactScenery& scenery, const ExactScenery& grown_scenery,
                                             std::span<const Place> path, std::span<const ColliderIndex> crushed,
                                             const Meetings& meetings, double pushed, const WhatTurns& turns);

/// How much farther the octagon is from where it began, and was free, than it wanted to go [m].
[[nodiscard]] double pushed_by(const TraceStep& step);

}  // namespace paperproof::compare::detail
