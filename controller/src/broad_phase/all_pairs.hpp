/// The broad phase that looks at every box.
#pragma once

#include <paperproof/broad_phase.hpp>

namespace paperproof::broad_phase {

/// The slow, honest twin of the others: only the overlap test itself can be wrong here.
template <class Scalar>
class AllPairs final : public BroadPhase<Scalar> {
 public:
  explicit AllPairs(std::span<const Box2<Scalar>> boxes) : boxes_(boxes) {}

  [[nodiscard]] std::size_t query(const Box2<Scalar>& query, std::span<PieceIndex> found) const noexcept override {
    std::size_t count = 0;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (!boxes_[i].overlaps(query)) continue;
      if (count < found.size()) found[count] = static_cast<PieceIndex>(i);
      ++count;
    }
    return count;
  }
  [[nodiscard]] std::size_t size() const noexcept override { return boxes_.size(); }

 private:
  std::span<const Box2<Scalar>> boxes_;
};

}  // namespace paperproof::broad_phase
