/// Which pieces of a mover are near a box.
#pragma once

#include "broad_phase/tree.hpp"

#include <paperproof/scenery.hpp>

#include <span>
#include <vector>

namespace paperproof::octagon_sweep {

/// A tree for each mover, over its pieces at offset zero: a mover keeps its shape, so it is the box that is
/// shifted. Immutable after construction; may be shared between threads.
class MoverPhases {
 public:
  MoverPhases(PieceSearch search, const Scenery& scenery);

  [[nodiscard]] MoverIndex size() const noexcept { return static_cast<MoverIndex>(movers_.size()); }

  /// Around all pieces of a mover at offset zero [m]. One that has none is nowhere: its box meets no other.
  [[nodiscard]] const Box2& whole(MoverIndex mover) const noexcept { return movers_[mover].whole; }

  /// The pieces whose boxes at offset zero meet `box`, ascending.
  /// @param found has room for all pieces of the mover.
  /// @return the part of `found` that was written.
  [[nodiscard]] std::span<const PieceIndex> query(MoverIndex mover, const Box2& box,
                                                  std::span<PieceIndex> found) const noexcept;

 private:
  struct Mover {
    Box2 whole;
    PieceIndex first = 0;
    broad_phase::Tree tree;
  };
  std::vector<Mover> movers_;
};

}  // namespace paperproof::octagon_sweep
