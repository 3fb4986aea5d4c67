#include "broad_phase/most_at_once.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <vector>

namespace paperproof::broad_phase {
namespace {

/// Number of size classes. The class of a box is the power of two that exceeds its longer side; the last class holds
/// all larger boxes.
constexpr std::size_t classes = 48;
/// Factor by which cells are widened: rounding may decide whether two boxes touch at their ends.
constexpr double spare = 1.01;

/// Boxes farther out are in the last cell.
constexpr double outermost = 0x1p60;

std::size_t mixed(std::int64_t x, std::int64_t y, std::size_t size_class) noexcept {
  const std::uint64_t of_x = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15U + size_class;
  const std::uint64_t both = (of_x ^ (of_x >> 32U) ^ static_cast<std::uint64_t>(y)) * 0xd6e8feb86659fd93U;
  return static_cast<std::size_t>(both ^ (both >> 32U));
}

}  // namespace

/// Take all boxes of one class that meet a query box. Their lower corners lie in a rectangle that is larger than the
/// query box by the longest side of the class, so they lie in at most four cells of the size of this rectangle. Cells
/// that share a counter make the bound larger.
std::size_t most_at_once(std::span<const Box2> boxes, const Vec2d& size) {
  std::vector<std::uint32_t> counters(std::bit_ceil(boxes.size() + 1));
  std::array<std::size_t, classes> fullest{};
  const int least = std::ilogb(size.maxCoeff());
  for (const Box2& box : boxes) {
    const auto side = (box.upper - box.lower).maxCoeff();
    const int exponent = side > 0 ? std::max(std::ilogb(side) + 1, least) : least;
    const auto size_class = std::min(static_cast<std::size_t>(exponent - least), classes - 1);
    const double longest = std::ldexp(1.0, exponent);
    const auto cell = [&](Eigen::Index axis) {
      const double width = (size[axis] + longest) * spare;
      const double place = std::floor(box.lower[axis] / width);
      return static_cast<std::int64_t>(std::clamp(place, -outermost, outermost));
    };
    const bool fits = size_class + 1 < classes;
    std::uint32_t& counter =
        counters[(fits ? mixed(cell(0), cell(1), size_class) : size_class) & (counters.size() - 1)];
    fullest[size_class] = std::max<std::size_t>(fullest[size_class], ++counter);
  }
  return std::min(boxes.size(), 4 * std::accumulate(fullest.begin(), fullest.end(), std::size_t{0}));
}

}  // namespace paperproof::broad_phase
