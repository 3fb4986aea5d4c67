#include <paperproof/scenery.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof {
namespace {

/// Cells of 4 mm are the smallest. Larger: small pieces crowd a cell. Smaller: a cell for each point of a dense chain.
constexpr int finest = -8;

/// No piece lies there, but a box that is searched may.
constexpr double furthest = 2e9;

/// The cell of a place, in one dimension. Its lower end belongs to a cell; its upper end belongs to the next one.
std::int32_t cell_at(double coordinate, double cells_per_metre) {
  const double place = std::clamp(coordinate * cells_per_metre, -furthest, furthest);
  const auto cell = static_cast<std::int32_t>(place);
  return cell - (place < cell ? 1 : 0);
}

/// The same, but a place between two cells belongs to the lower one.
std::int32_t cell_below(double coordinate, double cells_per_metre) {
  return -cell_at(-coordinate, cells_per_metre) - 1;
}

/// Calls `visit` for the cells in which a piece is. Tiles that fill cells are in no others.
template <class Visit>
void for_each_cell_of(const Box2& box, double cells_per_metre, const Visit& visit) {
  const std::int32_t left = cell_at(box.lower.x(), cells_per_metre);
  const std::int32_t bottom = cell_at(box.lower.y(), cells_per_metre);
  const std::int32_t right = std::max(left, cell_below(box.upper.x(), cells_per_metre));
  const std::int32_t top = std::max(bottom, cell_below(box.upper.y(), cells_per_metre));
  for (std::int32_t x = left; x <= right; ++x)
    for (std::int32_t y = bottom; y <= top; ++y) visit(x, y);
}

}  // namespace

/// Where the cell of a place is, or would be: cells of one hash follow each other.
std::size_t PieceGrid::Layer::index_of(std::int32_t x, std::int32_t y) const noexcept {
  const auto word = [](std::int32_t value) { return std::uint64_t{static_cast<std::uint32_t>(value)}; };
  const std::uint64_t hash = (word(x) << 32U | word(y)) * 0x9e3779b97f4a7c15;
  const std::size_t mask = cells.size() - 1;
  std::size_t index = static_cast<std::size_t>(hash ^ hash >> 32U) & mask;
  while (cells[index].is_used && !(cells[index].x == x && cells[index].y == y)) index = (index + 1) & mask;
  return index;
}

/// Half of the cells are free, so that a search for one ends soon.
void PieceGrid::Layer::grow() {
  std::vector<Cell> before(2 * cells.size());
  before.swap(cells);
  for (const Cell& cell : before)
    if (cell.is_used) cells[index_of(cell.x, cell.y)] = cell;
}

/// Those after it in the row of used cells move up, unless they are where their hashes put them.
void PieceGrid::Layer::erase(std::size_t index) {
  const std::size_t mask = cells.size() - 1;
  --used;
  cells[index].is_used = false;
  for (std::size_t next = (index + 1) & mask; cells[next].is_used; next = (next + 1) & mask) {
    const Cell cell = cells[next];
    cells[next].is_used = false;
    cells[index_of(cell.x, cell.y)] = cell;
  }
}

/// The finest layer whose cells are larger than a box. The box meets four of them at most.
PieceGrid::Layer& PieceGrid::layer_for(const Box2& box) {
  int exponent = 0;
  std::frexp(box.size().maxCoeff(), &exponent);  // the size is less than 2^exponent
  const double cells_per_metre = std::ldexp(1.0, -std::max(exponent, finest));
  const auto same = [&](const Layer& layer) { return layer.cells_per_metre == cells_per_metre; };
  const auto known = std::ranges::find_if(layers_, same);
  if (known != layers_.end()) return *known;
  layers_.push_back({cells_per_metre, 0, std::vector<Cell>(8)});
  return layers_.back();
}

void PieceGrid::add(PieceIndex piece, const Box2& box) {
  whole_ = whole_.merged(box);
  Layer& layer = layer_for(box);
  for_each_cell_of(box, layer.cells_per_metre, [&](std::int32_t x, std::int32_t y) {
    if (2 * layer.used >= layer.cells.size()) layer.grow();
    Cell& cell = layer.cells[layer.index_of(x, y)];
    if (!cell.is_used) {
      cell = {x, y, no_link, true};
      ++layer.used;
    }
    std::uint32_t link = unused_;
    if (link == no_link) {
      link = static_cast<std::uint32_t>(links_.size());
      links_.emplace_back();
    } else {
      unused_ = links_[link].next;
    }
    links_[link] = {piece, cell.first};
    cell.first = link;
  });
}

void PieceGrid::remove(PieceIndex piece, const Box2& box) {
  Layer& layer = layer_for(box);
  for_each_cell_of(box, layer.cells_per_metre, [&](std::int32_t x, std::int32_t y) {
    const std::size_t index = layer.index_of(x, y);
    std::uint32_t* before = &layer.cells[index].first;
    while (links_[*before].piece != piece) before = &links_[*before].next;
    const std::uint32_t link = *before;
    *before = links_[link].next;
    links_[link].next = unused_;
    unused_ = link;
    if (layer.cells[index].first == no_link) layer.erase(index);
  });
}

void PieceGrid::shrink(const Box2& removed, std::span<const Box2> boxes) {
  const bool is_within =
      (removed.lower.array() > whole_.lower.array()).all() && (removed.upper.array() < whole_.upper.array()).all();
  if (is_within) return;
  whole_ = Box2::nowhere();
  for (const Layer& layer : layers_)
    for (const Cell& cell : layer.cells)
      for (std::uint32_t link = cell.is_used ? cell.first : no_link; link != no_link; link = links_[link].next)
        whole_ = whole_.merged(boxes[links_[link].piece]);
}

void PieceGrid::find(const Box2& box, std::span<const Box2> boxes, std::vector<PieceIndex>& found) const {
  for (const Layer& layer : layers_) {
    const double scale = layer.cells_per_metre;
    // A piece that touches the box may end where a cell does.
    const std::int32_t left = cell_below(box.lower.x(), scale);
    const std::int32_t bottom = cell_below(box.lower.y(), scale);
    const std::int32_t right = cell_at(box.upper.x(), scale);
    const std::int32_t top = cell_at(box.upper.y(), scale);
    // A piece that is in several cells is found in the first of them that the box meets.
    const auto look_into = [&](const Cell& cell) {
      if (cell.x < left || cell.y < bottom) return;
      const double least_x = cell.x == left ? -furthest : cell.x / scale;
      const double least_y = cell.y == bottom ? -furthest : cell.y / scale;
      for (std::uint32_t link = cell.first; link != no_link; link = links_[link].next) {
        const Box2& here = boxes[links_[link].piece];
        if (here.overlaps(box) && here.lower.x() >= least_x && here.lower.y() >= least_y)
          found.push_back(links_[link].piece);
      }
    };
    if ((1.0 + right - left) * (1.0 + top - bottom) < static_cast<double>(layer.cells.size())) {
      for (std::int32_t x = left; x <= right; ++x)
        for (std::int32_t y = bottom; y <= top; ++y) {
          const Cell& cell = layer.cells[layer.index_of(x, y)];
          if (cell.is_used) look_into(cell);
        }
    } else {
      for (const Cell& cell : layer.cells)
        if (cell.is_used) look_into(cell);
    }
  }
}

}  // namespace paperproof
