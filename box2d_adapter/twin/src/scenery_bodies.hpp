/// The scenery inside a Box2D world: bodies for what stands and for what moves.
#pragma once

#include "fixtures.hpp"

#include <paperproof/box2d/body_world.hpp>

#include <box2d/b2_world.h>

#include <optional>
#include <span>
#include <vector>

namespace paperproof::box2d {

/// One static body for what stands; for each mover a kinematic one, which is moved by velocity, or a dynamic one, which
/// Box2D moves. A body's position is its mover's offset.
struct SceneryBodies {
  /// @param world must outlive this.
  /// @param scenery judged and cut for the controller; its colliders are rounded to float here.
  /// @param dynamic which movers are dynamic bodies, one for each mover; or empty: none.
  /// @throws InvalidDefinition before Box2D sees what it would abort on.
  SceneryBodies(b2World& world, const Scenery& scenery, const ReferenceWorldDef& def,
                std::span<const std::optional<BodyDef>> dynamic = {});

  /// Begins a step: gives every kinematic body the velocity that takes it to where it is to be.
  /// @throws InvalidDefinition for what `ReferenceWorld::step_all` refuses; then nothing changed.
  void send(double length, std::span<const MoverMotion> wanted);
  /// Steps the world, and fills `motions`.
  void step(const ReferenceWorldDef& def);

  struct Mover {
    b2Body* body = nullptr;
    bool dynamic = false;
    b2Vec2 goal{0, 0};     ///< Where it is to be after the present step, or the last [m].
    float goal_angle = 0;  ///< The same [radians].
  };

  SceneryDef as_run;        ///< In float.
  std::vector<Part> parts;  ///< What stands, then each mover. Needed no more once the bodies are there.
  SceneryFixtures fixtures;
  std::vector<Mover> movers;
  std::vector<Vec2d> offsets;        ///< Of the movers, when the step begins [m].
  std::vector<MoverMotion> motions;  ///< As Box2D made them.
  bool capped = false;               ///< A kinematic body was to go beyond the travel cap.
  float dt = 0;                      ///< Of the present step, or the last [s].

 private:
  void send(Mover& mover, const MoverMotion& wanted);

  b2World& world_;
  MoverDrive drive_;
  float last_dt_ = 0;
};

}  // namespace paperproof::box2d
