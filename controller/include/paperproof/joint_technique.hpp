/// A technique that moves several characters in one call.
#pragma once

#include <paperproof/crowd.hpp>

#include <span>

namespace paperproof {

/// Const and shareable between threads, as every technique.
template <class Scalar>
class JointTechnique : public Technique<Scalar> {
 public:
  /// Memory for up to `most_characters`. For one character it is the memory of `make_scratch`.
  [[nodiscard]] virtual Scratch<Scalar> make_joint_scratch(std::size_t most_characters) const = 0;

  /// Never allocates and never throws.
  /// @param requests one for each character, all with the same movers; at most as many as the scratch was made for.
  /// @param report has at least as many members, cleared. The technique sets `step.move`, `met` (see
  ///   `CrowdReport::add_contact`), `started_overlapping` and `island` of each, and the `impacts` of the report.
  /// @return false if a step would leave the range that the technique is made for: then nothing moved.
  virtual bool move_together(std::span<const MoveRequest<Scalar>> requests, Scratch<Scalar>& scratch,
                             CrowdReport<Scalar>& report) const noexcept = 0;
};

}  // namespace paperproof
