#include <paperproof/broad_phase.hpp>

#include "techniques/broad_phase/buckets.hpp"
#include "techniques/broad_phase/tree.hpp"

namespace paperproof {
namespace {

/// A tree, or all boxes one by one.
class TreeSearch final : public BroadPhase {
 public:
  TreeSearch(std::span<const Box2> boxes, bool one_by_one) : tree_(boxes, one_by_one) {}

  [[nodiscard]] std::size_t query(const Box2& query, std::span<PieceIndex> found) const noexcept override {
    return tree_.query(query, found);
  }

 private:
  broad_phase::Tree tree_;
};

}  // namespace

std::string_view name_of(BroadPhaseKind kind) noexcept {
  switch (kind) {
    case BroadPhaseKind::all_pairs:
      return "all_pairs";
    case BroadPhaseKind::buckets:
      return "buckets";
    case BroadPhaseKind::tree:
      break;
  }
  return "tree";
}

std::unique_ptr<BroadPhase> make_broad_phase(BroadPhaseKind kind, std::span<const Box2> boxes) {
  if (kind == BroadPhaseKind::buckets) return std::make_unique<broad_phase::Buckets>(boxes);
  return std::make_unique<TreeSearch>(boxes, kind == BroadPhaseKind::all_pairs);
}

}  // namespace paperproof
