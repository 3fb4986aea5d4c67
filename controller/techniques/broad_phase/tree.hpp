/// Which boxes meet a box.
#pragma once

#include <paperproof/types.hpp>

#include <array>
#include <span>
#include <vector>

namespace paperproof::broad_phase {

/// A box in `float` that holds one in `double`.
struct RoundedBox {
  Vec2f lower;
  Vec2f upper;
};

/// A tree of boxes with sixteen children to a node, packed (I. Kamel and C. Faloutsos 1993, "On packing R-trees"):
/// boxes in the order of a Hilbert curve through their centres, each sixteen of them in a node, each sixteen nodes in
/// one above. With fewer to a node a query waits more often for the memory of the next level; with more it looks at
/// boxes far away.
///
/// The place of a node determines its children, so a node stores only its boxes, in `float`, rounded outwards. A box
/// that a query finds this way is tested again with its given coordinates.
///
/// Immutable after construction; may be shared between threads; a query never allocates.
class Tree {
 public:
  /// @param boxes finite; they must outlive the tree and stay as they are.
  /// @param one_by_one nothing is built, as for boxes so few that a tree costs more than it saves.
  explicit Tree(std::span<const Box2> boxes, bool one_by_one = false);

  /// Writes the indices of all boxes that meet `query` (closed: touching counts) to `found`, ascending.
  /// @return the number of these boxes. If it exceeds `found.size()`, the contents of `found` are unspecified: call
  ///   again with more room.
  [[nodiscard]] std::size_t query(const Box2& query, std::span<PieceIndex> found) const noexcept;

 private:
  static constexpr std::size_t fan = 16;
  static constexpr std::size_t most_levels = 8;  ///< Of 2^32 boxes.
  using Four [[gnu::vector_size(4 * sizeof(float))]] = float;
  /// A coordinate of all boxes of a node.
  using Each = std::array<Four, fan / 4>;
  /// Not a number if there is no box: NaN overlaps nothing.
  struct Node {
    Each lower_x;
    Each lower_y;
    Each upper_x;
    Each upper_y;
  };

  [[nodiscard]] std::size_t query_each(const Box2& query, std::span<PieceIndex> found) const noexcept;
  [[nodiscard]] static unsigned met_by(const Node& node, const RoundedBox& box) noexcept;
  void add_level(std::vector<RoundedBox>& boxes);

  std::span<const Box2> boxes_;
  std::vector<PieceIndex> order_;  ///< Along the curve.
  std::vector<Node> nodes_;        ///< Level by level: nodes of boxes, nodes of these nodes, …, the root.
  FixedVector<std::uint32_t, most_levels> levels_;  ///< The first node of each.
};

}  // namespace paperproof::broad_phase
