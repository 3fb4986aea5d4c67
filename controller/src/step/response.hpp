/// What becomes of a motion that met a surface.
///
/// Let u be the motion that a character has without this step's steering (momentum and gravity), s the change that
/// steering makes in this step, braking included, and w = u + s. A surface with unit normal n holds w where w·n < 0.
///
/// **Walkable ground** (n.y >= c): the horizontal part is kept by following the surface: (x, -x n.x / n.y). A fall
/// ends. Steering that a steep surface took is there again: x = u.x + s.
///
/// **Steep ground and walls** (0 <= n.y < c): steering never holds or slows a fall.
///  1. Of u, the horizontal part that presses in (x n.x < 0) is zero: an impact. It does not become a climb. Speed that
///     was gained by sliding points outward (x n.x > 0) and is not touched: it is momentum.
///  2. If it still enters, it is a fall: x n.x >= 0 and u·n < 0 give y < 0 (a wall, n.y = 0, is entered no more). It
///     slides: u - (u·n) n. Its length does not grow, x stays outward, and it stays a fall: y' = y n.x² - (x n.x) n.y,
///     where both terms are below zero.
///  3. Steering that presses in (s·n < 0) does not change y: of all motions along the surface w is the one with the y
///  of u,
///     (-y n.y / n.x, y). Where u entered that is u itself, slid. So y(t) on a steep slope is the same with the key
///     uphill and without a key, at any dt. (Had only the part of s along n gone, the rest would point up the slope,
///     and hold the character on a platform's corner for good. Were all of it gone, a character that turns around at a
///     wall would be thrown back by its own momentum, and tremble there.) Steering that does not press in is treated
///     with u: 1 and 2 apply to w.
/// A rise goes on: after 1 it does not enter. But a climb that came only from following walkable ground ends with the
/// walk: where 1 or 3 takes the horizontal part, and the ground was followed, an upward y is zero, too. A character
/// that walks up a slope into a wall would otherwise leave the ground with the speed of its climb, land, and hop again,
/// for ever.
///
/// **Ceilings** (n.y < 0): a rise slides, w - (w·n) n; the climb of a walk ends there, with the walk. A fall goes on: x
/// shrinks to what follows the surface.
///
/// **Two surfaces** that both hold the motion: whether they are a wedge is decided by the fall of u alone. The nearest
/// motion to it that all surfaces allow is taken, if that still falls; else the motion ends there, as it does where one
/// of them is walkable. So steering into one side of a funnel does not hold a character that would slip through it.
///
/// All of this is as the character sees it: x is across it, and y is up (see `UpFrame`).
///
/// Position and velocity are treated alike: each rule is homogeneous of degree one. u is carried through every contact
/// beside w. A falling motion comes to rise on nothing but walkable ground. The loop ends after a given number of
/// impacts.
#pragma once

#include "inlining.hpp"
#include "step/half_planes.hpp"

#include <paperproof/up_frame.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

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

/// A surface, and how the character comes to it.
struct Surface {
  Vec2 normal;
  bool walkable;
  bool after_walk;  ///< The character follows walkable ground that it touches: a rise is the climb of a walk.
};

/// Adding zero turns a negative zero into a positive one: rest has one pattern of bits.
[[nodiscard]] PAPERPROOF_INLINE Vec2 follow(Real x, const Vec2& n) { return {x, -x * n.x() / n.y() + Real(0)}; }

[[nodiscard]] PAPERPROOF_INLINE Vec2 slide(const Vec2& w, const Vec2& n) {
  const Real into = dot(w, n);
  return {w.x() - into * n.x() + Real(0), w.y() - into * n.y() + Real(0)};
}

/// A slide that enters its surface by rounding, along the surface. One that is nothing but rounding is no motion: it
/// goes about as far into the surface as along it.
[[nodiscard]] inline Vec2 rounded_slide(const Vec2& slide, const Vec2& n) {
  const Real along = slide.x() * n.y() - slide.y() * n.x();
  if (!(std::abs(along) > 1024 * std::abs(dot(slide, n)))) return Vec2::Zero();
  return {n.y() * along + Real(0), -n.x() * along + Real(0)};
}

/// The response on steep ground and walls, without steering: rules 1 and 2 above.
[[nodiscard]] PAPERPROOF_INLINE Vec2 impact(Vec2 w, const Surface& at) {
  if (w.x() * at.normal.x() < 0) {
    w.x() = 0;
    if (at.after_walk) w.y() = std::min(w.y(), Real(0));
  }
  return dot(w, at.normal) < 0 ? slide(w, at.normal) : w;
}

/// Under a ceiling.
[[nodiscard]] PAPERPROOF_INLINE Vec2 bump(const Vec2& w, const Surface& at) {
  const Vec2& n = at.normal;
  if (w.y() > 0) return at.after_walk ? Vec2(Vec2::Zero()) : slide(w, n);
  return {-w.y() * n.y() / n.x() + Real(0), w.y() + Real(0)};
}

/// The response without steering.
[[nodiscard]] PAPERPROOF_INLINE Vec2 respond(const Vec2& w, const Surface& at) {
  if (dot(w, at.normal) >= 0) return w;
  if (at.walkable) return follow(w.x(), at.normal);
  return at.normal.y() < 0 ? bump(w, at) : impact(w, at);
}

/// Rule 3: where steering presses in.
/// @param unsteered the motion without steering, and @param result what became of it at this surface.
[[nodiscard]] PAPERPROOF_INLINE Vec2 press(const Vec2& unsteered, const Vec2& result, const Surface& at) {
  if (dot(unsteered, at.normal) < 0) return result;
  const Real y = at.after_walk ? std::min(result.y(), Real(0)) : result.y();
  return {-y * at.normal.y() / at.normal.x() + Real(0), y + Real(0)};
}

/// The response to a surface that is entered, of what is wanted and of what there is without steering.
/// @param steered the horizontal part that this step's steering added to what was wanted.
[[nodiscard]] PAPERPROOF_INLINE Desired respond(const Desired& desired, Real steered, const Surface& at) {
  if (dot(desired.wanted, at.normal) >= 0) return desired;
  const Vec2 unsteered = respond(desired.unsteered, at);
  if (steered == 0) return {unsteered, unsteered};
  if (at.walkable) return {follow(desired.unsteered.x() + steered, at.normal), unsteered};
  const bool moves_in = at.normal.y() >= 0 && dot(Vec2(desired.wanted - desired.unsteered), at.normal) < 0;
  return {moves_in ? press(desired.unsteered, unsteered, at) : respond(desired.wanted, at), unsteered};
}

/// A motion of the world that was seen along a surface, or not into it, by a character that is not upright. A motion
/// that rounding turned into the surface runs along it again.
[[nodiscard]] inline Vec2 in_world(const UpFrame& up, const Vec2& seen, const Vec2& n) {
  const Vec2 w = up.in_world(seen);
  if (!up.is_slanted() || std::abs(dot(w, n)) > along_plane * length_of(w)) return w;
  return Vec2{n.y(), -n.x()} * (w.x() * n.y() - w.y() * n.x());
}

/// The response of a character with any up. Motions and surface are those of the world.
[[nodiscard]] PAPERPROOF_COLD inline Desired respond_turned(const UpFrame& up, const Desired& desired, Real steered,
                                                            const Surface& at) {
  const Surface seen{up.seen(at.normal), at.walkable, at.after_walk};
  const Desired result = respond({up.seen(desired.wanted), up.seen(desired.unsteered)}, steered, seen);
  return {in_world(up, result.wanted, at.normal), in_world(up, result.unsteered, at.normal)};
}
[[nodiscard]] PAPERPROOF_INLINE Desired respond(const UpFrame& up, const Desired& desired, Real steered,
                                                const Surface& at) {
  return up.is_turned() ? respond_turned(up, desired, steered, at) : respond(desired, steered, at);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
