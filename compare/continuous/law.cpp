#include "continuous/law.hpp"

#include <algorithm>
#include <optional>

namespace paperproof::compare::continuous {
namespace {

template <class Real>
using Touches = std::span<const Touch<Real>>;

template <class Real>
Real tolerance_for(const Point<Real>& v) {
  return same<Real>() * (1 + abs(v.x) + abs(v.y));
}

template <class Real>
bool enters(const Point<Real>& v, const Touch<Real>& at) {
  const Real tolerance = tolerance_for(v);
  const Real into = dot(v, at.normal);
  if (!at.corner) return into < -tolerance;
  const Real into_other = dot(v, *at.corner);
  return into < -tolerance && into_other < -tolerance && into >= into_other - tolerance;
}

template <class Real>
bool enters_any(const Point<Real>& v, Touches<Real> touched) {
  return std::any_of(touched.begin(), touched.end(), [&](const Touch<Real>& at) { return enters(v, at); });
}

template <class Real>
Point<Real> slid(const Point<Real>& v, const Point<Real>& n) {
  return v - n * dot(v, n);
}

/// The motion nearest to a wanted one that all surfaces allow: that itself, its foot on one surface, or none at all.
template <class Real>
Point<Real> nearest_allowed(const Point<Real>& wanted, Touches<Real> touched) {
  if (!enters_any(wanted, touched)) return wanted;
  std::optional<Point<Real>> nearest;
  for (const Touch<Real>& at : touched) {
    if (!enters(wanted, at)) continue;
    const Point<Real> foot = slid(wanted, at.normal);
    if (enters_any(foot, touched)) continue;
    if (!nearest || length_of(foot - wanted) < length_of(*nearest - wanted)) nearest = foot;
  }
  return nearest.value_or(Point<Real>{});
}

/// The surface that the motion enters and whose normal points up most; null if it enters none.
template <class Real>
const Touch<Real>* most_level_entered(const Point<Real>& v, Touches<Real> touched) {
  const Touch<Real>* found = nullptr;
  for (const Touch<Real>& at : touched)
    if (enters(v, at) && (found == nullptr || at.normal.y > found->normal.y)) found = &at;
  return found;
}

/// octagon_sweep's answer to one surface.
template <class Real>
Point<Real> answer(Point<Real> v, const Touch<Real>& at, Touches<Real> touched, bool after_walk) {
  const Point<Real>& n = at.normal;
  if (at.walkable) return {v.x, -v.x * n.x / n.y};
  if (n.y < 0) {
    if (v.y > 0) return after_walk ? Point<Real>{} : slid(v, n);
    return {-v.y * n.y / n.x, v.y};
  }
  if (v.x * n.x < 0) {
    v.x = 0;
    if (after_walk && v.y > 0) v.y = 0;
    if (const Touch<Real>* ground = most_level_entered(v, touched); ground != nullptr && ground->walkable) return {};
  }
  return enters(v, at) ? slid(v, n) : v;
}

/// Between surfaces that both stop a motion: the fall goes on between them, or the motion ends.
template <class Real>
Point<Real> slipped(const Real& fall, Touches<Real> held) {
  if (fall >= 0 || std::any_of(held.begin(), held.end(), [](const Touch<Real>& at) { return at.walkable; })) return {};
  const Point<Real> way = nearest_allowed(Point<Real>{0, fall}, held);
  return way.y < 0 ? way : Point<Real>{};
}

template <class Real>
Point<Real> after_impact_of_octagon(Point<Real> v, Touches<Real> touched, bool stood) {
  const Real fall = v.y;
  bool after_walk = stood;
  std::vector<Touch<Real>> held;
  while (const Touch<Real>* at = most_level_entered(v, touched)) {
    const bool again = std::any_of(held.begin(), held.end(), [&](const auto& one) { return one.facet == at->facet; });
    if (again) return {};
    held.push_back(*at);
    v = answer(v, *at, touched, after_walk);
    after_walk = after_walk || at->walkable;
    if (enters_any<Real>(v, held)) v = slipped<Real>(fall, held);
  }
  return v;
}

/// The acceleration along one surface that is pressed upon by octagon_sweep's law.
template <class Real>
Point<Real> along(const Touch<Real>& at, const Forces<Real>& forces, const Real& steering) {
  const Point<Real>& n = at.normal;
  if (at.walkable) return {steering, -steering * n.x / n.y};
  const Point<Real> gravity{0, -forces.fall};
  if (n.y < 0 && forces.velocity.y <= 0) return {forces.fall * n.y / n.x, -forces.fall};
  if (n.y >= 0 && steering * n.x < 0) return dot(gravity, n) < 0 ? slid(gravity, n) : gravity;
  return slid(Point<Real>{steering, -forces.fall}, n);
}

template <class Real>
std::vector<std::size_t> held_by(const Point<Real>& acceleration, const Point<Real>& pressing, Touches<Real> touched) {
  std::vector<std::size_t> held;
  for (const Touch<Real>& at : touched)
    if (enters(pressing, at) &&
        abs(dot(acceleration, at.normal)) <= tolerance_for(acceleration) + tolerance_for(pressing))
      held.push_back(at.facet);
  return held;
}

/// Surfaces of which each keeps the acceleration along the other from happening.
template <class Real>
Hold<Real> between(const Forces<Real>& forces, Touches<Real> running, bool on_ground) {
  const Point<Real> gravity{0, -forces.fall};
  const Point<Real> slip = on_ground ? Point<Real>{} : nearest_allowed<Real>(gravity, running);
  if (slip.y < 0) return {slip, held_by(slip, gravity, running), false, false};
  return {Point<Real>{}, {}, on_ground || forces.fall > 0, false};
}

/// What steering and gravity do without surfaces. The climb of a walk that brakes slows with the walk.
template <class Real>
Point<Real> unheld(const Forces<Real>& forces, const Real& steering, bool on_ground) {
  const Point<Real>& v = forces.velocity;
  const bool brakes_uphill = on_ground && v.y > 0 && steering * v.x < 0;
  return {steering, brakes_uphill ? steering * v.y / v.x - forces.fall : -forces.fall};
}

/// octagon_sweep's law. Nothing where whether it stands is not as `on_ground` says.
template <class Real>
std::optional<Hold<Real>> held_by_octagon(const Forces<Real>& forces, const Real& steering, Touches<Real> running,
                                          bool on_ground) {
  const Point<Real> pressing = unheld(forces, steering, on_ground);
  std::vector<Touch<Real>> pressed;
  for (const Touch<Real>& at : running)
    if (enters(pressing, at)) pressed.push_back(at);
  const bool any_walkable = std::any_of(pressed.begin(), pressed.end(), [](const auto& at) { return at.walkable; });
  if (any_walkable != on_ground) return std::nullopt;
  if (pressed.empty()) return Hold<Real>{pressing};
  std::stable_sort(pressed.begin(), pressed.end(),
                   [](const auto& a, const auto& b) { return a.normal.y > b.normal.y; });
  for (const Touch<Real>& at : pressed) {
    const Point<Real> acceleration = along(at, forces, steering);
    if (!enters_any<Real>(acceleration, running))
      return Hold<Real>{acceleration, held_by(acceleration, pressing, running), at.walkable, false};
  }
  return between(forces, running, on_ground);
}

/// Box2D's law, in the same way.
template <class Real>
std::optional<Hold<Real>> held_without_friction(const Forces<Real>& forces, const Real& steering, Touches<Real> running,
                                                bool on_ground) {
  const Point<Real> pressing = unheld(forces, steering, on_ground);
  Hold<Real> hold{nearest_allowed(pressing, running)};
  hold.facets = held_by(hold.acceleration, pressing, running);
  for (const Touch<Real>& at : running)
    hold.stands = hold.stands || (at.walkable && std::count(hold.facets.begin(), hold.facets.end(), at.facet) > 0);
  return hold.stands == on_ground ? std::optional(hold) : std::nullopt;
}

/// @param direction of steering: -1, 0 or 1.
template <class Real>
Hold<Real> held_while_steering(Law law, const Forces<Real>& forces, int direction, Touches<Real> running) {
  const auto by = law == Law::octagon_sweep ? held_by_octagon<Real> : held_without_friction<Real>;
  if (auto hold = by(forces, forces.on_ground * direction, running, true)) return *hold;
  if (auto hold = by(forces, forces.in_air * direction, running, false)) return *hold;
  Hold<Real> chattering;
  chattering.chatters = true;
  return chattering;
}

/// At the wanted speed: see Filippov in law.hpp.
template <class Real>
Hold<Real> held_at_wanted_speed(Law law, const Forces<Real>& forces, Touches<Real> running) {
  const Hold<Real> led = held_while_steering(law, forces, 0, running);
  if (led.chatters || abs(led.acceleration.x) <= tolerance_for(led.acceleration)) return led;
  const int back = led.acceleration.x > 0 ? -1 : 1;
  Hold<Real> steered = held_while_steering(law, forces, back, running);
  if (steered.chatters || steered.acceleration.x * back <= 0) return steered;
  const Real share = led.acceleration.x / (led.acceleration.x - steered.acceleration.x);
  steered.acceleration = steered.acceleration * share + led.acceleration * (1 - share);
  return steered;
}

/// Those that the velocity runs along. A corner that it leaves on one side is none any more.
template <class Real>
std::vector<Touch<Real>> run_along(const Point<Real>& velocity, Touches<Real> touched) {
  const Real tolerance = tolerance_for(velocity);
  std::vector<Touch<Real>> running;
  for (Touch<Real> at : touched) {
    if (abs(dot(velocity, at.normal)) > tolerance) continue;
    const Real into_other = at.corner ? dot(velocity, *at.corner) : Real(0);
    if (into_other > tolerance) continue;
    if (into_other < -tolerance) at.corner.reset();
    running.push_back(at);
  }
  return running;
}

}  // namespace

template <class Real>
Point<Real> after_impact(Law law, Point<Real> velocity, Touches<Real> touched, bool stood) {
  if (law == Law::frictionless) return nearest_allowed(velocity, touched);
  return after_impact_of_octagon(velocity, touched, stood);
}

template <class Real>
StepMotion<Real> after_impact(Law law, const StepMotion<Real>& step, Touches<Real> touched, bool stood) {
  if (!enters_any(step.velocity, touched)) return step;
  const Point<Real> whole = step.momentum + Point<Real>{step.steered, 0};
  const auto opposes = [&](const Touch<Real>& at) {
    return at.normal.y >= 0 && step.steered * at.normal.x < 0 && enters(whole, at);
  };
  const auto lands = [&](const Point<Real>& v) {
    const Touch<Real>* const ground = most_level_entered(v, touched);
    return ground != nullptr && ground->walkable;
  };
  if (law == Law::frictionless || lands(whole) || lands(step.momentum) ||
      std::none_of(touched.begin(), touched.end(), opposes)) {
    const Point<Real> after = after_impact<Real>(law, whole, touched, stood);
    return {after, after, Real(0)};
  }
  const Point<Real> momentum = after_impact<Real>(law, step.momentum, touched, stood);
  Point<Real> after = momentum + Point<Real>{step.steered, 0};
  for (const Touch<Real>& at : touched)
    if (opposes(at) && dot(after, at.normal) < 0) after.x = -after.y * at.normal.y / at.normal.x;
  return {enters_any<Real>(after, touched) ? momentum : after, momentum, step.steered};
}

template <class Real>
Point<Real> without_climb(Law law, Point<Real> velocity, Touches<Real> touched) {
  if (law == Law::frictionless) return velocity;
  for (const Touch<Real>& at : run_along(velocity, touched))
    if (!at.walkable && at.normal.y > 0 && velocity.x * at.normal.x < -tolerance_for(velocity)) velocity.x = 0;
  return velocity;
}

template <class Real>
Hold<Real> acceleration_of(Law law, const Forces<Real>& forces, Touches<Real> touched) {
  const std::vector<Touch<Real>> running = run_along(forces.velocity, touched);
  if (abs(forces.missing) <= tolerance_for(forces.velocity)) return held_at_wanted_speed<Real>(law, forces, running);
  return held_while_steering<Real>(law, forces, forces.missing > 0 ? 1 : -1, running);
}

template Point<Number<30>> after_impact(Law, Point<Number<30>>, Touches<Number<30>>, bool);
template StepMotion<Number<30>> after_impact(Law, const StepMotion<Number<30>>&, Touches<Number<30>>, bool);
template Point<Number<30>> without_climb(Law, Point<Number<30>>, Touches<Number<30>>);
template Hold<Number<30>> acceleration_of(Law, const Forces<Number<30>>&, Touches<Number<30>>);
template Point<Number<50>> after_impact(Law, Point<Number<50>>, Touches<Number<50>>, bool);
template StepMotion<Number<50>> after_impact(Law, const StepMotion<Number<50>>&, Touches<Number<50>>, bool);
template Point<Number<50>> without_climb(Law, Point<Number<50>>, Touches<Number<50>>);
template Hold<Number<50>> acceleration_of(Law, const Forces<Number<50>>&, Touches<Number<50>>);
template Point<Number<70>> after_impact(Law, Point<Number<70>>, Touches<Number<70>>, bool);
template StepMotion<Number<70>> after_impact(Law, const StepMotion<Number<70>>&, Touches<Number<70>>, bool);
template Point<Number<70>> without_climb(Law, Point<Number<70>>, Touches<Number<70>>);
template Hold<Number<70>> acceleration_of(Law, const Forces<Number<70>>&, Touches<Number<70>>);

}  // namespace paperproof::compare::continuous
