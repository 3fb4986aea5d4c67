/// One step among solids, as those that judge it see it.
#pragma once

#include "oracle/exact.hpp"
#include "oracle/up.hpp"
#include "records/trace.hpp"

#include <algorithm>
#include <functional>

namespace paperproof::compare {

/// What turns near a character: the exact scenery does not have it. It answers what is near, and where there is room.
/// All empty where nothing turns near by, but for `left_free`, which is empty where nothing turns at all.
struct WhatTurns {
  /// The parts within so many metres of a corner of the way, at that moment.
  std::function<std::vector<NearPart>(const PathPoint& corner, double within)> near{};
  /// The same where the step ends, `moved` as what turns goes then.
  std::function<std::vector<NearPart>(double within)> near_at_end{};
  /// What a displacement from where the step ends meets first, while all stays as it is then.
  std::function<std::vector<ExactImpact>(const Vec2d& displacement)> impacts_at_end{};
  /// Whether something that is farther away than `within` at a corner of the way is met in the rest of the step, if the
  /// character goes on by so much.
  std::function<bool(const PathPoint& corner, const Vec2d& way, double within)> runs_into{};
  /// Whether it leaves free a way of the whole step, from fraction 0 to 1, and the place where it ends.
  std::function<bool(std::span<const PathPoint> way)> left_free{};
  double longest_way = 0;  ///< That a point of it goes in the step [m].
};

}  // namespace paperproof::compare

namespace paperproof::compare::detail {

inline const WhatTurns nothing_turns{};

/// What it refers to must outlive it.
struct StepView {
  const TraceHeader& header;
  const ExactScenery& scenery;
  const TraceStep& step;
  const WhatTurns& turns = nothing_turns;
  Vec2d up = up_in(step, header);       ///< Of the character in this step, a unit vector,
  Vec2d right = right_of(up);           ///< and across it.
  double dt = length_of(step, header);  ///< [s]

  [[nodiscard]] Place place(std::size_t corner) const { return {step.path[corner], step.movers}; }
  [[nodiscard]] Place end() const { return {step.path.back(), step.movers}; }
  [[nodiscard]] const ColliderDef& solid(ColliderIndex collider) const { return scenery.scenery().colliders[collider]; }
  /// How far the mover of a collider goes [m].
  [[nodiscard]] Vec2d moved(ColliderIndex collider) const {
    const MoverIndex mover = solid(collider).mover;
    return mover == no_mover ? Vec2d(Vec2d::Zero()) : Vec2d(step.movers[mover].to - step.movers[mover].from);
  }
  /// What was requested without what this step's steering added [m].
  [[nodiscard]] Vec2d unsteered() const { return step.requested - step.steered * right; }
  /// The parts, of what turns as well, within so many metres of a corner of the way.
  [[nodiscard]] std::vector<NearPart> near(std::size_t corner, double within) const {
    std::vector<NearPart> parts = scenery.near_parts(place(corner), within);
    if (turns.near) std::ranges::move(turns.near(step.path[corner], within), std::back_inserter(parts));
    return parts;
  }
};

/// Whether any face of the parts is so. @param is_so asked of a part and a face of it.
template <class Question>
[[nodiscard]] bool any_face(std::span<const NearPart> parts, const Question& is_so) {
  return std::ranges::any_of(parts, [&](const NearPart& part) {
    return std::ranges::any_of(part.faces, [&](const NearFace& face) { return is_so(part, face); });
  });
}

}  // namespace paperproof::compare::detail
