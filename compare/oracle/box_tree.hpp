/// A tree of boxes: which of them meet a given box. Boost's, independent of the controller's.
#pragma once

#include <paperproof/types.hpp>

#include <memory>
#include <span>
#include <vector>

namespace paperproof::compare::detail {

/// Immutable after construction; may be shared between threads.
class BoxTree {
 public:
  BoxTree() = default;
  /// @param names what each box is called in an answer.
  BoxTree(std::span<const Box2> boxes, std::span<const std::uint32_t> names);

  /// The names of the boxes that meet `box` (closed), ascending.
  [[nodiscard]] std::vector<std::uint32_t> meeting(const Box2& box) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace paperproof::compare::detail
