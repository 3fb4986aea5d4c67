#include "scenes/json_motion.hpp"

#include <fmt/format.h>

namespace paperproof::compare {

Vec2d read_place(const JsonCursor& at) {
  constexpr double farthest = 2e6;
  const Vec2d place = at.point();
  if (!(place.cwiseAbs().maxCoeff() <= farthest)) at.refuse("expected coordinates within 2e6 m");
  return place;
}

Vec2d read_velocity(const JsonCursor& at, double dt) {
  const Vec2d velocity = at.point();
  check_travel(at, velocity.cwiseAbs().maxCoeff() * dt, dt);
  return velocity;
}

void check_travel(const JsonCursor& at, double per_step, double dt) {
  constexpr double most = 1e6;  // of the guarantee
  if (!(per_step <= most)) at.refuse(fmt::format("expected at most 1e6 m of motion in a step of {} s", dt));
}

}  // namespace paperproof::compare
