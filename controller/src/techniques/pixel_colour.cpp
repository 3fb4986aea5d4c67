#include "techniques/pixel_colour.hpp"

#include "techniques/raster/pixel_walk.hpp"

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

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_pixel_colour(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                     const CharacterDef& character) {
  using Made = raster::PixelTechnique<Scalar, TechniqueKind::pixel_colour, ColourRules>;
  raster::RasterParts<Scalar> parts(def, scenery, character);
  SceneryDef drawn = scenery.as_run();
  if (def.decoration)
    drawn.colliders.insert(drawn.colliders.end(), def.decoration->colliders.begin(), def.decoration->colliders.end());
  return std::make_unique<Made>(std::move(parts),
                                ColourRules(raster::ColourPicture(drawn, def.article.raster_pixels_per_metre)));
}

template std::unique_ptr<Technique<float>> make_pixel_colour(const TechniqueDef&, const Scenery<float>&,
                                                             const CharacterDef&);
template std::unique_ptr<Technique<double>> make_pixel_colour(const TechniqueDef&, const Scenery<double>&,
                                                              const CharacterDef&);

}  // namespace paperproof
