#include "techniques/broad_phase/buckets.hpp"

#include <bit>
#include <cmath>

namespace paperproof::broad_phase {
namespace {

/// Most cells that one box is entered into. Few: every query tests wide platforms. Many: more memory.
constexpr std::int64_t most_cells_of_a_box = 64;

/// Cells are numbered from minus this to this; boxes farther out are in the last one. Beyond 2^31 the number of cells
/// of a box would not fit into 64 bits.
constexpr double last_cell = 0x1p30;

/// The value that a fraction of all values lies below. Reorders them.
double quantile(std::vector<double>& values, std::size_t quarters) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() * quarters / 4);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Spread of the middle half of the boxes along an axis [m].
double middle_spread(std::span<const Box2> boxes, Eigen::Index axis) {
  std::vector<double> lower;
  for (const Box2& box : boxes) lower.push_back(box.lower[axis]);
  return quantile(lower, 3) - quantile(lower, 1);
}

/// The side of a square that holds one box, on average, if boxes lie evenly: half of them in half of the width [m].
double spacing(std::span<const Box2> boxes) {
  const auto count = static_cast<double>(boxes.size());
  const double width = 2 * middle_spread(boxes, 0);
  const double height = 2 * middle_spread(boxes, 1);
  // Two roots, because the product could overflow. Along a line the other side is zero.
  return std::max(std::sqrt(width) * std::sqrt(height) / std::sqrt(count), std::max(width, height) / count);
}

double median_of_longer_sides(std::span<const Box2> boxes) {
  std::vector<double> sides;
  for (const Box2& box : boxes) sides.push_back(box.size().maxCoeff());
  return quantile(sides, 2);
}

/// Any number will do where all boxes are points in one place.
double cells_per_metre(std::span<const Box2> boxes) {
  if (boxes.empty()) return 1;
  const double side = std::max(median_of_longer_sides(boxes), spacing(boxes));
  const double per_metre = 1 / side;
  return std::isfinite(per_metre) ? per_metre : 1.0;
}

}  // namespace

Buckets::Buckets(std::span<const Box2> boxes) : boxes_(boxes), cells_per_metre_(cells_per_metre(boxes)) { fill(); }

/// The cell number never falls as the coordinate rises, with any rounding, so boxes that overlap share a cell.
std::int64_t Buckets::cell_of(double coordinate) const noexcept {
  const double cell = std::floor(coordinate * cells_per_metre_);
  return static_cast<std::int64_t>(std::clamp(cell, -last_cell, last_cell));
}

typename Buckets::Cells Buckets::cells_of(const Box2& box) const noexcept {
  return {{cell_of(box.lower.x()), cell_of(box.lower.y())}, {cell_of(box.upper.x()), cell_of(box.upper.y())}};
}

/// Multiplying by a large odd number spreads neighbours over the upper bits, which are then folded onto the lower ones.
std::size_t Buckets::bucket_of(const Cell& cell) const noexcept {
  const std::uint64_t of_x = static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15U;
  const std::uint64_t mixed = (of_x ^ (of_x >> 32U) ^ static_cast<std::uint64_t>(cell.y)) * 0xd6e8feb86659fd93U;
  return static_cast<std::size_t>(mixed ^ (mixed >> 32U)) & (first_entry_.size() - 2);
}

void Buckets::fill() {
  std::vector<Entry> unsorted;
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    const auto piece = static_cast<PieceIndex>(i);
    const Cells cells = cells_of(boxes_[i]);
    if (cells.count() > most_cells_of_a_box) {
      large_.push_back(piece);
      continue;
    }
    for (std::int64_t y = cells.lower.y; y <= cells.upper.y; ++y) {
      for (std::int64_t x = cells.lower.x; x <= cells.upper.x; ++x) unsorted.push_back({{x, y}, piece});
    }
  }
  // The number of buckets is a power of two, so that a mask gives the remainder. One more entry ends the last bucket.
  first_entry_.assign(std::bit_ceil(unsorted.size() + 1) + 1, 0);
  for (const Entry& entry : unsorted) ++first_entry_[bucket_of(entry.cell) + 1];
  for (std::size_t i = 1; i < first_entry_.size(); ++i) first_entry_[i] += first_entry_[i - 1];
  std::vector<std::uint32_t> next(first_entry_.begin(), first_entry_.end() - 1);
  entries_.resize(unsorted.size());
  for (const Entry& entry : unsorted) entries_[next[bucket_of(entry.cell)]++] = entry;
}

/// A box may be in several of the query's cells. It counts only in the first cell that both share.
bool Buckets::is_first_cell(const Cell& cell, const Cells& cells, const Box2& box) const noexcept {
  return cell.x == std::max(cells.lower.x, cell_of(box.lower.x())) &&
         cell.y == std::max(cells.lower.y, cell_of(box.lower.y()));
}

std::size_t Buckets::query(const Box2& query, std::span<PieceIndex> found) const noexcept {
  std::size_t count = 0;
  const auto look_at = [&](PieceIndex piece) {
    if (!boxes_[piece].overlaps(query)) return;
    if (count < found.size()) found[count] = piece;
    ++count;
  };
  const Cells cells = cells_of(query);
  if (cells.count() > static_cast<std::int64_t>(boxes_.size())) {
    for (std::size_t i = 0; i < boxes_.size(); ++i) look_at(static_cast<PieceIndex>(i));
    return count;
  }
  for (const PieceIndex piece : large_) look_at(piece);
  for (Cell cell = cells.lower; cell.y <= cells.upper.y; ++cell.y) {
    for (cell.x = cells.lower.x; cell.x <= cells.upper.x; ++cell.x) {
      const std::size_t bucket = bucket_of(cell);
      for (std::size_t i = first_entry_[bucket]; i < first_entry_[bucket + 1]; ++i) {
        if (entries_[i].cell == cell && is_first_cell(cell, cells, boxes_[entries_[i].piece])) {
          look_at(entries_[i].piece);
        }
      }
    }
  }
  if (count <= found.size()) std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
  return count;
}

}  // namespace paperproof::broad_phase
