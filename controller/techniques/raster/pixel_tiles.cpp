#include "techniques/raster/bitmap.hpp"

#include <paperproof/pixel_tiles.hpp>
#include <paperproof/techniques.hpp>

#include <map>

namespace paperproof {
namespace {

using raster::Bitmap;
using raster::Pixel;

/// Rounds towards minus infinity, unlike `/`.
constexpr std::int64_t floor_divide(std::int64_t a, std::int64_t b) noexcept {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

/// What 64 neighbouring pixels of a row do, one bit for each.
struct RowActions {
  static constexpr std::size_t words = 5;
  std::uint64_t solid = 0;
  std::uint64_t up_moving_left = 0;
  std::uint64_t up_moving_right = 0;
  std::uint64_t down_moving_left = 0;
  std::uint64_t down_moving_right = 0;
};

/// Moving right, a foot comes from the column on the left, where it stood on the pixel that is one lower: it was free
/// there, with ground below. Its next pixel is solid and the one above free: up. Or the next one is free, and so is
/// the one below, with ground under that: down.
RowActions actions_from(const Bitmap& level, const Pixel& first) noexcept {
  const auto at = [&](std::int64_t x, std::int64_t y) { return level.row_from(first + Pixel{x, y}); };
  const std::uint64_t here = at(0, 0);
  const std::uint64_t stood_left = ~at(-1, 0) & at(-1, -1);
  const std::uint64_t stood_right = ~at(1, 0) & at(1, -1);
  const std::uint64_t rises = here & ~at(0, 1);
  const std::uint64_t falls = ~here & ~at(0, -1) & at(0, -2);
  return {here, rises & stood_right, rises & stood_left, falls & stood_right, falls & stood_left};
}

PixelAction action_of(bool solid, bool up, bool down) noexcept {
  if (solid) return up ? PixelAction::up : PixelAction::block;
  return down ? PixelAction::down : PixelAction::nothing;
}

/// A tile as bits, to be compared: `RowActions` after `RowActions`.
using TileBits = std::vector<std::uint64_t>;

TileBits bits_of_tile(const Bitmap& level, const Pixel& lower, int size) {
  TileBits bits;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; x += 64) {
      const RowActions row = actions_from(level, lower + Pixel{x, y});
      const std::uint64_t ours = ~std::uint64_t{0} >> (64 - std::min(64, size - x));
      bits.insert(bits.end(), {row.solid & ours, row.up_moving_left & ours, row.up_moving_right & ours,
                               row.down_moving_left & ours, row.down_moving_right & ours});
    }
  }
  return bits;
}

PixelTileSet::Tile tile_from(const TileBits& bits, int size) {
  PixelTileSet::Tile tile;
  const std::size_t words_per_row = RowActions::words * static_cast<std::size_t>((size + 63) / 64);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const std::size_t word =
          static_cast<std::size_t>(y) * words_per_row + static_cast<std::size_t>(x / 64) * RowActions::words;
      const auto is_set = [&](std::size_t i) { return ((bits[word + i] >> (x % 64)) & 1U) != 0; };
      tile.push_back({action_of(is_set(0), is_set(1), is_set(3)), action_of(is_set(0), is_set(2), is_set(4))});
    }
  }
  return tile;
}

std::size_t bytes_of_types(std::size_t count, int size) noexcept {
  return count * static_cast<std::size_t>(size) * static_cast<std::size_t>(size) * sizeof(PixelCollision);
}

/// Collects the types of tiles, each once.
class Types {
 public:
  explicit Types(int size) : size_(size) {}

  std::uint32_t index_of(const TileBits& bits) {
    const auto [known, is_new] = indices_.try_emplace(bits, static_cast<std::uint32_t>(types_.size()));
    if (is_new) {
      if (bytes_of_types(types_.size() + 1, size_) > raster::max_picture_bytes) {
        throw NotExpressible("the level has more than " + std::to_string(types_.size()) + " types of tiles, and at " +
                             std::to_string(size_) + " x " + std::to_string(size_) +
                             " pixels for each they would take more than 256 MiB");
      }
      types_.push_back(tile_from(bits, size_));
    }
    return known->second;
  }
  [[nodiscard]] std::vector<PixelTileSet::Tile> take() { return std::move(types_); }

 private:
  int size_;
  std::map<TileBits, std::uint32_t> indices_;
  std::vector<PixelTileSet::Tile> types_;
};

void require_tiles(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("pixel tiles: " + what);
}

}  // namespace

PixelCollision PixelTileSet::at(std::int64_t x, std::int64_t y) const noexcept {
  const std::int64_t size = pixels_per_tile;
  const std::int64_t column = floor_divide(x, size) - first_column;
  const std::int64_t row = floor_divide(y, size) - first_row;
  if (column < 0 || column >= columns || row < 0) return {};
  const auto index = static_cast<std::size_t>(row * columns + column);
  if (index >= map.size()) return {};
  const std::int64_t pixel = (y - (row + first_row) * size) * size + x - (column + first_column) * size;
  return types[map[index]][static_cast<std::size_t>(pixel)];
}

std::size_t PixelTileSet::memory_bytes() const noexcept {
  return bytes_of_types(types.size(), pixels_per_tile) + map.size() * sizeof(map[0]);
}

void PixelTileSet::validate() const {
  require_tiles(pixels_per_tile >= 1, "a tile needs at least 1 pixel, not " + std::to_string(pixels_per_tile));
  require_tiles(
      columns >= 0 && (columns > 0 ? map.size() % static_cast<std::size_t>(columns) == 0 : map.empty()),
      "the map of " + std::to_string(map.size()) + " tiles is not made of rows of " + std::to_string(columns));
  const auto pixels = static_cast<std::size_t>(pixels_per_tile) * static_cast<std::size_t>(pixels_per_tile);
  for (std::size_t i = 0; i < types.size(); ++i) {
    const std::string type = "type " + std::to_string(i);
    require_tiles(types[i].size() == pixels,
                  type + " has " + std::to_string(types[i].size()) + " pixels instead of " + std::to_string(pixels));
    for (const PixelCollision& pixel : types[i]) {
      const bool solid_from_right = PixelCollision{pixel.moving_right, pixel.moving_left}.is_solid();
      require_tiles(pixel.is_solid() == solid_from_right, type + " has a pixel that is solid from one direction only");
    }
  }
  for (const std::uint32_t index : map) {
    require_tiles(index < types.size(),
                  "the map names type " + std::to_string(index) + " of " + std::to_string(types.size()));
  }
}

PixelTileSet make_pixel_tiles(const SceneryDef& scenery, double pixels_per_metre, int pixels_per_tile) {
  const Bitmap level = raster::rasterise(scenery, pixels_per_metre);
  PixelTileSet set;
  set.pixels_per_tile = pixels_per_tile;
  if (level.box().width == 0) return set;
  // Two rows more: what stands above the last solid one.
  const Pixel upper = level.box().lower + Pixel{level.box().width, level.box().height + 1};
  set.first_column = floor_divide(level.box().lower.x - 1, pixels_per_tile);
  set.first_row = floor_divide(level.box().lower.y, pixels_per_tile);
  set.columns = floor_divide(upper.x, pixels_per_tile) - set.first_column + 1;
  const std::int64_t end_row = floor_divide(upper.y, pixels_per_tile) + 1;
  raster::check_picture_size({{}, set.columns, end_row - set.first_row}, 8 * sizeof(set.map[0]));
  Types types(pixels_per_tile);
  for (std::int64_t row = set.first_row; row < end_row; ++row) {
    for (std::int64_t i = 0; i < set.columns; ++i) {
      const Pixel lower{(set.first_column + i) * pixels_per_tile, row * pixels_per_tile};
      set.map.push_back(types.index_of(bits_of_tile(level, lower, pixels_per_tile)));
    }
  }
  set.types = types.take();
  return set;
}

}  // namespace paperproof
