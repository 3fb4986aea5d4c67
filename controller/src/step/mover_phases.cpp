#include "step/mover_phases.hpp"

#include <limits>

namespace paperproof::octagon_sweep {
namespace {

Box2 nowhere() noexcept {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {Vec2d::Constant(infinity), Vec2d::Constant(-infinity)};
}

}  // namespace

MoverPhases::MoverPhases(PieceSearch search, const Scenery& scenery) {
  movers_.reserve(scenery.mover_count());
  for (MoverIndex mover = 0; mover < scenery.mover_count(); ++mover) {
    const PieceRange range = scenery.pieces_of_mover(mover);
    const std::span<const Box2> boxes = scenery.boxes().subspan(range.first, range.size());
    Box2 whole = nowhere();
    for (const Box2& box : boxes) whole = whole.merged(box);
    movers_.push_back({whole, range.first, broad_phase::Tree(boxes, search)});
  }
}

std::span<const PieceIndex> MoverPhases::query(MoverIndex index, const Box2& box,
                                               std::span<PieceIndex> found) const noexcept {
  const Mover& mover = movers_[index];
  const std::size_t count = mover.tree.query(box, found);
  for (PieceIndex& piece : found.first(count)) piece += mover.first;
  return found.first(count);
}

}  // namespace paperproof::octagon_sweep
