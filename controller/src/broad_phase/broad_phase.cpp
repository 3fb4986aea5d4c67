#include <paperproof/broad_phase.hpp>

#include "broad_phase/all_pairs.hpp"
#include "broad_phase/buckets.hpp"
#include "broad_phase/tree.hpp"

namespace paperproof {

template <class Scalar>
std::unique_ptr<BroadPhase<Scalar>> make_broad_phase(BroadPhaseKind kind, std::span<const Box2<Scalar>> boxes) {
  switch (kind) {
    case BroadPhaseKind::all_pairs:
      return std::make_unique<broad_phase::AllPairs<Scalar>>(boxes);
    case BroadPhaseKind::buckets:
      return std::make_unique<broad_phase::Buckets<Scalar>>(boxes);
    case BroadPhaseKind::tree:
      break;
  }
  return std::make_unique<broad_phase::Tree<Scalar>>(boxes);
}

template std::unique_ptr<BroadPhase<float>> make_broad_phase(BroadPhaseKind, std::span<const Box2<float>>);
template std::unique_ptr<BroadPhase<double>> make_broad_phase(BroadPhaseKind, std::span<const Box2<double>>);

}  // namespace paperproof
