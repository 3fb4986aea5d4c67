#include "techniques/raster/raster_parts.hpp"

#include "step_parts.hpp"

#include <paperproof/tolerances.hpp>

namespace paperproof::raster {
RasterParts::RasterParts(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character)
    : scenery_(&scenery),
      broad_phase_(make_broad_phase(def.broad_phase, standing_boxes(scenery))),
      pixels_per_metre_(def.article.raster_pixels_per_metre),
      lower_(character.shape.box().lower),
      sprite_(character.shape, pixels_per_metre_) {}

Scratch RasterParts::make_scratch() const {
  Scratch scratch;
  scratch.solids.pieces.reserve(scenery_->pieces().size());
  return scratch;
}

bool RasterParts::refuse(const MoveRequest& request, MoveResult& result) const noexcept {
  const Vec2d end = request.position + request.displacement;
  const double pixels = request.displacement.cwiseAbs().sum() * pixels_per_metre_;
  result.clear();
  result.position = request.position;
  result.velocity = request.velocity;
  result.path.push_back({request.position, 0});
  const bool stays = step_parts::in_range(request.position) && step_parts::in_range(end);
  if (stays && pixels <= double(article::max_search_steps)) return false;
  result.status = stays ? StepStatus::refused : StepStatus::out_of_range;
  if (stays) result.refusal = article::too_many_units;
  result.path.push_back({request.position, 1});
  return true;
}

void RasterParts::look_around(const Pixel& placement, Scratch& scratch) const noexcept {
  // One pixel around the sprite, and one more for the line of a chain, which is drawn beside its box.
  const PixelBox& box = sprite_.mask().box();
  const Pixel upper = placement + Pixel{box.width, box.height};
  const Box2 around{Vec2d(metres(placement.x - 2), metres(placement.y - 2)),
                    Vec2d(metres(upper.x + 2), metres(upper.y + 2))};
  scratch.solids.pieces.clear();
  broad_phase_->query(around, scratch.solids.pieces);
}

void RasterParts::report(const Pixel& pixel, Side side, double fraction, const Scratch& scratch,
                         MoveResult& result) const noexcept {
  const std::vector<PieceIndex>& near = scratch.solids.pieces;
  const auto found = std::ranges::find_if(
      near, [&](PieceIndex piece) { return covers(scenery_->vertices_of(piece), pixels_per_metre_, pixel); });
  if (found == near.end()) return;
  const Pixel out = towards(side);
  const Vec2d normal(static_cast<double>(-out.x), static_cast<double>(-out.y));
  const Vec2d middle(static_cast<double>(pixel.x) + 0.5, static_cast<double>(pixel.y) + 0.5);
  const Vec2d point = (middle + normal * 0.5) / pixels_per_metre_;
  article::add_contact(*scenery_, PointHit{*found, point, normal, fraction}, side, fraction, result);
}

}  // namespace paperproof::raster
