/// A character among movers, and what moves them.
#pragma once

#include "controller/article_support.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::article_tests {

using Motions = std::vector<MoverMotion<double>>;

inline ColliderDef of_mover(ColliderDef def, MoverIndex mover = 0) {
  def.mover = mover;
  return def;
}

inline ColliderDef conveyor(ColliderDef def, double speed) {
  def.surface_speed = speed;
  return def;
}

/// A character among movers, stepped as a controller does it.
struct Passenger {
  Rig<double> rig;
  double dt = 1.0 / 64;
  double gravity = 32;
  Vec2d position{Vec2d::Zero()};
  Vec2d velocity{Vec2d::Zero()};
  Ride<double> ride{};

  Passenger(std::string_view kind, std::vector<ColliderDef> colliders, const ArticleKnobs& knobs = {})
      : rig(kind, std::move(colliders), knobs) {}

  const MoveResult<double>& step(const Motions& movers) {
    MoveRequest<double> request;
    request.position = position;
    request.velocity = velocity - ride.velocity;
    request.velocity.y() -= gravity * dt;
    request.displacement = request.velocity * dt;
    request.movers = movers;
    request.dt = dt;
    request.ride = ride;
    rig.technique->move(request, rig.scratch, rig.result);
    position = rig.result.position;
    velocity = rig.result.velocity;
    ride = rig.result.ride;
    return rig.result;
  }
  /// A step of a second without gravity.
  const MoveResult<double>& fly(const Vec2d& from, const Vec2d& by, const Motions& movers) {
    dt = 1;
    gravity = 0;
    position = from;
    velocity = by;
    return step(movers);
  }
};

inline const Contact<double>& only_contact(const MoveResult<double>& result) {
  EXPECT_EQ(result.contacts.size(), 1U);
  return result.contacts[0];
}

/// There and back, `reach` far, in 128 steps.
inline Vec2d swing(const Vec2d& reach, int step) {
  return reach * (0.5 - 0.5 * std::cos(step * 2 * 3.14159265358979 / 128));
}

}  // namespace paperproof::article_tests
