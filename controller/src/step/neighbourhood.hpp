/// Which pieces a step may have to look at.
#pragma once

#include "piece_finder.hpp"
#include "step/configuration_space.hpp"
#include "step/step_memory.hpp"

#include <paperproof/scratch.hpp>
#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// The pieces that stand still around a character. Superset of what meets a box; kept between steps.
class Neighbourhood {
 public:
  /// @param look_ahead how far ahead of a motion candidates are collected at most [m].
  /// @param filter null: all colliders are there.
  Neighbourhood(const ConfigurationSpace& space, const broad_phase::Tree& tree, Real look_ahead,
                const ColliderFilter* filter, Scratch& scratch) noexcept
      : space_(space), tree_(tree), look_ahead_(look_ahead), filter_(filter), scratch_(scratch) {
    if (filter != nullptr || scratch.solids.filtered) [[unlikely]]
      forget_others();
  }

  /// Every piece that the octagon can touch while its reference point is in `box`, and perhaps more; ascending.
  /// @param displacement where the character goes [m]: the next steps will need the pieces there.
  [[nodiscard]] std::span<const PieceIndex> around(const Box2& box, const Vec2& displacement = Vec2::Zero()) noexcept;

  /// The same without `displacement` and without what was collected before, for the caller to reorder. Nothing is kept.
  /// @return memory for all pieces of the scenery, and how many were written.
  [[nodiscard]] std::pair<std::span<PieceIndex>, std::size_t> take(const Box2& box) noexcept {
    forget();
    const std::size_t count = around(box).size();
    forget();
    return {scratch_.solids.pieces, count};
  }

  /// Forgets the cached candidates: the next answer is the same after any history.
  void forget() noexcept { scratch_.solids.valid = false; }

  /// For what exceeds the inline storage of a step.
  [[nodiscard]] StepMemory& memory() const noexcept { return static_cast<StepMemory&>(*scratch_.own); }

 private:
  /// Forgets the pieces that were collected with another filter.
  [[gnu::cold, gnu::noinline]] void forget_others() noexcept {
    Candidates& known = scratch_.solids;
    const ColliderFilter filter = filter_ != nullptr ? *filter_ : ColliderFilter{};
    const bool by_predicate =
        filter.is_there != nullptr || known.filter.is_there != nullptr;  // it may say otherwise now
    const bool same = Filter(filter) == Filter(known.filter) && filter.end == known.filter.end;
    if ((filter_ != nullptr) != known.filtered || by_predicate || !same) forget();
    known.filtered = filter_ != nullptr;
    known.filter = filter;
  }
  [[gnu::cold, gnu::noinline]] void leave_out_filtered() noexcept {
    Candidates& known = scratch_.solids;
    const Scenery& scenery = space_.scenery();
    const std::span<PieceIndex> pieces = std::span(known.pieces.data(), known.count);
    const auto end = std::remove_if(pieces.begin(), pieces.end(), [&](PieceIndex piece) {
      return !(*filter_)(scenery, scenery.pieces()[piece].collider);
    });
    known.count = static_cast<std::size_t>(end - pieces.begin());
  }

  const ConfigurationSpace& space_;
  const broad_phase::Tree& tree_;
  Real look_ahead_;
  const ColliderFilter* filter_;
  Scratch& scratch_;
};

inline std::span<const PieceIndex> Neighbourhood::around(const Box2& box, const Vec2& displacement) noexcept {
  Candidates& known = scratch_.solids;
  if (!known.valid || !known.box.contains(box)) {
    // A step that begins elsewhere is one of another character, and the next step will be, too: pieces ahead of this
    // one are not needed.
    const bool goes_on = !known.valid || known.box.overlaps(box);
    known.box = positions_ahead(box, goes_on ? displacement : Vec2(Vec2::Zero()), look_ahead_);
    known.count = tree_.query(space_.touched_from(known.box), known.pieces);
    if (filter_ != nullptr) [[unlikely]]
      leave_out_filtered();
    known.valid = true;
  }
  return {known.pieces.data(), known.count};
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
