/// One and the same step, said in two ways: what each vector, place, side and number of a collider is in the other way.
#pragma once

#include "campaign/random.hpp"
#include "campaign/random_run.hpp"
#include "campaign/shapes.hpp"
#include "geometry/pose.hpp"

#include <paperproof/controller.hpp>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace paperproof::test {

/// Says points and directions of a collider in another way.
inline void say_anew(ColliderDef& collider, const auto& way) {
  for (Vec2d& p : collider.points) p = way(p);
  for (std::vector<Vec2d>& hole : collider.holes)
    for (Vec2d& p : hole) p = way(p);
  if (collider.one_way) collider.one_way = way(*collider.one_way);
}

/// How one and the same thing is said in another way of a run: vectors are multiplied, colliders are numbered anew, and
/// a character is said to be somewhere else, as its shape is written around another origin.
struct Saying {
  Eigen::Matrix2d vector = Eigen::Matrix2d::Identity();
  Vec2d elsewhere{0, 0};  ///< By so much [m].
  /// Those of the other way, by those of the run; empty: the same.
  std::map<ColliderIndex, ColliderIndex> colliders{};

  [[nodiscard]] Vec2d of(const Vec2d& v) const { return vector * v; }
  [[nodiscard]] Vec2d of_place(const Vec2d& p) const { return of(p) + elsewhere; }
  [[nodiscard]] ColliderIndex of(ColliderIndex collider) const {
    return collider == no_collider || colliders.empty() ? collider : colliders.at(collider);
  }
  [[nodiscard]] bool mirrors() const { return vector.determinant() < 0; }
  [[nodiscard]] Side of(Side side) const {
    if (!mirrors() || side == Side::top || side == Side::bottom) return side;
    return side == Side::left ? Side::right : Side::left;
  }
  [[nodiscard]] Input of(Input input) const {
    if (mirrors() && input.move) input.move = -*input.move;
    return input;
  }
  [[nodiscard]] CharacterState of(CharacterState state) const {
    for (Vec2d* p : {&state.position, &state.last_free, &state.ride.place}) *p = of_place(*p);
    for (Vec2d* v : {&state.velocity, &state.ride.velocity, &state.ground.normal, &state.ground.velocity}) *v = of(*v);
    for (Crusher& crusher : state.crushers) {
      crusher.collider = of(crusher.collider);
      crusher.last_free = of_place(crusher.last_free);
      crusher.displacement = of(crusher.displacement);
    }
    state.ride.ground = of(state.ride.ground);
    state.ground.collider = of(state.ground.collider);
    if (mirrors()) std::swap(state.wall_left, state.wall_right);
    return state;
  }
  [[nodiscard]] SceneryDef of(SceneryDef def) const {
    for (ColliderDef& collider : def.colliders) {
      say_anew(collider, [this](const Vec2d& v) { return of(v); });
      if (mirrors()) collider.surface_speed = -collider.surface_speed;
    }
    return def;
  }
  [[nodiscard]] CharacterDef of(CharacterDef def) const {
    std::vector<Vec2d> points;
    for (const Vec2d& p : def.shape.points()) points.emplace_back(of(p) - elsewhere);
    def.shape = CharacterShape(points);
    return def;
  }
  /// With the shape of all written elsewhere, and nothing turned.
  [[nodiscard]] compare::RandomRun of(compare::RandomRun run) const {
    run.scene.character = of(run.scene.character);
    run.centre = of_place(run.centre);
    run.scene.start.position = of_place(run.scene.start.position);
    for (compare::OtherCharacter& other : run.scene.others) other.start.position = of_place(other.start.position);
    return run;
  }
};

/// With a shape that is written around another origin, up to 1,000 m away.
inline Saying written_elsewhere(compare::Random& random) {
  const double angle = random.angle();
  return {.elsewhere = random.log_between(1e-2, 1000) * compare::towards(angle)};
}

/// With movers that are made turned, each about its origin.
inline SceneryDef made_turned(SceneryDef def, const std::vector<double>& angles) {
  for (ColliderDef& collider : def.colliders)
    if (collider.mover != no_mover) say_anew(collider, geometry::Turn(angles[collider.mover]));
  return def;
}

/// What differs between a step and what the other way says; empty where nothing does. @param near are equal numbers.
inline std::string difference(const StepReport& one, const StepReport& other, const Saying& saying, double near) {
  const MoveResult& a = one.move;
  const MoveResult& b = other.move;
  const auto same = [near](const Vec2d& p, const Vec2d& q) { return p == q || (p - q).cwiseAbs().maxCoeff() <= near; };
  const auto same_number = [near](double x, double y) { return x == y || std::abs(x - y) <= near; };
  if (one.status != other.status) return "status";
  if (one.status == StepStatus::invalid_input || one.status == StepStatus::out_of_range) return "";
  if (!same(saying.of(one.requested), other.requested)) return "requested";
  if (!same(saying.of(a.velocity) / (1 + a.velocity.norm()), b.velocity / (1 + a.velocity.norm()))) return "velocity";
  if (!std::ranges::equal(a.path, b.path, [&](const auto& p, const auto& q) {
        return same(saying.of_place(p.position), q.position) && same_number(p.fraction, q.fraction);
      }))
    return "path";
  if (!std::ranges::equal(a.contacts, b.contacts, [&](const Contact& p, const Contact& q) {
        return saying.of(p.collider) == q.collider && same(saying.of(p.normal), q.normal) &&
               saying.of(p.side) == q.side && same_number(p.fraction, q.fraction) &&
               same_number(p.separation, q.separation);
      }))
    return "contacts";
  const auto same_collider = [&](ColliderIndex p, ColliderIndex q) { return saying.of(p) == q; };
  if (!std::ranges::equal(a.crushed, b.crushed, same_collider)) return "crushed";
  // In the order of their ids, which are others in another way.
  std::vector<ColliderIndex> passed;
  for (const ColliderIndex chain : one.dropped_through) passed.push_back(saying.of(chain));
  std::ranges::sort(passed);
  if (!std::ranges::equal(passed, other.dropped_through)) return "dropped_through";
  if (!std::ranges::equal(one.sensors, other.sensors, [&](const auto& p, const auto& q) {
        return saying.of(p.sensor) == q.sensor && p.change == q.change && same_number(p.fraction, q.fraction);
      }))
    return "sensors";
  return "";
}

}  // namespace paperproof::test
