/// A surface that a motion met, as the laws of response see it, and how a velocity stands to it.
#pragma once

#include "oracle/up.hpp"

#include <algorithm>
#include <limits>
#include <optional>
#include <span>

namespace paperproof::compare {

/// A surface that a motion met.
struct MetSurface {
  Vec2d normal{Vec2d::Zero()};    ///< Unit, towards the character.
  Vec2d velocity{Vec2d::Zero()};  ///< Of what it goes along with, a conveyor's surface included [m/s].
  ColliderIndex collider = no_collider;
  bool walkable = false;       ///< Within the climb limit of the character.
  bool is_overlapped = false;  ///< For bounds alone: the character is inside of it, and may go along.
  bool is_side = false;        ///< Touches the left or right side of the character.
  bool ridden = false;         ///< The step begins on it, and goes along: nobody lands on it.
  bool climbs = false;         ///< A rise that comes to it is the climb of a walk, whose ground is still touched.
  double met = 0;              ///< When it was met, as a fraction of the step; 1: only touched where that ends.
  double left = std::numeric_limits<double>::infinity();  ///< From then on it is touched no more.
  bool is_beside = false;                                 ///< It is touched corner to corner: it bears nobody.
  bool past_rim = false;  ///< It is touched still where it is left: the way goes on past its rim.
  bool returned = false;  ///< It was left, and is touched again.
  /// Its velocity is known to within this, where it turns [m/s]: for bounds along its normal, else in any direction.
  double spread = 0;
  double spread_along = 0;  ///< The same along the face; for bounds alone.
  /// The mover that turns it. A face of that mover stands so at one fraction of the step only: it presses nobody
  /// against a face of the same mover at another fraction.
  std::optional<MoverIndex> turning{};
  double stands_at = 0;

  /// The smallest box that holds its velocities.
  [[nodiscard]] Box2 velocities() const {
    constexpr double any = std::numeric_limits<double>::infinity();
    if (spread + spread_along == any) return {Vec2d::Constant(-any), Vec2d::Constant(any)};
    const Vec2d along(-normal.y(), normal.x());
    const Vec2d unknown = spread * normal.cwiseAbs() + spread_along * along.cwiseAbs();
    return {velocity - unknown, velocity + unknown};
  }
};

}  // namespace paperproof::compare

/// How a velocity stands to surfaces: what the laws of response ask of each.
namespace paperproof::compare::surfaces {

/// A velocity that enters or leaves a surface by no more than this share of its length runs along it.
inline constexpr double grazing = 1e-9;
/// Normals whose cross product is smaller are of one direction.
inline constexpr double one_direction = 1e-9;

[[nodiscard]] inline double entering(const Vec2d& v, const MetSurface& at) { return (v - at.velocity).dot(at.normal); }

[[nodiscard]] inline bool enters(const Vec2d& v, const MetSurface& at) {
  return entering(v, at) < -grazing * std::max(1.0, (v - at.velocity).norm());
}

[[nodiscard]] inline bool leaves(const Vec2d& v, const MetSurface& at) {
  return entering(v, at) > grazing * std::max(1.0, (v - at.velocity).norm());
}

[[nodiscard]] inline Vec2d slid(const Vec2d& v, const MetSurface& at) { return v - entering(v, at) * at.normal; }

[[nodiscard]] inline Vec2d follow(double x, const Vec2d& n) { return {x, -x * n.x() / n.y()}; }

/// The velocity that neither enters nor leaves either of two surfaces.
[[nodiscard]] std::optional<Vec2d> held_by(const MetSurface& a, const MetSurface& b);

/// The velocity nearest to `wanted` that enters none of the surfaces, if there is one. What runs along a surface does
/// not enter it, however it is rounded.
[[nodiscard]] std::optional<Vec2d> nearest_allowed(const Vec2d& wanted, std::span<const MetSurface> surfaces);

}  // namespace paperproof::compare::surfaces
