#include "one_way_chains.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/overlap_time.hpp"

namespace paperproof {
namespace {

/// How far beyond the character what it passes is looked for, as a share of its size. Zero: rounding hides a chain
/// whose tip is grazed. Large: chains beside the way are named.
constexpr double margin_share = 1e-6;

/// Of the height over a segment, as a share of the coordinates.
template <class Scalar>
inline constexpr Scalar height_rounding = std::numeric_limits<Scalar>::epsilon() * 16;

}  // namespace

template <class Scalar>
OneWayChains<Scalar>::OneWayChains(const Scenery<Scalar>& scenery, const CharacterShape& shape) : scenery_(&scenery) {
  const std::span<const PieceInfo> pieces = scenery.pieces();
  for (PieceIndex piece = 0; piece < pieces.size(); ++piece)
    if (pieces[piece].one_way) segments_.push_back(piece);
  std::stable_sort(segments_.begin(), segments_.end(),
                   [&](PieceIndex a, PieceIndex b) { return pieces[a].collider < pieces[b].collider; });
  Vec2d middle = Vec2d::Zero();
  for (const Vec2d& corner : shape.hull()) middle += corner / static_cast<double>(shape.hull().size());
  for (const Vec2d& corner : shape.hull()) {
    const Vec2d grown = corner + margin_share * (corner - middle);
    outline_.push_back(corner.cast<Scalar>());
    grown_.push_back(grown.cast<Scalar>());
  }
}

template <class Scalar>
void OneWayChains<Scalar>::find_passed(std::span<const PathPoint<Scalar>> path,
                                       std::span<const MoverMotion<Scalar>> movers, Passed& passed) const noexcept {
  passed.clear();
  for (const PieceIndex piece : segments_) {
    const PieceInfo& info = scenery_->pieces()[piece];
    if (!passed.empty() && passed.back() == info.collider) continue;
    const MoverMotion<Scalar> motion = info.mover == no_mover ? MoverMotion<Scalar>{} : movers[info.mover];
    for (std::size_t i = 1; i < path.size(); ++i) {
      const Vec2<Scalar> from = path[i - 1].position - motion.at(path[i - 1].fraction);
      const Vec2<Scalar> to = path[i].position - motion.at(path[i].fraction);
      if (!passes(piece, from, to)) continue;
      passed.push_back(info.collider);
      break;
    }
  }
}

/// A segment runs so that its blocking normal is on its left.
template <class Scalar>
bool OneWayChains<Scalar>::passes(PieceIndex piece, const Vec2<Scalar>& from, const Vec2<Scalar>& to) const noexcept {
  const std::span<const Vec2<Scalar>> ends = scenery_->vertices_of(piece);
  const Vec2<Scalar> along = ends[1] - ends[0];
  const Vec2<Scalar> normal{-along.y(), along.x()};
  const Vec2<Scalar> way = to - from;
  if (!(normal.dot(way) < 0)) return false;
  const Scalar size = from.cwiseAbs().maxCoeff() + ends[0].cwiseAbs().maxCoeff() + ends[1].cwiseAbs().maxCoeff();
  const Scalar below = -height_rounding<Scalar> * size * (std::abs(normal.x()) + std::abs(normal.y()));
  for (const Vec2<Scalar>& corner : outline_) {
    const Vec2<Scalar> above = from + corner - ends[0];
    if (!(normal.dot(above) >= below)) return false;
  }
  return geometry::overlap_time<Scalar>({grown_.begin(), grown_.end()}, ends, from, to).any();
}

template class OneWayChains<float>;
template class OneWayChains<double>;

}  // namespace paperproof
