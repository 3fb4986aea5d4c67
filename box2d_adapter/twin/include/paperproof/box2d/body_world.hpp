/// Bodies that Box2D moves, for characters that stand on them: crates, stacks, what falls.
#pragma once

#include <paperproof/box2d/reference_world.hpp>

#include <memory>
#include <optional>
#include <span>

namespace paperproof::box2d {

inline constexpr double least_mass = 1e-6;   ///< [kg]
inline constexpr double largest_mass = 1e9;  ///< [kg]

/// A dynamic body. It does not turn.
struct BodyDef {
  double mass = 1;        ///< [kg], from `least_mass` to `largest_mass`.
  double friction = 0.2;  ///< Of two surfaces Box2D takes the root of the product; scenery has 0.2.
  double restitution = 0;
  Vec2d velocity{Vec2d::Zero()};  ///< At the start [m/s].
};

/// Holds a body to the ground or to another body. Points are where they are at the start [m]. As bodies do not turn,
/// two that are held by a pin keep their places to each other, and one that is pinned to the ground stays where it is.
struct JointDef {
  enum class Kind : std::uint8_t {
    distance,   ///< Between two points: a rod, or with a stiffness a spring (Box2D's implicit soft constraint).
    revolute,   ///< A pin through both. Bodies that are pinned together do not collide.
    prismatic,  ///< A rail: the body goes along `axis` only, relative to what it is held to.
  };
  Kind kind = Kind::distance;
  MoverIndex body = 0;
  MoverIndex other = no_mover;  ///< Another body; absent: the ground.
  Vec2d point{Vec2d::Zero()};   ///< On `body`: of a distance or a pin.
  Vec2d end{Vec2d::Zero()};     ///< On `other`: of a distance.
  Vec2d axis{0, 1};             ///< Of a prismatic joint.
  double length = 1;            ///< Of a distance, where it pulls and pushes nothing [m]; from `least_length`.
  double stiffness = 0;         ///< [N/m], up to `largest_stiffness`. 0: a rod.
  double damping = 0;           ///< Of a spring [N s/m], up to `largest_stiffness`.
};
inline constexpr double least_length = 0.005;      ///< Box2D takes a shorter distance for as long [m].
inline constexpr double largest_stiffness = 1e12;  ///< [N/m]

/// Owns a `b2World` with the scenery and dynamic bodies in it, and no character: whoever stands on a body is carried by
/// it and does not weigh on it. Bodies are movers of the scenery like those that go along paths, and collide with
/// those, with what stands, and with each other; a one-way chain holds them as Box2D's one-sided edges do. Not
/// thread-safe; two worlds are independent.
class BodyWorld {
 public:
  /// @param scenery all colliders of a body stand where the body begins, at offset (0, 0).
  /// @param bodies one for each mover of the scenery; absent for those that go along paths.
  /// @param gravity [m/s²].
  /// @param joints between bodies and the ground, which is no collider: joints change no collision but of what is
  /// pinned.
  /// @throws InvalidDefinition in words; never aborts inside Box2D.
  BodyWorld(const Scenery& scenery, std::span<const std::optional<BodyDef>> bodies, const Vec2d& gravity,
            std::span<const JointDef> joints = {});
  ~BodyWorld();
  BodyWorld(BodyWorld&&) noexcept;
  BodyWorld& operator=(BodyWorld&&) noexcept;

  /// Steps the world once.
  /// @param motions one for each mover of the scenery: those along paths are read, those of bodies are written, from
  ///   where Box2D had them to where it has them (floats, which are doubles exactly).
  /// @throws InvalidDefinition for numbers that are not finite or beyond 1e9, another number of movers, or dt below
  ///   1e-9 s; then nothing was stepped.
  void step(double dt, std::span<MoverMotion> motions);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace paperproof::box2d
