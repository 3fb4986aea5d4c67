/// The scenery in the only numbers Box2D knows, and the limits that have to be kept before Box2D sees them.
#pragma once

#include "float_geometry.hpp"

#include <paperproof/scenery.hpp>

#include <span>
#include <string_view>
#include <vector>

namespace paperproof::box2d {

/// Not closed: the first vertex is not repeated.
using Ring = std::vector<b2Vec2>;

/// Largest position [m], speed [m/s] or time step [s] that Box2D is given. Beyond about 1e18 the squares that its
/// solver takes overflow a float, NaN follows, and its asserts end the process. Small values would refuse honest
/// scenes.
inline constexpr double largest_number = 1e9;

/// Edges shorter than this are left out [m]. Box2D does not normalise below 1.2e-7 m, and then computes with a normal
/// that is not one. Larger values would leave holes that something could get caught in.
inline constexpr float shortest_edge = 1e-6F;

/// Rounds to float.
/// @throws InvalidDefinition "<what> is ..." for a number that is not finite or beyond `largest_number`.
[[nodiscard]] b2Vec2 checked(const Vec2d& value, std::string_view what);

/// Every coordinate rounded to float; the counts stay as they are.
[[nodiscard]] SceneryDef rounded(const SceneryDef& scenery);

/// The points as floats without repeated neighbours, the last and the first included where `closed`.
[[nodiscard]] Ring without_repeats(std::span<const Vec2d> points, bool closed);

/// Twice the area, positive for counter-clockwise. Taken about the first vertex, so that it does not lose its digits
/// far from the origin.
[[nodiscard]] double twice_area(std::span<const b2Vec2> ring) noexcept;

[[nodiscard]] double distance_to_segment(const Vec2d& point, const Vec2d& a, const Vec2d& b) noexcept;

}  // namespace paperproof::box2d
