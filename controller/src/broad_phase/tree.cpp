#include "broad_phase/tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "broad_phase/hilbert_order.hpp"

namespace paperproof::broad_phase {
namespace {

constexpr std::size_t fan = 4;
constexpr float most = std::numeric_limits<float>::max();

/// A float that is not above a number, and one that is not below it: a few times further away than the nearest, as
/// finding the next one takes as long as the rest of a small query.
[[gnu::always_inline]] inline float rounded_down(double value) noexcept {
  const auto near = static_cast<float>(std::clamp(value, -double{most}, double{most}));
  return near - (std::abs(near) * 0x1p-22F + std::numeric_limits<float>::min());
}
[[gnu::always_inline]] inline float rounded_up(double value) noexcept { return -rounded_down(-value); }

template <class Scalar>
[[gnu::always_inline]] inline Box2<float> rounded_outwards(const Box2<Scalar>& box) noexcept {
  return {{rounded_down(box.lower.x()), rounded_down(box.lower.y())},
          {rounded_up(box.upper.x()), rounded_up(box.upper.y())}};
}

/// A node: its level in the upper half, and which one of that level it is in the lower.
using Place = std::uint64_t;
constexpr Place place_of(std::uint64_t level, std::uint64_t node) noexcept { return level << 32U | node; }
constexpr std::uint64_t level_of(Place place) noexcept { return place >> 32U; }
constexpr std::uint64_t node_of(Place place) noexcept { return place & 0xffffffffU; }

/// A query finds some ten pieces, in any order: each goes to its place, which is the number of those before it, and
/// nothing branches on which is less.
void sort_few(std::span<PieceIndex> pieces) noexcept {
  constexpr std::size_t few = 16;
  if (pieces.size() > few) return std::sort(pieces.begin(), pieces.end());
  std::array<PieceIndex, few> given;
  given.fill(std::numeric_limits<PieceIndex>::max());
  std::copy(pieces.begin(), pieces.end(), given.begin());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const PieceIndex piece = given[i];
    std::uint32_t place = 0;
    for (const PieceIndex other : given) place += other < piece ? 1U : 0U;
    pieces[place] = piece;
  }
}

}  // namespace

template <class Scalar>
Tree<Scalar>::Tree(std::span<const Box2<Scalar>> boxes) : boxes_(boxes), order_(hilbert_order(boxes)) {
  std::vector<Box2<float>> below;
  below.reserve(boxes.size());
  for (const PieceIndex piece : order_) below.push_back(rounded_outwards(boxes[piece]));
  nodes_.reserve(boxes.size() / (fan - 1) + most_levels);
  while (!below.empty() && (levels_.empty() || below.size() > 1)) add_level(below);
  nodes_.shrink_to_fit();
}

/// @param boxes of what is below; becomes those of the nodes that are added.
template <class Scalar>
void Tree<Scalar>::add_level(std::vector<Box2<float>>& boxes) {
  levels_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  std::size_t made = 0;
  for (std::size_t first = 0; first < boxes.size(); first += fan) {
    const Four nothing = std::numeric_limits<float>::quiet_NaN() - Four{};
    Node node{nothing, nothing, nothing, nothing};
    Box2<float> around = boxes[first];
    for (std::size_t k = 0; k < std::min(fan, boxes.size() - first); ++k) {
      const Box2<float>& box = boxes[first + k];
      node.lower_x[k] = box.lower.x();
      node.lower_y[k] = box.lower.y();
      node.upper_x[k] = box.upper.x();
      node.upper_y[k] = box.upper.y();
      around = around.merged(box);
    }
    nodes_.push_back(node);
    boxes[made++] = around;
  }
  boxes.resize(made);
}

template <class Scalar>
std::size_t Tree<Scalar>::query(const Box2<Scalar>& query, std::span<PieceIndex> found) const noexcept {
  if (levels_.empty()) return 0;
  // Each level leaves three nodes for later at most; and a place is written for each child, met or not.
  std::array<Place, (fan - 1) * most_levels + 1 + fan> open;
  open[0] = place_of(levels_.size() - 1, 0);
  const Box2<float> wanted = rounded_outwards(query);
  std::size_t count = 0;
  for (std::size_t left = 1; left > 0;) {
    const Place place = open[--left];
    const std::uint64_t level = level_of(place);
    const Node& node = nodes_[levels_[level] + node_of(place)];
    const auto met = (node.lower_x <= wanted.upper.x()) & (node.upper_x >= wanted.lower.x()) &
                     (node.lower_y <= wanted.upper.y()) & (node.upper_y >= wanted.lower.y());
    const std::uint64_t below = node_of(place) * fan;
    if (level > 0) {
      // Nothing branches on which children are met: no processor foresees that, and it cost more than all arithmetic.
      const Place first = place_of(level - 1, below);
      const auto each = std::bit_cast<std::array<std::uint32_t, fan>>(met);
      for (std::size_t k = 0; k < fan; ++k) {
        open[left] = first + k;
        left += each[k] & 1U;
      }
      continue;
    }
    for (std::size_t k = 0; k < fan; ++k) {
      if (met[k] == 0 || !boxes_[order_[below + k]].overlaps(query)) continue;
      if (count < found.size()) found[count] = order_[below + k];
      ++count;
    }
  }
  if (count <= found.size()) sort_few(found.first(count));
  return count;
}

template class Tree<float>;
template class Tree<double>;

}  // namespace paperproof::broad_phase
