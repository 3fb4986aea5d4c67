/// A technique that moves several characters in one go, instead of one by one.
#pragma once

#include <paperproof/crowd.hpp>

#include <span>

namespace paperproof {

/// Const and shareable between threads, as every technique.
template <class Scalar>
class JointTechnique : public Technique<Scalar> {
 public:
  /// For one character it is what `make_scratch` gives.
  [[nodiscard]] virtual Scratch<Scalar> make_joint_scratch(std::size_t most_characters) const = 0;

  /// Never allocates and never throws.
  /// @param requests one for each character, all with the same movers; at most as many as the scratch was made for.
  /// @param report has as many members, cleared. Of each its `step.move`, `met`, `started_overlapping` and `island` are
  ///   filled in, and of the report its `impacts`.
  /// @return false where the step would leave the range the technique is made for: nothing was moved.
  virtual bool move_together(std::span<const MoveRequest<Scalar>> requests, Scratch<Scalar>& scratch,
                             CrowdReport<Scalar>& report) const noexcept = 0;
};

}  // namespace paperproof
