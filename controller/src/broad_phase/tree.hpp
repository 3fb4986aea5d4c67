/// The broad phase for many boxes.
#pragma once

#include <paperproof/broad_phase.hpp>

#include <array>

namespace paperproof::broad_phase {

/// A tree of boxes with sixteen children to a node, packed (I. Kamel and C. Faloutsos 1993, "On packing R-trees"):
/// boxes in the order of a Hilbert curve through their centres, each sixteen of them in a node, each sixteen nodes in
/// one above. With fewer to a node a query waits more often for the memory of the next level; with more it looks at
/// boxes far away.
///
/// The place of a node determines its children, so a node stores only its boxes, in `float`, rounded outwards. A box
/// that a query finds this way is tested again with its given coordinates.
template <class Scalar>
class Tree final : public BroadPhase<Scalar> {
 public:
  explicit Tree(std::span<const Box2<Scalar>> boxes);

  [[nodiscard]] std::size_t query(const Box2<Scalar>& query, std::span<PieceIndex> found) const noexcept override;
  [[nodiscard]] std::size_t size() const noexcept override { return boxes_.size(); }

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

  [[nodiscard]] static unsigned met_by(const Node& node, const Box2<float>& box) noexcept;
  void add_level(std::vector<Box2<float>>& boxes);

  std::span<const Box2<Scalar>> boxes_;
  std::vector<PieceIndex> order_;  ///< Along the curve.
  std::vector<Node> nodes_;        ///< Level by level: nodes of boxes, nodes of these nodes, …, the root.
  FixedVector<std::uint32_t, most_levels> levels_;  ///< The first node of each.
};

}  // namespace paperproof::broad_phase
