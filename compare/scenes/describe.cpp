#include "scenes/describe.hpp"

#include <fmt/format.h>

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
  for (const ColliderDef& collider : scenery.colliders) {
    if (collider.shape == ColliderDef::Shape::polygon) {
      ++polygons;
      holes += collider.holes.size();
    } else {
      ++(collider.one_way ? one_way : chains);
    }
  }
  return fmt::format("{} polygons ({} holes), {} two-sided chains, {} one-way chains", polygons, holes, chains,
                     one_way);
}

}  // namespace

std::string describe(const Scene& scene) {
  const Scenery<double> built(scene.scenery);
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
  if (scene.respawn_box) line("map", box(*scene.respawn_box));
  for (const std::string& note : scene.notes) line("note", note);
  return out;
}

}  // namespace paperproof::compare
