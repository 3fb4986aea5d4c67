#include "scenes/validate.hpp"

#include <fmt/format.h>

#include "oracle/exact.hpp"
#include "oracle/pair.hpp"
#include "scenes/input_error.hpp"

namespace paperproof::compare {

namespace {

void check_company(const Scene& scene, const std::string& where, std::size_t character) {
  if (character == 0) return;  // a third of a short case otherwise
  const ExactPair pair(scene.character.shape.hull());
  for (std::size_t other = 0; other < character; ++other)
    if (pair.overlap(start_of(scene, character).position, start_of(scene, other).position))
      refuse(where, fmt::format("expected a start outside of every other character, but it overlaps character {}, "
                                "which begins at ({}, {})",
                                other, start_of(scene, other).position.x(), start_of(scene, other).position.y()));
}

std::size_t corner_count(const ColliderDef& collider) {
  std::size_t count = collider.points.size();
  for (const std::vector<Vec2d>& hole : collider.holes) count += hole.size();
  return count;
}

}  // namespace

void check_collider_count(std::size_t count, const std::string& where) {
  if (count > most_colliders)
    refuse(where, fmt::format("expected at most {} colliders, as all contenders keep them in memory; split the level",
                              most_colliders));
}

void check_scenery(const SceneryDef& scenery, const std::vector<std::string>& ids, const WhereIs& where) {
  if (!ids.empty()) check_collider_count(ids.size(), where(0));
  for (ColliderIndex i = 0; i < ids.size(); ++i) {
    const std::size_t corners = corner_count(scenery.colliders[i]);
    if (scenery.colliders[i].shape == ColliderDef::Shape::polygon && corners > most_corners)
      refuse(where(i), fmt::format("\"{}\": expected at most {} corners, as cutting a polygon takes time with their "
                                   "square, not {}; split it",
                                   ids[i], most_corners, corners));
  }
  try {
    const Scenery built(scenery);
  } catch (const InvalidScenery& error) {
    refuse(where(error.collider()), fmt::format("\"{}\": {}", ids[error.collider()], error.what()));
  }
}

Box2 box_of(const ColliderDef& collider) { return Box2::around(collider.points).inflated(collider.radius); }

FreePlaces::FreePlaces(const SceneryDef& scenery, const CharacterShape& shape)
    : scenery_(scenery), hull_(shape.hull().begin(), shape.hull().end()), character_box_(shape.box()) {
  std::vector<Box2> boxes;
  std::vector<ColliderIndex> solids;
  for (ColliderIndex i = 0; i < scenery.colliders.size(); ++i) {
    if (scenery.colliders[i].sensor) continue;
    boxes.push_back(box_of(scenery.colliders[i]));
    solids.push_back(i);
  }
  solids_ = detail::BoxTree(boxes, solids);
}

std::vector<ColliderIndex> FreePlaces::overlapped(const Vec2d& position) const {
  // Only what is near goes to the exact judge: a level has 100,000 tiles, a character meets a dozen. The rounding of
  // the box's corners is far below the margin.
  constexpr double margin = 1.0 / 1024;
  const Box2 box = Box2{character_box_.lower + position, character_box_.upper + position}.inflated(margin);
  const std::vector<ColliderIndex> original = near(box);
  if (original.empty()) return {};
  SceneryDef nearby;
  for (const ColliderIndex i : original) nearby.colliders.push_back(scenery_.colliders[i]);
  std::vector<ColliderIndex> found = ExactScenery(nearby, hull_).overlapped(position);
  for (ColliderIndex& index : found) index = original[index];
  return found;
}

void check_start(const Scene& scene, const std::string& where, const std::string& remedy, std::size_t character) {
  check_company(scene, where, character);
  const Start& start = start_of(scene, character);
  if (start.resolve_overlap) return;
  const SceneryDef scenery = scenery_at(scene, 0);
  const std::vector<ColliderIndex> inside = FreePlaces(scenery, scene.character.shape).overlapped(start.position);
  if (inside.empty()) return;
  refuse(where, fmt::format("expected a start outside of every solid, but the character overlaps \"{}\"{}{}{}",
                            scene.ids[inside.front()],
                            inside.size() == 1 ? "" : fmt::format(" and {} more", inside.size() - 1),
                            remedy.empty() ? "" : "; ", remedy));
}

void check_scene(const Scene& scene, const std::string& name) {
  check_scenery(scene.scenery, scene.ids, [&](ColliderIndex) { return name; });
  for (std::size_t k = 0; k < character_count(scene); ++k) check_start(scene, name, "", k);
}

}  // namespace paperproof::compare
