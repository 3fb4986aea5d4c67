/// Boxes in an order in which neighbours stand together.
#pragma once

#include <paperproof/types.hpp>

#include <span>
#include <vector>

namespace paperproof::broad_phase {

/// The indices of all boxes, along a Hilbert curve through their centres: consecutive ones lie close together. Boxes
/// that a curve of 2^16 cells a side does not tell apart are ordered among themselves by a curve of their own, so that
/// one box far away does no harm.
template <class Scalar>
[[nodiscard]] std::vector<PieceIndex> hilbert_order(std::span<const Box2<Scalar>> boxes);

}  // namespace paperproof::broad_phase
