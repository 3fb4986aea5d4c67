/// What becomes of a motion that meets surfaces.
///
/// Let u be the motion that a character has without this step's steering (momentum and gravity), s the change that
/// steering makes in this step, braking included, and w = u + s. The surfaces that it touches, each with unit normal n,
/// allow the motions K: all v with n·v >= least, where least is the motion of the surface along n. `rest` is the motion
/// of who rests at a surface: all of the surface's motion if it carries, else the part along n. All of this is as the
/// character sees it, x across it and y up, and relative to the first surface. Where w enters no surface, it goes on as
/// it is. Else:
///
///  1. **The climb of a walk ends** at a surface that is not walkable and stops w: u rises no faster than that surface.
///     A character that walks up a slope into a wall would leave the ground with the speed of its climb otherwise,
///     land, and hop again, for ever.
///  2. **Momentum that presses is an impact.** Of u, the part across that presses into what is not walkable, and enters
///     it, ends: it does not become a climb. The part across shrinks to that of `rest`. It shrinks less in two cases:
///     to where u would enter an upward surface on the other side, and to where u presses into a ceiling no longer. (A
///     rise under a ceiling slides.) Steering against it is spent on it first: a character that turns around at a wall
///     would be thrown back by its own momentum otherwise. Speed that was gained by sliding points outward and is not
///     touched.
///  3. **What is left of u** becomes a walk if it enters walkable ground: along the ground, with its x or the nearest x
///     that the other surfaces allow. In all other cases, and if they allow no x, it becomes the motion of K that is
///     nearest to it. Before that, steering joins it that leads away from slopes and walls; and
///     while it rises under a ceiling, steering to either side. A fall stays a fall. If K is empty, the surfaces leave
///     no motion.
///  4. **Steering**, as far as it has not joined, moves the motion that rule 3 gives across: at the height of that
///     motion, or along walkable ground where that is higher, as far as all surfaces allow. So steering never holds or
///     slows a fall along a surface: from the same place and speed, y(t) on a steep slope is the same with the key
///     uphill and without a key. Steering that a surface took is there again at the next one; steering that was spent
///     is not.
///
/// **A wedge** holds a fall: surfaces on both sides, none of them walkable, that leave no more than a small share of
/// it; or such with ground that the character is beside. It does not hold who can fall on between its rims, straight
/// down or, where up is slanted, along a side of the character.
///
/// Displacement and velocity are treated alike: each rule is homogeneous of degree one. u is carried through every
/// contact beside w. A falling motion comes to rise on nothing but walkable ground, and what moves. The loop ends after
/// a given number of impacts.
#pragma once

#include "inlining.hpp"
#include "step/half_planes.hpp"

#include <paperproof/up_frame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// Two unit normals of one plane. Zero: rounding would make two of it. Large: a crease would be taken for a plane.
inline constexpr Real same_plane = std::numeric_limits<Real>::epsilon() * 16;

/// A motion that points into a plane by less than this share of its length runs along it.
inline constexpr Real along_plane = std::numeric_limits<Real>::epsilon() * 64;

/// Whether a motion goes into a plane that it touches, rather than along it.
[[nodiscard]] inline bool enters(const Vec2& displacement, const Vec2& normal) {
  const Real out = dot(displacement, normal);
  return out < 0 && out < -along_plane * length_of(displacement);
}

/// A motion [m] or velocity [m/s] that is wanted, and the part of it that is there without this step's steering.
struct Desired {
  Vec2 wanted;
  Vec2 unsteered;
};

/// A slide that enters its surface by rounding, along the surface. One that is nothing but rounding is no motion: it
/// goes about as far into the surface as along it.
[[nodiscard]] inline Vec2 rounded_slide(const Vec2& slide, const Vec2& n) {
  const Real along = slide.x() * n.y() - slide.y() * n.x();
  if (!(std::abs(along) > 1024 * std::abs(dot(slide, n)))) return Vec2::Zero();
  return {n.y() * along + Real(0), -n.x() * along + Real(0)};
}

/// A motion of the world that was seen along a surface, or not into it, by a character that is not upright. A motion
/// that rounding turned into the surface runs along it again.
[[nodiscard]] inline Vec2 in_world(const UpFrame& up, const Vec2& seen, const Vec2& n) {
  const Vec2 w = up.in_world(seen);
  if (!up.is_slanted() || std::abs(dot(w, n)) > along_plane * length_of(w)) return w;
  return Vec2{n.y(), -n.x()} * (w.x() * n.y() - w.y() * n.x());
}

/// The motion across to `x` at height `y`, or along walkable ground that is higher. Nothing else may block it.
[[nodiscard]] inline std::optional<Vec2> walk_to(Real x, Real y, std::span<const HalfPlane> touched) {
  Vec2 w{x + Real(0), y + Real(0)};
  for (const HalfPlane& at : touched)
    if (at.walkable) w.y() = std::max(w.y(), at.along(x).y());
  for (const HalfPlane& at : touched)
    if (!at.walkable && !at.allows(w)) return std::nullopt;
  return w;
}

/// The nearest such motion to `x`, across no farther than from `from` to `to`; nothing where there is none.
[[nodiscard]] inline std::optional<Vec2> walk(Real x, Real y, Real from, Real to, std::span<const HalfPlane> touched) {
  std::optional<Vec2> best = walk_to(x, y, touched);
  if (best) return best;
  const auto consider = [&](Real across) {
    if (!(across >= std::min(from, to) && across <= std::max(from, to))) return;
    if (best && std::abs(best->x() - x) <= std::abs(across - x)) return;
    if (const std::optional<Vec2> w = walk_to(across, y, touched)) best = w;
  };
  for (const HalfPlane& at : touched) {
    if (at.walkable) continue;
    if (std::isfinite(y)) consider(crossing(at, {{0, 1}, y}).x());
    for (const HalfPlane& ground : touched)
      if (ground.walkable) consider(crossing(at, ground).x());
  }
  return best;
}

/// Rule 2 at one surface. A motion along what moves enters it by rounding: that is no impact. Nor is it one that only
/// the end of another leads in: so the order of the surfaces does not matter.
/// @param came u before rule 2. @param u is changed. @param steered what steering adds across; what brakes is taken
/// from it. @param rounding of a margin.
inline void end_pressing(const HalfPlane& at, std::span<const HalfPlane> touched, const Vec2& came, Vec2& u,
                         Real& steered, Real rounding) {
  const Vec2& n = at.normal;
  const Real pressing = u.x() - at.rest.x();
  const bool is_ceiling = n.y() < 0;
  if (std::max(at.margin(came), at.margin(u)) >= -rounding || !(pressing * n.x() < 0) ||
      (is_ceiling && u.y() > at.rest.y()))
    return;
  if (steered * n.x() > 0) {
    const Real braked = std::abs(steered) < std::abs(pressing) ? steered : -pressing;
    u.x() += braked;
    steered -= braked;
  }
  // Of two places across the one that the pressing motion reaches first, and the other.
  const auto sooner = [&](Real a, Real b) { return n.x() < 0 ? std::min(a, b) : std::max(a, b); };
  const auto later = [&](Real a, Real b) { return n.x() < 0 ? std::max(a, b) : std::min(a, b); };
  Real stop = at.rest.x();
  if (is_ceiling) stop = later(stop, (at.least - n.y() * u.y()) / n.x());
  for (const HalfPlane& other : touched)
    if (other.normal.x() * n.x() < 0 && other.normal.y() > 0) stop = later(stop, crossing(at, other).x());
  u.x() = sooner(u.x(), stop);
}

/// Whether steering is part of the momentum: rule 3.
[[nodiscard]] inline bool is_momentum(Real steered, const Vec2& u, std::span<const HalfPlane> touched) {
  bool enters_any = false;
  for (const HalfPlane& at : touched) {
    if (at.walkable) continue;
    const bool slides = at.normal.y() < 0 && u.y() > at.rest.y();
    if (steered * at.normal.x() < 0 && !slides) return false;
    enters_any = enters_any || at.margin({u.x() + steered, u.y()}) < 0;
  }
  return enters_any;
}

/// The response to all surfaces that are touched, as above; nothing where they leave no motion.
/// @param steered what this step's steering added across to what is wanted; what brakes is spent, and taken from it.
/// @param after_walk the character follows walkable ground that it touches: a rise is the climb of a walk.
/// @param rounding of the margins: differences of motions in the world, which may be far larger.
[[nodiscard]] inline std::optional<Desired> respond(const Desired& desired, Real& steered, bool after_walk,
                                                    std::span<const HalfPlane> touched, Real rounding) {
  constexpr Real infinite = std::numeric_limits<Real>::infinity();
  Vec2 u = desired.unsteered;
  bool is_free = true;
  for (const HalfPlane& at : touched) {
    if (at.margin(desired.wanted) >= 0) continue;
    is_free = false;
    if (after_walk && !at.walkable) u.y() = std::min(u.y(), at.rest.y());
  }
  if (is_free) return desired;
  const Vec2 came = u;
  for (const HalfPlane& at : touched)
    if (!at.walkable) end_pressing(at, touched, came, u, steered, rounding);
  const bool lands = std::ranges::any_of(touched, [&](const HalfPlane& at) { return at.walkable && at.margin(u) < 0; });
  if (!lands && is_momentum(steered, u, touched)) u.x() += std::exchange(steered, Real(0));
  std::optional<Vec2> base;
  if (lands) base = walk(u.x(), -infinite, -infinite, infinite, touched);
  const Real fall = base ? u.y() : infinite;
  if (!base) base = nearest_allowed(u, touched);
  if (!base) return std::nullopt;
  Desired result{*base, *base};
  if (steered == 0) return result;
  const Real x = base->x() + steered;
  if (const auto steers = walk(x, std::min(fall, base->y()), base->x(), x, touched)) result.wanted = *steers;
  return result;
}

/// The same for one walkable plane alone that stands still: the usual case. Without steering the two parts of a motion
/// are one, and `unsteered` is not read.
PAPERPROOF_INLINE void follow(const HalfPlane& ground, Real steered, Desired& desired) {
  if (ground.margin(desired.wanted) >= 0) return;
  if (steered == 0) {
    desired.wanted = ground.along(desired.wanted.x());
    return;
  }
  Vec2& u = desired.unsteered;
  desired.wanted = ground.along(u.x() + steered);
  u.y() = std::max(u.y(), ground.along(u.x()).y());
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
