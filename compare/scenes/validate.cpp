#include "scenes/validate.hpp"

#include <fmt/format.h>

#include "oracle/exact.hpp"
#include "oracle/pair.hpp"
#include "scenes/input_error.hpp"

namespace paperproof::compare {

namespace {

void check_company(const Scene& scene, const std::string& where, std::size_t character) {
  const ExactPair pair(scene.character.shape.hull());
  for (std::size_t other = 0; other < character; ++other)
    if (pair.overlap(start_of(scene, character).position, start_of(scene, other).position))
      refuse(where, fmt::format("expected a start outside of every other character, but it overlaps character {}, "
                                "which begins at ({}, {})",
                                other, start_of(scene, other).position.x(), start_of(scene, other).position.y()));
}

}  // namespace

void check_scenery(const SceneryDef& scenery, const std::vector<std::string>& ids, const WhereIs& where) {
  try {
    const Scenery<double> built(scenery);
  } catch (const InvalidScenery& error) {
    refuse(where(error.collider()), fmt::format("\"{}\": {}", ids[error.collider()], error.what()));
  }
}

Box2<double> box_of(const ColliderDef& collider) {
  Box2<double> box{collider.points.front(), collider.points.front()};
  for (const Vec2d& point : collider.points) box = box.merged({point, point});
  return box;
}

FreePlaces::FreePlaces(const SceneryDef& scenery, const CharacterShape& shape)
    : scenery_(scenery), hull_(shape.hull().begin(), shape.hull().end()), character_box_(shape.box()) {
  boxes_.reserve(scenery.colliders.size());
  for (const ColliderDef& collider : scenery.colliders) boxes_.push_back(box_of(collider));
}

std::vector<ColliderIndex> FreePlaces::overlapped(const Vec2d& position) const {
  // Only what is near goes to the exact judge: a level has 100,000 tiles, a character meets a dozen. The rounding of
  // the box's corners is far below the margin.
  constexpr double margin = 1.0 / 1024;
  const Box2<double> box =
      Box2<double>{character_box_.lower + position, character_box_.upper + position}.inflated(margin);
  SceneryDef near;
  std::vector<ColliderIndex> original;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (scenery_.colliders[i].sensor || !boxes_[i].overlaps(box)) continue;
    near.colliders.push_back(scenery_.colliders[i]);
    original.push_back(static_cast<ColliderIndex>(i));
  }
  if (original.empty()) return {};
  std::vector<ColliderIndex> found = ExactScenery(near, hull_).overlapped(position);
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

}  // namespace paperproof::compare
