#include "oracle/response_laws.hpp"

#include "oracle/up.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <limits>
#include <optional>
#include <sstream>

namespace paperproof::compare {
namespace {

/// A velocity that enters a surface by no more than this share of its length runs along it.
constexpr double grazing = 1e-9;
/// Normals whose cross product is smaller are of one direction.
constexpr double one_direction = 1e-9;
/// Velocities of the law of octagon_sweep are the same within this share of the largest one that they are made of: they
/// are in double.
constexpr double same_velocity = 1e-9;
/// Share of a velocity that is rounding in Box2D.
constexpr double in_float = 1e-5;
/// Share of a velocity that is rounding where up is slanted.
constexpr double in_double = 1e-14;
constexpr double infinity = std::numeric_limits<double>::infinity();

double cross(const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x(); }

double entering(const Vec2d& v, const MetSurface& at) { return (v - at.velocity).dot(at.normal); }

bool enters(const Vec2d& v, const MetSurface& at) {
  return entering(v, at) < -grazing * std::max(1.0, (v - at.velocity).norm());
}

Vec2d slid(const Vec2d& v, const MetSurface& at) { return v - entering(v, at) * at.normal; }

/// The velocity that neither enters nor leaves either of two surfaces.
std::optional<Vec2d> held_by(const MetSurface& a, const MetSurface& b) {
  const double determinant = cross(a.normal, b.normal);
  if (std::abs(determinant) < one_direction) return std::nullopt;
  const double of_a = a.velocity.dot(a.normal);
  const double of_b = b.velocity.dot(b.normal);
  return Vec2d((of_a * b.normal.y() - of_b * a.normal.y()) / determinant,
               (of_b * a.normal.x() - of_a * b.normal.x()) / determinant);
}

/// The velocity nearest to `wanted` that enters none of the surfaces, if there is one. What runs along a surface does
/// not enter it, however it is rounded.
std::optional<Vec2d> nearest_allowed(const Vec2d& wanted, std::span<const MetSurface> surfaces) {
  std::optional<Vec2d> best;
  const auto consider = [&](const Vec2d& v, std::initializer_list<std::size_t> along) {
    for (std::size_t i = 0; i < surfaces.size(); ++i)
      if (std::find(along.begin(), along.end(), i) == along.end() && enters(v, surfaces[i])) return;
    if (!best || (v - wanted).squaredNorm() < (*best - wanted).squaredNorm()) best = v;
  };
  consider(wanted, {});
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    consider(slid(wanted, surfaces[i]), {i});
    for (std::size_t k = 0; k < i; ++k)
      if (const std::optional<Vec2d> held = held_by(surfaces[i], surfaces[k])) consider(*held, {i, k});
  }
  return best;
}

/// The impulses along both normals that make the change, per mass; none where the normals are of one direction.
std::optional<Vec2d> impulses_of(const Vec2d& change, const MetSurface& a, const MetSurface& b) {
  const double determinant = cross(a.normal, b.normal);
  if (std::abs(determinant) < one_direction) return std::nullopt;
  return Vec2d(cross(change, b.normal) / determinant, cross(a.normal, change) / determinant);
}

/// Whether a velocity rises under a ceiling: then it slides there.
bool rises_under(const Vec2d& v, const MetSurface& at) {
  return at.normal.y() < 0 && v.y() - at.velocity.y() > in_double * std::max(1.0, (v - at.velocity).norm());
}

Vec2d follow(double x, const Vec2d& n) { return {x, -x * n.x() / n.y()}; }

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
  if (!std::isfinite(y) || std::any_of(surfaces.begin(), surfaces.end(), is_in)) return std::nullopt;
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
  std::stable_sort(places.begin(), places.end(), [x](double a, double b) { return std::abs(a - x) < std::abs(b - x); });
  for (const double place : places)
    if (const std::optional<Vec2d> v = walked_to(place, y, surfaces)) return v;
  return std::nullopt;
}

/// An impact ends the momentum that presses into a surface which nobody walks on. Steering against it is spent first.
/// @return the velocity that is left.
Vec2d after_impact(Vec2d u, const MetSurface& at, std::span<const MetSurface> surfaces, double& steering) {
  const Vec2d& n = at.normal;
  const double towards = n.x() < 0 ? 1 : -1;  // across, into the surface
  if (!enters(u, at) || n.x() == 0 || rises_under(u, at) || !(towards * (u.x() - at.velocity.x()) > 0)) return u;
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
  return std::none_of(surfaces.begin(), surfaces.end(), presses) &&
         std::any_of(surfaces.begin(), surfaces.end(), [&](const auto& at) { return !at.walkable && enters(w, at); });
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
  for (const MetSurface& at : surfaces)
    if (!at.walkable) u = after_impact(u, at, surfaces, steering);
  const bool lands =
      std::any_of(surfaces.begin(), surfaces.end(), [&](const MetSurface& at) { return at.walkable && enters(u, at); });
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

/// Surfaces of which one pushes leave no larger speed of a velocity that comes to them [m/s]: its own, which is along
/// its ground if it walks, or twice that of the fastest of them. So fast a wall pushes up a slope of 60 degrees.
double most_pressed(const Vec2d& came, double steering, std::span<const MetSurface> held) {
  const auto pushes = [](const MetSurface& at) { return at.velocity.dot(at.normal) > 0; };
  const auto is_other = [&](const MetSurface& at) {
    return std::abs(cross(at.normal, held[0].normal)) > one_direction;
  };
  if (std::none_of(held.begin(), held.end(), pushes) || std::none_of(held.begin(), held.end(), is_other))
    return infinity;
  double most = came.norm();
  for (const MetSurface& at : held) {
    if (at.walkable) most = std::max(most, std::abs(came.x()) / at.normal.y());
    most = std::max(most, 2 * at.velocity.norm());
  }
  return most + std::abs(steering);
}

/// Whether surfaces on both sides that nobody walks on, and that go almost alike, leave hardly anything of a fall; or
/// some beside which the character is.
bool hold_fall(std::span<const MetSurface> held, const Vec2d& left, double fall) {
  const MetSurface& first = *std::max_element(held.begin(), held.end(),
                                              [](const auto& a, const auto& b) { return a.normal.y() < b.normal.y(); });
  const double hardly = 0.1 * (first.velocity.y() - fall);
  const auto goes_alike = [&](const MetSurface& at) {
    return (!at.walkable || at.is_beside) && (at.velocity - first.velocity).norm() <= hardly;
  };
  const auto is_at = [&](double side) {
    return std::any_of(held.begin(), held.end(), [&](const auto& at) { return side * at.normal.x() > 0; });
  };
  const bool beside = std::any_of(held.begin(), held.end(), is_ground_beside);
  return held.size() > 1 && hardly > 0 && first.normal.y() > 0 && (beside || (is_at(-1) && is_at(1))) &&
         (left - first.velocity).norm() <= hardly && std::all_of(held.begin(), held.end(), goes_alike);
}

/// As an upright character sees it. Surfaces that are met at one moment are answered together with all that still hold.
/// @param fastest set to the speed at which surfaces press it out, where that is larger [m/s].
Vec2d controlled(const Steered& velocity, std::span<const MetSurface> surfaces, const Unknown& unknown,
                 double& fastest) {
  Steered now = velocity;
  double steering = (velocity.wanted - velocity.unsteered).x();
  double fall = velocity.unsteered.y();
  std::vector<MetSurface> held;
  for (std::size_t k = 0; k < surfaces.size();) {
    const MetSurface& at = surfaces[k];
    const bool goes_on = k > 0 && surfaces[k - 1].met < at.met;
    std::vector<MetSurface> rims;  // touched here for the last time
    std::copy_if(held.begin(), held.end(), std::back_inserter(rims),
                 [&](const MetSurface& one) { return one.past_rim && one.left == at.met; });
    std::erase_if(held, [&](const MetSurface& one) { return one.left <= at.met; });
    do {
      if (!is_at_end(surfaces[k]) || unknown.met_at_end) held.push_back(surfaces[k]);
      ++k;
    } while (k < surfaces.size() && surfaces[k].met == at.met && !unknown.one_by_one);
    if (held.empty()) continue;
    if (goes_on) fall = now.unsteered.y();
    const Vec2d came = now.wanted;
    if (unknown.carried && may_carry(held.back()) && enters(came, held.back()) &&
        std::abs(came.x()) <= grazing * came.norm()) {
      now = {held.back().velocity, held.back().velocity};
      steering = 0;
    }
    const Steered rest{Vec2d::Zero(), Vec2d::Zero()};
    rims.insert(rims.end(), held.begin(), held.end());
    double spent = steering;
    const Steered between = respond(now, spent, at.climbs, rims).value_or(rest);
    now = respond(now, steering, at.climbs, held).value_or(rest);
    const bool all_left = std::all_of(rims.begin(), rims.end(), [](const MetSurface& one) { return one.left <= 1; });
    const bool borne = unknown.bears_beside && std::any_of(rims.begin(), rims.end(), is_ground_beside);
    if (all_left && !borne && hold_fall(rims, between.unsteered, fall)) {
      const Vec2d falls = unknown.falls_along * (unknown.falls_along.y() * fall);
      now = {falls, falls};
    }
    const double most = most_pressed(came, steering, held);
    fastest = std::max(fastest, most < infinity ? now.wanted.norm() : 0);
    const double share = std::min(1.0, most / now.wanted.norm());
    now = {now.wanted * share, now.unsteered * share};
  }
  return now.wanted;
}

std::array<Vec2d, 4> corners_of(const Box2& box) {
  return {box.lower, box.upper, Vec2d(box.lower.x(), box.upper.y()), Vec2d(box.upper.x(), box.lower.y())};
}

/// The corners of the box that its velocity is in.
std::array<Vec2d, 4> velocities_of(const MetSurface& at) { return corners_of(at.velocities()); }

double fastest(const MetSurface& at) { return at.velocity.norm() + std::hypot(at.spread, at.spread_along); }

/// Holds nothing.
const Box2 no_box{Vec2d::Constant(infinity), Vec2d::Constant(-infinity)};

/// Whether some velocity in a box enters a surface.
bool may_enter(const Box2& box, const MetSurface& at) {
  if (!(box.lower.x() <= box.upper.x())) return false;
  const std::array<Vec2d, 4> corners = corners_of(box);
  const std::array<Vec2d, 4> goes = velocities_of(at);
  return std::any_of(corners.begin(), corners.end(), [&](const Vec2d& v) {
    return std::any_of(goes.begin(), goes.end(),
                       [&](const Vec2d& velocity) { return enters(v, {.normal = at.normal, .velocity = velocity}); });
  });
}

/// Whether both may be touched at once.
bool are_together(const MetSurface& a, const MetSurface& b) {
  return !a.turning || a.turning != b.turning || a.stands_at == b.stands_at;
}

/// `controlled_bounds` goes so often over the surfaces. Each time the box holds more that no motion does.
constexpr std::size_t most_rounds = 2;

/// Adds to a box what one surface that rests can make of a velocity. Ground may be followed that is not entered. A wall
/// takes what leads across up into it, or a part of that: it turns none of that upwards.
void add_responses(const Vec2d& v, const MetSurface& at, Box2& box) {
  const Vec2d& n = at.normal;
  const auto add = [&box](const Vec2d& made) { box = box.merged({made, made}); };
  const auto slide = [&](const Vec2d& w) { add(w - std::min(w.dot(n), 0.0) * n); };
  if (at.walkable) return add(follow(v.x(), n));
  if (v.dot(n) >= 0) return;
  const bool leads_into = v.x() * n.x() < 0;
  const Vec2d falls(leads_into ? 0 : v.x(), v.y());
  add(falls);
  add({falls.x(), std::min(v.y(), 0.0)});
  slide(falls);
  if (n.y() >= 0) return;
  add(Vec2d::Zero());
  slide(v);
}

/// Where the speed that a push gives is limited, all of it is slowed, by no more than the push gave.
Box2 slowed_by_limit(Box2 box, std::span<const MetSurface> surfaces) {
  double push = 0;
  for (const MetSurface& at : surfaces)
    if (surfaces.size() > 1 && at.velocity.dot(at.normal) + at.spread > 0) push = std::max(push, fastest(at));
  for (const Eigen::Index i : {0, 1}) {
    box.lower[i] = std::min(box.lower[i], std::max(box.lower[i] - push, 0.0));
    box.upper[i] = std::max(box.upper[i], std::min(box.upper[i] + push, 0.0));
  }
  return box;
}

/// What the trace leaves open of these surfaces.
/// @param sides see `ControlledStep`.
std::vector<Unknown> ways(std::span<const MetSurface> surfaces, std::span<const Vec2d> sides) {
  const bool any_at_end = std::any_of(surfaces.begin(), surfaces.end(), is_at_end);
  const bool any_carries = std::any_of(surfaces.begin(), surfaces.end(), may_carry);
  const bool any_at_once = std::adjacent_find(surfaces.begin(), surfaces.end(), [](const auto& a, const auto& b) {
                             return a.met == b.met;
                           }) != surfaces.end();
  std::vector<Unknown> all;
  for (const bool met_at_end : {false, true})
    for (const bool carried : {false, true})
      for (const bool one_by_one : {false, true})
        if (met_at_end <= any_at_end && carried <= any_carries && one_by_one <= any_at_once)
          all.push_back({met_at_end, carried, one_by_one});
  if (std::any_of(surfaces.begin(), surfaces.end(), is_ground_beside)) {
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
/// @param most_pressed_out see `ControlledStep`. @param sides the same.
std::vector<Vec2d> upright_outcomes(const Steered& velocity, std::span<const MetSurface> surfaces,
                                    double most_pressed_out, std::span<const Vec2d> sides) {
  std::vector<Vec2d> outcomes;
  for (const Unknown& unknown : ways(surfaces, sides)) {
    double fastest = 0;
    const Vec2d met = outcomes.emplace_back(controlled(velocity, surfaces, unknown, fastest));
    if (fastest > most_pressed_out) outcomes.emplace_back(0, 0);
    for (const MetSurface& at : surfaces)
      if (at.walkable && (is_at_end(at) || at.returned))
        outcomes.emplace_back(follow((met - at.velocity).x(), at.normal) + at.velocity);
  }
  return outcomes;
}

}  // namespace

std::vector<Vec2d> frictionless_outcomes(const Vec2d& wanted, std::span<const MetSurface> surfaces) {
  std::vector<Vec2d> outcomes{wanted};
  const auto meet = [&](const Vec2d& v) {
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
      if (enters(v, surfaces[i])) outcomes.push_back(slid(v, surfaces[i]));
      for (std::size_t k = 0; k < i; ++k)
        if (const auto both = nearest_allowed(v, std::array{surfaces[i], surfaces[k]})) outcomes.push_back(*both);
    }
  };
  meet(wanted);
  const std::size_t once = outcomes.size();
  for (std::size_t k = 1; k < once; ++k) meet(Vec2d(outcomes[k]));
  return outcomes;
}

bool is_short_of_limit(const Vec2d& wanted, const Vec2d& velocity, std::span<const MetSurface> surfaces,
                       const Vec2d& kept, int rounds) {
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const std::array both{surfaces[i], surfaces[k]};
      const std::optional<Vec2d> limit = nearest_allowed(wanted, both);
      const std::optional<Vec2d> pushes = impulses_of(velocity - wanted, both[0], both[1]);
      if (!limit || !pushes || pushes->minCoeff() < -in_float * std::max(1.0, pushes->norm())) continue;
      const double speed = wanted.norm() + impulses_of(kept, both[0], both[1])->lpNorm<1>();
      const double left = std::pow(std::abs(both[0].normal.dot(both[1].normal)), 2 * rounds - 1);
      if ((velocity - *limit).norm() <= left * speed + in_float) return true;
    }
  return false;
}

bool is_turned_by_tilt(const Vec2d& wanted, const Vec2d& velocity, std::span<const MetSurface> surfaces, double tilt) {
  const Vec2d change = velocity - wanted;
  const double slack = in_float * std::max(1.0, wanted.norm());
  if (!(change.norm() > slack)) return false;
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const MetSurface& at) {
    // What is left runs along the tilted surface, or there is nothing left.
    const Vec2d along_it = velocity - at.velocity;
    const bool ends = !(along_it.norm() > slack);
    const Vec2d across = ends ? change : Vec2d(-along_it.y(), along_it.x());
    const Vec2d normal = across.normalized() * (across.dot(at.normal) < 0 ? -1 : 1);
    return std::abs(cross(normal, at.normal)) <= tilt && std::abs(cross(change, normal)) <= slack &&
           change.dot(normal) > 0;
  });
}

std::vector<Vec2d> controlled_outcomes(const ControlledStep& step, std::span<const MetSurface> surfaces) {
  std::vector<MetSurface> upright(surfaces.begin(), surfaces.end());
  for (MetSurface& at : upright) {
    at.normal = seen(at.normal, step.up);
    at.velocity = seen(at.velocity, step.up);
  }
  const bool ends_rise = step.side_hit_ends_rise &&
                         std::any_of(surfaces.begin(), surfaces.end(), [](const MetSurface& at) { return at.is_side; });
  std::vector<Vec2d> sides = step.sides;
  for (Vec2d& side : sides) side = seen(side, step.up);
  std::vector<Vec2d> outcomes = upright_outcomes({seen(step.wanted, step.up), seen(step.unsteered, step.up)}, upright,
                                                 step.most_pressed_out, sides);
  for (Vec2d& outcome : outcomes) {
    if (ends_rise) outcome.y() = std::min(outcome.y(), 0.0);
    outcome = in_world(outcome, step.up);
  }
  return outcomes;
}

Box2 controlled_bounds(const ControlledRange& range, std::span<const MetSurface> surfaces) {
  const Vec2d slower(range.least_steering, 0);
  const Vec2d faster(range.most_steering, 0);
  Box2 unsteered = range.unsteered;
  Box2 wanted{unsteered.lower + slower, unsteered.upper + faster};
  std::vector<Box2> made_by(surfaces.size(), no_box);
  // What impulses along the normal leave.
  const auto slides = [&wanted](const MetSurface& at) {
    Box2 left = no_box;
    for (const Vec2d& goes : velocities_of(at))
      for (const Vec2d& v : corners_of(wanted)) {
        const MetSurface moving{.normal = at.normal, .velocity = goes};
        const Vec2d made = slid(v, moving);
        if (enters(v, moving)) left = left.merged({made, made});
      }
    return left;
  };
  // What one has made comes to others, and from there back to it.
  for (std::size_t turn = 0; turn < most_rounds * surfaces.size(); ++turn) {
    const std::size_t i = turn % surfaces.size();
    const MetSurface& at = surfaces[i];
    const auto responses = [&at](const Box2& box) {
      Box2 all = no_box;
      // Ground may carry the character.
      if (at.walkable || at.is_overlapped) all = at.velocities();
      for (const Vec2d& goes : velocities_of(at))
        for (const Vec2d& v : corners_of(box)) {
          Box2 made = no_box;
          add_responses(v - goes, at, made);
          all = all.merged({made.lower + goes, made.upper + goes});
        }
      return all;
    };
    const Box2 before = unsteered;
    unsteered = unsteered.merged(responses(before));
    made_by[i] = responses(wanted);
    wanted = wanted.merged(made_by[i]).merged(unsteered);
    // What takes steering takes it for once.
    wanted = wanted.merged({unsteered.lower + slower, unsteered.upper + faster});
    if (at.walkable) wanted = wanted.merged(responses({before.lower + slower, before.upper + faster}));
    for (std::size_t k = 0; k < i; ++k) {
      const MetSurface& with = surfaces[k];
      if (!are_together(at, with)) continue;
      const Box2 slide = slides(at);
      const Box2 other_slide = slides(with);
      const bool enters_with = may_enter(made_by[i].merged(slide), with);
      const bool enters_at = may_enter(made_by[k].merged(other_slide), at);
      // At two surfaces with different velocities the nearest motion may be left that enters neither.
      if (at.velocity != with.velocity && (enters_with || enters_at)) wanted = wanted.merged(slide).merged(other_slide);
      // Two hold only a motion that goes into each by what the other leaves of it.
      if (!enters_with || !enters_at) continue;
      const double most = fastest(at) + fastest(with) + range.squeezed;
      for (const Vec2d& velocity : velocities_of(at))
        for (const Vec2d& other : velocities_of(with)) {
          auto held = held_by({.normal = at.normal, .velocity = velocity}, {.normal = with.normal, .velocity = other});
          if (!held) continue;
          const double limited = 2 * std::max(fastest(at), fastest(with));
          for (const double speed : {most, limited}) {
            const Vec2d slow = held->norm() > speed ? Vec2d(*held * (speed / held->norm())) : *held;
            unsteered = unsteered.merged({slow, slow});
          }
        }
    }
  }
  return slowed_by_limit(wanted.merged(unsteered), surfaces);
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
        << step.wanted.y() << ") the law makes (" << made.x() << ", " << made.y() << ") at " << surfaces.size()
        << (surfaces.size() == 1 ? " surface" : " surfaces");
  return fault.str();
}

double distance_from(std::span<const Vec2d> outcomes, const Vec2d& velocity) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2d& outcome : outcomes) least = std::min(least, (outcome - velocity).norm());
  return least;
}

}  // namespace paperproof::compare
