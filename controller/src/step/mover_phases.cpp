#include "step/mover_phases.hpp"

#include <limits>

namespace paperproof::octagon_sweep {
namespace {

template <class Scalar>
Box2<Scalar> nowhere() noexcept {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  return {Vec2<Scalar>::Constant(infinity), Vec2<Scalar>::Constant(-infinity)};
}

}  // namespace

template <class Scalar>
MoverPhases<Scalar>::MoverPhases(PieceSearch search, const Scenery<Scalar>& scenery) {
  movers_.reserve(scenery.mover_count());
  for (MoverIndex mover = 0; mover < scenery.mover_count(); ++mover) {
    const PieceRange range = scenery.pieces_of_mover(mover);
    const std::span<const Box2<Scalar>> boxes = scenery.boxes().subspan(range.first, range.size());
    Box2<Scalar> whole = nowhere<Scalar>();
    for (const Box2<Scalar>& box : boxes) whole = whole.merged(box);
    movers_.push_back({whole, range.first, broad_phase::Tree<Scalar>(boxes, search)});
  }
}

template <class Scalar>
std::span<const PieceIndex> MoverPhases<Scalar>::query(MoverIndex index, const Box2<Scalar>& box,
                                                       std::span<PieceIndex> found) const noexcept {
  const Mover& mover = movers_[index];
  const std::size_t count = mover.tree.query(box, found);
  for (PieceIndex& piece : found.first(count)) piece += mover.first;
  return found.first(count);
}

template class MoverPhases<float>;
template class MoverPhases<double>;

}  // namespace paperproof::octagon_sweep
