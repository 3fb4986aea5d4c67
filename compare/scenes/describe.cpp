#include "scenes/describe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/validate.hpp"

namespace paperproof::compare {

namespace {

std::string point(const Vec2d& p) { return fmt::format("({}, {})", p.x(), p.y()); }

std::string box(const Box2<double>& b) { return fmt::format("{} to {} m", point(b.lower), point(b.upper)); }

std::string colliders(const SceneryDef& scenery) {
  std::size_t polygons = 0;
  std::size_t holes = 0;
  std::size_t chains = 0;
  std::size_t one_way = 0;
  std::size_t moving = 0;
  std::size_t sensors = 0;
  for (const ColliderDef& collider : scenery.colliders) {
    if (collider.mover != no_mover) ++moving;
    if (collider.sensor) ++sensors;
    if (collider.shape == ColliderDef::Shape::polygon) {
      ++polygons;
      holes += collider.holes.size();
    } else {
      ++(collider.one_way ? one_way : chains);
    }
  }
  std::string out =
      fmt::format("{} polygons ({} holes), {} two-sided chains, {} one-way chains", polygons, holes, chains, one_way);
  if (moving > 0) out += fmt::format("; {} of them move", moving);
  if (sensors > 0) out += fmt::format("; {} of them are sensors", sensors);
  return out;
}

std::string mover(const Scene& scene, MoverIndex index) {
  const MoverDef& def = scene.movers[index];
  const std::vector<ColliderDef>& all = scene.scenery.colliders;
  const auto colliders = std::count_if(all.begin(), all.end(), [index](const auto& c) { return c.mover == index; });
  std::string out = fmt::format("{}: {} colliders, {} waypoints in {} s", def.id, colliders, def.path.size(),
                                def.path.back().time - def.path.front().time);
  if (!def.turns.empty()) out += fmt::format(", {} angles", def.turns.size());
  switch (def.loop) {
    case MoverDef::Loop::once:
      return out + ", once";
    case MoverDef::Loop::loop:
      return out + ", again and again";
    case MoverDef::Loop::ping_pong:
      return out + ", to and fro";
  }
  return out;
}

}  // namespace

std::string describe(const Scene& scene) {
  const Scenery<double> built(scenery_at(scene, 0));
  std::string out = scene.name + "\n";
  const auto line = [&](std::string_view what, const std::string& text) {
    out += fmt::format("  {:<10} {}\n", what, text);
  };
  if (!scene.description.empty()) line("about", scene.description);
  line("colliders", fmt::format("{}: {}", scene.scenery.colliders.size(), colliders(scene.scenery)));
  line("pieces", fmt::format("{} convex", built.pieces().size()));
  if (!built.boxes().empty()) {
    Box2<double> bounds = built.boxes().front();
    for (const Box2<double>& piece : built.boxes()) bounds = bounds.merged(piece);
    line("bounds", box(bounds));
  }
  line("start", fmt::format("{} m, {} m/s{}", point(scene.start.position), point(scene.start.velocity),
                            scene.start.resolve_overlap ? ", an overlap is resolved" : ""));
  line("character", fmt::format("{} points, {} x {} m", scene.character.shape.points().size(),
                                scene.character.shape.box().upper.x() - scene.character.shape.box().lower.x(),
                                scene.character.shape.box().upper.y() - scene.character.shape.box().lower.y()));
  line("run", fmt::format("{} steps of {} s, gravity {} m/s²", scene.steps, scene.dt, point(scene.gravity)));
  line("input", fmt::format("{} events", scene.input.size()));
  line("movers", std::to_string(scene.movers.size()));
  for (MoverIndex i = 0; i < scene.movers.size(); ++i) line("", mover(scene, i));
  if (scene.respawn_box) line("map", box(*scene.respawn_box));
  for (const std::string& note : scene.notes) line("note", note);
  return out;
}

}  // namespace paperproof::compare
