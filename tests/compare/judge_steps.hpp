/// Headers and steps of traces for the tests of the judge.
#pragma once

#include "compare/exact_shapes.hpp"
#include "oracle/judge.hpp"

namespace paperproof::compare::test {

inline constexpr double dt = 1.0 / 64;

inline TraceHeader header(std::vector<ColliderDef> colliders, bool path_exact = true) {
  TraceHeader header;
  header.dt = dt;
  header.points = octagon();
  for (std::size_t i = 0; i < colliders.size(); ++i) header.ids.push_back(std::to_string(i));
  header.scenery.colliders = std::move(colliders);
  header.path_exact = path_exact;
  return header;
}

/// Of who is excused nothing.
inline TraceHeader promising(std::vector<ColliderDef> colliders) {
  TraceHeader promising = header(std::move(colliders));
  promising.contender = "octagon_sweep";
  promising.scalar = "double";
  return promising;
}

inline TraceStep step(const std::vector<Vec2d>& path) {
  TraceStep step;
  for (std::size_t i = 0; i < path.size(); ++i) {
    step.path.push_back(
        {path[i], static_cast<double>(i) / static_cast<double>(std::max<std::size_t>(path.size() - 1, 1))});
  }
  step.requested = path.back() - path.front();
  step.velocity = step.requested / dt;
  return step;
}

}  // namespace paperproof::compare::test
