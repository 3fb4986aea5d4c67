/// Scenery as compact JSON: equal shapes are written once, and placed.
#pragma once

#include "report/json_text.hpp"

#include <paperproof/scenery.hpp>

#include <set>

namespace paperproof::compare {

/// The points of a collider; of a circle, those of a polygon of 64 corners.
[[nodiscard]] std::vector<Vec2d> drawn_outline(const ColliderDef& collider);

/// `{"shapes":[[kind,[ring…],one_way?]…],"order":[shape,count,…],"unit":u,"at":[dx,dy,…],"ids":{"3":"paper"}}`.
/// A ring is flat, relative to its shape's first vertex, each vertex as the difference to the one before; kind is 0 for
/// a polygon, 1 for a chain. `order` says which shape the colliders have, run by run; `at` is where each one's first
/// vertex is, as the difference to the collider before, in `unit`s. Where anything moves, `movers` has for each
/// collider 0, or 1 more than its mover, run by run; where there are sensors, `sensors` lists them. Everything is in
/// multiples of the quantum.
/// @param ids    one per collider; @param named  the colliders whose ids the page will need.
[[nodiscard]] std::string scenery_json(const SceneryDef& scenery, const std::vector<std::string>& ids,
                                       const std::set<ColliderIndex>& named, const Quantum& quantum);

}  // namespace paperproof::compare
