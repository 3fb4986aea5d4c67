/// A character in a game's own `b2World`.
#pragma once

#include <paperproof/controller.hpp>
#include <paperproof/report.hpp>

#include <box2d/b2_fixture.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

class b2Body;
class b2World;

namespace paperproof::box2d {

/// From where a fixture blocks a hero.
enum class Blocking : std::uint8_t {
  /// A one-sided edge or chain that the hero is behind lets the hero come through, if each of its segments faces the
  /// side that the straight way from its first vertex to its last faces, and its body is static, or kinematic and does
  /// not turn. Anything else blocks from everywhere. `Input::drop` leaves neither.
  as_in_box2d,
  from_everywhere,
  from_above,  ///< A ledge: the hero jumps up through it and lands on it. `Input::drop` lets the hero fall through.
  not_at_all,
};

/// What a fixture is for a hero.
struct Surface {
  Blocking blocks = Blocking::as_in_box2d;
  double speed = 0;  ///< Of a conveyor, to the right for a positive speed [m/s].
  friend bool operator==(const Surface&, const Surface&) = default;
};

struct HeroDef {
  CharacterDef character{};
  Vec2d position{Vec2d::Zero()};  ///< Of the origin of the character's shape, within 1e6 m [m].
  b2Filter filter{};              ///< Of the hero's fixture.
  /// With which it pushes dynamic bodies, weighs on them, and takes their impacts [kg]; from 1e-6 to 1e9. Absent: that
  /// of its shape, of density 1.
  std::optional<double> mass{};
  /// The largest force with which its steering pushes dynamic bodies [N]. Absent: that with which it accelerates
  /// itself.
  std::optional<double> push_force{};
  /// If set, it is asked in every step for each solid fixture near the hero that passes the filter: the place for what
  /// a game would decide in `PreSolve`. It may read the fixture's user data, and where the hero was after its last
  /// step.
  std::function<Surface(b2Fixture&)> surface_of{};
};

/// A surface that was in the hero's way in its last step, or that was so in the step before.
struct HeroContact {
  using Change = ContactChange;
  /// One that is `removed` may have been destroyed by the game: compare the pointer, do not follow it. A fixture that
  /// was destroyed and made anew at the same address is taken for the old one.
  b2Fixture* fixture = nullptr;
  Change change = Change::added;
  Contact contact;  ///< Of a `removed` one: the last.
};

/// The hero's open interior came to overlap a sensor fixture, or ceased to. What happened between two steps (the hero
/// was placed, the sensor was made) is at fraction 0 of the second one.
struct HeroSensorEvent {
  b2Fixture* sensor = nullptr;
  SensorEvent::Change change = SensorEvent::Change::enter;
  double fraction = 0;  ///< Of the step, in [0, 1].
};

/// Where a body was at the end of a step of the hero.
struct BodyPose {
  const b2Body* body = nullptr;
  Vec2d position{Vec2d::Zero()};  ///< Of its origin [m].
  double angle = 0;               ///< [radians]
  double speed = 0;               ///< [m/s]
  double spin = 0;                ///< Counter-clockwise [radians/s].
};

/// A hero at one time, to roll back. Restore it together with the world. It names the game's own bodies and fixtures by
/// their addresses: it is not for a file, nor for another process.
struct HeroSave {
  CharacterDef character;
  CharacterState state;
  b2Fixture* ride = nullptr;           ///< What `state.ride` is on.
  b2Fixture* ground = nullptr;         ///< What `state.ground` is.
  std::vector<b2Fixture*> crushers{};  ///< What `state.crushers` are.
  std::vector<BodyPose> poses{};       ///< Of the bodies near it.
  std::vector<HeroContact> contacts{};
  std::vector<b2Fixture*> inside{};  ///< Sensors that it overlaps.
  b2Vec2 body_position{0, 0};        ///< Of its body in the world, which is some millimetres beside it [m];
  b2Vec2 body_velocity{0, 0};        ///< with its weight and push [m/s].
  bool is_bullet = true;
  Vec2d struck{Vec2d::Zero()};  ///< The velocity with which its body strikes what stopped the hero at once [m/s].
};

/// A character in a game's own `b2World`, moved by a `Controller`. Each frame the world steps, then the hero:
///
///     world.Step(dt, 8, 3);
///     hero.step({.move = 1.0}, dt);
///
/// The hero reads the fixtures near it anew in each step, so the game tells it nothing: it may make, destroy, move,
/// turn, enable and filter bodies and fixtures as it likes. While nothing near the hero changes, what was read is used
/// again.
///
/// - Static bodies stand. Kinematic and dynamic bodies move from where they were in the hero's last step to where they
///   are now, and carry, push and crush it on this way. A body that went half a metre farther than its velocity
///   explains, or turned by half a radian more, was put there by the game.
/// - A body that turns does so at the beginning of the step, or of several shorter ones: see `Controller`. Each
/// step proves that nothing passes through the hero, and names what crushed it.
/// - Polygons, edges, chains and circles are exact, without Box2D's skin; a circle that is a ledge is a polygon of 32
///   corners around it.
/// - The game's `b2ContactFilter` decides with which fixtures the hero collides. Without one Box2D's own does, by
///   categories, masks and groups.
///
/// The world has a dynamic body for the hero, of the same shape but 0.2 mm larger, without gravity, friction and
/// restitution. Box2D reports contacts of its fixture to the game's listener, also with static bodies and sensors, as
/// for each dynamic body: in the next `world.Step`, of what the hero then touches within 6.5 mm. Dynamic bodies feel
/// the hero through this body: its mass, its weight and its push. The hero takes the impacts that its body took from
/// them. Where it touches them, its body is some millimetres beside it: draw it at `position()`.
///
/// Not thread-safe, as the world is not.
class Hero {
 public:
  /// Makes the body. The world must outlive the hero.
  /// @throws InvalidCharacter, or InvalidDefinition in words for another member of `def`.
  Hero(b2World& world, const HeroDef& def = {});
  /// Destroys the body. Not during a step of the world, nor is it moved then.
  ~Hero();
  Hero(Hero&&) noexcept;
  Hero& operator=(Hero&&) noexcept;

  /// One step, after `world.Step` with the same `dt`. The hero steers, jumps and falls as in `Controller::step`, by the
  /// gravity of the world; its up is where gravity comes from (without gravity (0, 1)), so gravity may turn.
  /// @return as `Controller::step`. `invalid_input`, if the world is locked, too: nothing changed.
  StepStatus step(const Input& input, double dt);
  /// One step of a game that owns the hero's velocity: see `Controller::move`.
  StepStatus move(const Vec2d& displacement, double dt);

  [[nodiscard]] const Vec2d& position() const noexcept { return state().position; }
  [[nodiscard]] const Vec2d& velocity() const noexcept { return state().velocity; }
  [[nodiscard]] bool grounded() const noexcept { return state().grounded; }
  [[nodiscard]] const CharacterState& state() const noexcept;
  /// The last step. Its colliders are those of this step: see `fixture_of`. Valid until the next step, `change` or
  /// `restore`.
  [[nodiscard]] const StepReport& report() const noexcept;
  /// @param collider of `report()`. @return null for `no_collider`.
  [[nodiscard]] b2Fixture* fixture_of(ColliderIndex collider) const noexcept;
  /// What the hero stands on or slides down: see `MoveResult::ground`. Null in the air. Valid until the next step, or
  /// until the game destroys the fixture.
  [[nodiscard]] b2Fixture* ground() const noexcept;
  /// Contacts of the last step by fixture: each fixture once, with its first contact; then those removed.
  [[nodiscard]] std::span<const HeroContact> contacts() const noexcept;
  /// Sensors that the hero entered and left in the last step, however fast it passed them, in order of time.
  [[nodiscard]] std::span<const HeroSensorEvent> sensors() const noexcept;
  /// Sensors that the hero overlaps after the last step.
  [[nodiscard]] std::span<b2Fixture* const> inside() const noexcept;
  /// Fixtures of moving bodies that left the hero no room in the last step; while it is `stuck` none.
  [[nodiscard]] std::span<b2Fixture* const> crushed_by() const noexcept;
  /// Fixtures near the hero that no scenery can be made of: an edge of zero length, for example. The hero does not see
  /// them.
  [[nodiscard]] std::span<b2Fixture* const> skipped() const noexcept;
  /// The hero's body, of one fixture. The game may read it, set the user data of both, and change the filter of the
  /// fixture, which is the filter of the hero. It must not move or destroy it. Another shape is another fixture, with
  /// the same filter and user data.
  [[nodiscard]] b2Body& body() const noexcept;

  /// Puts the hero elsewhere, without a way between: it forgets ground, crushes and what carried it. Nothing
  /// is dragged along.
  /// @throws InvalidDefinition for numbers that are not finite or beyond 1e6, and during a step of the world.
  void place(const Vec2d& position, const Vec2d& velocity = {0, 0});
  /// Adds to the velocity: a hit, a spring. The hero leaves the ground: see `paperproof::knock_back`.
  /// @param velocity [m/s] @throws InvalidDefinition for numbers that are not finite or beyond 1e6.
  void knock_back(const Vec2d& velocity);
  /// Lets the hero move by `velocity` from now on: a dash. A velocity upwards leaves the ground. @throws as
  /// `knock_back`.
  void set_velocity(const Vec2d& velocity);
  /// Another shape, or another way to move: to crouch, to stand up, to swim. The lowest points of both shapes are at
  /// one height along up, and their boxes have one middle across it. Another shape is another fixture: the game's
  /// listener hears the end of every contact, and in the next step of the world their begin.
  /// @return false if the new shape would overlap a solid; then nothing changed.
  /// @throws InvalidCharacter, InvalidDefinition as the constructor; InvalidDefinition during a step of the world.
  bool change(const CharacterDef& character);
  /// After `b2World::ShiftOrigin`: the hero's body has moved with the world, and the hero follows. @throws as `place`.
  void shift_origin(const Vec2d& new_origin);

  [[nodiscard]] HeroSave save() const;
  /// Call it after the world is as it was: what the save names must be there again. `contacts()` and `inside()` are
  /// those of the save; `sensors()`, `crushed_by()` and `skipped()` are empty until the next step.
  /// @throws InvalidDefinition during a step of the world.
  void restore(const HeroSave& save);

 private:
  friend void step_together(std::span<Hero* const> heroes, std::span<const Input> inputs, double dt);
  struct Impl;
  class Turn;
  std::unique_ptr<Impl> impl_;
};

/// One step of several heroes of one world that may be in each other's way, instead of `step` for each: they take
/// turns, as in `paperproof::step_together`. Who stands on another is carried, also up; who is pushed pushes on.
/// @param heroes each once. Their order is that of the turns where none is in the way of another.
/// @param inputs one for each. `Hero::report` says of each how its step went.
void step_together(std::span<Hero* const> heroes, std::span<const Input> inputs, double dt);

}  // namespace paperproof::box2d
