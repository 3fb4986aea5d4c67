/// From vectors to pixels.
///
/// A pixel is solid when its centre is inside a polygon (holes respected). A centre on an edge belongs to the side on
/// the right or above, so that of two polygons that share an edge exactly one has it. A chain, which has no inside, is
/// drawn as a line one pixel wide: along its longer axis, the pixel that holds the line at the middle of each column
/// (row), and the pixels of its ends. A one-way chain cannot be drawn: a pixel is solid from all sides.
#pragma once

#include "techniques/nearby_scenery.hpp"
#include "techniques/raster/pixel.hpp"

#include <paperproof/scenery.hpp>

#include <span>
#include <vector>

namespace paperproof::raster {

/// Neighbouring solid pixels of a row: `first` up to, but not including, `end`.
struct Span {
  std::int64_t row = 0;
  std::int64_t first = 0;
  std::int64_t end = 0;
};

/// Replaces `spans` by the solid pixels of a collider. A scan line method: crossings of the outline with the middle
/// lines of the rows, sorted; between an odd and an even one is inside. The same vertices give the same crossings, bit
/// for bit, whichever polygon they belong to.
/// @throws NotExpressible for a one-way chain.
void spans_of(const ColliderDef& collider, double pixels_per_metre, std::vector<Span>& spans);

/// Calls `visit(collider, span)` for the solid pixels of everything that blocks and stands still, in order.
/// @throws NotExpressible as `spans_of`.
template <class Visit>
void for_each_span(const SceneryDef& scenery, double pixels_per_metre, const Visit& visit) {
  std::vector<Span> spans;
  for (const ColliderIndex collider : standing_solids(scenery)) {
    spans_of(scenery.colliders[collider], pixels_per_metre, spans);
    for (const Span& span : spans) visit(collider, span);
  }
}

/// A box that holds every solid pixel; empty where nothing is solid.
[[nodiscard]] PixelBox pixels_around(const SceneryDef& scenery, double pixels_per_metre);

/// Whether `pixel` is one of a piece's solid pixels.
/// @param outline of a polygon, or the two ends of a chain's segment [m].
[[nodiscard]] bool covers(std::span<const Vec2d> outline, double pixels_per_metre, const Pixel& pixel) noexcept;

}  // namespace paperproof::raster
