/// Sorts boxes so that neighbours are close together in the order.
#pragma once

#include <paperproof/types.hpp>

#include <span>
#include <vector>

namespace paperproof::broad_phase {

/// The indices of all boxes, along a Hilbert curve through their centres: consecutive ones lie close together. Boxes in
/// the same cell of a curve of 2^16 cells a side are ordered among themselves by a curve of their own, so one box far
/// away does no harm.
[[nodiscard]] std::vector<PieceIndex> hilbert_order(std::span<const Box2> boxes);

}  // namespace paperproof::broad_phase
