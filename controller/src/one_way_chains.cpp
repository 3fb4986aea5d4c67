#include "one_way_chains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/overlap_time.hpp"

namespace paperproof {
namespace {

/// Margin around the character in which passed chains are looked for, as a share of its size. Zero: rounding hides a
/// chain whose tip the character grazes. Large: chains beside the way are named.
constexpr double margin_share = 1e-6;

/// Rounding error of the height over a segment, as a share of the coordinates.
inline constexpr double height_rounding = std::numeric_limits<double>::epsilon() * 24;

}  // namespace

OneWayChains::OneWayChains(const Scenery& scenery, const CharacterShape& shape) : scenery_(&scenery) {
  Vec2d middle = Vec2d::Zero();
  for (const Vec2d& corner : shape.hull()) middle += corner / static_cast<double>(shape.hull().size());
  for (const Vec2d& corner : shape.hull()) {
    const Vec2d grown = corner + margin_share * (corner - middle);
    outline_.push_back(corner);
    grown_.push_back(grown);
  }
}

void OneWayChains::find_passed(std::span<const PathPoint> path, std::span<const MoverMotion> movers, Nearby near,
                               const OneWaySurfaces& surfaces, Passed& passed) const noexcept {
  passed.clear();
  const auto look_at = [&](PieceIndex piece, const MoverMotion& motion) {
    const ColliderIndex chain = scenery_->pieces()[piece].collider;
    const auto place = std::lower_bound(passed.begin(), passed.end(), chain);
    if (place != passed.end() && *place == chain) return;
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vec2d from = path[i - 1].position - motion.at(path[i - 1].fraction);
      const Vec2d to = path[i].position - motion.at(path[i].fraction);
      if (from != to && passes(surfaces, piece, from, to)) return void(passed.insert(place, chain));
    }
  };
  near.for_each_group(box_around(path, {}), Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    const MoverMotion motion = mover == no_mover ? MoverMotion{} : movers[mover];
    for (const PieceIndex piece : pieces)
      if (scenery_->pieces()[piece].one_way) look_at(piece, motion);
  });
}

/// A segment runs so that its blocking normal is on its left.
bool OneWayChains::passes(const OneWaySurfaces& surfaces, PieceIndex piece, const Vec2d& from,
                          const Vec2d& to) const noexcept {
  const PieceVertices ends = scenery_->vertices_of(piece);
  const Vec2d along = ends[1] - ends[0];
  const bool against = Vec2d(-along.y(), along.x()).dot(to - from) < 0;
  const OneWaySurfaces::Index surface = surfaces.of(piece);
  // A character above a straight surface does not pass it along the normal, but another part of a bent surface may be
  // in the way. A segment that is not met against its normal is tested without the margin.
  if (!against && surfaces.is_straight(surface)) return false;
  const auto& outline = against ? grown_ : outline_;
  if (!geometry::overlap_time({outline.begin(), outline.end()}, ends, from, to).any()) return false;
  const double size = from.cwiseAbs().maxCoeff() + ends[0].cwiseAbs().maxCoeff() + ends[1].cwiseAbs().maxCoeff();
  return surfaces.may_be_above(surface, from, height_rounding * size);
}

}  // namespace paperproof
