/// The broad phase for many boxes of about the same size.
#pragma once

#include <paperproof/broad_phase.hpp>

#include <vector>

namespace paperproof::broad_phase {

/// A grid of uniform square cells. Each cell that some box meets has its entries in one bucket of a hash table, so that
/// memory grows with the boxes and not with the world (Teschner et al. 2003, "Optimized spatial hashing for collision
/// detection of deformable objects").
///
/// The side of a cell is the median of the boxes' longer sides, or more: in the densest region, the middle half of the
/// boxes, a cell has one box on average at least. Smaller cells: a box is in many of them. Larger: a cell is full of
/// boxes that are nowhere near.
///
/// A box that would fill more than 64 cells is not in the grid; every query looks at it. A query that covers more cells
/// than there are boxes looks at all boxes instead.
class Buckets final : public BroadPhase {
 public:
  explicit Buckets(std::span<const Box2> boxes);

  [[nodiscard]] std::size_t query(const Box2& query, std::span<PieceIndex> found) const noexcept override;

 private:
  struct Cell {
    std::int64_t x = 0;
    std::int64_t y = 0;
    friend bool operator==(const Cell&, const Cell&) = default;
  };
  /// All cells from one corner to the other, both included.
  struct Cells {
    Cell lower;
    Cell upper;
    [[nodiscard]] std::int64_t count() const noexcept { return (upper.x - lower.x + 1) * (upper.y - lower.y + 1); }
  };
  struct Entry {
    Cell cell;
    PieceIndex piece = 0;
  };

  [[nodiscard]] std::int64_t cell_of(double coordinate) const noexcept;
  [[nodiscard]] Cells cells_of(const Box2& box) const noexcept;
  [[nodiscard]] std::size_t bucket_of(const Cell& cell) const noexcept;
  [[nodiscard]] bool is_first_cell(const Cell& cell, const Cells& cells, const Box2& box) const noexcept;
  void fill();

  std::span<const Box2> boxes_;
  double cells_per_metre_ = 1;
  std::vector<PieceIndex> large_;           ///< Boxes that are not in the grid.
  std::vector<std::uint32_t> first_entry_;  ///< By bucket, and one more: where the last one ends.
  std::vector<Entry> entries_;
};

}  // namespace paperproof::broad_phase
