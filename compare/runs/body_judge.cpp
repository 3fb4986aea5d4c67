#include "runs/body_judge.hpp"

#include "oracle/convex_parts.hpp"
#include "records/verdict.hpp"
#include "words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace paperproof::compare {

BodyJudge::BodyJudge(const Scene& scene, const TraceHeader& header) : ids_(header.ids), energy_(scene) {
  for (ColliderIndex i = 0; i < header.scenery.colliders.size(); ++i) {
    const ColliderDef& def = header.scenery.colliders[i];
    if (def.mover == no_mover || def.sensor || !scene.movers[def.mover].body) continue;
    for (const detail::ConvexPart& part : detail::convex_parts(def)) {
      TraceHeader own = header;
      own.characters = 1;
      own.points = part.points;
      // Among everything but what goes along with the mover.
      for (ColliderDef& other : own.scenery.colliders) other.sensor = other.sensor || other.mover == def.mover;
      bodies_.push_back({def.mover, header.ids[i], std::make_unique<Judge>(own)});
    }
  }
}

void BodyJudge::add(const TraceStep& step) {
  bool inside = false;
  bool passed = false;
  for (Body& body : bodies_) {
    const MoverMotion& motion = step.movers[body.mover];
    TraceStep own;
    own.step = step.step;
    own.dt = step.dt;
    own.path = {{motion.from, 0}, {motion.to, 1}};
    own.requested = motion.to - motion.from;
    own.movers = step.movers;
    own.vertex_ways = step.vertex_ways;
    const StepJudgement judged = body.judge->judge(own);
    inside = inside || judged.end_overlap.size() > judged.rounded.size();
    deepest_ = std::max(deepest_, judged.max_penetration);
    passed = passed || !judged.tunnelled.empty();
    if (first_tunnel_.empty() && !judged.tunnelled.empty())
      first_tunnel_ = fmt::format("step {}: body `{}` passed `{}`", step.step, body.id, ids_[judged.tunnelled.front()]);
  }
  energy_.add(step);
  steps_inside_ += inside;
  tunnels_ += passed;
}

void BodyJudge::write(Row& row) const {
  row.body_tunnels = tunnels_;
  row.body_steps_inside = steps_inside_;
  row.body_max_penetration_m = deepest_;
  energy_.write(row);
  if (tunnels_ > 0) add_fault(row, Axis::safety, Verdict::tunnels, first_tunnel_);
  if (steps_inside_ > 0)
    add_fault(
        row, Axis::safety, Verdict::flagged,
        fmt::format("bodies end {} inside something, up to {:.3g} m deep", counted(steps_inside_, "step"), deepest_));
}

}  // namespace paperproof::compare
