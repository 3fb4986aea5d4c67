#include <paperproof/techniques.hpp>

#include "scenery_facts.hpp"
#include "techniques/bounding_box.hpp"
#include "techniques/discrete/discrete.hpp"
#include "techniques/frame_of_reference.hpp"
#include "techniques/grid/grid.hpp"
#include "techniques/mask.hpp"
#include "techniques/octagon_sweep/octagon_sweep.hpp"
#include "techniques/penetration_resolution.hpp"
#include "techniques/pixel_colour.hpp"
#include "techniques/pixel_tile.hpp"
#include "techniques/speculative.hpp"
#include "techniques/speculative_march.hpp"
#include "techniques/wind_back.hpp"

#include <cmath>
#include <string>

namespace paperproof {
namespace {

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument(what);
}

/// Finer, and the whole range of positions would no longer have whole pixels in a double.
constexpr double max_raster_pixels_per_metre = 1000;
/// Larger, and one type of tile takes half of the memory that a level may.
constexpr int max_pixels_per_tile = 4096;
/// Each impact is a corner of the path; the start, the end, a start that is put right and a snap are corners too.
constexpr int max_sweep_iterations = static_cast<int>(MoveResult<double>::max_corners) - 4;

/// @tparam Scalar in which the unit has to be a positive number too.
template <class Scalar>
void validate(const ArticleKnobs& knobs) {
  const Scalar unit = static_cast<Scalar>(knobs.unit);
  require(std::isfinite(unit) && unit > 0, "unit: must be a positive length, not " + std::to_string(knobs.unit));
  require(knobs.iterations >= 1, "iterations: must be at least 1, not " + std::to_string(knobs.iterations));
  require(knobs.points == 8 || knobs.points == 4, "points: must be 8 or 4, not " + std::to_string(knobs.points));
  require(knobs.pairs == ArticleKnobs::Pairs::direction || knobs.pairs == ArticleKnobs::Pairs::all,
          "pairs: must be direction or all");
  require(knobs.response == ArticleKnobs::Response::component || knobs.response == ArticleKnobs::Response::shorten,
          "response: must be component or shorten");
  require(knobs.objects == ArticleKnobs::Objects::each || knobs.objects == ArticleKnobs::Objects::all,
          "objects: must be each or all");
  require(std::isfinite(knobs.square) && knobs.square > static_cast<double>(Tolerances<Scalar>{}.touch),
          "square: must be longer than what counts as touching, not " + std::to_string(knobs.square));
  const double fineness = knobs.raster_pixels_per_metre;
  require(fineness > 0 && fineness <= max_raster_pixels_per_metre,
          "raster_pixels_per_metre: must be above 0 and at most 1000, not " + std::to_string(fineness));
  require(knobs.pixels_per_tile >= 1 && knobs.pixels_per_tile <= max_pixels_per_tile,
          "pixels_per_tile: must be from 1 to 4096, not " + std::to_string(knobs.pixels_per_tile));
}

}  // namespace

std::string_view name_of(TechniqueKind kind) noexcept {
  switch (kind) {
    case TechniqueKind::grid:
      return "grid";
    case TechniqueKind::pixel_colour:
      return "pixel_colour";
    case TechniqueKind::pixel_tile:
      return "pixel_tile";
    case TechniqueKind::mask:
      return "mask";
    case TechniqueKind::bounding_box:
      return "bounding_box";
    case TechniqueKind::discrete:
      return "discrete";
    case TechniqueKind::wind_back:
      return "wind_back";
    case TechniqueKind::penetration_resolution:
      return "penetration_resolution";
    case TechniqueKind::speculative_march:
      return "speculative_march";
    case TechniqueKind::speculative:
      return "speculative";
    case TechniqueKind::octagon_sweep:
      return "octagon_sweep";
  }
  return "unknown";
}

namespace {

bool knows_movers(TechniqueKind kind) noexcept {
  switch (kind) {
    case TechniqueKind::bounding_box:
    case TechniqueKind::discrete:
    case TechniqueKind::penetration_resolution:
    case TechniqueKind::speculative_march:
    case TechniqueKind::speculative:
    case TechniqueKind::octagon_sweep:
      return true;
    case TechniqueKind::grid:
    case TechniqueKind::pixel_colour:
    case TechniqueKind::pixel_tile:
    case TechniqueKind::mask:
    case TechniqueKind::wind_back:
      break;
  }
  return false;
}

}  // namespace

template <class Scalar>
std::unique_ptr<Technique<Scalar>> make_technique(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                  const CharacterDef& character) {
  character.validate();
  validate<Scalar>(def.article);
  require(def.sweep_iterations >= 1 && def.sweep_iterations <= max_sweep_iterations,
          "sweep_iterations: must be from 1 to " + std::to_string(max_sweep_iterations) + ", not " +
              std::to_string(def.sweep_iterations));
  if (!knows_movers(def.kind) && something_carries(scenery))
    throw NotExpressible(std::string(name_of(def.kind)) + " is for scenery that stands still");
  if (def.kind == TechniqueKind::bounding_box && has_conveyors(scenery))
    throw NotExpressible("bounding_box carries nobody: there is a conveyor");
  switch (def.kind) {
    case TechniqueKind::grid:
      return make_grid(def, scenery, character);
    case TechniqueKind::pixel_colour:
      return make_pixel_colour(def, scenery, character);
    case TechniqueKind::pixel_tile:
      return make_pixel_tile(def, scenery, character);
    case TechniqueKind::mask:
      return make_mask(def, scenery, character);
    case TechniqueKind::bounding_box:
      return make_bounding_box(def, scenery, character);
    case TechniqueKind::discrete:
      return make_discrete(def, scenery, character);
    case TechniqueKind::wind_back:
      return make_wind_back(def, scenery, character);
    case TechniqueKind::penetration_resolution:
      return make_penetration_resolution(def, scenery, character);
    case TechniqueKind::speculative_march:
      return make_speculative_march(def, scenery, character);
    case TechniqueKind::speculative:
      return make_speculative(def, scenery, character);
    case TechniqueKind::octagon_sweep:
      return make_octagon_sweep(def, scenery, character);
  }
  throw std::invalid_argument("technique: there is none with the number " + std::to_string(static_cast<int>(def.kind)));
}

template std::unique_ptr<Technique<float>> make_technique(const TechniqueDef&, const Scenery<float>&,
                                                          const CharacterDef&);
template std::unique_ptr<Technique<double>> make_technique(const TechniqueDef&, const Scenery<double>&,
                                                           const CharacterDef&);

}  // namespace paperproof
