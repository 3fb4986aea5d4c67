#include "techniques/broad_phase/tree.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "techniques/broad_phase/hilbert_order.hpp"

namespace paperproof::broad_phase {
namespace {

constexpr float most = std::numeric_limits<float>::max();

/// Up to this many boxes, a test of each costs no more than a search: 1.7 ns for each against 45 ns.
constexpr std::size_t few = 16;

/// A float not above a number, and a float not below it. They are a few times further away than the nearest such float,
/// because finding the nearest takes as long as the rest of a small query.
[[gnu::always_inline]] inline float rounded_down(double value) noexcept {
  const auto near = static_cast<float>(std::clamp(value, -double{most}, double{most}));
  return near - (std::abs(near) * 0x1p-22F + std::numeric_limits<float>::min());
}
[[gnu::always_inline]] inline float rounded_up(double value) noexcept { return -rounded_down(-value); }

[[gnu::always_inline]] inline RoundedBox rounded_outwards(const Box2& box) noexcept {
  return {{rounded_down(box.lower.x()), rounded_down(box.lower.y())},
          {rounded_up(box.upper.x()), rounded_up(box.upper.y())}};
}

/// Sorts the ten or so pieces that a query finds. The place of a piece is the number of smaller pieces, so the
/// comparison needs no branch.
void sort_few(std::span<PieceIndex> pieces) noexcept {
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

Tree::Tree(std::span<const Box2> boxes, bool one_by_one) : boxes_(boxes) {
  if (one_by_one || boxes.size() <= few) return;
  order_ = hilbert_order(boxes);
  std::vector<RoundedBox> below;
  below.reserve(boxes.size());
  for (const PieceIndex piece : order_) below.push_back(rounded_outwards(boxes[piece]));
  nodes_.reserve(boxes.size() / (fan - 1) + most_levels);
  while (below.size() > 1) add_level(below);
  nodes_.shrink_to_fit();
}

/// @param boxes of the level below; replaced by the boxes of the added nodes.
void Tree::add_level(std::vector<RoundedBox>& boxes) {
  levels_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  std::size_t made = 0;
  for (std::size_t first = 0; first < boxes.size(); first += fan) {
    Each nothing;
    nothing.fill(std::numeric_limits<float>::quiet_NaN() - Four{});
    Node node{nothing, nothing, nothing, nothing};
    RoundedBox around = boxes[first];
    for (std::size_t k = 0; k < std::min(fan, boxes.size() - first); ++k) {
      const RoundedBox& box = boxes[first + k];
      node.lower_x[k / 4][k % 4] = box.lower.x();
      node.lower_y[k / 4][k % 4] = box.lower.y();
      node.upper_x[k / 4][k % 4] = box.upper.x();
      node.upper_y[k / 4][k % 4] = box.upper.y();
      around = {around.lower.cwiseMin(box.lower), around.upper.cwiseMax(box.upper)};
    }
    nodes_.push_back(node);
    boxes[made++] = around;
  }
  boxes.resize(made);
}

/// One bit for each child.
[[gnu::always_inline]] inline unsigned Tree::met_by(const Node& node, const RoundedBox& box) noexcept {
  using Flags [[gnu::vector_size(4 * sizeof(int))]] = int;
  Flags overlapped{};
  Flags bit_of_each{1, 2, 4, 8};
  for (std::size_t i = 0; i < fan / 4; ++i) {
    const Flags met = (node.lower_x[i] <= box.upper.x()) & (node.upper_x[i] >= box.lower.x()) &
                      (node.lower_y[i] <= box.upper.y()) & (node.upper_y[i] >= box.lower.y());
    overlapped |= met & bit_of_each;
    bit_of_each <<= 4;
  }
  return static_cast<unsigned>(overlapped[0] | overlapped[1] | overlapped[2] | overlapped[3]);
}

std::size_t Tree::query_each(const Box2& query, std::span<PieceIndex> found) const noexcept {
  std::size_t count = 0;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!boxes_[i].overlaps(query)) continue;
    if (count < found.size()) found[count] = static_cast<PieceIndex>(i);
    ++count;
  }
  return count;
}

std::size_t Tree::query(const Box2& query, std::span<PieceIndex> found) const noexcept {
  if (levels_.empty()) return query_each(query, found);
  struct Place {
    std::size_t level;
    std::size_t node;  ///< Of its level.
  };
  // Each level leaves at most all its nodes but one for later.
  FixedVector<Place, (fan - 1) * most_levels + 1> open;
  open.push_back({levels_.size() - 1, 0});
  const RoundedBox wanted = rounded_outwards(query);
  std::size_t count = 0;
  while (!open.empty()) {
    const Place place = open.back();
    open.pop_back();
    const Node& node = nodes_[levels_[place.level] + place.node];
    for (unsigned left = met_by(node, wanted); left != 0; left &= left - 1) {
      const std::size_t below = place.node * fan + static_cast<std::size_t>(std::countr_zero(left));
      if (place.level > 0) {
        open.push_back({place.level - 1, below});
      } else if (boxes_[order_[below]].overlaps(query)) {
        if (count < found.size()) found[count] = order_[below];
        ++count;
      }
    }
  }
  if (count <= found.size()) sort_few(found.first(count));
  return count;
}

}  // namespace paperproof::broad_phase
