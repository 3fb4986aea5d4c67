/// A binary tree of boxes: which of them meet a given box. The oracle's own, independent of the controller's.
#pragma once

#include <paperproof/types.hpp>

#include <span>
#include <vector>

namespace paperproof::compare::detail {

/// Immutable after construction; may be shared between threads.
class BoxTree {
 public:
  BoxTree() = default;
  /// @param names what each box is called in an answer.
  BoxTree(std::vector<Box2> boxes, std::vector<std::uint32_t> names);

  /// The names of the boxes that meet `box` (closed), ascending.
  [[nodiscard]] std::vector<std::uint32_t> meeting(const Box2& box) const;

 private:
  struct Node {
    Box2 box;
    std::uint32_t first = 0;  ///< Leaf: into `order_`. Inner node: the left child; the right one follows it.
    std::uint32_t count = 0;  ///< 0 for an inner node.
  };
  void build(std::uint32_t node, std::uint32_t first, std::uint32_t count);

  std::vector<Box2> boxes_;
  std::vector<std::uint32_t> names_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

}  // namespace paperproof::compare::detail
