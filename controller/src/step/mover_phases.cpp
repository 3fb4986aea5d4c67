#include "step/mover_phases.hpp"

#include <limits>

namespace paperproof::octagon_sweep {
namespace {

/// Up to this many boxes are looked at one by one: any structure over so few costs more than it saves.
constexpr std::size_t few = 8;

template <class Scalar>
Box2<Scalar> nowhere() noexcept {
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  return {Vec2<Scalar>::Constant(infinity), Vec2<Scalar>::Constant(-infinity)};
}

}  // namespace

template <class Scalar>
MoverPhases<Scalar>::MoverPhases(BroadPhaseKind kind, const Scenery<Scalar>& scenery) {
  movers_.resize(scenery.mover_count());
  for (MoverIndex i = 0; i < size(); ++i) {
    const PieceRange range = scenery.pieces_of_mover(i);
    const std::span<const Box2<Scalar>> boxes = scenery.boxes().subspan(range.first, range.size());
    Mover& mover = movers_[i];
    mover.first = range.first;
    mover.whole = nowhere<Scalar>();
    for (const Box2<Scalar>& box : boxes) mover.whole = mover.whole.merged(box);
    mover.phase = make_broad_phase<Scalar>(boxes.size() <= few ? BroadPhaseKind::all_pairs : kind, boxes);
  }
}

template <class Scalar>
std::span<const PieceIndex> MoverPhases<Scalar>::query(MoverIndex index, const Box2<Scalar>& box,
                                                       std::span<PieceIndex> found) const noexcept {
  const Mover& mover = movers_[index];
  const std::size_t count = mover.phase->query(box, found);
  for (PieceIndex& piece : found.first(count)) piece += mover.first;
  return found.first(count);
}

template class MoverPhases<float>;
template class MoverPhases<double>;

}  // namespace paperproof::octagon_sweep
