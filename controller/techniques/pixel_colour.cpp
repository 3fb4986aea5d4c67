/// The article's "Pixel Colour": the level is a picture in indexed colours, one of which is the background; before each
/// pixel of movement the colours next to the character are tested.
///
/// The outline of the sprite is tested on the side that moves, so nothing is passed at any speed; a step costs as many
/// tests as the sprite has rows (columns) for every pixel of the way. A solid that lies within the character from the
/// start is not seen. Decoration in the colour of a platform stops it as a platform does (`TechniqueDef::decoration`):
/// the article names this as the price of the technique. No contact names it, as it is no collider. The knobs `unit`,
/// `iterations`, `points`, `pairs` and `response` have no meaning here: the unit is the pixel, and the response that of
/// the article (see raster/pixel_walk.hpp).
#include "techniques/knobs.hpp"
#include "techniques/raster/pixel_walk.hpp"
#include "techniques/registry.hpp"

namespace paperproof {
namespace {

using raster::Advance;
using raster::Pixel;
using raster::Sprite;

constexpr std::uint8_t background = 0;

class ColourRules {
 public:
  explicit ColourRules(raster::ColourPicture picture) : picture_(std::move(picture)) {}

  [[nodiscard]] bool is_free(const Sprite& sprite, const Pixel& at) const noexcept {
    return std::all_of(article::all_sides.begin(), article::all_sides.end(), [&](Side side) {
      const auto is_background = [&](const Pixel& pixel) { return picture_.colour(at + pixel) == background; };
      return std::all_of(sprite.edge(side).begin(), sprite.edge(side).end(), is_background);
    });
  }
  [[nodiscard]] Advance advance(const Sprite& sprite, const Pixel& at, Side side, bool /*rising*/) const noexcept {
    const Pixel next = at + raster::towards(side);
    const auto is_solid = [&](const Pixel& pixel) { return picture_.colour(next + pixel) != background; };
    return {.blocked = std::any_of(sprite.edge(side).begin(), sprite.edge(side).end(), is_solid)};
  }
  template <class Visit>
  void for_each_blocking(const Sprite& sprite, const Pixel& at, Side side, const Visit& visit) const noexcept {
    for (const Pixel& pixel : sprite.edge(side)) {
      const Pixel beside = at + raster::towards(side) + pixel;
      if (picture_.colour(beside) != background) visit(beside);
    }
  }
  [[nodiscard]] std::size_t memory_bytes() const noexcept { return picture_.memory_bytes(); }

 private:
  raster::ColourPicture picture_;
};

std::unique_ptr<Technique> make_pixel_colour(const TechniqueDef& def, const Scenery& scenery,
                                             const CharacterDef& character) {
  using Made = raster::PixelTechnique<ColourRules>;
  raster::RasterParts parts(def, scenery, character);
  SceneryDef drawn = scenery.as_run();
  if (def.decoration)
    drawn.colliders.insert(drawn.colliders.end(), def.decoration->colliders.begin(), def.decoration->colliders.end());
  return std::make_unique<Made>("pixel_colour", std::move(parts),
                                ColourRules(raster::ColourPicture(drawn, def.article.raster_pixels_per_metre)));
}

}  // namespace

TechniqueEntry pixel_colour_entry() {
  return {.name = "pixel_colour",
          .make = make_pixel_colour,
          .knobs = {knob::raster_pixels_per_metre, knob::broad_phase},
          .draws_level = true,
          .unit = knob::pixel};
}

}  // namespace paperproof
