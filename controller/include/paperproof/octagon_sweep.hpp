/// Choices for `octagon_sweep`, the controller's own way to move: the whole octagon is swept, so that nothing slips
/// between two of its points.
#pragma once

#include <cstdint>

namespace paperproof {

/// How a step finds the pieces that it looks at. It changes the cost of a step, and never its bits.
enum class PieceSearch : std::uint8_t {
  grid,        ///< The grid of the scenery finds those that are near.
  one_by_one,  ///< The box of each is compared.
  /// The slow, honest twin of the others. Each step looks at every piece that stands and of each mover that it comes
  /// near to, and asks for sensors, one-way chains and filters, whether the scenery has any or not.
  none,
};

struct SweepDef {
  PieceSearch search = PieceSearch::grid;
  int iterations = 12;  ///< Impacts per step before the rest of the displacement is dropped; from 1 to 60.
};

}  // namespace paperproof
