/// The article's "Pixel Tile": the level is made of square tiles of a few types, each with an array that says per pixel
/// what a collision there does; the collision points of the character are looked up in it.
///
/// All of the character's points are tested before each pixel of movement, so none of them enters a solid; what is
/// narrower than the gaps between them passes. On a slope of up to 45 degrees the array takes a foot that walks into it
/// one pixel up, and one that walks away from it one pixel down (see pixel_tiles.hpp). The knobs `unit`, `iterations`,
/// `points`, `pairs` and `response` have no meaning here.
#include "techniques/knobs.hpp"
#include "techniques/raster/pixel_walk.hpp"
#include "techniques/registry.hpp"

#include <paperproof/pixel_tiles.hpp>

namespace paperproof {
namespace {

using raster::Advance;
using raster::Pixel;
using raster::Sprite;

class TileRules {
 public:
  explicit TileRules(std::shared_ptr<const PixelTileSet> tiles) : tiles_(std::move(tiles)) {}

  [[nodiscard]] bool is_free(const Sprite& sprite, const Pixel& at) const noexcept {
    return std::none_of(sprite.points().begin(), sprite.points().end(),
                        [&](const Pixel& point) { return is_solid(at + point); });
  }
  [[nodiscard]] Advance advance(const Sprite& sprite, const Pixel& at, Side side, bool rising) const noexcept {
    const Pixel next = at + raster::towards(side);
    if (side == Side::top || side == Side::bottom) return {.blocked = !is_free(sprite, next)};
    Advance advance = asked_by_feet(sprite, next, side);
    const bool no_way_down = rising || !is_free(sprite, next + Pixel{0, -1});
    if (advance.lift < 0 && no_way_down) advance.lift = 0;
    advance.blocked = advance.blocked || !is_free(sprite, next + Pixel{0, advance.lift});
    return advance;
  }
  template <class Visit>
  void for_each_blocking(const Sprite& sprite, const Pixel& at, Side side, const Visit& visit) const noexcept {
    for (const Pixel& point : sprite.points()) {
      const Pixel beside = at + raster::towards(side) + point;
      const Pixel above = beside + Pixel{0, 1};  // where a slope would have taken it
      if (is_solid(beside)) {
        visit(beside);
      } else if (side != Side::bottom && is_solid(above)) {
        visit(above);
      }
    }
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept { return tiles_->memory_bytes(); }

 private:
  [[nodiscard]] bool is_solid(const Pixel& pixel) const noexcept { return tiles_->at(pixel.x, pixel.y).is_solid(); }

  /// One foot that is blocked blocks both; one that has to go up takes the other with it.
  [[nodiscard]] Advance asked_by_feet(const Sprite& sprite, const Pixel& next, Side side) const noexcept {
    Advance asked;
    for (const Pixel& foot : sprite.feet()) {
      const PixelCollision collision = tiles_->at(next.x + foot.x, next.y + foot.y);
      switch (side == Side::left ? collision.moving_left : collision.moving_right) {
        case PixelAction::nothing:
          break;
        case PixelAction::block:
          asked.blocked = true;
          break;
        case PixelAction::up:
          asked.lift = 1;
          break;
        case PixelAction::down:
          if (asked.lift == 0) asked.lift = -1;
          break;
      }
    }
    return asked;
  }

  std::shared_ptr<const PixelTileSet> tiles_;
};

std::unique_ptr<Technique> make_pixel_tile(const TechniqueDef& def, const Scenery& scenery,
                                           const CharacterDef& character) {
  using Made = raster::PixelTechnique<TileRules>;
  raster::RasterParts parts(def, scenery, character);
  std::shared_ptr<const PixelTileSet> tiles = def.pixel_tiles;
  if (tiles) {
    tiles->validate();
  } else {
    tiles = std::make_shared<const PixelTileSet>(
        make_pixel_tiles(scenery.as_run(), def.article.raster_pixels_per_metre, def.article.pixels_per_tile));
  }
  return std::make_unique<Made>("pixel_tile", std::move(parts), TileRules(std::move(tiles)));
}

}  // namespace

TechniqueEntry pixel_tile_entry() {
  return {
      .name = "pixel_tile",
      .make = make_pixel_tile,
      .knobs = {knob::raster_pixels_per_metre,
                knob::broad_phase,
                {"pixels_per_tile", "along a side of a tile: more take more memory, nothing else changes",
                 [](const std::string& value, TechniqueDef& def) { def.article.pixels_per_tile = whole_in(value); }}},
      .draws_level = true,
      .unit = knob::pixel};
}

}  // namespace paperproof
