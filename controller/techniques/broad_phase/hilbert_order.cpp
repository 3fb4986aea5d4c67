#include "techniques/broad_phase/hilbert_order.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace paperproof::broad_phase {
namespace {

constexpr unsigned bits = 16;

/// Halved before adding, so that huge boxes do not overflow.
Vec2d centre(const Box2& box) noexcept { return 0.5 * box.lower + 0.5 * box.upper; }

/// Place of a cell along the curve, found quarter by quarter. The square is turned for each quarter, so that the curve
/// is continuous (D. Hilbert 1891).
std::uint32_t place_on_curve(std::uint32_t x, std::uint32_t y) noexcept {
  std::uint32_t place = 0;
  for (unsigned bit = bits; bit-- > 0;) {
    const std::uint32_t right = (x >> bit) & 1U;
    const std::uint32_t up = (y >> bit) & 1U;
    place = place << 2U | ((3 * right) ^ up);
    // The lower quarters are seen with x and y exchanged, the right one of them from the other end.
    const std::uint32_t turned = 0U - (right & ~up);
    x ^= turned;
    y ^= turned;
    const std::uint32_t exchanged = (x ^ y) & (up - 1U);
    x ^= exchanged;
    y ^= exchanged;
  }
  return place;
}

/// The upper bits are a place on the curve, the lower bits the index of a box: sorting needs nothing else.
using Key = std::uint64_t;
std::uint32_t place_of(Key key) noexcept { return static_cast<std::uint32_t>(key >> 32U); }
PieceIndex index_of(Key key) noexcept { return static_cast<PieceIndex>(key); }

/// Sorts keys by place, digit by digit from the last; keys with the same place keep their order (D. Knuth, "The Art of
/// Computer Programming" 3, 5.2.5). Keys come with indices ascending.
void sort_by_place(std::span<Key> keys, std::vector<Key>& room) {
  constexpr unsigned digit_bits = 8;
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  // Below this number a sort by comparison is faster than counting.
  if (keys.size() < digits) return std::sort(keys.begin(), keys.end());
  room.resize(std::max(room.size(), keys.size()));
  std::span<Key> from = keys;
  std::span<Key> to = std::span(room).first(keys.size());
  for (unsigned shift = 32; shift < 64; shift += digit_bits) {
    const auto digit = [&](Key key) { return (key >> shift) % digits; };
    std::array<std::size_t, digits> next{};
    for (const Key key : from) ++next[digit(key)];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), std::size_t{0});
    for (const Key key : from) to[next[digit(key)]++] = key;
    std::swap(from, to);
  }
}

void sort_along_curve(std::span<const Box2> boxes, std::span<Key> keys, std::vector<Key>& room) {
  Vec2d lower = centre(boxes[index_of(keys.front())]);
  Vec2d upper = lower;
  for (const Key key : keys) {
    const Vec2d at = centre(boxes[index_of(key)]);
    lower = lower.cwiseMin(at);
    upper = upper.cwiseMax(at);
  }
  if (lower == upper) return;
  constexpr auto cells = static_cast<double>((1U << bits) - 1);
  const Vec2d half = 0.5 * upper - 0.5 * lower;
  const auto cell = [&](const Vec2d& at, Eigen::Index axis) {
    if (!(half[axis] > 0)) return 0U;
    return static_cast<std::uint32_t>((0.5 * at[axis] - 0.5 * lower[axis]) / half[axis] * cells);
  };
  for (Key& key : keys) {
    const PieceIndex index = index_of(key);
    const Vec2d at = centre(boxes[index]);
    key = Key{place_on_curve(cell(at, 0), cell(at, 1))} << 32U | index;
  }
  sort_by_place(keys, room);
  for (auto first = keys.begin(); first != keys.end();) {
    const auto end = std::find_if(first, keys.end(), [&](Key key) { return place_of(key) != place_of(*first); });
    if (end - first > 4) sort_along_curve(boxes, {first, end}, room);
    first = end;
  }
}

}  // namespace

std::vector<PieceIndex> hilbert_order(std::span<const Box2> boxes) {
  std::vector<Key> keys(boxes.size());
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = i;
  std::vector<Key> room;
  if (!keys.empty()) sort_along_curve(boxes, keys, room);
  std::vector<PieceIndex> order(keys.size());
  std::transform(keys.begin(), keys.end(), order.begin(), index_of);
  return order;
}

}  // namespace paperproof::broad_phase
