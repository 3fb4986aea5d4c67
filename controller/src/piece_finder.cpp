#include "piece_finder.hpp"

#include <paperproof/tolerances.hpp>

namespace paperproof {
namespace {

/// Margin around the character, as a share of its size, so that rounding hides no piece. It is far larger than the
/// rounding error, and too small to find pieces beside the way.
constexpr double reach_share = 1e-5;

}  // namespace

PieceFinder::PieceFinder(const Scenery& scenery, const CharacterShape& shape, std::span<const PieceIndex> pieces,
                         PieceSearch search)
    : asks_all_(search == PieceSearch::none) {
  const Box2& box = shape.box();
  const double size = (box.upper - box.lower).maxCoeff();
  look_ahead_ = look_ahead_share * size;
  reach_ = box.inflated(Tolerances{}.look + reach_share * size);
  std::vector<Group> of_mover(scenery.mover_count());
  for (const PieceIndex piece : pieces) {
    const MoverIndex mover = scenery.pieces()[piece].mover;
    (mover == no_mover ? standing_ : of_mover[mover]).pieces.push_back(piece);
  }
  const auto prepare = [&](Group& group) {
    group.boxes.reserve(group.pieces.size());
    for (const PieceIndex piece : group.pieces) group.boxes.push_back(scenery.box(piece));
    group.tree.emplace(group.boxes, search);
  };
  prepare(standing_);
  for (MoverIndex mover = 0; mover < of_mover.size(); ++mover) {
    if (of_mover[mover].pieces.empty()) continue;
    of_mover[mover].mover = mover;
    prepare(of_mover[mover]);
    moving_.push_back(std::move(of_mover[mover]));
  }
}

Candidates PieceFinder::make_candidates() const {
  std::size_t most_of_a_mover = 0;
  for (const Group& group : moving_) most_of_a_mover = std::max(most_of_a_mover, group.pieces.size());
  Candidates candidates;
  candidates.pieces = PieceBuffer(standing_.pieces.size() + most_of_a_mover);
  return candidates;
}

std::span<const PieceIndex> PieceFinder::Group::query(const Box2& box, std::span<PieceIndex> found) const noexcept {
  const std::size_t count = tree->query(box, found);
  for (PieceIndex& piece : found.first(count)) piece = pieces[piece];
  return found.first(count);
}

Box2 PieceFinder::positions_seen(std::span<const PathPoint> path, const MoverMotion& motion) noexcept {
  const Vec2d first = path.front().position - motion.at(path.front().fraction);
  Box2 positions{first, first};
  for (const PathPoint& corner : path.subspan(1)) {
    const Vec2d at = corner.position - motion.at(corner.fraction);
    positions = positions.merged({at, at});
  }
  return positions;
}

std::span<const PieceIndex> PieceFinder::near_standing(std::span<const PathPoint> path,
                                                       Candidates& candidates) const noexcept {
  Box2 positions{path.front().position, path.front().position};
  for (const PathPoint& corner : path.subspan(1)) positions = positions.merged({corner.position, corner.position});
  if (!asks_all_ && (positions.lower == positions.upper || candidates.quiet.contains(positions))) return {};
  if (!candidates.valid || !candidates.box.contains(positions)) {
    const Vec2d way = path.back().position - path.front().position;
    candidates.box = positions_ahead(positions, way, look_ahead_);
    candidates.count = standing_.query(touched_from(candidates.box), candidates.pieces).size();
    candidates.valid = true;
  }
  return std::span<const PieceIndex>(candidates.pieces).first(candidates.count);
}

}  // namespace paperproof
