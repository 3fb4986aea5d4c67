/// How crowded a level can be.
#pragma once

#include <paperproof/types.hpp>

#include <span>

namespace paperproof::broad_phase {

/// No box of a size meets more of `boxes` than this, wherever it is. The bound is a few times what there is: memory is
/// sized by it. Linear in the number of boxes.
/// @param size [m]
template <class Scalar>
[[nodiscard]] std::size_t most_at_once(std::span<const Box2<Scalar>> boxes, const Vec2<Scalar>& size);

}  // namespace paperproof::broad_phase
