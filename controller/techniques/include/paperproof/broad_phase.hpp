/// The broad phases of the techniques: which pieces are near a box.
#pragma once

#include <paperproof/types.hpp>

#include <memory>
#include <span>
#include <string_view>

namespace paperproof {

/// The pieces whose bounding boxes meet a query box.
///
/// Every implementation returns the same pieces in the same order (ascending index): implementations differ in cost
/// only. Immutable after construction; may be shared between threads.
class BroadPhase {
 public:
  virtual ~BroadPhase() = default;

  /// Writes the indices of all boxes that meet `query` (closed: touching counts) to `found`, ascending.
  /// @return the number of these boxes. If it exceeds `found.size()`, the contents of `found` are unspecified: call
  ///   again with more room.
  [[nodiscard]] virtual std::size_t query(const Box2& query, std::span<PieceIndex> found) const noexcept = 0;
};

enum class BroadPhaseKind : std::uint8_t { all_pairs, buckets, tree };
[[nodiscard]] std::string_view name_of(BroadPhaseKind kind) noexcept;

/// Builds a broad phase over `boxes` (finite), which must outlive it and stay as they are.
///
/// - `all_pairs` looks at every box: the slow, honest twin.
/// - `buckets` is a grid of uniform squares, kept in a hash table: constant cost where boxes are alike and queries are
///   small.
/// - `tree` is a packed tree of boxes, sixteen to a node: the cost is logarithmic in the number of boxes.
[[nodiscard]] std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseKind kind, std::span<const Box2> boxes);

}  // namespace paperproof
