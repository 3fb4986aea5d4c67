/// Headers and steps of traces for tests of the judge that are no tables (../judge).
#pragma once

#include "compare/exact_shapes.hpp"
#include "oracle/judge.hpp"

namespace paperproof::compare::test {

inline constexpr double dt = 1.0 / 64;
inline constexpr double gap = 5e-7;  ///< Where a motion is stopped [m].

inline void add(TraceHeader& header, const ColliderDef& solid) {
  header.ids.push_back(std::to_string(header.ids.size()));
  header.scenery.colliders.push_back(solid);
}

inline TraceHeader header(const std::vector<ColliderDef>& colliders, bool path_exact = true) {
  TraceHeader header;
  header.dt = dt;
  header.points = octagon();
  for (const ColliderDef& collider : colliders) add(header, collider);
  header.path_exact = path_exact;
  return header;
}

/// Of who is excused nothing.
inline TraceHeader promising(const std::vector<ColliderDef>& colliders) {
  TraceHeader promising = header(colliders);
  promising.contender = "octagon_sweep";
  promising.scalar = "double";
  return promising;
}

/// @param requested as far as the path leads, if it is not said.
inline TraceStep step(const std::vector<Vec2d>& path, const std::optional<Vec2d>& requested = {},
                      std::vector<Contact> contacts = {}) {
  TraceStep step;
  for (std::size_t i = 0; i < path.size(); ++i)
    step.path.push_back(
        {path[i], static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(path.size() - 1, 1))});
  step.velocity = (path.back() - path.front()) / dt;
  step.requested = requested.value_or(path.back() - path.front());
  step.contacts = std::move(contacts);
  return step;
}

inline TraceStep among(TraceStep step, Motions movers) {
  step.movers = std::move(movers);
  return step;
}

/// On the side that its normal says.
inline Contact contact(ColliderIndex collider, const Vec2d& normal, double fraction = 0) {
  const Side side = side_of_normal(normal.x(), normal.y());
  return {.collider = collider, .normal = normal, .fraction = fraction, .side = side};
}

/// That a motion was wanted, by its velocity.
inline Wanted wanting(const Vec2d& displacement) {
  return {.displacement = displacement, .velocity = displacement / dt};
}

inline StepJudgement judged(const TraceHeader& header, const TraceStep& step) { return Judge(header).judge(step); }
inline StepJudgement judged(const TraceHeader& header, const TraceStep& step, const Wanted& wanted) {
  return Judge(header).judge(step, &wanted);
}

}  // namespace paperproof::compare::test
