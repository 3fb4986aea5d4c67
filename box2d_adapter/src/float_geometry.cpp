#include "float_geometry.hpp"

namespace paperproof::box2d {

b2Vec2 rounded(const Vec2d& value) noexcept { return {static_cast<float>(value.x()), static_cast<float>(value.y())}; }

}  // namespace paperproof::box2d
