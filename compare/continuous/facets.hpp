/// The outline that a character's position cannot cross: straight facets, in extended precision.
///
/// A position touches a solid P where the character K there touches it: on the outline of the sum of P and -K. Of a
/// polygon that outline consists of the sides of P, each shifted by the point of -K that is furthest along its normal,
/// and of the sides of -K at each convex corner of P whose normals lie between those of the corner's two sides (the
/// convolution of two tracings: Guibas, Ramshaw, Stolfi, "A kinetic framework for computational geometry", 1983). At
/// concave corners the convolution runs inside the sum, where no free position can get to: nothing is made of those. So
/// concave polygons need no cutting. A chain is a polygon that is walked forth and back.
#pragma once

#include "continuous/number.hpp"
#include "scenes/scene.hpp"

#include <vector>

namespace paperproof::compare::continuous {

/// One straight part. The solid is on the left of the way from `begin` to `end`, the free side on the right.
struct Facet {
  static constexpr std::size_t none = ~std::size_t{0};
  Point begin;     ///< [m]; of a mover, where it is at offset zero.
  Point along;     ///< Unit vector from begin to end.
  Point normal;    ///< Unit vector to the free side.
  Real length{0};  ///< [m]
  bool walkable = false;
  MoverIndex mover = no_mover;
  std::size_t before = none;  ///< The facet that ends where this one begins, at a convex corner of the outline.
  std::size_t after = none;   ///< The facet that begins where this one ends, at a convex corner of the outline.
};

/// Of all colliders that block, in their order. Sensors have none.
[[nodiscard]] std::vector<Facet> facets_of(const Scene& scene);

}  // namespace paperproof::compare::continuous
