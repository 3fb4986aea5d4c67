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
template <class Scalar>
PairImpact<Scalar> collisions(const Parts<Scalar>& parts, const NearbyScenery<Scalar>& nearby,
                              const CharacterShape::Pair& pair, const Vec2<Scalar>& from, const Vec2<Scalar>& to,
                              const Vec2<Scalar>& movement) noexcept {
  PairImpact<Scalar> impact;
  for (const std::size_t i : article::distinct(pair)) {
    const Vec2<Scalar> here = from + parts.points.offsets[i];
    const Vec2<Scalar> there = to + parts.points.offsets[i];
    if (const auto inside = nearby.containing(there)) {
      impact.hits.push_back({nearby.way_out(*inside, there, -movement), i});
    } else if (const auto crossed = nearby.crossed(here, there)) {
      impact.hits.push_back({nearby.crossing(*crossed, here, there), i});
    }
  }
  return impact;
}

template <class Scalar>
PairImpact<Scalar> march(const Parts<Scalar>& parts, const NearbyScenery<Scalar>& nearby,
                         const CharacterShape::Pair& pair, const Vec2<Scalar>& position,
                         const Vec2<Scalar>& movement) noexcept {
  const Scalar vector_length = article::length(movement);
  const Vec2<Scalar> one_unit = movement / vector_length * parts.unit;
  const Scalar whole_units = std::floor(vector_length / parts.unit);
  PairImpact<Scalar> impact = collisions(parts, nearby, pair, position, position, movement);
  Vec2<Scalar> reached{Vec2<Scalar>::Zero()};
  int segments = 0;
  for (bool at_end = false; impact.hits.empty() && !at_end; ++segments) {
    at_end = static_cast<Scalar>(segments) >= whole_units;
    const Vec2<Scalar> next = at_end ? movement : Vec2<Scalar>(one_unit * static_cast<Scalar>(segments + 1));
    impact = collisions(parts, nearby, pair, Vec2<Scalar>(position + reached), Vec2<Scalar>(position + next), movement);
    if (!impact.hits.empty()) break;
    reached = next;
  }
  impact.reached = reached;
  impact.fraction = std::min(Scalar(1), static_cast<Scalar>(segments) * parts.unit / vector_length);
  return impact;
}

template <class Scalar>
using SpeculativeMarch = article::SearchingTechnique<Scalar, &march<Scalar>, true>;

}  // namespace

TechniqueEntry speculative_march_entry() { return article::entry_of_search<SpeculativeMarch>("speculative_march"); }

}  // namespace paperproof
