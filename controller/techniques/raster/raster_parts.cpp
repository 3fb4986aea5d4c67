#include "techniques/raster/raster_parts.hpp"

#include <paperproof/tolerances.hpp>

namespace paperproof::raster {
template <class Scalar>
RasterParts<Scalar>::RasterParts(const TechniqueDef& def, const Scenery<Scalar>& scenery, const CharacterDef& character)
    : scenery_(&scenery),
      broad_phase_(make_broad_phase<Scalar>(def.broad_phase, scenery.static_boxes())),
      pixels_per_metre_(def.article.raster_pixels_per_metre),
      scale_(static_cast<Scalar>(pixels_per_metre_)),
      lower_(character.shape.box().lower.template cast<Scalar>()),
      sprite_(character.shape, pixels_per_metre_) {}

template <class Scalar>
Scratch<Scalar> RasterParts<Scalar>::make_scratch() const {
  Scratch<Scalar> scratch;
  scratch.solids.pieces = PieceBuffer(scenery_->pieces().size());
  return scratch;
}

template <class Scalar>
bool RasterParts<Scalar>::refuse(const MoveRequest<Scalar>& request, MoveResult<Scalar>& result) const noexcept {
  const Vec2<Scalar> end = request.position + request.displacement;
  const Scalar pixels = request.displacement.cwiseAbs().sum() * scale_;
  result.clear();
  result.position = request.position;
  result.velocity = request.velocity;
  result.path.push_back({request.position, 0});
  const bool stays = article::in_range<Scalar>(request.position) && article::in_range<Scalar>(end);
  if (stays && pixels <= Scalar(article::max_search_steps)) return false;
  result.status = stays ? MoveStatus::refused : MoveStatus::out_of_range;
  if (stays) result.refusal = article::too_many_units;
  result.path.push_back({request.position, 1});
  return true;
}

template <class Scalar>
void RasterParts<Scalar>::look_around(const Pixel& placement, Scratch<Scalar>& scratch) const noexcept {
  // One pixel around the sprite, and one more for the line of a chain, which is drawn beside its box.
  const PixelBox& box = sprite_.mask().box();
  const Pixel upper = placement + Pixel{box.width, box.height};
  const Box2<Scalar> around{Vec2<Scalar>(metres(placement.x - 2), metres(placement.y - 2)),
                            Vec2<Scalar>(metres(upper.x + 2), metres(upper.y + 2))};
  scratch.solids.valid = false;
  scratch.solids.count = broad_phase_->query(around, scratch.solids.pieces);
}

template <class Scalar>
void RasterParts<Scalar>::report(const Pixel& pixel, Side side, Scalar fraction, const Scratch<Scalar>& scratch,
                                 MoveResult<Scalar>& result) const noexcept {
  const auto candidates = std::span<const PieceIndex>(scratch.solids.pieces).first(scratch.solids.count);
  const auto found =
      std::find_if(candidates.begin(), candidates.end(), [&](PieceIndex piece) { return is_of(piece, pixel); });
  if (found == candidates.end()) return;
  const Pixel out = towards(side);
  const Vec2<Scalar> normal(static_cast<Scalar>(-out.x), static_cast<Scalar>(-out.y));
  const Vec2<Scalar> middle(static_cast<Scalar>(pixel.x) + Scalar(0.5), static_cast<Scalar>(pixel.y) + Scalar(0.5));
  const Vec2<Scalar> point = (middle + normal * Scalar(0.5)) / scale_;
  article::add_contact(*scenery_, PointHit<Scalar>{*found, point, normal, fraction}, side, fraction, result);
}

template class RasterParts<float>;
template class RasterParts<double>;

}  // namespace paperproof::raster
