/// Scenery as fixtures of static and kinematic bodies, every shape checked before Box2D sees it.
#pragma once

#include "float_scenery.hpp"
#include "shapes.hpp"

#include <paperproof/box2d/reference_world.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_edge_shape.h>
#include <box2d/b2_polygon_shape.h>

#include <optional>
#include <vector>

namespace paperproof::box2d {

/// Where a fixture comes from. A fixture's user data is its position in `SceneryFixtures::sources`.
struct FixtureSource {
  /// Absent for an outline of several colliders: which one is touched depends on where.
  std::optional<ColliderIndex> collider;
  MoverIndex mover = no_mover;
  bool sensor = false;
  /// One-way segments only: its ends at offset zero, and the unit normal of the side that it blocks.
  struct OneWay {
    Vec2d point;
    Vec2d end;
    Vec2d normal;
  };
  std::optional<OneWay> one_way{};
  std::optional<CharacterIndex> character{};  ///< It is no scenery, but a character.
};

/// What goes along with one mover, or stands. It has a body of its own, whose position is the mover's offset.
struct Part {
  MoverIndex mover = no_mover;
  SceneryDef solids;  ///< As run; chains are among them, sensors are not. A one-way polygon is one chain or more.
  std::vector<ColliderIndex> colliders;  ///< Which those are.
};

/// What stands comes first, then each mover in order.
/// @param as_run rounded to float.
/// @throws InvalidDefinition for a collider that is a single point in float.
[[nodiscard]] std::vector<Part> parts_of(const SceneryDef& as_run, std::size_t mover_count);

struct SceneryFixtures {
  std::vector<FixtureSource> sources;
  ReferenceWorld::Size size;
};

/// Gives `body` one fixture per loop of the union of the part's solids, or one per convex piece; and one per chain
/// segment.
///
/// - An outline is a one-sided chain loop. A solid too thin or too small for one (`spaced` in solid_union.hpp) gets
///   every edge of its own outline as a two-sided edge: Box2D's edges have no smallest length, and nothing passes them.
///   A void that thin is filled: nothing fits into it.
/// - A piece is a polygon set vertex by vertex: `b2PolygonShape::Set` would weld points within 2.5 mm and turn thin
///   paper into a box of 2 m. Pieces of more than 8 vertices are cut as a fan.
/// - A chain segment is a two-sided edge; a one-way segment a one-sided edge whose ghost vertices are its neighbours
///   where these block the same way, and its own continuation where not.
/// @param scenery gives the convex pieces.
void add_solids(b2Body& body, const Scenery& scenery, const Part& part, SceneryMode mode, SceneryFixtures& made);

/// Gives every sensor to the body of its mover, piece by piece.
/// @param bodies of the parts, in their order.
void add_sensors(std::span<b2Body* const> bodies, const Scenery& scenery, const SceneryDef& as_run,
                 SceneryFixtures& made);

/// A convex polygon exactly as given: counter-clockwise, 3 to 8 vertices that differ. Two-sided, any thickness above
/// zero.
[[nodiscard]] b2PolygonShape polygon_as_given(std::span<const b2Vec2> vertices);

}  // namespace paperproof::box2d
