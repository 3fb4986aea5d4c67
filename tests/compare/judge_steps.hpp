/// Headers and steps of traces for the tests of the judge, and what it says of them.
#pragma once

#include "compare/exact_shapes.hpp"
#include "oracle/judge.hpp"

namespace paperproof::compare::test {

inline constexpr double dt = 1.0 / 64;
inline constexpr double gap = 5e-7;  ///< Where a motion is stopped [m].
inline constexpr double standing = half_height + gap;

using Touches = std::vector<std::pair<ColliderIndex, Side>>;

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

/// What became of all solids: "inside 0 1, entered 1, tunnelled 2".
inline std::string told(const StepJudgement& judged) {
  std::string all;
  for (const auto& [what, colliders] : {std::pair{"inside", &judged.end_overlap},
                                        {"pressed", &judged.pressed},
                                        {"entered", &judged.entered},
                                        {"rounded", &judged.rounded},
                                        {"drawn", &judged.drawn},
                                        {"tunnelled", &judged.tunnelled},
                                        {"clipped", &judged.clipped},
                                        {"one-way broken", &judged.one_way_broken},
                                        {"crushed", &judged.crushed},
                                        {"crushed with room", &judged.crushed_with_room}}) {
    if (colliders->empty()) continue;
    all += (all.empty() ? "" : ", ") + std::string(what);
    for (const ColliderIndex collider : *colliders) all += " " + std::to_string(collider);
  }
  return all;
}

/// The contacts that should have been reported.
inline Touches demanded(const StepJudgement& judged) {
  Touches all;
  for (const ExactContact& contact : judged.contacts) all.emplace_back(contact.collider, contact.side);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace paperproof::compare::test
