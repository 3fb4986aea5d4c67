/// What the picture techniques share: where a character lies among the pixels, and whose pixels it met.
///
/// The position stays a position in metres; collisions are decided on whole pixels. With c the lower left corner of the
/// character's bounding box in pixels, the sprite is laid on whole pixels (a *placement*): on the pixel of floor(c),
/// and, along a movement to the right or upwards, on that of ceil(c): the pixels that its leading edge has reached.
/// Across the movement a character is therefore up to one pixel away from its picture, on every side of it. What
/// stops a character leaves it on a whole placement, so that at rest it stays where it is.
#pragma once

#include "techniques/article_response.hpp"
#include "techniques/raster/sprite.hpp"

namespace paperproof::raster {

/// A share of the way as a fraction of the step, in [0, 1]; a negative zero, as of no way at all to the left, is zero.
[[nodiscard]] inline double fraction_of_step(double share) noexcept { return share > 0 ? std::min(share, 1.0) : 0.0; }

/// Immutable; shareable between threads.
class RasterParts {
 public:
  /// @param def its article knobs are valid. `scenery` must outlive the parts.
  /// @throws NotExpressible as `Sprite`.
  RasterParts(const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character);

  [[nodiscard]] const Sprite& sprite() const noexcept { return sprite_; }
  [[nodiscard]] Scratch make_scratch() const;

  /// Lower left corner of the bounding box [px].
  [[nodiscard]] Vec2d corner_at(const Vec2d& position) const noexcept {
    return (position + lower_) * pixels_per_metre_;
  }
  /// A coordinate of the position whose corner is on a whole pixel [m].
  [[nodiscard]] double position_of(std::int64_t corner, Eigen::Index component) const noexcept {
    return static_cast<double>(corner) / pixels_per_metre_ - lower_[component];
  }
  [[nodiscard]] double metres(std::int64_t pixels) const noexcept {
    return static_cast<double>(pixels) / pixels_per_metre_;
  }

  /// Where a movement by `way` begins: the first of the up to four placements around `corner` that `is_free` accepts.
  /// A movement that was free ends on one of them. The one that lies farthest ahead comes first: it is where a movement
  /// in the same direction has ended. None is free: that one, and `inside`.
  template <class IsFree>
  [[nodiscard]] Pixel start(const Vec2d& corner, const Vec2d& way, const IsFree& is_free, bool& inside) const noexcept;

  /// Fills `result` as a refusal and returns true where the movement leaves the range of the tolerances or takes more
  /// than `article::max_search_steps` pixels.
  [[nodiscard]] bool refuse(const MoveRequest& request, MoveResult& result) const noexcept;

  /// Looks up whose pixels are around a placement, before `report`.
  void look_around(const Pixel& placement, Scratch& scratch) const noexcept;
  /// Adds a contact with the collider that a solid pixel belongs to, where it is around the last `look_around`.
  /// The picture knows of no surface: the point is the middle of the pixel's edge that faces the character, the normal
  /// that of the side, and the separation zero.
  void report(const Pixel& pixel, Side side, double fraction, const Scratch& scratch,
              MoveResult& result) const noexcept;

 private:
  const Scenery* scenery_;
  std::unique_ptr<BroadPhase> broad_phase_;
  double pixels_per_metre_;
  Vec2d lower_;  ///< Corner of the bounding box, relative to the position [m].
  Sprite sprite_;
};

template <class IsFree>
Pixel RasterParts::start(const Vec2d& corner, const Vec2d& way, const IsFree& is_free, bool& inside) const noexcept {
  const Pixel low{floor_to_pixel(corner.x()), floor_to_pixel(corner.y())};
  const Pixel high{ceil_to_pixel(corner.x()), ceil_to_pixel(corner.y())};
  const Pixel ahead{way.x() > 0 ? high.x : low.x, way.y() > 0 ? high.y : low.y};
  const Pixel behind = low + high - ahead;
  inside = false;
  for (const Pixel& each : {ahead, Pixel{behind.x, ahead.y}, Pixel{ahead.x, behind.y}, behind}) {
    if (is_free(each)) return each;
  }
  inside = true;
  return ahead;
}

}  // namespace paperproof::raster
