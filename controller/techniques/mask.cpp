/// The article's "Mask": level and sprite in black and white; when the character attempts to move, each white pixel of
/// the sprite is compared with the level's at the corresponding position, 64 at a time.
///
/// Only the attempted position is compared, nothing between: paper is passed. Where it collides, the character is wound
/// back one pixel at a time until it is free, as in the article's primitive: with the knob `response=component` first
/// the vertical movement alone, in the order of the article's pairs, then the horizontal one from there, so that a
/// walker is not held by the floor; with `shorten` the whole movement, so that it is.
///
/// The picture of the character is that of its hull, or `TechniqueDef::sprite`: then only its white pixels collide, and
/// what stands under the arch of its legs does not. The knobs `unit`, `iterations`, `points` and `pairs` have no
/// meaning here: the unit is the pixel.
#include "techniques/knobs.hpp"
#include "techniques/raster/raster_parts.hpp"
#include "techniques/registry.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace paperproof {
namespace {

using raster::Bitmap;
using raster::Pixel;
using raster::RasterParts;

/// The picture of the character that is given.
Bitmap figure_of(const TechniqueDef& def, const CharacterShape& shape) {
  const std::vector<std::string>& rows = def.sprite;
  const Vec2d size = shape.box().size() * def.article.raster_pixels_per_metre;
  const auto width = static_cast<std::int64_t>(std::llround(size.x()));
  const auto height = static_cast<std::int64_t>(std::llround(size.y()));
  const auto fits = [&](const std::string& row) { return static_cast<std::int64_t>(row.size()) == width; };
  if (static_cast<std::int64_t>(rows.size()) != height || !std::all_of(rows.begin(), rows.end(), fits))
    throw std::invalid_argument("sprite: must have the size of the character's box, " + std::to_string(width) + " x " +
                                std::to_string(height) + " pixels");
  Bitmap figure({.lower = {}, .width = width, .height = height});
  for (std::int64_t row = 0; row < height; ++row)
    for (std::int64_t x = 0; x < width; ++x)
      if (rows[static_cast<std::size_t>(height - 1 - row)][static_cast<std::size_t>(x)] == '#')
        figure.make_white({.row = row, .first = x, .end = x + 1});
  return figure;
}

class Mask final : public Technique {
 public:
  Mask(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character)
      : parts_(def, scenery, character),
        figure_(def.sprite.empty() ? parts_.sprite().mask() : figure_of(def, character.shape)),
        level_(raster::rasterise(scenery.as_run(), def.article.raster_pixels_per_metre)),
        response_(def.article.response) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "mask"; }
  [[nodiscard]] Scratch make_scratch() const override { return parts_.make_scratch(); }
  [[nodiscard]] std::size_t memory_bytes() const noexcept override {
    return level_.memory_bytes() + figure_.memory_bytes();
  }
  void move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept override;

 private:
  [[nodiscard]] bool is_free(const Pixel& placement) const noexcept { return !level_.overlaps(figure_, placement); }
  [[nodiscard]] Pixel attempted(const Vec2d& corner, const Vec2d& way, const Pixel& start) const noexcept;
  void wind_back(Side side, const Pixel& start, const MoveRequest& request, Pixel& placement, Scratch& scratch,
                 MoveResult& result) const noexcept;
  void wind_back_whole(const Pixel& start, const MoveRequest& request, Scratch& scratch,
                       MoveResult& result) const noexcept;
  void stop(Side side, const Pixel& collided, double fraction, Scratch& scratch, MoveResult& result) const noexcept;

  RasterParts parts_;
  Bitmap figure_;  ///< Of the character, with the lower left corner of its box on pixel (0, 0).
  Bitmap level_;
  ArticleKnobs::Response response_;
};

/// The pixels that the leading edges have reached, never behind the start; across a movement the start's.
Pixel Mask::attempted(const Vec2d& corner, const Vec2d& way, const Pixel& start) const noexcept {
  const Vec2d end = corner + way;
  const auto leading = [](double to, double along, std::int64_t from) {
    if (along == 0) return from;
    return along > 0 ? std::max(from, raster::ceil_to_pixel(to)) : std::min(from, raster::floor_to_pixel(to));
  };
  return {leading(end.x(), way.x(), start.x), leading(end.y(), way.y(), start.y)};
}

/// Along one component: from `placement`, which collides, towards the start. Leaves the placement free, unless the
/// start is not.
void Mask::wind_back(Side side, const Pixel& start, const MoveRequest& request, Pixel& placement, Scratch& scratch,
                     MoveResult& result) const noexcept {
  const Eigen::Index i = article::component_of(side);
  const Pixel out = raster::towards(side);
  Pixel collided = placement;
  while (placement != start && !is_free(placement)) {
    collided = placement;
    placement = placement - out;
  }
  if (collided == placement) collided = placement + out;  // it has not moved at all
  result.position[i] = parts_.position_of(i == 0 ? placement.x : placement.y, i);
  const double share = (result.position[i] - request.position[i]) / request.displacement[i];
  stop(side, collided, raster::fraction_of_step(share), scratch, result);
}

/// Along the whole movement, by one pixel of its length at a time. It ends between whole pixels.
void Mask::wind_back_whole(const Pixel& start, const MoveRequest& request, Scratch& scratch,
                           MoveResult& result) const noexcept {
  const Vec2d corner = parts_.corner_at(request.position);
  const double length = request.displacement.norm() / parts_.metres(1);
  double fraction = 1;
  Pixel collided = start;
  Pixel placement = start;
  for (int back = 0; fraction > 0; ++back) {
    fraction = static_cast<double>(back) < length ? 1 - static_cast<double>(back) / length : 0.0;
    const Vec2d moved = request.displacement * fraction;
    result.position = request.position + moved;
    const Vec2d way = parts_.corner_at(result.position) - corner;
    placement = fraction > 0 ? attempted(corner, way, start) : start;
    if (is_free(placement)) break;
    collided = placement;
  }
  result.velocity.setZero();
  const Pixel step = collided - placement;
  if (step == Pixel{}) return;  // it began inside
  const Side across = step.x < 0 ? Side::left : Side::right;
  const Side along = step.y < 0 ? Side::bottom : Side::top;
  const bool across_collides = step.x != 0 && !is_free(placement + Pixel{step.x, 0});
  const bool along_collides = step.y != 0 && !is_free(placement + Pixel{0, step.y});
  if (across_collides) stop(across, placement + Pixel{step.x, 0}, fraction, scratch, result);
  if (along_collides) stop(along, placement + Pixel{0, step.y}, fraction, scratch, result);
  if (!across_collides && !along_collides) stop(step.y != 0 ? along : across, collided, fraction, scratch, result);
}

void Mask::stop(Side side, const Pixel& collided, double fraction, Scratch& scratch,
                MoveResult& result) const noexcept {
  result.velocity[article::component_of(side)] = 0;
  if (side == Side::bottom) result.grounded = true;
  parts_.look_around(collided, scratch);
  level_.for_each_overlap(figure_, collided,
                          [&](const Pixel& pixel) { parts_.report(pixel, side, fraction, scratch, result); });
}

void Mask::move(const MoveRequest& request, Scratch& scratch, MoveResult& result) const noexcept {
  if (parts_.refuse(request, result)) return;
  const auto free = [this](const Pixel& placement) { return is_free(placement); };
  const Vec2d corner = parts_.corner_at(request.position);
  const Vec2d way = parts_.corner_at(request.position + request.displacement) - corner;
  bool began_inside = false;
  const Pixel start = parts_.start(corner, way, free, began_inside);
  const Pixel end = attempted(corner, way, start);
  result.position = request.position + request.displacement;
  if (!is_free(end)) {
    if (response_ == ArticleKnobs::Response::shorten) {
      wind_back_whole(start, request, scratch, result);
    } else {
      Pixel placement{start.x, end.y};
      if (way.y() != 0 && !is_free(placement))
        wind_back(way.y() < 0 ? Side::bottom : Side::top, start, request, placement, scratch, result);
      const Pixel beside{start.x, placement.y};
      placement.x = end.x;
      if (way.x() != 0 && !is_free(placement))
        wind_back(way.x() < 0 ? Side::left : Side::right, beside, request, placement, scratch, result);
    }
  }
  result.path.push_back({result.position, 1});
  bool ends_inside = began_inside;
  if (began_inside) (void)parts_.start(parts_.corner_at(result.position), way, free, ends_inside);
  if (ends_inside) result.status = StepStatus::stuck;
}

}  // namespace

TechniqueEntry mask_entry() {
  TechniqueEntry entry = entry_of<Mask>("mask", {knob::response, knob::raster_pixels_per_metre, knob::broad_phase});
  entry.draws_level = true;
  entry.unit = knob::pixel;
  return entry;
}

}  // namespace paperproof
