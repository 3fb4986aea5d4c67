/// The techniques by name: the article's ten, `octagon_sweep`, and those that a user registers.
#pragma once

#include <paperproof/broad_phase.hpp>
#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>
#include <paperproof/technique.hpp>
#include <paperproof/technique_controller.hpp>

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace paperproof {

/// A technique that cannot express a scenery: a grid and a slope, a picture and a one-way chain. `what()` says why.
class NotExpressible : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Knobs of the article's techniques.
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

/// A technique with its knobs. Each technique reads the fields that it knows.
struct TechniqueDef {
  std::string_view name = "octagon_sweep";
  BroadPhaseKind broad_phase = BroadPhaseKind::tree;
  PieceSearch search = PieceSearch::grid;  ///< Of `octagon_sweep`, and of what belongs to the controller.
  ArticleKnobs article{};
  int sweep_iterations = SweepDef{}.iterations;  ///< `octagon_sweep`: see `SweepDef::iterations`.
  /// `pixel_tile`: the level as tiles (pixel_tiles.hpp), `article.raster_pixels_per_metre` fine. None: they are made
  /// from the scenery, which is what contacts name in either case.
  std::shared_ptr<const PixelTileSet> pixel_tiles{};
  /// `pixel_colour`: what is drawn in the colour of a platform and stops nobody else. None: nothing.
  std::shared_ptr<const SceneryDef> decoration{};
  /// `mask`: the picture of the character, rows from the top, `#` for white: a pixel that collides. As large as the box
  /// of the character's shape, `article.raster_pixels_per_metre` fine. Empty: the pixels of the hull.
  std::vector<std::string> sprite{};
  std::map<std::string, std::string> own{};  ///< Knobs of a registered technique, by name.
};

/// A knob as its technique describes it.
struct Knob {
  std::string_view name;
  std::string_view meaning;  ///< In one line, with the unit and with the value that holds where it is not turned.
  /// @throws std::invalid_argument in words for a value of the wrong kind. A value out of range is refused by
  /// `make_technique`.
  void (*turn)(const std::string& value, TechniqueDef& def);
};

/// For the values of knobs. @throws std::invalid_argument in words.
[[nodiscard]] double real_in(const std::string& text);
[[nodiscard]] int whole_in(const std::string& text);
/// One of two words: false for the first.
[[nodiscard]] bool is_second(const std::string& text, std::string_view first, std::string_view second);

using TechniqueMaker = std::unique_ptr<Technique> (*)(const TechniqueDef&, const Scenery&, const CharacterDef&);

/// How a technique is known.
struct TechniqueEntry {
  std::string_view name;
  TechniqueMaker make = nullptr;  ///< Null: it is `octagon_sweep`, which the core makes.
  std::vector<Knob> knobs{};
  bool knows_movers = false;   ///< False: scenery that moves or conveys is refused.
  bool knows_circles = false;  ///< False: scenery with circles is refused.
  bool moves_crowds = false;   ///< It is `octagon_sweep` or a `JointTechnique`.
  bool draws_level = false;    ///< It sees the level as a picture, `article.raster_pixels_per_metre` fine.
  /// The length of the steps in which it searches or moves [m]. Null: it computes.
  double (*unit)(const ArticleKnobs& knobs) = nullptr;
};

/// For a technique that is built from (const TechniqueDef&, const Scenery&, const CharacterDef&).
template <class Made>
[[nodiscard]] TechniqueEntry entry_of(std::string_view name, std::vector<Knob> knobs = {}) {
  return {
      name,
      [](const TechniqueDef& def, const Scenery& scenery, const CharacterDef& character) -> std::unique_ptr<Technique> {
        return std::make_unique<Made>(def, scenery, character);
      },
      std::move(knobs)};
}

/// All of them: the article's in its order, `octagon_sweep`, those that were registered. Thread-safe once `main` began.
[[nodiscard]] const std::vector<TechniqueEntry>& all_techniques();
[[nodiscard]] std::vector<std::string_view> technique_names();
/// Null where there is none of the name.
[[nodiscard]] const TechniqueEntry* find_technique(std::string_view name);
/// Makes a technique of your own known. To be called before `main`, to initialise a constant of your file.
/// @return true. @throws std::invalid_argument for a name that is taken.
bool register_technique(TechniqueEntry entry);

/// Builds a technique for one scenery and one character. `scenery` must outlive it.
/// @throws std::invalid_argument for `octagon_sweep` and for a name that is not known, a knob out of range, or a sprite
/// of another size than the character; InvalidCharacter for an impossible character; NotExpressible where the technique
/// cannot express the scenery.
[[nodiscard]] std::unique_ptr<Technique> make_technique(const TechniqueDef& def, const Scenery& scenery,
                                                        const CharacterDef& character);

/// A controller that moves by the technique. Its `CharacterDef::wall_reach` is one unit.
/// @throws as `make_technique`.
[[nodiscard]] TechniqueController make_controller(const Scenery& scenery, const CharacterDef& character,
                                                  const TechniqueDef& def);

/// A crowd that moves by the technique.
/// @throws as `make_technique`, and std::invalid_argument for a technique that knows one character.
[[nodiscard]] TechniqueCrowd make_crowd(const Scenery& scenery, const CharacterDef& character, const TechniqueDef& def);

}  // namespace paperproof
