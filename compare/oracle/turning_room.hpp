/// Whether the octagon had room where something that turns is said to have crushed it; and how that goes.
#pragma once

#include "oracle/exact.hpp"
#include "records/trace.hpp"

#include <functional>

namespace paperproof::compare::detail {

/// @throws std::invalid_argument where the step has none.
[[nodiscard]] const VertexWay& way_of(const TraceStep& step, ColliderIndex collider);
/// Where the vertices are at a fraction of the step, rounded [m].
[[nodiscard]] std::vector<Vec2d> vertices_at(const VertexWay& way, double fraction);
/// Whether any vertex does not stay where it is.
[[nodiscard]] bool goes(const VertexWay& way);

/// A free position at the end of the step, or none: see `Judge` for what counts as room.
/// @param rest the solids that do not turn. @param crusher the way of the one that is said to crush.
/// @param left_free whether a way of the whole step leaves free what turns.
[[nodiscard]] std::optional<Vec2d> room_beside(
    const TraceHeader& header, const ExactScenery& rest, const TraceStep& step, const VertexWay& crusher,
    const std::function<bool(std::span<const PathPoint<double>>)>& left_free);

}  // namespace paperproof::compare::detail
