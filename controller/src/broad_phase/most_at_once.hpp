/// The largest number of boxes near one place of a level.
#pragma once

#include <paperproof/types.hpp>

#include <span>

namespace paperproof::broad_phase {

/// Upper bound for the number of `boxes` that a box of the given size meets, at any place. The bound is a few times the
/// true number; memory is sized by it. Linear in the number of boxes.
/// @param size [m]
[[nodiscard]] std::size_t most_at_once(std::span<const Box2> boxes, const Vec2d& size);

}  // namespace paperproof::broad_phase
