#include <paperproof/broad_phase.hpp>

#include "broad_phase/tree.hpp"
#include "techniques/broad_phase/buckets.hpp"

namespace paperproof {
namespace {

/// The search of the core, with its tree or without.
class CoreSearch final : public BroadPhase {
 public:
  CoreSearch(std::span<const Box2> boxes, PieceSearch search) : tree_(boxes, search) {}

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
  const bool all_pairs = kind == BroadPhaseKind::all_pairs;
  return std::make_unique<CoreSearch>(boxes, all_pairs ? PieceSearch::one_by_one : PieceSearch::tree);
}

}  // namespace paperproof
