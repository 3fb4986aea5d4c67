/// Makes the techniques, by definition.
#pragma once

#include <paperproof/broad_phase.hpp>
#include <paperproof/character.hpp>
#include <paperproof/plan.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/technique.hpp>
#include <paperproof/tolerances.hpp>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace paperproof {

enum class TechniqueKind : std::uint8_t {
  grid,
  pixel_colour,
  pixel_tile,
  mask,
  bounding_box,
  discrete,
  wind_back,
  penetration_resolution,
  speculative_march,
  speculative,
  octagon_sweep,
};

inline constexpr std::array all_techniques{
    TechniqueKind::grid,        TechniqueKind::pixel_colour,           TechniqueKind::pixel_tile,
    TechniqueKind::mask,        TechniqueKind::bounding_box,           TechniqueKind::discrete,
    TechniqueKind::wind_back,   TechniqueKind::penetration_resolution, TechniqueKind::speculative_march,
    TechniqueKind::speculative, TechniqueKind::octagon_sweep,
};

/// The name the command takes: `octagon_sweep`, ...
[[nodiscard]] std::string_view name_of(TechniqueKind kind) noexcept;

/// A technique that cannot express a scenery: a grid and a slope, a picture and a one-way chain. `what()` says why.
class NotExpressible : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Knobs of the article's techniques (all but `octagon_sweep`).
struct ArticleKnobs {
  enum class Pairs : std::uint8_t {
    direction,  ///< Only the pairs that face the movement are tested, as the article says.
    all,        ///< All of them, to show how that gets stuck.
  };
  enum class Response : std::uint8_t {
    component,  ///< Only the component of the direction under test changes, as the article says.
    shorten,    ///< The whole vector is shortened, to show how that sticks to the floor.
  };
  enum class Objects : std::uint8_t {
    each,  ///< Penetration resolution frees a pair of one object after the other, as the article says.
    all,   ///< Of all that is near at once: less is left to the next iteration.
  };
  double unit = 1.0 / 32;  ///< One pixel [m]: the step of every search.
  int iterations = 4;      ///< At least 1.
  int points = 8;          ///< 8: the character's points; 4: the corners of their bounding box.
  Pairs pairs = Pairs::direction;
  Response response = Response::component;
  Objects objects = Objects::each;  ///< An object is a collider, whatever convex pieces it is made of.
  double square = 1;  ///< `grid`: the side of its squares [m]. Large: less can be expressed. Small: memory.
  double raster_pixels_per_metre = 32;  ///< Of the picture techniques, in (0, 1000]. Small: edges move by up to half a
                                        ///< pixel, and gaps close. Large: memory, with its square.
  int pixels_per_tile = 32;             ///< `pixel_tile`: along one side of a tile, in [1, 4096].
};

struct PixelTileSet;

struct TechniqueDef {
  TechniqueKind kind = TechniqueKind::octagon_sweep;
  BroadPhaseKind broad_phase = BroadPhaseKind::tree;
  Stages stages{};
  ArticleKnobs article{};
  int sweep_iterations = 12;  ///< `octagon_sweep`: impacts per step before the rest is dropped; from 1 to 60.
  /// `octagon_sweep`: colliders from here on are other characters. They are in the way and push, and carry nobody.
  /// `Crowd` sets it; none otherwise.
  ColliderIndex first_companion = ~ColliderIndex{0};
  /// `pixel_tile`: the level as tiles (pixel_tiles.hpp), `article.raster_pixels_per_metre` fine. None: they are made
  /// from the scenery, which is what contacts name in either case.
  std::shared_ptr<const PixelTileSet> pixel_tiles{};
  /// `pixel_colour`: what is drawn in the colour of a platform and stops nobody else. None: nothing.
  std::shared_ptr<const SceneryDef> decoration{};
  /// `mask`: the picture of the character, rows from the top, `#` for white: a pixel that collides. As large as the box
  /// of the character's shape, `article.raster_pixels_per_metre` fine. Empty: the pixels of the hull.
  std::vector<std::string> sprite{};
};

/// Builds a technique for one scenery and one character. `scenery` must outlive it.
/// @throws std::invalid_argument for a knob out of range, or a sprite of another size than the character,
/// InvalidCharacter for an impossible character, NotExpressible
///   where the technique cannot express the scenery.
template <class Scalar>
[[nodiscard]] std::unique_ptr<Technique<Scalar>> make_technique(const TechniqueDef& def, const Scenery<Scalar>& scenery,
                                                                const CharacterDef& character);

}  // namespace paperproof
