#include "continuous/law.hpp"

#include "contains.hpp"

#include <algorithm>
#include <optional>

namespace paperproof::compare::continuous {
namespace {

using Touches = std::span<const Touch>;

Real tolerance_for(const Point& v) { return same() * (1 + abs(v.x()) + abs(v.y())); }

bool enters(const Point& v, const Touch& at) {
  const Real tolerance = tolerance_for(v);
  const Real into = v.dot(at.normal);
  if (!at.corner) return into < -tolerance;
  const Real into_other = v.dot(*at.corner);
  return into < -tolerance && into_other < -tolerance && into >= into_other - tolerance;
}

bool enters_any(const Point& v, Touches touched) {
  return std::ranges::any_of(touched, [&](const Touch& at) { return enters(v, at); });
}

Point slid(const Point& v, const Point& n) { return v - n * v.dot(n); }

/// The motion nearest to a wanted one that all surfaces allow: that itself, its foot on one surface, or none at all.
Point nearest_allowed(const Point& wanted, Touches touched) {
  if (!enters_any(wanted, touched)) return wanted;
  std::optional<Point> nearest;
  for (const Touch& at : touched) {
    if (!enters(wanted, at)) continue;
    const Point foot = slid(wanted, at.normal);
    if (enters_any(foot, touched)) continue;
    if (!nearest || (foot - wanted).norm() < (*nearest - wanted).norm()) nearest = foot;
  }
  return nearest.value_or(Point{});
}

/// The surface that the motion enters and whose normal points up most; null if it enters none.
const Touch* most_level_entered(const Point& v, Touches touched) {
  const Touch* found = nullptr;
  for (const Touch& at : touched)
    if (enters(v, at) && (found == nullptr || at.normal.y() > found->normal.y())) found = &at;
  return found;
}

/// octagon_sweep's answer to one surface.
Point answer(Point v, const Touch& at, Touches touched, bool after_walk) {
  const Point& n = at.normal;
  if (at.walkable) return {v.x(), -v.x() * n.x() / n.y()};
  if (n.y() < 0) {
    if (v.y() > 0) return after_walk ? Point{} : slid(v, n);
    return {-v.y() * n.y() / n.x(), v.y()};
  }
  if (v.x() * n.x() < 0) {
    v.x() = 0;
    if (after_walk && v.y() > 0) v.y() = 0;
    if (const Touch* ground = most_level_entered(v, touched); ground != nullptr && ground->walkable) return {};
  }
  return enters(v, at) ? slid(v, n) : v;
}

/// Between surfaces that both stop a motion: the fall goes on between them, or the motion ends.
Point slipped(const Real& fall, Touches held) {
  if (fall >= 0 || std::ranges::any_of(held, [](const Touch& at) { return at.walkable; })) return {};
  const Point way = nearest_allowed(Point{0, fall}, held);
  return way.y() < 0 ? way : Point{};
}

Point after_impact_of_octagon(Point v, Touches touched, bool stood) {
  const Real fall = v.y();
  bool after_walk = stood;
  std::vector<Touch> held;
  while (const Touch* at = most_level_entered(v, touched)) {
    const bool again = std::ranges::any_of(held, [&](const auto& one) { return one.facet == at->facet; });
    if (again) return {};
    held.push_back(*at);
    v = answer(v, *at, touched, after_walk);
    after_walk = after_walk || at->walkable;
    if (enters_any(v, held)) v = slipped(fall, held);
  }
  return v;
}

/// The acceleration along one surface that is pressed upon by octagon_sweep's law.
Point along(const Touch& at, const Forces& forces, const Real& steering) {
  const Point& n = at.normal;
  if (at.walkable) return {steering, -steering * n.x() / n.y()};
  const Point gravity{0, -forces.fall};
  if (n.y() < 0 && forces.velocity.y() <= 0) return {forces.fall * n.y() / n.x(), -forces.fall};
  if (n.y() >= 0 && steering * n.x() < 0) return gravity.dot(n) < 0 ? slid(gravity, n) : gravity;
  return slid(Point{steering, -forces.fall}, n);
}

std::vector<std::size_t> held_by(const Point& acceleration, const Point& pressing, Touches touched) {
  std::vector<std::size_t> held;
  for (const Touch& at : touched)
    if (enters(pressing, at) &&
        abs(acceleration.dot(at.normal)) <= tolerance_for(acceleration) + tolerance_for(pressing))
      held.push_back(at.facet);
  return held;
}

/// Surfaces of which each keeps the acceleration along the other from happening.
Hold between(const Forces& forces, Touches running, bool on_ground) {
  const Point gravity{0, -forces.fall};
  const Point slip = on_ground ? Point{} : nearest_allowed(gravity, running);
  if (slip.y() < 0) return {slip, held_by(slip, gravity, running), false, false};
  return {Point{}, {}, on_ground || forces.fall > 0, false};
}

/// What steering and gravity do without surfaces. The climb of a walk that brakes slows with the walk.
Point unheld(const Forces& forces, const Real& steering, bool on_ground) {
  const Point& v = forces.velocity;
  const bool brakes_uphill = on_ground && v.y() > 0 && steering * v.x() < 0;
  return {steering, brakes_uphill ? steering * v.y() / v.x() - forces.fall : -forces.fall};
}

/// octagon_sweep's law. Nothing where whether it stands is not as `on_ground` says.
std::optional<Hold> held_by_octagon(const Forces& forces, const Real& steering, Touches running, bool on_ground) {
  const Point pressing = unheld(forces, steering, on_ground);
  std::vector<Touch> pressed;
  for (const Touch& at : running)
    if (enters(pressing, at)) pressed.push_back(at);
  const bool any_walkable = std::ranges::any_of(pressed, [](const auto& at) { return at.walkable; });
  if (any_walkable != on_ground) return std::nullopt;
  if (pressed.empty()) return Hold{pressing};
  std::ranges::stable_sort(pressed, [](const auto& a, const auto& b) { return a.normal.y() > b.normal.y(); });
  for (const Touch& at : pressed) {
    const Point acceleration = along(at, forces, steering);
    if (!enters_any(acceleration, running))
      return Hold{acceleration, held_by(acceleration, pressing, running), at.walkable, false};
  }
  return between(forces, running, on_ground);
}

/// Box2D's law, in the same way.
std::optional<Hold> held_without_friction(const Forces& forces, const Real& steering, Touches running, bool on_ground) {
  const Point pressing = unheld(forces, steering, on_ground);
  Hold hold{nearest_allowed(pressing, running)};
  hold.facets = held_by(hold.acceleration, pressing, running);
  for (const Touch& at : running) hold.stands = hold.stands || (at.walkable && contains(hold.facets, at.facet));
  return hold.stands == on_ground ? std::optional(hold) : std::nullopt;
}

/// @param direction of steering: -1, 0 or 1.
Hold held_while_steering(Law law, const Forces& forces, int direction, Touches running) {
  const auto by = law == Law::octagon_sweep ? held_by_octagon : held_without_friction;
  if (auto hold = by(forces, forces.on_ground * direction, running, true)) return *hold;
  if (auto hold = by(forces, forces.in_air * direction, running, false)) return *hold;
  return {.acceleration = Point{}, .chatters = true};
}

/// At the wanted speed: see Filippov in law.hpp.
Hold held_at_wanted_speed(Law law, const Forces& forces, Touches running) {
  const Hold led = held_while_steering(law, forces, 0, running);
  if (led.chatters || abs(led.acceleration.x()) <= tolerance_for(led.acceleration)) return led;
  const int back = led.acceleration.x() > 0 ? -1 : 1;
  Hold steered = held_while_steering(law, forces, back, running);
  if (steered.chatters || steered.acceleration.x() * back <= 0) return steered;
  const Real share = led.acceleration.x() / (led.acceleration.x() - steered.acceleration.x());
  steered.acceleration = steered.acceleration * share + led.acceleration * (1 - share);
  return steered;
}

/// Those that the velocity runs along. A corner that it leaves on one side is none any more.
std::vector<Touch> run_along(const Point& velocity, Touches touched) {
  const Real tolerance = tolerance_for(velocity);
  std::vector<Touch> running;
  for (Touch at : touched) {
    if (abs(velocity.dot(at.normal)) > tolerance) continue;
    const Real into_other = at.corner ? velocity.dot(*at.corner) : Real(0);
    if (into_other > tolerance) continue;
    if (into_other < -tolerance) at.corner.reset();
    running.push_back(at);
  }
  return running;
}

}  // namespace

Point after_impact(Law law, Point velocity, Touches touched, bool stood) {
  if (law == Law::frictionless) return nearest_allowed(velocity, touched);
  return after_impact_of_octagon(velocity, touched, stood);
}

StepMotion after_impact(Law law, const StepMotion& step, Touches touched, bool stood) {
  if (!enters_any(step.velocity, touched)) return step;
  const Point whole = step.momentum + Point{step.steered, 0};
  const auto opposes = [&](const Touch& at) {
    return at.normal.y() >= 0 && step.steered * at.normal.x() < 0 && enters(whole, at);
  };
  const auto lands = [&](const Point& v) {
    const Touch* const ground = most_level_entered(v, touched);
    return ground != nullptr && ground->walkable;
  };
  if (law == Law::frictionless || lands(whole) || lands(step.momentum) || std::ranges::none_of(touched, opposes)) {
    const Point after = after_impact(law, whole, touched, stood);
    return {after, after, Real(0)};
  }
  const Point momentum = after_impact(law, step.momentum, touched, stood);
  Point after = momentum + Point{step.steered, 0};
  for (const Touch& at : touched)
    if (opposes(at) && after.dot(at.normal) < 0) after.x() = -after.y() * at.normal.y() / at.normal.x();
  return {enters_any(after, touched) ? momentum : after, momentum, step.steered};
}

Point without_climb(Law law, Point velocity, Touches touched) {
  if (law == Law::frictionless) return velocity;
  for (const Touch& at : run_along(velocity, touched))
    if (!at.walkable && at.normal.y() > 0 && velocity.x() * at.normal.x() < -tolerance_for(velocity)) velocity.x() = 0;
  return velocity;
}

Hold acceleration_of(Law law, const Forces& forces, Touches touched) {
  const std::vector<Touch> running = run_along(forces.velocity, touched);
  if (abs(forces.missing) <= tolerance_for(forces.velocity)) return held_at_wanted_speed(law, forces, running);
  return held_while_steering(law, forces, forces.missing > 0 ? 1 : -1, running);
}

}  // namespace paperproof::compare::continuous
