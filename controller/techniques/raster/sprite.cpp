#include "techniques/raster/sprite.hpp"

#include "techniques/side_points.hpp"

#include <paperproof/techniques.hpp>

namespace paperproof::raster {
namespace {

Bitmap mask_of(const CharacterShape& shape, double pixels_per_metre) {
  SceneryDef hull;
  hull.colliders.emplace_back();
  for (const Vec2d& point : shape.hull()) hull.colliders[0].points.push_back(point - shape.box().lower);
  return rasterise(hull, pixels_per_metre);
}

/// The pixel of a coordinate; on a border the one towards the middle.
std::int64_t pixel_of(double coordinate, double middle) noexcept {
  return coordinate > middle ? ceil_to_pixel(coordinate) - 1 : floor_to_pixel(coordinate);
}

std::vector<Pixel> edge_of(const Bitmap& mask, Side side) {
  const bool by_rows = article::component_of(side) == 0;
  const bool from_end = article::outwards(side) > 0;
  const std::int64_t lines = by_rows ? mask.box().height : mask.box().width;
  const std::int64_t length = by_rows ? mask.box().width : mask.box().height;
  std::vector<Pixel> edge;
  for (std::int64_t line = 0; line < lines; ++line) {
    for (std::int64_t i = 0; i < length; ++i) {
      const std::int64_t along = from_end ? length - 1 - i : i;
      const Pixel pixel = by_rows ? Pixel{along, line} : Pixel{line, along};
      if (!mask.is_white(pixel)) continue;
      edge.push_back(pixel);
      break;
    }
  }
  return edge;
}

}  // namespace

Sprite::Sprite(const CharacterShape& shape, double pixels_per_metre) : mask_(mask_of(shape, pixels_per_metre)) {
  for (const Side side : article::all_sides) edges_[static_cast<std::size_t>(side)] = edge_of(mask_, side);
  if (edge(Side::bottom).empty()) {
    throw NotExpressible("the character has no pixel at " + std::to_string(pixels_per_metre) + " pixels per metre");
  }
  const Vec2d size = shape.box().size() * pixels_per_metre;
  for (const Vec2d& point : shape.points()) {
    const Vec2d at = (point - shape.box().lower) * pixels_per_metre;
    points_.push_back({pixel_of(at.x(), size.x() / 2), pixel_of(at.y(), size.y() / 2)});
  }
  const PointPair pair = points_of_side(shape.points(), Side::bottom);
  feet_ = {points_[pair[0]], points_[pair[1]]};
}

}  // namespace paperproof::raster
