#include "techniques/speculative_march.hpp"

#include "techniques/article_technique.hpp"

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

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_speculative_march(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                          const CharacterDef& character) {
  using Made = article::SearchingTechnique<Scalar, TechniqueKind::speculative_march, &march<Scalar>>;
  return std::make_unique<Made>(def, scenery, character);
}

template std::unique_ptr<Technique<float>> make_speculative_march(const TechniqueDef&, const Scenery<float>&,
                                                                  const CharacterDef&);
template std::unique_ptr<Technique<double>> make_speculative_march(const TechniqueDef&, const Scenery<double>&,
                                                                   const CharacterDef&);

}  // namespace paperproof
