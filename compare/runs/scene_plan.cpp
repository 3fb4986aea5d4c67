#include "runs/scene_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paperproof::compare {

Foreseen foreseen_in(const Scene& scene, const Script& script) {
  const auto jumps = [](const std::vector<InputEvent>& events) {
    return std::any_of(events.begin(), events.end(), [](const InputEvent& event) { return event.jump == true; });
  };
  const auto pulls = [](double gravity) { return gravity != 0 || std::signbit(gravity); };
  return {.gravity = pulls(scene.gravity.x()) || pulls(scene.gravity.y()),
          .jump = std::any_of(script.begin(), script.end(), jumps),
          .company = !scene.others.empty()};
}

template <class Scalar>
Plan plan_of(const Scenery<Scalar>& scenery, const Planning& planning) {
  if (!planning.full) return make_plan(scenery, planning.foreseen);
  Plan full;
  full.broad_phase_reason = "as asked for: nothing is left out";
  return full;
}

template Plan plan_of(const Scenery<float>&, const Planning&);
template Plan plan_of(const Scenery<double>&, const Planning&);

MetricPlan metrics_for(const Scene& scene, const Planning& planning) {
  MetricPlan plan;
  plan.measured.gravity = scene.gravity;
  if (planning.full) return plan;
  const std::vector<ColliderDef>& colliders = scene.scenery.colliders;
  const auto any = [&colliders](auto&& test) { return std::any_of(colliders.begin(), colliders.end(), test); };
  const auto leave_out = [&plan](bool needed, bool Measured::*member, const char* metric, const char* reason) {
    if (member != nullptr) plan.measured.*member = needed;
    if (!needed) plan.omitted.push_back({metric, reason});
  };
  leave_out(planning.foreseen.gravity, &Measured::rest, "rest jitter",
            "without gravity nothing presses the character onto anything, so nothing rests");
  leave_out(any([](const ColliderDef& def) { return def.one_way.has_value(); }), nullptr, "one-way violations",
            "there is no one-way chain");
  leave_out(scene.respawn_box.has_value(), &Measured::respawns, "respawns", "there is no map that could be left");
  leave_out(any([](const ColliderDef& def) { return def.mover != no_mover; }), nullptr, "crushes",
            "nothing moves that could leave no room");
  leave_out(any([](const ColliderDef& def) { return def.sensor; }), nullptr, "sensor events", "there is no sensor");
  return plan;
}

std::string describe_plan(const Scene& scene, const Script& script) {
  const Planning planning{.foreseen = foreseen_in(scene, script)};
  const Plan plan = plan_of(Scenery<double>(scene.scenery), planning);
  std::string out = scene.name + "\n";
  out += fmt::format("  broad phase  {}: {}\n", name_of(plan.broad_phase), plan.broad_phase_reason);
  for (const Omission& omission : plan.omitted)
    out += fmt::format("  without      {}: {}\n", name_of(omission.stage), omission.reason);
  if (plan.omitted.empty()) out += "  without      nothing: the scene can need every stage\n";
  for (const MetricOmission& omission : metrics_for(scene, planning).omitted)
    out += fmt::format("  not measured {}: {}\n", omission.metric, omission.reason);
  return out;
}

}  // namespace paperproof::compare
