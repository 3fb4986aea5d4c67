#include "broad_phase/tree.hpp"

namespace paperproof::broad_phase {
namespace {

/// Boxes per leaf. One: twice the nodes to walk. Many: boxes are tested that the node above could have ruled out.
constexpr std::size_t leaf_size = 4;

/// Halved before adding, so that huge boxes do not overflow.
template <class Scalar>
Vec2<Scalar> centre(const Box2<Scalar>& box) {
  return Scalar(0.5) * box.lower + Scalar(0.5) * box.upper;
}

/// 0 (x) or 1 (y): the direction in which the centres are spread wider.
template <class Scalar>
Eigen::Index longer_axis(std::span<const Box2<Scalar>> boxes, std::span<const PieceIndex> pieces) {
  Vec2<Scalar> lower = centre(boxes[pieces[0]]);
  Vec2<Scalar> upper = lower;
  for (const PieceIndex piece : pieces) {
    const Vec2<Scalar> at = centre(boxes[piece]);
    lower = lower.cwiseMin(at);
    upper = upper.cwiseMax(at);
  }
  const Vec2<Scalar> halves = Scalar(0.5) * upper - Scalar(0.5) * lower;
  return halves.x() >= halves.y() ? 0 : 1;
}

}  // namespace

template <class Scalar>
Tree<Scalar>::Tree(std::span<const Box2<Scalar>> boxes) {
  std::vector<PieceIndex> pieces(boxes.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i] = static_cast<PieceIndex>(i);
  leaf_boxes_.reserve(boxes.size());
  leaf_pieces_.reserve(boxes.size());
  if (!pieces.empty()) build(boxes, pieces);
}

/// Appends the subtree over `pieces`, which is reordered. Halving keeps the recursion at most 32 deep.
template <class Scalar>
void Tree<Scalar>::build(std::span<const Box2<Scalar>> boxes, std::span<PieceIndex> pieces) {
  const std::size_t self = nodes_.size();
  Node node;
  node.box = boxes[pieces[0]];
  for (const PieceIndex piece : pieces) node.box = node.box.merged(boxes[piece]);
  nodes_.push_back(node);

  if (pieces.size() <= leaf_size) {
    nodes_[self].first = static_cast<std::uint32_t>(leaf_boxes_.size());
    nodes_[self].count = static_cast<std::uint32_t>(pieces.size());
    for (const PieceIndex piece : pieces) {
      leaf_boxes_.push_back(boxes[piece]);
      leaf_pieces_.push_back(piece);
    }
  } else {
    const Eigen::Index axis = longer_axis<Scalar>(boxes, pieces);
    const std::size_t half = pieces.size() / 2;
    std::nth_element(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(half), pieces.end(),
                     [&](PieceIndex a, PieceIndex b) {
                       const Scalar at_a = centre(boxes[a])[axis];
                       const Scalar at_b = centre(boxes[b])[axis];
                       return at_a != at_b ? at_a < at_b : a < b;
                     });
    build(boxes, pieces.first(half));
    build(boxes, pieces.subspan(half));
  }
  nodes_[self].skip = static_cast<std::uint32_t>(nodes_.size());
}

template <class Scalar>
std::size_t Tree<Scalar>::query(const Box2<Scalar>& query, std::span<PieceIndex> found) const noexcept {
  std::size_t count = 0;
  for (std::size_t at = 0; at < nodes_.size();) {
    const Node& node = nodes_[at];
    if (!node.box.overlaps(query)) {
      at = node.skip;
      continue;
    }
    for (std::size_t i = node.first; i < node.first + node.count; ++i) {
      if (!leaf_boxes_[i].overlaps(query)) continue;
      if (count < found.size()) found[count] = leaf_pieces_[i];
      ++count;
    }
    ++at;
  }
  if (count <= found.size()) std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

template class Tree<float>;
template class Tree<double>;

}  // namespace paperproof::broad_phase
