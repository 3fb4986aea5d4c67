/// The article's speculative contacts with the time of impact of each point computed instead of searched: the pair
/// lands just at the edge of what it would enter. Then penetration resolution; all iterated.
///
/// The knob `unit` is left to penetration resolution. A contact's fraction is the time of impact of its point.
#include "techniques/article_technique.hpp"
#include "techniques/registry.hpp"

#include <paperproof/tolerances.hpp>

#include <limits>

namespace paperproof {
namespace {

using article::distinct;
using article::PairImpact;
using article::Parts;

/// The time of impact is rounded, and so is the position that it leads to: without this the next frame would find the
/// point an ulp inside, and penetration resolution would push it out by a whole unit. Doubling reaches any rounding
/// error in a few tests.
double just_outside(const Parts& parts, const NearbyScenery& nearby, const PointPair& pair, const Vec2d& position,
                    const Vec2d& movement, double fraction) noexcept {
  const double scale = position.cwiseAbs().maxCoeff() / movement.cwiseAbs().maxCoeff();
  double back = std::numeric_limits<double>::epsilon() * std::max(scale, fraction);
  while (fraction > 0 && collides(parts, nearby, pair, position, position + movement * fraction)) {
    fraction = std::max(0.0, fraction - back);
    back *= 2;
  }
  return fraction;
}

PairImpact time_of_impact(const Parts& parts, const NearbyScenery& nearby, const PointPair& pair, const Vec2d& position,
                          const Vec2d& movement) noexcept {
  PairImpact impact;
  for (const std::size_t i : distinct(pair)) {
    const auto entry = nearby.first_entry(position + parts.points.offsets[i], movement);
    if (!entry) continue;
    impact.fraction = std::min(impact.fraction, entry->fraction);
    impact.hits.push_back({*entry, i});
  }
  if (impact.hits.empty()) return impact;
  // Both points touch where one landing brings both to an edge.
  const double touching = impact.fraction + Tolerances{}.touch / movement.norm();
  if (impact.hits.size() == 2 && impact.hits[1].on.fraction > touching) impact.hits.pop_back();
  if (impact.hits.size() == 2 && impact.hits[0].on.fraction > touching) {
    impact.hits[0] = impact.hits[1];
    impact.hits.pop_back();
  }
  impact.fraction = just_outside(parts, nearby, pair, position, movement, impact.fraction);
  impact.reached = movement * impact.fraction;
  return impact;
}

using Speculative = article::SearchingTechnique<&time_of_impact, false>;

}  // namespace

TechniqueEntry speculative_entry() { return article::entry_of_search<Speculative>("speculative"); }

}  // namespace paperproof
