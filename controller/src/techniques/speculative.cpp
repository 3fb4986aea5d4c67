#include "techniques/speculative.hpp"

#include "techniques/article_technique.hpp"

#include <limits>

namespace paperproof {
namespace {

using article::distinct;
using article::PairImpact;
using article::Parts;

/// The time of impact is rounded, and so is the position that it leads to: without this the next frame would find the
/// point an ulp inside, and penetration resolution would push it out by a whole unit. Doubling reaches any rounding
/// error in a few tests.
template <class Scalar>
Scalar just_outside(const Parts<Scalar>& parts, const NearbyScenery<Scalar>& nearby, const CharacterShape::Pair& pair,
                    const Vec2<Scalar>& position, const Vec2<Scalar>& movement, Scalar fraction) noexcept {
  const Scalar scale = position.cwiseAbs().maxCoeff() / movement.cwiseAbs().maxCoeff();
  Scalar back = std::numeric_limits<Scalar>::epsilon() * std::max(scale, fraction);
  while (fraction > 0 && collides<Scalar>(parts, nearby, pair, position, position + movement * fraction)) {
    fraction = std::max(Scalar(0), fraction - back);
    back *= 2;
  }
  return fraction;
}

template <class Scalar>
PairImpact<Scalar> time_of_impact(const Parts<Scalar>& parts, const NearbyScenery<Scalar>& nearby,
                                  const CharacterShape::Pair& pair, const Vec2<Scalar>& position,
                                  const Vec2<Scalar>& movement) noexcept {
  PairImpact<Scalar> impact;
  for (const std::size_t i : distinct(pair)) {
    const auto entry = nearby.first_entry(position + parts.points.offsets[i], movement);
    if (!entry) continue;
    impact.fraction = std::min(impact.fraction, entry->fraction);
    impact.hits.push_back({*entry, i});
  }
  if (impact.hits.empty()) return impact;
  // Both points touch where one landing brings both to an edge.
  const Scalar touching = impact.fraction + Tolerances<Scalar>{}.touch / article::length(movement);
  if (impact.hits.size() == 2 && impact.hits[1].on.fraction > touching) impact.hits.pop_back();
  if (impact.hits.size() == 2 && impact.hits[0].on.fraction > touching) {
    impact.hits[0] = impact.hits[1];
    impact.hits.pop_back();
  }
  impact.fraction = just_outside(parts, nearby, pair, position, movement, impact.fraction);
  impact.reached = movement * impact.fraction;
  return impact;
}

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_speculative(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                    const CharacterDef& character) {
  using Made = article::SearchingTechnique<Scalar, TechniqueKind::speculative, &time_of_impact<Scalar>>;
  return std::make_unique<Made>(def, scenery, character);
}

template std::unique_ptr<Technique<float>> make_speculative(const TechniqueDef&, const Scenery<float>&,
                                                            const CharacterDef&);
template std::unique_ptr<Technique<double>> make_speculative(const TechniqueDef&, const Scenery<double>&,
                                                             const CharacterDef&);

}  // namespace paperproof
