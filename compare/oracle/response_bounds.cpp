#include "oracle/response_laws.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace paperproof::compare {
namespace {

using namespace surfaces;

std::array<Vec2d, 4> corners_of(const Box2& box) {
  return {box.lower, box.upper, Vec2d(box.lower.x(), box.upper.y()), Vec2d(box.upper.x(), box.lower.y())};
}

/// The corners of the box that its velocity is in.
std::array<Vec2d, 4> velocities_of(const MetSurface& at) { return corners_of(at.velocities()); }

double fastest(const MetSurface& at) { return at.velocity.norm() + std::hypot(at.spread, at.spread_along); }

/// Whether some velocity in a box enters a surface.
bool may_enter(const Box2& box, const MetSurface& at) {
  if (!(box.lower.x() <= box.upper.x())) return false;
  const std::array<Vec2d, 4> corners = corners_of(box);
  const std::array<Vec2d, 4> goes = velocities_of(at);
  return std::ranges::any_of(corners, [&](const Vec2d& v) {
    return std::ranges::any_of(
        goes, [&](const Vec2d& velocity) { return enters(v, {.normal = at.normal, .velocity = velocity}); });
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
  const auto add = [&box](const Vec2d& made) { box = box.with(made); };
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

}  // namespace

Box2 controlled_bounds(const ControlledRange& range, std::span<const MetSurface> surfaces) {
  const Vec2d slower(range.least_steering, 0);
  const Vec2d faster(range.most_steering, 0);
  Box2 unsteered = range.unsteered;
  Box2 wanted{unsteered.lower + slower, unsteered.upper + faster};
  std::vector<Box2> made_by(surfaces.size(), Box2::nowhere());
  // What impulses along the normal leave.
  const auto slides = [&wanted](const MetSurface& at) {
    Box2 left = Box2::nowhere();
    for (const Vec2d& goes : velocities_of(at))
      for (const Vec2d& v : corners_of(wanted)) {
        const MetSurface moving{.normal = at.normal, .velocity = goes};
        const Vec2d made = slid(v, moving);
        if (enters(v, moving)) left = left.with(made);
      }
    return left;
  };
  // What one has made comes to others, and from there back to it.
  for (std::size_t turn = 0; turn < most_rounds * surfaces.size(); ++turn) {
    const std::size_t i = turn % surfaces.size();
    const MetSurface& at = surfaces[i];
    const auto responses = [&at](const Box2& box) {
      Box2 all = Box2::nowhere();
      // Ground may carry the character.
      if (at.walkable || at.is_overlapped) all = at.velocities();
      for (const Vec2d& goes : velocities_of(at))
        for (const Vec2d& v : corners_of(box)) {
          Box2 made = Box2::nowhere();
          add_responses(v - goes, at, made);
          all = all.merged(made + goes);
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
            unsteered = unsteered.with(slow);
          }
        }
    }
  }
  return slowed_by_limit(wanted.merged(unsteered), surfaces);
}

bool leave_no_motion(std::span<const MetSurface> surfaces, double most) {
  const auto comes_against = [](const MetSurface& at) { return entering(Vec2d::Zero(), at) < 0; };
  const auto leaves_none = [&](const std::vector<MetSurface>& touched) {
    if (std::ranges::none_of(touched, comes_against)) return false;
    const std::optional<Vec2d> left = nearest_allowed(Vec2d::Zero(), touched);
    return !left || left->norm() > most;
  };
  // In the plane three leave none where any number of them does.
  for (std::size_t i = 0; i < surfaces.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      for (std::size_t j = 0; j <= k; ++j) {
        const MetSurface& a = surfaces[i];
        const MetSurface& b = surfaces[k];
        const MetSurface& c = surfaces[j];
        if (are_together(a, b) && are_together(b, c) && are_together(a, c) && leaves_none({a, b, c})) return true;
      }
  return false;
}

}  // namespace paperproof::compare
