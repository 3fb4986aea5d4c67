#include "scenes/supertux_tiles.hpp"

#include <array>
#include <filesystem>

#include "scenes/input_error.hpp"
#include "scenes/s_expression.hpp"

namespace paperproof::compare {

namespace {

constexpr std::uint32_t solid_bit = 0x01;
constexpr std::uint32_t one_way_bits = 0x02;
constexpr std::uint32_t slope_bit = 0x10;

/// Upper bits of a slope's data: which half of the tile the sloping line spans.
enum class Half : std::uint8_t { whole, bottom, top, left, right };

/// (tile (id 1) (solid #t) (data 0)): one tile, its attributes by name.
void read_tile(const SReader& reader, const SExpression& entry, SuperTuxTiles& tiles) {
  struct Named {
    std::string_view name;
    std::uint32_t bits;
  };
  static constexpr std::array named{Named{"solid", solid_bit}, Named{"unisolid", solid_bit | one_way_bits}};
  SuperTuxTile tile;
  for (const Named& attribute : named) {
    if (reader.flag(entry, attribute.name, false)) tile.attributes |= attribute.bits;
  }
  tile.data = static_cast<std::uint32_t>(reader.integer(entry, "data", 0));
  const int id = reader.integer(entry, "id", std::nullopt);
  if (id > 0) tiles[static_cast<std::uint32_t>(id)] = tile;
}

/// (tiles (ids ...) (attributes ...) (datas ...)): a picture with many tiles; 0 stands where there is none.
void read_tiles(const SReader& reader, const SExpression& entry, SuperTuxTiles& tiles) {
  const std::vector<std::uint32_t> ids = reader.numbers(entry, "ids");
  const std::vector<std::uint32_t> attributes = reader.numbers(entry, "attributes");
  const std::vector<std::uint32_t> datas = reader.numbers(entry, "datas");
  if (!attributes.empty() && attributes.size() != ids.size()) reader.refuse(entry, "expected one attribute per id");
  if (!datas.empty() && datas.size() != ids.size()) reader.refuse(entry, "expected one data entry per id");
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (ids[i] == 0) continue;
    tiles[ids[i]] = {.attributes = attributes.empty() ? 0 : attributes[i], .data = datas.empty() ? 0 : datas[i]};
  }
}

/// The part of the unit square on the left of the directed line from a to b (seen with y down: its right).
std::vector<Vec2d> cut_square(const Vec2d& a, const Vec2d& b) {
  static const std::array<Vec2d, 4> square{Vec2d{0, 0}, Vec2d{1, 0}, Vec2d{1, 1}, Vec2d{0, 1}};
  const Vec2d along = b - a;
  const auto side = [&](const Vec2d& p) { return along.x() * (p.y() - a.y()) - along.y() * (p.x() - a.x()); };
  std::vector<Vec2d> kept;
  for (std::size_t i = 0; i < square.size(); ++i) {
    const Vec2d& p = square[i];
    const Vec2d& q = square[(i + 1) % square.size()];
    const double from = side(p);
    const double to = side(q);
    if (from >= 0) kept.push_back(p);
    // Every crossing is at a half or a whole: the arithmetic is exact.
    if ((from > 0 && to < 0) || (from < 0 && to > 0)) kept.push_back(p + (q - p) * (from / (from - to)));
  }
  return kept;
}

}  // namespace

SuperTuxTile::Kind SuperTuxTile::kind() const noexcept {
  if ((attributes & solid_bit) == 0) return Kind::nothing;
  if ((attributes & slope_bit) != 0) return Kind::slope;
  return (attributes & one_way_bits) != 0 ? Kind::one_way : Kind::solid;
}

std::vector<Vec2d> SuperTuxTile::solid_part() const {
  const auto half = static_cast<Half>(data >> 4U & 7U);
  const double left = half == Half::right ? 0.5 : 0;
  const double right = half == Half::left ? 0.5 : 1;
  const double top = half == Half::bottom ? 0.5 : 0;
  const double bottom = half == Half::top ? 0.5 : 1;
  switch (data & 3U) {
    case 0:
      return cut_square({left, top}, {right, bottom});  // south-west is solid
    case 1:
      return cut_square({right, bottom}, {left, top});  // north-east
    case 2:
      return cut_square({left, bottom}, {right, top});  // south-east
    default:
      return cut_square({right, top}, {left, bottom});  // north-west
  }
}

SuperTuxTiles read_supertux_tiles(const std::string& path, const std::string& given) {
  const std::string source = read_text(path, given);
  const SReader reader(given);
  const SExpression file = parse_s_expressions(source, given);
  const SExpression& root = file.items.front();
  if (root.head() != "supertux-tiles") reader.refuse(root, "expected (supertux-tiles ...)");
  SuperTuxTiles tiles;
  for (const SExpression& entry : root.items) {
    if (entry.head() == "tile") read_tile(reader, entry, tiles);
    if (entry.head() == "tiles") read_tiles(reader, entry, tiles);
  }
  if (tiles.empty()) reader.refuse(root, "expected at least one (tile ...) or (tiles ...)");
  return tiles;
}

std::optional<std::string> supertux_root(const std::string& level_path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const auto holds_tiles = [&](const fs::path& folder) { return fs::exists(folder / "images" / "tiles.strf", error); };
  for (fs::path folder = fs::absolute(level_path, error).parent_path(); folder != folder.parent_path();
       folder = folder.parent_path()) {
    if (holds_tiles(folder)) return folder.string();
  }
  const fs::path installed = "/usr/share/games/supertux2";
  if (holds_tiles(installed)) return installed.string();
  return std::nullopt;
}

}  // namespace paperproof::compare
