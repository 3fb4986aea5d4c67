/// The broad phase for many boxes.
#pragma once

#include <paperproof/broad_phase.hpp>

namespace paperproof::broad_phase {

/// A tree of boxes with four children to a node, packed (I. Kamel and C. Faloutsos 1993, "On packing R-trees"): boxes
/// in the order of a Hilbert curve through their centres, each four of them in a node, each four nodes in one above.
///
/// Which nodes are below one follows from its place, so that a node is four boxes and nothing else: in `float`, rounded
/// outwards, they fill one cache line. A box that is found so is looked at again as it was given.
template <class Scalar>
class Tree final : public BroadPhase<Scalar> {
 public:
  explicit Tree(std::span<const Box2<Scalar>> boxes);

  [[nodiscard]] std::size_t query(const Box2<Scalar>& query, std::span<PieceIndex> found) const noexcept override;
  [[nodiscard]] std::size_t size() const noexcept override { return boxes_.size(); }

 private:
  static constexpr std::size_t most_levels = 16;  ///< Of 2^32 boxes.
  using Four [[gnu::vector_size(4 * sizeof(float))]] = float;
  /// Not a number where there is no box: that overlaps nothing.
  struct Node {
    Four lower_x;
    Four lower_y;
    Four upper_x;
    Four upper_y;
  };

  void add_level(std::vector<Box2<float>>& boxes);

  std::span<const Box2<Scalar>> boxes_;
  std::vector<PieceIndex> order_;  ///< Along the curve.
  std::vector<Node> nodes_;        ///< Level by level: those of four boxes, those of four such nodes, …, the root.
  FixedVector<std::uint32_t, most_levels> levels_;  ///< The first node of each.
};

}  // namespace paperproof::broad_phase
