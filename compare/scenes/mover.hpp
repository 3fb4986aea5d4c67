/// What moves in a scene: colliders that go along a path through time, or are bodies that Box2D moves.
#pragma once

#include "records/mover_script.hpp"

#include <paperproof/scenery.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// What Box2D moves: by gravity, impacts and weight. It does not turn.
struct Body {
  double mass = 1;                ///< [kg]
  double friction = 0.2;          ///< Of two surfaces Box2D takes the root of the product; scenery has 0.2.
  double restitution = 0;         ///< From 0 to 1.
  Vec2d velocity{Vec2d::Zero()};  ///< At the start [m/s].
};

/// A thing that goes along a path, or that Box2D moves; the colliders with its number in `ColliderDef::mover` go with
/// it. Their points are where they are at offset (0, 0) and angle 0; they turn about the point (0, 0) that they are
/// written around, and are then moved by the offset.
struct MoverDef {
  using Loop = MoverScript::Loop;
  using Waypoint = MoverScript::Waypoint;
  using Turn = MoverScript::Turn;
  std::string id;
  std::vector<Waypoint> path;  ///< At least one.
  Loop loop = Loop::once;
  std::vector<Turn> turns{};  ///< Empty: it does not turn.
  /// Where there is one, the path says only where it begins.
  std::optional<Body> body{};
};

/// Holds a body to the ground or to another body. Points are where they are at the start [m].
struct Joint {
  enum class Kind : std::uint8_t {
    distance,   ///< Between two points: a rod, or with a stiffness a spring.
    revolute,   ///< A pin through both: as bodies do not turn they keep their places to each other.
    prismatic,  ///< A rail along `axis`.
  };
  std::string id;
  Kind kind = Kind::distance;
  MoverIndex body = 0;
  MoverIndex other = no_mover;  ///< Another body, or the ground.
  Vec2d point{Vec2d::Zero()};   ///< On `body`: of a distance or a pin.
  Vec2d end{Vec2d::Zero()};     ///< On `other`: of a distance.
  Vec2d axis{Vec2d::Zero()};    ///< Of a rail; its length does not matter.
  double length = 0;            ///< Of a distance, where it neither pulls nor pushes [m].
  double stiffness = 0;         ///< [N/m]; 0: a rod.
  double damping = 0;           ///< [N s/m]; of a spring.
};

/// Where the mover is `time` seconds after the start of the scene [m]: linear between waypoints, at a waypoint exactly
/// that, before the first one there. The same bits on every machine.
[[nodiscard]] Vec2d offset_at(const MoverDef& mover, double time);

/// How far it is turned at that time [radians], in the same way.
[[nodiscard]] double angle_at(const MoverDef& mover, double time);

/// How the mover goes in a step from one absolute time to another [s].
[[nodiscard]] MoverMotion motion_between(const MoverDef& mover, double begin, double end);

}  // namespace paperproof::compare
