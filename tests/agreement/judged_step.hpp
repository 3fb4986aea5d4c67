/// A character whose steps are judged one by one.
#pragma once

#include "agreement/recorded.hpp"
#include "campaign/shapes.hpp"
#include "oracle/judge.hpp"

#include <paperproof/controller.hpp>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace paperproof::test {

using compare::box;
using compare::half_height;
using compare::half_width;

/// No step enters or passes what is not named, or names what had left room or came no closer.
inline bool holds(const compare::StepJudgement& judged) {
  return judged.entered.empty() && judged.tunnelled.empty() && judged.corner_cut.empty() &&
         judged.one_way_broken.empty() && judged.crushed_with_room.empty();
}

/// Contacts that were reported, and that neither the requested motion has nor what an exact contact leaves of it. In
/// the band where the guarantee lets a contact be held or not a face must be there.
inline int unfounded(const compare::StepJudgement& judged, const MoveResult<double>& move) {
  return static_cast<int>(
      std::count_if(move.contacts.begin(), move.contacts.end(), [&judged](const Contact<double>& named) {
        const std::pair touch(named.collider, named.side);
        const auto has = [](const auto& range, const auto& value) {
          return std::find(range.begin(), range.end(), value) != range.end();
        };
        const bool is_exact = std::any_of(
            judged.contacts.begin(), judged.contacts.end(),
            [&touch](const compare::ExactContact& exact) { return std::pair(exact.collider, exact.side) == touch; });
        if (is_exact || has(judged.deflected, touch)) return false;
        return !has(judged.contact_band, named.collider) || has(judged.ghosts, touch);
      }));
}

struct Judged {
  Scenery<double> scenery;
  Controller<double> controller;
  Scratch<double> scratch = controller.make_scratch();
  compare::Judge judge;
  CharacterState<double> state;
  StepReport<double> report;
  std::vector<MoverMotion<double>> motions;  ///< Of the next step.
  Vec2d gravity{0, 0};
  double dt;
  bool looks_for_room = true;  ///< The judge does, among all that crush: for minutes, where they are many.

  Judged(const std::vector<ColliderDef>& colliders, const Vec2d& position, double length_of_step,
         const CharacterDef& character = {})
      : scenery(SceneryDef{colliders}),
        controller(scenery, character),
        judge(header(length_of_step)),
        motions(scenery.mover_count()),
        dt(length_of_step) {
    state.position = position;
  }
  /// Every mover goes on by so far.
  compare::StepJudgement step_by(const Vec2d& by, const Input& input = {}) {
    for (MoverMotion<double>& motion : motions) motion = {motion.to, motion.to + by};
    return step(input);
  }
  compare::StepJudgement step(const Input& input = {}) {
    controller.step(state, input, {gravity, dt, motions}, scratch, report);
    if (!looks_for_room) return {};
    return judge.judge(recorded(report, state, motions));
  }
  [[nodiscard]] std::set<ColliderIndex> crushed() const {
    return {report.move.crushed.begin(), report.move.crushed.end()};
  }
  /// All that exact arithmetic finds on the way.
  [[nodiscard]] std::set<ColliderIndex> gone_through() const {
    std::set<ColliderIndex> all;
    const auto& path = report.move.path;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      for (const ColliderIndex collider : judge.scenery().met({path[i].position, motions, path[i].fraction},
                                                              {path[i + 1].position, motions, path[i + 1].fraction}))
        all.insert(collider);
    return all;
  }

  /// Where the step ends [m].
  [[nodiscard]] double gap_to(ColliderIndex collider) const {
    return judge.scenery().separation({state.position, motions, 1}, collider);
  }
  /// What it overlaps where the step ends.
  [[nodiscard]] std::set<ColliderIndex> on_it() const {
    const std::vector<ColliderIndex> all = judge.scenery().overlapped({state.position, motions, 1});
    return {all.begin(), all.end()};
  }

 private:
  [[nodiscard]] compare::TraceHeader header(double length_of_step) const {
    compare::TraceHeader header;
    header.contender = "octagon_sweep";
    header.scalar = "double";
    header.points.assign(controller.character().shape.hull().begin(), controller.character().shape.hull().end());
    header.scenery = scenery.as_run();
    header.dt = length_of_step;
    return header;
  }
};

}  // namespace paperproof::test
