#include "scenes/describe.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/step_times.hpp"
#include "scenes/validate.hpp"
#include "words.hpp"

namespace paperproof::compare {

namespace {

std::string point(const Vec2d& p) { return fmt::format("({}, {})", p.x(), p.y()); }

std::string box(const Box2& b) { return fmt::format("{} to {} m", point(b.lower), point(b.upper)); }

std::string lengths(const Scene& scene) {
  const StepTimes times(scene);
  if (!times.vary()) return fmt::format("{} s", scene.dt);
  return fmt::format("{} to {} s ({}, again and again)", times.shortest(), times.longest(),
                     counted(scene.dt_list.size(), "length"));
}

std::string colliders(const SceneryDef& scenery) {
  const auto many = [&scenery](const auto& is_so) {
    return static_cast<std::size_t>(std::count_if(scenery.colliders.begin(), scenery.colliders.end(), is_so));
  };
  const auto of = [&many](ColliderDef::Shape shape, bool one_way) {
    return many([&](const ColliderDef& def) { return def.shape == shape && def.one_way.has_value() == one_way; });
  };
  std::size_t holes = 0;
  for (const ColliderDef& collider : scenery.colliders) holes += collider.holes.size();
  const std::size_t one_way_polygons = of(ColliderDef::Shape::polygon, true);
  const std::size_t polygons = of(ColliderDef::Shape::polygon, false) + one_way_polygons;
  const std::size_t chains = of(ColliderDef::Shape::chain, false);
  const std::size_t one_way = of(ColliderDef::Shape::chain, true);
  const std::size_t circles = of(ColliderDef::Shape::circle, false);
  const std::size_t moving = many([](const ColliderDef& def) { return def.mover != no_mover; });
  const std::size_t sensors = many([](const ColliderDef& def) { return def.sensor; });
  std::string out = fmt::format("{} ({}), {}, {}", counted(polygons, "polygon"), counted(holes, "hole"),
                                counted(chains, "two-sided chain"), counted(one_way, "one-way chain"));
  if (circles > 0) out += fmt::format(", {}", counted(circles, "circle"));
  if (one_way_polygons > 0) out += fmt::format("; one-way polygons: {}", one_way_polygons);
  if (moving > 0) out += fmt::format("; moving: {}", moving);
  if (sensors > 0) out += fmt::format("; sensors: {}", sensors);
  return out;
}

std::string mover(const Scene& scene, MoverIndex index) {
  const MoverDef& def = scene.movers[index];
  const std::vector<ColliderDef>& all = scene.scenery.colliders;
  const auto colliders = std::count_if(all.begin(), all.end(), [index](const auto& c) { return c.mover == index; });
  if (def.body) return fmt::format("{}: {}, a body of {} kg", def.id, counted(colliders, "collider"), def.body->mass);
  std::string out = fmt::format("{}: {}, {} in {} s", def.id, counted(colliders, "collider"),
                                counted(def.path.size(), "waypoint"), def.path.back().time - def.path.front().time);
  if (!def.turns.empty()) out += ", " + counted(def.turns.size(), "angle");
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

std::string joint(const Scene& scene, const Joint& def) {
  const std::string other = def.other == no_mover ? "the ground" : scene.movers[def.other].id;
  const std::string ends = fmt::format("{}: {} to {}", def.id, scene.movers[def.body].id, other);
  switch (def.kind) {
    case Joint::Kind::distance:
      if (def.stiffness == 0) return fmt::format("{}, a rod of {} m", ends, def.length);
      return fmt::format("{}, a spring of {} m, {} N/m, {} N s/m", ends, def.length, def.stiffness, def.damping);
    case Joint::Kind::revolute:
      return fmt::format("{}, a pin at {}: bodies do not turn, so it holds them in place", ends, point(def.point));
    case Joint::Kind::prismatic:
      return fmt::format("{}, a rail along {}", ends, point(def.axis));
  }
  return ends;
}

/// One-way chains with segments that run along `one_way`, which have no side to block from.
std::vector<std::string> idle_segments(const Scene& scene, const Scenery& built) {
  std::vector<std::size_t> blocking(scene.ids.size(), 0);
  for (const PieceInfo& piece : built.pieces()) ++blocking[piece.collider];
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < scene.ids.size(); ++i) {
    const ColliderDef& collider = scene.scenery.colliders[i];
    if (!collider.one_way || collider.shape == ColliderDef::Shape::polygon) continue;
    if (blocking[i] + 1 == collider.points.size()) continue;
    const std::size_t idle = collider.points.size() - 1 - blocking[i];
    notes.push_back(
        fmt::format("\"{}\": {} along its one_way, where nothing is blocked", scene.ids[i], counted(idle, "segment")));
  }
  return notes;
}

}  // namespace

std::string describe(const Scene& scene) {
  const Scenery built(scenery_at(scene, 0));
  std::string out = scene.name + "\n";
  const auto line = [&](std::string_view what, const std::string& text) {
    out += fmt::format("  {:<10} {}\n", what, text);
  };
  if (!scene.description.empty()) line("about", scene.description);
  line("colliders", fmt::format("{}: {}", scene.scenery.colliders.size(), colliders(scene.scenery)));
  line("pieces", fmt::format("{} convex", built.pieces().size()));
  if (!built.boxes().empty()) {
    Box2 bounds = built.boxes().front();
    for (const Box2& piece : built.boxes()) bounds = bounds.merged(piece);
    line("bounds", box(bounds));
  }
  line("start", fmt::format("{} m, {} m/s{}", point(scene.start.position), point(scene.start.velocity),
                            scene.start.resolve_overlap ? ", an overlap is resolved" : ""));
  line("character", fmt::format("{} points, {} x {} m", scene.character.shape.points().size(),
                                scene.character.shape.box().upper.x() - scene.character.shape.box().lower.x(),
                                scene.character.shape.box().upper.y() - scene.character.shape.box().lower.y()));
  if (!scene.others.empty()) line("characters", fmt::format("{} of that kind", character_count(scene)));
  for (std::size_t k = 1; k < character_count(scene); ++k)
    line("", fmt::format("{}: {} m, {} m/s, {}", k, point(start_of(scene, k).position),
                         point(start_of(scene, k).velocity), counted(scene.others[k - 1].input.size(), "input event")));
  line("run",
       fmt::format("{} of {}, gravity {} m/s²", counted(scene.steps, "step"), lengths(scene), point(scene.gravity)));
  line("input", scene.moves_at_random ? fmt::format("random:{}, as a map has no script", *scene.moves_at_random)
                                      : counted(scene.input.size(), "event"));
  line("movers", std::to_string(scene.movers.size()));
  for (MoverIndex i = 0; i < scene.movers.size(); ++i) line("", mover(scene, i));
  if (!scene.joints.empty()) line("joints", std::to_string(scene.joints.size()));
  for (const Joint& each : scene.joints) line("", joint(scene, each));
  if (const PixelTileSet* tiles = scene.tiles.get()) {
    // The first of the types is no tile.
    line("tiles", fmt::format("{} of {} x {} px, {} x {} in the map", counted(tiles->types.size() - 1, "type"),
                              tiles->pixels_per_tile, tiles->pixels_per_tile, tiles->columns,
                              tiles->map.size() / static_cast<std::size_t>(tiles->columns)));
  }
  if (!scene.decoration.empty()) line("decoration", counted(scene.decoration.size(), "polygon"));
  if (!scene.sprite.empty())
    line("sprite", fmt::format("{} x {} px", scene.sprite.front().size(), scene.sprite.size()));
  if (scene.respawn_box) line("map", box(*scene.respawn_box));
  for (const std::string& note : scene.notes) line("note", note);
  for (const std::string& note : idle_segments(scene, built)) line("note", note);
  return out;
}

}  // namespace paperproof::compare
