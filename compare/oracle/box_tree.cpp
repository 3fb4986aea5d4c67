#include "oracle/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace paperproof::compare::detail {
namespace {

constexpr std::uint32_t leaf_size = 4;
constexpr std::size_t max_depth = 64;

}  // namespace

BoxTree::BoxTree(std::vector<Box2> boxes, std::vector<std::uint32_t> names)
    : boxes_(std::move(boxes)), names_(std::move(names)), order_(boxes_.size()) {
  if (boxes_.empty()) return;
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(boxes_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<std::uint32_t>(boxes_.size()));
}

void BoxTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t count) {
  Box2 box = boxes_[order_[first]];
  for (std::uint32_t i = first + 1; i < first + count; ++i) box = box.merged(boxes_[order_[i]]);
  nodes_[node].box = box;
  if (count <= leaf_size) {
    nodes_[node].first = first;
    nodes_[node].count = count;
    return;
  }
  const bool wide = box.upper.x() - box.lower.x() >= box.upper.y() - box.lower.y();
  const auto centre = [&](std::uint32_t i) {
    const Box2& b = boxes_[i];
    return wide ? b.lower.x() + b.upper.x() : b.lower.y() + b.upper.y();
  };
  const std::uint32_t half = count / 2;
  const auto begin = order_.begin() + first;
  std::nth_element(begin, begin + half, begin + count, [&](std::uint32_t a, std::uint32_t b) {
    return centre(a) != centre(b) ? centre(a) < centre(b) : a < b;
  });
  const auto left = static_cast<std::uint32_t>(nodes_.size());
  nodes_[node].first = left;
  nodes_.emplace_back();
  nodes_.emplace_back();
  build(left, first, half);
  build(left + 1, first + half, count - half);
}

std::vector<std::uint32_t> BoxTree::meeting(const Box2& box) const {
  std::vector<std::uint32_t> found;
  if (nodes_.empty()) return found;
  std::array<std::uint32_t, max_depth> waiting{};
  std::size_t size = 1;
  while (size > 0) {
    const Node& node = nodes_[waiting[--size]];
    if (!node.box.overlaps(box)) continue;
    if (node.count == 0) {
      waiting[size++] = node.first + 1;
      waiting[size++] = node.first;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (boxes_[order_[i]].overlaps(box)) found.push_back(names_[order_[i]]);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace paperproof::compare::detail
