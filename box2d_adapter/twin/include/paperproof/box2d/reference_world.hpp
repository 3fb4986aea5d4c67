/// A Box2D world beside the controller: the same scenery, the same octagon, the same wanted velocity.
#pragma once

#include <paperproof/box2d/invalid_definition.hpp>
#include <paperproof/controller.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/together.hpp>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace paperproof::box2d {

/// How the solids become fixtures.
enum class SceneryMode : std::uint8_t {
  chain_loops,  ///< One-sided chain loops around the union of the solids: the way Box2D recommends. Contender `box2d`.
  pieces,       ///< One fixture per convex piece: shows ghost collisions. Contender `box2d_pieces`.
};

/// What the solids that stand are for Box2D.
enum class SolidBody : std::uint8_t {
  fixed,      ///< Static bodies.
  kinematic,  ///< Kinematic bodies that rest.
  dynamic,    ///< Dynamic bodies of 1e9 kg that rest: continuous collision looks at them for bullets alone. In pieces.
};

/// How what moves gets to where it should be at the end of a step.
enum class MoverDrive : std::uint8_t {
  velocity,   ///< Box2D sweeps it there.
  transform,  ///< It is put there before the step (`SetTransform`), and passes nothing on the way.
};

struct ReferenceWorldDef {
  SceneryMode mode = SceneryMode::chain_loops;
  int velocity_iterations = 8;
  int position_iterations = 3;
  bool bullet = true;      ///< Of the characters.
  bool continuous = true;  ///< Continuous collision at all.
  SolidBody solids = SolidBody::fixed;
  MoverDrive drive = MoverDrive::velocity;
};

/// Version of the Box2D in use, as it should be cited ("2.4.1": the packaged library calls itself 2.4.0).
[[nodiscard]] std::string box2d_version();
/// How the Box2D in use was built, as far as its package says: "shared, None" (Debian's: optimised, nothing defined).
/// And whether its asserts are on, which costs time and aborts on definitions that it does not like: "on", "off" or
/// "unknown".
[[nodiscard]] std::string box2d_build();
[[nodiscard]] std::string box2d_asserts();

/// Travel cap of Box2D: a body moves at most this far in one step [m].
inline constexpr double max_travel_per_step = 2.0;
/// Shortest step that it is given [s]: the reciprocal must be finite as a float, too.
inline constexpr double least_step = 1e-9;
/// Gap at which polygons rest in Box2D [m], and at which it begins to report touching.
inline constexpr double rest_gap = 0.015;
inline constexpr double touch_gap = 0.020;

/// What a character wants in one step.
struct TwinWish {
  Vec2d velocity{Vec2d::Zero()};  ///< [m/s]
  bool drop = false;              ///< One-way chains do not hold it.
};

/// What one step of the twin did. Positions and velocities are Box2D's floats.
///
/// Contacts: `separation` is the gap between the bare shapes, Box2D's own plus both radii, so that rest gives about
/// +0.015 m. `fraction` is where along the step's way Box2D stopped the body, 0 where it was touching when the step
/// began. Listed is what continuous collision stopped at, and what touches while the wanted motion leads into it by
/// more than 1e-7 m; one entry per collider and side, the earliest first.
struct TwinStep {
  bool capped = false;            ///< The wanted motion, or a mover's, exceeds the 2 m cap.
  Vec2d velocity{Vec2d::Zero()};  ///< After the step.
  /// Touching something whose normal is within the climb limit of up, and not moving away from it.
  bool grounded = false;
  /// What it stands on: the most level of what it touches, the lowest index among equals. Looked for only where
  /// something in the scenery moves or has a surface speed; absent elsewhere.
  struct Ground {
    ColliderIndex collider = 0;
    Vec2d normal{Vec2d::Zero()};  ///< Unit, upwards.
  };
  std::optional<Ground> ground;
  std::vector<PathPoint> path;      ///< Start, positions seen in callbacks during the step, end.
  std::vector<Contact> contacts;    ///< Touching after the step, and those that began and ended during it.
  std::vector<MoverMotion> movers;  ///< Where Box2D had the movers when the step began and ended.
  /// Box2D looks for sensors once, when a step begins, and within 20 mm: what is crossed in one step is not seen, and
  /// the fraction is always 0.
  std::vector<SensorEvent> sensors;
  std::vector<CrowdContact> met;  ///< Contacts with other characters, listed as those with scenery are.
  /// One-way chains that held the character when the step began, and through which it went because it dropped; of
  /// chains beside the way those are among them whose box it met. Ascending.
  std::vector<ColliderIndex> dropped_through;
};

/// Owns a `b2World` with the scenery and one dynamic octagon for each character. What moves are kinematic bodies, one
/// for each mover, that are moved by velocity. Characters have the same mass and push each other. Not thread-safe; two
/// worlds are independent.
class ReferenceWorld {
 public:
  /// @param scenery judged and cut exactly as for the controller; every definition is validated before Box2D sees it.
  /// @throws InvalidDefinition in words; never aborts inside Box2D.
  ReferenceWorld(const Scenery& scenery, const CharacterDef& character, const Vec2d& position,
                 const ReferenceWorldDef& def = {});
  /// The same with several characters of one kind.
  ReferenceWorld(const Scenery& scenery, const CharacterDef& character, std::span<const Vec2d> positions,
                 const ReferenceWorldDef& def = {});
  ~ReferenceWorld();
  ReferenceWorld(ReferenceWorld&&) noexcept;
  ReferenceWorld& operator=(ReferenceWorld&&) noexcept;

  /// Puts a character somewhere else (respawn, lockstep). Contacts and the solver's stored impulses are forgotten:
  /// what follows depends on this call only. What is within 20 mm touches again in the next step.
  /// @throws InvalidDefinition for numbers that are not finite or beyond 1e9; then nothing changed.
  void place(const Vec2d& position, const Vec2d& velocity, std::size_t character = 0);
  /// Sets the wanted velocity and steps the world once.
  /// @param movers one for each mover of the scenery. Each gets the velocity that takes it from where Box2D has it to
  ///   where it should be at the end, so that rounding does not add up; one that does not begin where it was to end in
  ///   the step before is put there. It turns by velocity as well: Box2D turns a body by at most a quarter of a circle
  ///   in a step, and beyond that the step counts as capped.
  /// @param drop one-way chains hold nobody in this step.
  /// @throws InvalidDefinition for numbers that are not finite or beyond 1e9, another number of movers, or dt below
  ///   1e-9 s; then nothing was stepped.
  const TwinStep& step(const Vec2d& wanted_velocity, double dt, std::span<const MoverMotion> movers = {},
                       bool drop = false);
  /// The same with a wish of each character. @returns one for each, valid until the next step.
  std::span<const TwinStep> step_all(std::span<const TwinWish> wishes, double dt,
                                     std::span<const MoverMotion> movers = {});

  /// The same step of the same world, for timing Box2D alone: nothing is recorded and nothing read. Where there are
  /// one-way chains a listener lets through what they do not hold; elsewhere there is none.
  void step_bare(std::span<const TwinWish> wishes, double dt, std::span<const MoverMotion> movers = {});

  [[nodiscard]] Vec2d position(std::size_t character = 0) const;
  /// The scenery as Box2D has it (float geometry): polygons as the original colliders rounded to float.
  [[nodiscard]] const SceneryDef& as_run() const noexcept;
  /// The octagon as Box2D has it.
  [[nodiscard]] const std::vector<Vec2d>& points_as_run() const noexcept;
  /// Fixtures, child shapes and vertices, for the report and for tests.
  struct Size {
    std::size_t fixtures = 0;
    std::size_t loops = 0;
    std::size_t vertices = 0;
  };
  [[nodiscard]] Size size() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace paperproof::box2d
