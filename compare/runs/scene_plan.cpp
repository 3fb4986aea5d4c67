#include "runs/scene_plan.hpp"

#include "runs/contender.hpp"
#include "runs/cost.hpp"
#include "words.hpp"

#include <paperproof/scenery.hpp>

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace paperproof::compare {
namespace {

bool has_slopes(const Scenery& scenery) {
  for (PieceIndex piece = 0; piece < scenery.pieces().size(); ++piece) {
    if (scenery.pieces()[piece].sensor) continue;
    if (scenery.pieces()[piece].is_circle()) return true;
    if (scenery.pieces()[piece].is_rectangle()) continue;
    const auto vertices = scenery.vertices_of(piece);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec2d edge = vertices[(i + 1) % vertices.size()] - vertices[i];
      if (edge.x() != 0 && edge.y() != 0) return true;
    }
  }
  return false;
}

/// Of what the allocator gave away [bytes].
std::size_t memory_in_use() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

/// The technique of the controller, planned one way, and the memory that it takes.
struct Planned {
  std::size_t bytes = 0;
  std::unique_ptr<Contender> contender;
};

Planned make_planned(bool full, const Scene& scene, const Scenery& scenery) {
  const std::size_t before = memory_in_use();
  auto made = make_contender("octagon_sweep", ScalarKind::binary64, scene, scenery, {.full = full});
  return {memory_in_use() - before, std::move(made)};
}

}  // namespace

LevelPlan plan_of(const Scenery& scenery, const Planning& planning) {
  LevelPlan plan;
  if (planning.full) {
    plan.search = PieceSearch::none;
    return plan;
  }
  const auto leave_out = [&plan](bool needed, std::string_view stage, std::string_view reason) {
    if (!needed) plan.omitted.push_back({stage, reason});
  };
  leave_out(scenery.counts().filtered > 0, "filters",
            "no collider has a filter, so no piece is asked whether it is there");
  leave_out(has_slopes(scenery), "slopes",
            "every edge is level or upright, so no piece has axes of its own: none is built, stored or tested");
  leave_out(scenery.mover_count() > 0 || scenery.counts().conveyors > 0, "movers",
            "nothing moves and there is no conveyor, so no mover is looked up and nothing carries the character");
  leave_out(scenery.counts().one_way > 0, "one_way",
            "there is no one-way chain, so no surface is built and none is asked for its side");
  leave_out(scenery.counts().sensors > 0, "sensors", "there is no sensor, so no path is searched for one");
  return plan;
}

MetricPlan metrics_for(const Scene& scene, const Planning& planning) {
  MetricPlan plan;
  plan.measured.gravity = scene.gravity;
  if (planning.full) return plan;
  const std::vector<ColliderDef>& colliders = scene.scenery.colliders;
  const auto any = [&colliders](auto&& test) { return std::ranges::any_of(colliders, test); };
  const auto leave_out = [&plan](bool needed, bool Measured::*member, std::string_view metric,
                                 std::string_view reason) {
    if (member != nullptr) plan.measured.*member = needed;
    if (!needed) plan.omitted.push_back({metric, reason});
  };
  // Minus zero pulls, too: it gives other bits.
  const auto pulls = [](double gravity) { return gravity != 0 || std::signbit(gravity); };
  leave_out(pulls(scene.gravity.x()) || pulls(scene.gravity.y()), &Measured::rest, "rest jitter",
            "without gravity nothing presses the character onto anything, so nothing rests");
  leave_out(any([](const ColliderDef& def) { return def.one_way.has_value(); }), nullptr, "one-way violations",
            "there is no one-way chain");
  leave_out(scene.respawn_box.has_value(), &Measured::respawns, "respawns", "there is no map that could be left");
  leave_out(any([](const ColliderDef& def) { return def.mover != no_mover; }), nullptr, "crushes",
            "nothing moves that could leave no room");
  leave_out(any([](const ColliderDef& def) { return def.sensor; }), nullptr, "sensor events", "there is no sensor");
  return plan;
}

std::string describe_plan(const Scene& scene, const Scenery& scenery) {
  const LevelPlan plan = plan_of(scenery, {});
  std::string out = scene.name + "\n";
  out += fmt::format("  looks at     pieces whose boxes meet the step's, of {}\n",
                     counted(scenery.pieces().size(), "piece"));
  for (const Omission& omission : plan.omitted)
    out += fmt::format("  without      {}: {}\n", omission.stage, omission.reason);
  if (plan.omitted.empty()) out += "  without      nothing: the level has everything\n";
  for (const Omission& omission : metrics_for(scene, {}).omitted)
    out += fmt::format("  not measured {}: {}\n", omission.stage, omission.reason);
  return out;
}

std::string describe_saving(const Scene& scene, const Scenery& scenery, const Script& script) {
  const Planned planned = make_planned(false, scene, scenery);
  const Planned full = make_planned(true, scene, scenery);
  const std::array runs{TimedRun{planned.contender.get(), {}}, TimedRun{full.contender.get(), {}}};
  const std::vector<Costs> costs = measure_costs(runs, scene, script, scene.steps);
  for (std::size_t k = 0; k < character_count(scene); ++k)
    if (planned.contender->pose(k).position != full.contender->pose(k).position)
      throw std::logic_error(scene.name + ": planned and full end at different positions");
  return fmt::format("  takes        {:.0f} ns a step and {} bytes, and with nothing left out {:.0f} ns and {} bytes\n",
                     costs[0].full.ns_per_step_min, planned.bytes, costs[1].full.ns_per_step_min, full.bytes);
}

}  // namespace paperproof::compare
