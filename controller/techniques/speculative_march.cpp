/// The article's speculative contacts as written: each pair advances along the movement vector one unit at a time, with
/// a last shorter step to its end; at a collision it goes back by one unit, or does nothing where there was no advance
/// yet; only the component of the pair's direction changes. Then penetration resolution; all iterated.
///
/// "If there was already a collision at the starting position, we do nothing": read as no backtracking. The free part
/// of the movement is nothing, so the pair's component becomes zero as after any other hit, and penetration resolution
/// takes the pair out. The article resolves object by object; the search along the vector is over all objects that are
/// near, since the first of them is what the pair reaches. After a hit nothing is left of the frame's movement, so a
/// further iteration has nothing to search: it resolves what the last one pushed into something else.
///
/// A polygon is met where a point is inside it after a step: what is thinner than a unit can be missed. A chain is met
/// where a step of a point crosses it. A contact's fraction is where the pair was last free: up to a unit too early.
#include "techniques/article_technique.hpp"
#include "techniques/registry.hpp"

#include <cmath>

namespace paperproof {
namespace {

using article::PairImpact;
using article::Parts;

/// What the points of a pair collide with when a step takes them from one position to the next. At the start the two
/// are the same.
PairImpact collisions(const Parts& parts, const NearbyScenery& nearby, const PointPair& pair, const Vec2d& from,
                      const Vec2d& to, const Vec2d& movement) noexcept {
  PairImpact impact;
  for (const std::size_t i : article::distinct(pair)) {
    const Vec2d here = from + parts.points.offsets[i];
    const Vec2d there = to + parts.points.offsets[i];
    if (const auto inside = nearby.containing(there)) {
      impact.hits.push_back({nearby.way_out(*inside, there, -movement), i});
    } else if (const auto crossed = nearby.crossed(here, there)) {
      impact.hits.push_back({nearby.crossing(*crossed, here, there), i});
    }
  }
  return impact;
}

PairImpact march(const Parts& parts, const NearbyScenery& nearby, const PointPair& pair, const Vec2d& position,
                 const Vec2d& movement) noexcept {
  const double vector_length = movement.norm();
  const Vec2d one_unit = movement / vector_length * parts.unit;
  const double whole_units = std::floor(vector_length / parts.unit);
  PairImpact impact = collisions(parts, nearby, pair, position, position, movement);
  Vec2d reached{Vec2d::Zero()};
  int segments = 0;
  for (bool at_end = false; impact.hits.empty() && !at_end; ++segments) {
    at_end = static_cast<double>(segments) >= whole_units;
    const Vec2d next = at_end ? movement : Vec2d(one_unit * static_cast<double>(segments + 1));
    impact = collisions(parts, nearby, pair, Vec2d(position + reached), Vec2d(position + next), movement);
    if (!impact.hits.empty()) break;
    reached = next;
  }
  impact.reached = reached;
  impact.fraction = std::min(1.0, static_cast<double>(segments) * parts.unit / vector_length);
  return impact;
}

using SpeculativeMarch = article::SearchingTechnique<&march, true>;

}  // namespace

TechniqueEntry speculative_march_entry() { return article::entry_of_search<SpeculativeMarch>("speculative_march"); }

}  // namespace paperproof
