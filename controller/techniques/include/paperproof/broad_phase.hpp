/// The broad phases of the techniques: which pieces are near a box.
#pragma once

#include <paperproof/types.hpp>

#include <memory>
#include <span>
#include <vector>

namespace paperproof {

/// The pieces whose bounding boxes meet a query box.
///
/// Every implementation returns the same pieces in the same order (ascending index): implementations differ in cost
/// only. Immutable after construction; may be shared between threads.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  /// Appends the indices of all boxes that meet `query` (closed: touching counts) to `found`, ascending. Allocates only
  /// where `found` has no room.
  void query(const Box2& query, std::vector<PieceIndex>& found) const;

 private:
  /// The same in any order.
  virtual void find(const Box2& query, std::vector<PieceIndex>& found) const = 0;
};

enum class BroadPhaseKind : std::uint8_t { all_pairs, buckets, tree };

/// Builds a broad phase over `boxes`, which must outlive it and stay as they are.
///
/// - `all_pairs` looks at every box: the slow, honest twin.
/// - `buckets` are grids of uniform squares, kept in hash tables: constant cost where queries are small. It is the grid
///   of the core, and its boxes are in the range of a scenery.
/// - `tree` is a binary tree of boxes: the cost is logarithmic in the number of boxes. Its boxes are finite.
[[nodiscard]] std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseKind kind, std::span<const Box2> boxes);

}  // namespace paperproof
