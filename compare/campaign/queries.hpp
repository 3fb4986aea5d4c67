/// Questions of first contact with their exact answers, from random runs: anybody's method can be held against them.
#pragma once

#include "campaign/families.hpp"
#include "oracle/exact.hpp"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace paperproof::compare {

/// A convex shape moves straight among solids that stand. When does it first touch one that it goes on to overlap?
struct Query {
  std::string source;         ///< The run and the step, as `paperproof replay` takes the run.
  std::vector<Vec2d> points;  ///< Hull of the shape, relative to its position [m].
  Vec2d position{Vec2d::Zero()};
  Vec2d displacement{Vec2d::Zero()};
  std::vector<ColliderDef> solids;       ///< Polygons and chains: all that are near the way.
  std::optional<ExactFraction> contact;  ///< Of the way, in [0, 1), exactly; none: the way is free.
  std::size_t with = 0;                  ///< Which solid, where there is a contact.
  /// Another answer, or one that is more than 1e-6 m off, is right for a shape that is larger or smaller by 1e-9 m.
  bool degenerate = false;
};

/// Random ways of a scene's character.
/// @throws InputError where anything else moves.
[[nodiscard]] Family ways_through(const Scene& scene);

/// From the runs of families, of those with one character among solids that stand: equally many of each, in their
/// order. Half of the ways are those of the runs themselves; the others have random directions and lengths, or begin
/// and end on a grid, where touching without overlap is frequent. No way begins inside anything, and no run asks one
/// twice.
/// @param take is called with each.
void make_queries(int count, const std::vector<Family>& from, const std::function<void(const Query&)>& take);

}  // namespace paperproof::compare
