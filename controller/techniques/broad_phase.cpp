#include <paperproof/broad_phase.hpp>
#include <paperproof/scenery.hpp>

#include <algorithm>
#include <numeric>

namespace paperproof {
namespace {

class Buckets final : public BroadPhase {
 public:
  explicit Buckets(std::span<const Box2> boxes) : boxes_(boxes) {
    for (PieceIndex piece = 0; piece < boxes.size(); ++piece) grid_.add(piece, boxes[piece]);
  }

 private:
  void find(const Box2& query, std::vector<PieceIndex>& found) const override { grid_.find(query, boxes_, found); }

  std::span<const Box2> boxes_;
  PieceGrid grid_;
};

/// A range of boxes is parted in the middle of their order along the longer side of what they cover, again and again. A
/// range that has few is searched one by one.
class Tree final : public BroadPhase {
 public:
  Tree(std::span<const Box2> boxes, std::size_t few)
      : boxes_(boxes), few_(few), order_(boxes.size()), covered_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), PieceIndex{0});
    part(0, boxes.size());
  }

 private:
  void part(std::size_t first, std::size_t end) {
    if (end - first <= few_) return;
    const std::size_t middle = std::midpoint(first, end);
    const std::span<PieceIndex> range = std::span(order_).subspan(first, end - first);
    Box2& covered = covered_[middle] = Box2::nowhere();
    for (const PieceIndex piece : range) covered = covered.merged(boxes_[piece]);
    Eigen::Index along = 0;
    covered.size().maxCoeff(&along);
    const auto place = [&](PieceIndex piece) { return boxes_[piece].lower[along] + boxes_[piece].upper[along]; };
    std::ranges::nth_element(range, range.begin() + std::ssize(range) / 2, {}, place);
    part(first, middle);
    part(middle, end);
  }

  void find_in(std::size_t first, std::size_t end, const Box2& query, std::vector<PieceIndex>& found) const {
    const std::size_t middle = std::midpoint(first, end);
    if (end - first <= few_) {
      for (const PieceIndex piece : std::span(order_).subspan(first, end - first))
        if (boxes_[piece].overlaps(query)) found.push_back(piece);
    } else if (covered_[middle].overlaps(query)) {
      find_in(first, middle, query, found);
      find_in(middle, end, query, found);
    }
  }

  void find(const Box2& query, std::vector<PieceIndex>& found) const override {
    find_in(0, boxes_.size(), query, found);
  }

  std::span<const Box2> boxes_;
  std::size_t few_;
  std::vector<PieceIndex> order_;
  std::vector<Box2> covered_;  ///< By the middle of a range that is parted.
};

}  // namespace

void BroadPhase::query(const Box2& query, std::vector<PieceIndex>& found) const {
  const auto first = std::ssize(found);
  find(query, found);
  std::sort(found.begin() + first, found.end());
}

std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseKind kind, std::span<const Box2> boxes) {
  constexpr std::size_t few = 8;
  if (kind == BroadPhaseKind::buckets) return std::make_unique<Buckets>(boxes);
  return std::make_unique<Tree>(boxes, kind == BroadPhaseKind::tree ? few : boxes.size());
}

}  // namespace paperproof
