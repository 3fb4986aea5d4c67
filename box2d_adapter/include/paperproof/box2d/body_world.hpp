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

/// Owns a `b2World` with the scenery and dynamic bodies in it, and no character: whoever stands on a body is carried by
/// it and does not weigh on it. Bodies are movers of the scenery like those that go along paths, and collide with
/// those, with what stands, and with each other; a one-way chain holds them as Box2D's one-sided edges do. Not
/// thread-safe; two worlds are independent.
class BodyWorld {
 public:
  /// @param scenery all colliders of a body stand where the body begins, at offset (0, 0).
  /// @param bodies one for each mover of the scenery; absent for those that go along paths.
  /// @param gravity [m/s²].
  /// @throws InvalidDefinition in words; never aborts inside Box2D.
  BodyWorld(const Scenery<double>& scenery, std::span<const std::optional<BodyDef>> bodies, const Vec2d& gravity);
  ~BodyWorld();
  BodyWorld(BodyWorld&&) noexcept;
  BodyWorld& operator=(BodyWorld&&) noexcept;

  /// Steps the world once.
  /// @param motions one for each mover of the scenery: those along paths are read, those of bodies are written, from
  ///   where Box2D had them to where it has them (floats, which are doubles exactly).
  /// @param turns one for each mover, or none where none turns.
  /// @throws InvalidDefinition for numbers that are not finite or beyond 1e9, another number of movers, or dt below
  ///   1e-9 s; then nothing was stepped.
  void step(double dt, std::span<MoverMotion<double>> motions, std::span<const MoverTurn> turns = {});

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace paperproof::box2d
