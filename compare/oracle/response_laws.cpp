#include "oracle/response_laws.hpp"

#include "oracle/up.hpp"
#include "words.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>

namespace paperproof::compare {
namespace {

using namespace surfaces;

/// Velocities of the law of octagon_sweep are the same within this share of the largest one that they are made of: they
/// are in double.
constexpr double same_velocity = 1e-9;
/// Share of a velocity that is rounding where up is slanted.
constexpr double in_double = 1e-14;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Whether a velocity rises under a ceiling: then it slides there.
bool rises_under(const Vec2d& v, const MetSurface& at) {
  return at.normal.y() < 0 && v.y() - at.velocity.y() > in_double * std::max(1.0, (v - at.velocity).norm());
}

/// A velocity that is wanted, and the part of it that is there without this step's steering [m/s].
struct Steered {
  Vec2d wanted;
  Vec2d unsteered;
};

/// The speed upwards of a walk along the ground that has the speed `x` across.
double rise_at(double x, const MetSurface& ground) {
  return follow(x - ground.velocity.x(), ground.normal).y() + ground.velocity.y();
}

/// Across at `x`, on the ground or above it at `y`; nothing where that enters a surface, or has no height.
std::optional<Vec2d> walked_to(double x, double y, std::span<const MetSurface> surfaces) {
  for (const MetSurface& at : surfaces)
    if (at.walkable) y = std::max(y, rise_at(x, at));
  const Vec2d v(x, y);
  const auto is_in = [&](const MetSurface& at) { return !at.walkable && enters(v, at); };
  if (!std::isfinite(y) || std::ranges::any_of(surfaces, is_in)) return std::nullopt;
  return v;
}

/// The same, as near to `x` across as the surfaces allow between two ends.
std::optional<Vec2d> walked_towards(double x, double y, double begin, double end,
                                    std::span<const MetSurface> surfaces) {
  std::vector<double> places{x};
  for (const MetSurface& at : surfaces) {
    if (at.walkable) continue;
    const auto level = std::isfinite(y) ? held_by(at, {.normal = {0, 1}, .velocity = {0, y}}) : std::nullopt;
    if (level) places.push_back(level->x());
    for (const MetSurface& ground : surfaces)
      if (const auto held = ground.walkable ? held_by(at, ground) : std::nullopt) places.push_back(held->x());
  }
  std::erase_if(places, [&](double place) { return place < std::min(begin, end) || place > std::max(begin, end); });
  std::ranges::stable_sort(places, [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
  for (const double place : places)
    if (const std::optional<Vec2d> v = walked_to(place, y, surfaces)) return v;
  return std::nullopt;
}

/// An impact ends the momentum that presses into a surface which nobody walks on. Steering against it is spent first.
/// @param came the velocity that came to all surfaces. @param u what the others have left of it.
/// @return the velocity that is left.
Vec2d after_impact(const Vec2d& came, Vec2d u, const MetSurface& at, std::span<const MetSurface> surfaces,
                   double& steering) {
  const Vec2d& n = at.normal;
  const double towards = n.x() < 0 ? 1 : -1;  // across, into the surface
  if (!enters(came, at) || !enters(u, at) || n.x() == 0 || rises_under(u, at) ||
      !(towards * (u.x() - at.velocity.x()) > 0))
    return u;
  if (towards * steering < 0) {
    const double braked = std::min(towards * (u.x() - at.velocity.x()), -towards * steering);
    u.x() -= towards * braked;
    steering += towards * braked;
  }
  double end = towards * at.velocity.x();
  if (n.y() < 0) end = std::max(end, towards * (at.velocity.dot(n) - n.y() * u.y()) / n.x());
  for (const MetSurface& other : surfaces)
    if (const auto held = other.normal.x() * n.x() < 0 && other.normal.y() > 0 ? held_by(at, other) : std::nullopt)
      end = std::max(end, towards * held->x());
  u.x() = towards * std::min(towards * u.x(), end);
  return u;
}

/// Whether steering slides along with the momentum: it presses into no slope and no wall, and under a ceiling there is
/// a rise.
bool slides_along(double steering, const Vec2d& u, std::span<const MetSurface> surfaces) {
  const Vec2d w = u + Vec2d(steering, 0);
  const auto presses = [&](const MetSurface& at) {
    return !at.walkable && steering * at.normal.x() < 0 && !rises_under(u, at);
  };
  return std::ranges::none_of(surfaces, presses) &&
         std::ranges::any_of(surfaces, [&](const auto& at) { return !at.walkable && enters(w, at); });
}

/// What surfaces make of a velocity that are touched at once; nothing where they leave none.
/// @param steering what steering added, horizontally; what brakes is spent. @param climbs a rise is the climb of a
/// walk.
std::optional<Steered> respond(const Steered& velocity, double& steering, bool climbs,
                               std::span<const MetSurface> surfaces) {
  Vec2d u = velocity.unsteered;
  bool is_free = true;
  for (const MetSurface& at : surfaces) {
    if (!enters(velocity.wanted, at)) continue;
    is_free = false;
    if (climbs && !at.walkable) u.y() = std::min(u.y(), at.velocity.y());
  }
  if (is_free) return velocity;
  const Vec2d came = u;
  for (const MetSurface& at : surfaces)
    if (!at.walkable) u = after_impact(came, u, at, surfaces, steering);
  const bool lands = std::ranges::any_of(surfaces, [&](const MetSurface& at) { return at.walkable && enters(u, at); });
  if (!lands && slides_along(steering, u, surfaces)) {
    u.x() += steering;
    steering = 0;
  }
  const auto walk = lands ? walked_towards(u.x(), -infinity, -infinity, infinity, surfaces) : std::nullopt;
  const std::optional<Vec2d> base = walk ? walk : nearest_allowed(u, surfaces);
  if (!base) return std::nullopt;
  const double x = base->x() + steering;
  const double y = walk ? std::min(u.y(), base->y()) : base->y();
  const auto steered = steering != 0 ? walked_towards(x, y, base->x(), x, surfaces) : std::nullopt;
  return Steered{steered.value_or(*base), *base};
}

/// What a trace does not say.
struct Unknown {
  bool met_at_end = false;             ///< Rounding decides that surfaces touched at the end were met.
  bool carried = false;                ///< A landing without horizontal speed is carried at once.
  bool one_by_one = false;             ///< Surfaces met at one time act one after another, with no way between.
  bool bears_beside = false;           ///< Ground that the character is beside bears it: there is no way to fall.
  Vec2d falls_along = Vec2d::UnitY();  ///< A fall that nothing holds.
};

bool is_at_end(const MetSurface& at) { return at.met >= 1; }
bool is_ground_beside(const MetSurface& at) { return at.walkable && at.is_beside; }
bool may_carry(const MetSurface& at) { return at.walkable && !at.ridden && at.velocity != Vec2d::Zero(); }

/// Surfaces of which one pushes leave no larger speed of a velocity that comes to them [m/s]: its own, with or without
/// steering, which is along its ground if it walks; or twice that of the fastest of them. So fast a wall pushes up a
/// slope of 60 degrees. How fast a wall goes along itself decides nothing: it pushes along its normal alone.
double most_pressed(const Steered& came, std::span<const MetSurface> held) {
  const auto pushes = [](const MetSurface& at) { return at.velocity.dot(at.normal) > 0; };
  const auto is_other = [&](const MetSurface& at) {
    return std::abs(cross_of(at.normal, held[0].normal)) > one_direction;
  };
  if (std::ranges::none_of(held, pushes) || std::ranges::none_of(held, is_other)) return infinity;
  double most = 0;
  for (const Vec2d& velocity : {came.wanted, came.unsteered}) {
    most = std::max(most, velocity.norm());
    for (const MetSurface& at : held)
      if (at.walkable) most = std::max(most, std::abs(velocity.x()) / at.normal.y());
  }
  for (const MetSurface& at : held)
    most = std::max(most, 2 * (at.walkable ? at.velocity.norm() : std::abs(at.velocity.dot(at.normal))));
  return most;
}

/// Whether surfaces on both sides that nobody walks on, and that go almost alike, leave hardly anything of a fall; or
/// some beside which the character is.
bool hold_fall(std::span<const MetSurface> held, const Vec2d& left, double fall) {
  const MetSurface& first =
      *std::ranges::max_element(held, [](const auto& a, const auto& b) { return a.normal.y() < b.normal.y(); });
  const double hardly = 0.1 * (first.velocity.y() - fall);
  const auto goes_alike = [&](const MetSurface& at) {
    return (!at.walkable || at.is_beside) && (at.velocity - first.velocity).norm() <= hardly;
  };
  const auto is_at = [&](double side) {
    return std::ranges::any_of(held, [&](const auto& at) { return side * at.normal.x() > 0; });
  };
  const bool beside = std::ranges::any_of(held, is_ground_beside);
  return held.size() > 1 && hardly > 0 && first.normal.y() > 0 && (beside || (is_at(-1) && is_at(1))) &&
         (left - first.velocity).norm() <= hardly && std::ranges::all_of(held, goes_alike);
}

/// As an upright character sees it. Surfaces that are met at one moment are answered together with all that still hold.
Vec2d controlled(const Steered& velocity, std::span<const MetSurface> surfaces, const Unknown& unknown) {
  Steered now = velocity;
  double steering = (velocity.wanted - velocity.unsteered).x();
  double fall = velocity.unsteered.y();
  std::vector<MetSurface> held;
  for (std::size_t k = 0; k < surfaces.size();) {
    const MetSurface& at = surfaces[k];
    const bool goes_on = k > 0 && surfaces[k - 1].met < at.met;
    std::vector<MetSurface> rims;  // touched here for the last time
    std::ranges::copy_if(held, std::back_inserter(rims),
                         [&](const MetSurface& one) { return one.past_rim && one.left == at.met; });
    std::erase_if(held, [&](const MetSurface& one) { return one.left <= at.met; });
    do {
      if (!is_at_end(surfaces[k]) || unknown.met_at_end) held.push_back(surfaces[k]);
      ++k;
    } while (k < surfaces.size() && surfaces[k].met == at.met && !unknown.one_by_one);
    if (held.empty()) continue;
    if (goes_on) fall = now.unsteered.y();
    const Steered came = now;
    // One that runs along ground may have landed on it: rounding decides.
    if (unknown.carried && may_carry(held.back()) && !leaves(came.wanted, held.back()) &&
        std::abs(came.wanted.x()) <= grazing * came.wanted.norm()) {
      now = {held.back().velocity, held.back().velocity};
      steering = 0;
    }
    const Steered rest{Vec2d::Zero(), Vec2d::Zero()};
    rims.insert(rims.end(), held.begin(), held.end());
    double spent = steering;
    const Steered between = respond(now, spent, at.climbs, rims).value_or(rest);
    now = respond(now, steering, at.climbs, held).value_or(rest);
    const bool all_left = std::ranges::all_of(rims, [](const MetSurface& one) { return one.left <= 1; });
    const bool borne = unknown.bears_beside && std::ranges::any_of(rims, is_ground_beside);
    if (all_left && !borne && hold_fall(rims, between.unsteered, fall)) {
      const Vec2d falls = unknown.falls_along * (unknown.falls_along.y() * fall);
      now = {falls, falls};
    }
    const double share = std::min(1.0, most_pressed(came, held) / now.wanted.norm());
    now = {now.wanted * share, now.unsteered * share};
  }
  return now.wanted;
}

/// What the trace leaves open of these surfaces.
/// @param sides see `ControlledStep`.
std::vector<Unknown> ways(std::span<const MetSurface> surfaces, std::span<const Vec2d> sides) {
  const bool any_at_end = std::ranges::any_of(surfaces, is_at_end);
  const bool any_carries = std::ranges::any_of(surfaces, may_carry);
  const bool any_at_once = std::ranges::adjacent_find(
                               surfaces, [](const auto& a, const auto& b) { return a.met == b.met; }) != surfaces.end();
  std::vector<Unknown> all;
  for (const bool met_at_end : {false, true})
    for (const bool carried : {false, true})
      for (const bool one_by_one : {false, true})
        if (met_at_end <= any_at_end && carried <= any_carries && one_by_one <= any_at_once)
          all.push_back({met_at_end, carried, one_by_one});
  if (std::ranges::any_of(surfaces, is_ground_beside)) {
    std::vector<Unknown> borne = all;
    for (Unknown& unknown : borne) unknown.bears_beside = true;
    all.insert(all.end(), borne.begin(), borne.end());
  }
  const std::size_t upright = all.size();
  for (std::size_t k = 0; k < upright && surfaces.size() > 1; ++k)
    for (const Vec2d& side : sides) {
      all.push_back(all[k]);
      all.back().falls_along = side;
    }
  return all;
}

/// All that the law can make, as an upright character sees it.
/// @param sides see `ControlledStep`.
std::vector<Vec2d> upright_outcomes(const Steered& velocity, std::span<const MetSurface> surfaces,
                                    std::span<const Vec2d> sides) {
  std::vector<Vec2d> outcomes;
  for (const Unknown& unknown : ways(surfaces, sides)) {
    const Vec2d met = outcomes.emplace_back(controlled(velocity, surfaces, unknown));
    for (const MetSurface& at : surfaces)
      if (at.walkable && (is_at_end(at) || at.returned))
        outcomes.emplace_back(follow((met - at.velocity).x(), at.normal) + at.velocity);
  }
  return outcomes;
}

}  // namespace

std::vector<Vec2d> controlled_outcomes(const ControlledStep& step, std::span<const MetSurface> surfaces) {
  std::vector<MetSurface> upright(surfaces.begin(), surfaces.end());
  for (MetSurface& at : upright) {
    at.normal = seen(at.normal, step.up);
    at.velocity = seen(at.velocity, step.up);
  }
  const bool ends_rise =
      step.side_hit_ends_rise && std::ranges::any_of(surfaces, [](const MetSurface& at) { return at.is_side; });
  std::vector<Vec2d> sides = step.sides;
  for (Vec2d& side : sides) side = seen(side, step.up);
  std::vector<Vec2d> outcomes =
      upright_outcomes({seen(step.wanted, step.up), seen(step.unsteered, step.up)}, upright, sides);
  for (Vec2d& outcome : outcomes) {
    if (ends_rise) outcome.y() = std::min(outcome.y(), 0.0);
    outcome = in_world(outcome, step.up);
  }
  return outcomes;
}

std::optional<std::string> velocity_fault(const ControlledStep& step, std::span<const MetSurface> surfaces,
                                          const Vec2d& velocity) {
  double largest = std::max(1.0, step.wanted.norm());
  double unknown = 0;
  for (const MetSurface& at : surfaces) {
    largest = std::max(largest, at.velocity.norm());
    unknown += at.spread;
  }
  unknown += same_velocity * largest;
  const std::vector<Vec2d> outcomes = controlled_outcomes(step, surfaces);
  const double off = distance_from(outcomes, velocity);
  if (off <= unknown) return std::nullopt;
  const Vec2d& made = outcomes.front();
  std::ostringstream fault;
  fault.precision(9);
  fault << "ends with (" << velocity.x() << ", " << velocity.y() << ") m/s; of (" << step.wanted.x() << ", "
        << step.wanted.y() << ") the law makes (" << made.x() << ", " << made.y() << ") at "
        << counted(surfaces.size(), "surface");
  return fault.str();
}

double distance_from(std::span<const Vec2d> outcomes, const Vec2d& velocity) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2d& outcome : outcomes) least = std::min(least, (outcome - velocity).norm());
  return least;
}

}  // namespace paperproof::compare
