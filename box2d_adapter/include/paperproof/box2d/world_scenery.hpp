/// The level of a `b2World` that stands, as the controller's scenery: for characters that are no `Hero`, and for many.
#pragma once

#include <paperproof/box2d/invalid_definition.hpp>
#include <paperproof/scenery.hpp>

#include <functional>
#include <vector>

class b2Fixture;
class b2World;

namespace paperproof::box2d {

/// Fixtures as colliders. Collider `i` is (a part of) `fixtures[i]`: that is how a contact finds the game's object.
struct WorldScenery {
  SceneryDef scenery;
  std::vector<b2Fixture*> fixtures;  ///< As many as colliders; owned by the world.
};

struct WorldSceneryDef {
  /// Which fixtures become scenery; sensors become sensors. Absent: all but sensors.
  std::function<bool(const b2Fixture&)> filter{};
};

/// Reads the static bodies of `world` that are enabled, in the order in which bodies and their fixtures were created.
///
/// - A polygon becomes a polygon of the same corners in world coordinates (Box2D's skin of 1 cm is not part of it).
/// - An edge or a chain becomes a chain, a loop a closed one. It blocks from both sides, also where Box2D's is
///   one-sided: give the collider a `one_way` where characters shall come through from behind.
/// - A circle becomes exactly that circle.
/// - Category, mask and group of a fixture are those of its collider: see `filter_of`.
///
/// The world is only read (Box2D's own lists are not const); call it between steps. Read it again after the level
/// changed.
/// Shapes that the controller refuses (points that coincide, zero area) throw `InvalidScenery` when the `Scenery` is
/// built.
[[nodiscard]] WorldScenery scenery_of(b2World& world, const WorldSceneryDef& def = {});

/// The filter of a fixture. Used as the filter of a step (`StepContext::filter`), it lets a character collide with
/// those fixtures with which Box2D lets this fixture collide. A mask of all of Box2D's 16 kinds becomes one of all
/// kinds.
[[nodiscard]] Filter filter_of(const b2Fixture& fixture) noexcept;

}  // namespace paperproof::box2d
