/// The controller over a borrowed `b2World`: the level that a game already has in Box2D becomes the controller's
/// scenery.
#pragma once

#include <paperproof/box2d/invalid_definition.hpp>
#include <paperproof/scenery.hpp>

#include <functional>
#include <span>
#include <vector>

class b2Body;
class b2Fixture;
class b2World;

namespace paperproof::box2d {

/// Fixtures as colliders. Collider `i` is (a part of) `fixtures[i]`: that is how a contact finds the game's object.
struct WorldScenery {
  SceneryDef scenery;
  std::vector<b2Fixture*> fixtures;  ///< As many as colliders; owned by the world.
  std::vector<b2Body*> movers;       ///< By `ColliderDef::mover`; owned by the world.
  std::vector<float> angles;         ///< Of those bodies when they were read [radians].
};

struct WorldSceneryDef {
  /// Which fixtures of static bodies and of movers become scenery; sensors become sensors. Absent: all but sensors.
  std::function<bool(const b2Fixture&)> filter{};
  /// Corners of the polygon that stands for a circle; it encloses the circle, and at 32 corners reaches 0.5 % of the
  /// radius beyond it. At least 3.
  int circle_corners = 32;
  /// Which kinematic and dynamic bodies become movers. Absent: none, as the character itself often is one. Movers do
  /// not turn: ask for dynamic ones with `IsFixedRotation()`.
  std::function<bool(const b2Body&)> movers{};
};

/// Reads the static bodies of `world` that are enabled, and those asked for that move, in the order in which bodies and
/// their fixtures were created.
///
/// - A polygon becomes a polygon of the same corners in world coordinates (Box2D's skin of 1 cm is not part of it).
/// - An edge or a chain becomes a chain, a loop a closed one. It blocks from both sides, also where Box2D's is
///   one-sided: a loop blocks as it does in Box2D from the side that faces the game, and what is behind it is out of
///   reach.
/// - A circle becomes the polygon of `circle_corners` corners around it.
/// - Category, mask and group of a fixture are those of its collider: see `filter_of`.
/// - A body that moves becomes a mover: its fixtures as it is turned now, around its own origin, which is the mover's
///   offset.
///
/// A body that is disabled is left out, as nothing collides with it in Box2D. One that is disabled later stays in what
/// was read, and stands still: read the world again.
///
/// The world is only read (Box2D's own lists are not const); call it between steps. Read it again after the level
/// changed: a body or fixture made, destroyed, enabled, disabled, turned, or of another type. What was read before is
/// of no use then: Box2D gives the address of a body that it destroyed to the next one, which `motions_of` and
/// `motions_since` would follow, and nobody could tell.
/// @throws InvalidDefinition for `circle_corners` below 3. Shapes that the controller refuses (points that coincide,
///   zero area) throw `InvalidScenery` when the `Scenery` is built.
[[nodiscard]] WorldScenery scenery_of(b2World& world, const WorldSceneryDef& def = {});

/// Who collides with a fixture. For a character whose body has this fixture it is the filter of a step
/// (`StepContext::filter`): the character then collides with those fixtures with which Box2D's own filter lets the body
/// collide. A mask of all of Box2D's 16 kinds becomes one of all kinds.
[[nodiscard]] Filter filter_of(const b2Fixture& fixture) noexcept;

/// How kinematic movers will go in the world's next step: from where their bodies are, with the velocities they have,
/// as Box2D will move them (at most 2 m; who is asleep or disabled stays). Call it before `world.Step` with the same
/// `dt` and hand it to `Controller::step`. A body that `SetTransform` puts elsewhere is there from the next call on,
/// and takes nobody along. Neither allocates nor throws.
/// @param scenery its world must still have the bodies.
/// @param motions one for each of `scenery.movers`; all are written.
/// @returns false where the controller would not know where a body is: one turns or has turned (`first_turned` says
///   which, and what to do), or is dynamic and enabled (what those do is known only after the step: `motions_since`).
template <class Scalar>
[[nodiscard]] bool motions_of(const WorldScenery& scenery, float dt, std::span<MoverMotion<Scalar>> motions) noexcept;

/// The first of `scenery.movers` that turns, or is not turned as it was when it was read; null if there is none. Until
/// it stands as it was read again the controller would take it for what it was.
///
/// What to do: read the world again, with a predicate that leaves out what turns
/// (`body.GetAngularVelocity() == 0`), and ask for the motions of that. The character then goes through what turns, and
/// goes on with the rest; once the body stands still, reading again takes it in as it is turned then.
[[nodiscard]] b2Body* first_turned(const WorldScenery& scenery) noexcept;

/// Where the bodies of the movers are [m].
/// @param scenery its world must still have the bodies.
/// @param places one for each of `scenery.movers`.
void places_of(const WorldScenery& scenery, std::span<Vec2d> places) noexcept;

/// How all movers went in the world's last step, kinematic or dynamic. Here the world goes first: `places_of`,
/// `world.Step`, `motions_since`, `Controller::step`. The controller then knows what gravity, impacts and weight did to
/// a body; what it does to the body (an impulse on `fixtures[contact.collider]->GetBody()`, say) is up to the game.
/// Let a body of the character's own not collide with what carries and pushes it (a sensor, or a filter): Box2D would
/// do so a second time, before the controller hears of it.
///
/// What a body did between the two calls is a motion, which carries and pushes: a body that `SetTransform` takes 20 m
/// away takes its rider along, at 1,200 m/s in frames of 1/60 s. So put bodies elsewhere before `places_of`. Neither
/// allocates nor throws.
/// @param scenery its world must still have the bodies: see `scenery_of`.
/// @param places what `places_of` gave before the step.
/// @returns false where a body turns or has turned, and the controller would not know where it is: see `first_turned`.
template <class Scalar>
[[nodiscard]] bool motions_since(const WorldScenery& scenery, std::span<const Vec2d> places,
                                 std::span<MoverMotion<Scalar>> motions) noexcept;

extern template bool motions_of(const WorldScenery&, float, std::span<MoverMotion<float>>) noexcept;
extern template bool motions_of(const WorldScenery&, float, std::span<MoverMotion<double>>) noexcept;
extern template bool motions_since(const WorldScenery&, std::span<const Vec2d>, std::span<MoverMotion<float>>) noexcept;
extern template bool motions_since(const WorldScenery&, std::span<const Vec2d>,
                                   std::span<MoverMotion<double>>) noexcept;

}  // namespace paperproof::box2d
