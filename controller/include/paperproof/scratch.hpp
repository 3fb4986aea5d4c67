/// The memory of a step.
#pragma once

#include <paperproof/step_context.hpp>

#include <memory>

namespace paperproof {

/// Memory that only its owner knows how to use.
struct OwnMemory {
  virtual ~OwnMemory() = default;
};

/// Memory for the answer of a query that may find every piece of a level. It is not touched before it is needed, so
/// small answers take little memory, even in a large level.
class PieceBuffer {
 public:
  PieceBuffer() = default;
  explicit PieceBuffer(std::size_t size) : pieces_(std::make_unique_for_overwrite<PieceIndex[]>(size)), size_(size) {}

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] PieceIndex* data() const noexcept { return pieces_.get(); }
  [[nodiscard]] PieceIndex& operator[](std::size_t i) const noexcept { return pieces_[i]; }
  [[nodiscard]] PieceIndex* begin() const noexcept { return data(); }
  [[nodiscard]] PieceIndex* end() const noexcept { return data() + size_; }

 private:
  std::unique_ptr<PieceIndex[]> pieces_;
  std::size_t size_ = 0;
};

/// Pieces near a character: the answer of a broad phase, which holds for the next steps as well.
struct Candidates {
  PieceBuffer pieces;  ///< Has room for the largest possible answer.
  std::size_t count = 0;
  Box2 box;  ///< Positions of the character for which the pieces are complete, if `valid`.
  bool valid = false;
  /// Positions known to be quiet: while the character moves among them, nothing happens between it and any piece.
  Box2 quiet{Vec2d::Constant(1), Vec2d::Constant(-1)};
  bool filtered = false;    ///< Pieces that are not there are missing,
  ColliderFilter filter{};  ///< by this filter.
};

/// Memory of a step, one per thread. It belongs to the controller that made it and carries nothing
/// from one step to the next that could change a result.
struct Scratch {
  Candidates solids;               ///< Belongs to the move, as the next member does.
  std::unique_ptr<OwnMemory> own;  ///< Of `octagon_sweep`, and of few other techniques.
  Candidates sensors;              ///< Belongs to the controller, as all that follows.
  Candidates one_way;
  /// The maker of this memory: a controller refuses memory that another controller made. The mark expires with its
  /// controller, so it never matches a later controller at the same address.
  std::weak_ptr<const void> maker;
};

}  // namespace paperproof
