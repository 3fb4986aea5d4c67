/// The broad phase for many boxes.
#pragma once

#include <paperproof/broad_phase.hpp>

namespace paperproof::broad_phase {

/// A binary tree of boxes, packed in the order of a depth-first walk.
///
/// A node's first child is the next node, and a node whose box misses the query is left by its `skip`: one pass forward
/// through one array, so a query needs neither a stack nor pointers.
template <class Scalar>
class Tree final : public BroadPhase<Scalar> {
 public:
  explicit Tree(std::span<const Box2<Scalar>> boxes);

  [[nodiscard]] std::size_t query(const Box2<Scalar>& query, std::span<PieceIndex> found) const noexcept override;
  [[nodiscard]] std::size_t size() const noexcept override { return leaf_boxes_.size(); }

 private:
  struct Node {
    Box2<Scalar> box;
    std::uint32_t skip = 0;   ///< The node to go on with if nothing below this one can meet the query.
    std::uint32_t first = 0;  ///< Leaves: into `leaf_boxes_` and `leaf_pieces_`.
    std::uint32_t count = 0;  ///< Leaves: how many boxes; 0 for all other nodes.
  };

  void build(std::span<const Box2<Scalar>> boxes, std::span<PieceIndex> pieces);

  std::vector<Node> nodes_;
  std::vector<Box2<Scalar>> leaf_boxes_;
  std::vector<PieceIndex> leaf_pieces_;
};

}  // namespace paperproof::broad_phase
