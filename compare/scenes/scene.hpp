/// A scene: everything a run needs, as a value.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/pixel_tiles.hpp>
#include <paperproof/scenery.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scenes/answer.hpp"
#include "scenes/mover.hpp"

namespace paperproof::compare {

/// From `step` on, the keys that are given apply until a later event changes them.
struct InputEvent {
  int step = 0;
  std::optional<double> move;
  std::optional<bool> jump;
  std::optional<bool> drop{};

  friend bool operator==(const InputEvent&, const InputEvent&) = default;
};

/// Where the scene's character begins.
struct Start {
  Vec2d position{Vec2d::Zero()};  ///< [m]
  Vec2d velocity{Vec2d::Zero()};  ///< [m/s]
  /// A start inside a solid is an error unless the scene asks to resolve it.
  bool resolve_overlap = false;
};

/// One more character, of the same kind as the scene's first.
struct OtherCharacter {
  Start start;
  std::vector<InputEvent> input;  ///< Sorted by step.
};

/// The scene's own word on the article's two jumping rules. Where it has none, contender and knob decide.
struct JumpRules {
  std::optional<bool> no_jump_toward_wall{};  ///< See `CharacterDef`, both.
  std::optional<bool> side_hit_ends_rise{};
};

/// Drawn in the colour of a platform, and solid only for `pixel_colour`, which reads colours.
struct Decoration {
  std::string id;
  std::vector<Vec2d> polygon;  ///< [m]
};

/// What characters want: one list of events for each of them.
using Script = std::vector<std::vector<InputEvent>>;

struct Scene {
  std::string name;
  std::string description;  ///< One line: what is measured and the exact answer. May be empty.
  double pixels_per_metre = 32;
  Vec2d gravity{0, -30};  ///< [m/s²]
  double dt = 1.0 / 60;   ///< [s]
  /// Where it is not empty the lengths of the steps, again and again [s]; `dt` is only shown then.
  std::vector<double> dt_list{};
  int steps = 600;
  CharacterDef character;  ///< But for the jumping rules.
  JumpRules jump_rules{};
  Start start;
  SceneryDef scenery;             ///< What stands, what moves and what only notices.
  std::vector<std::string> ids;   ///< One per collider, unique.
  std::vector<MoverDef> movers;   ///< By `ColliderDef::mover`; each has a collider.
  std::vector<Joint> joints{};    ///< Between bodies among the movers, and the ground.
  std::vector<InputEvent> input;  ///< Sorted by step.
  /// Maps only, which have no script: they move by `random_script` of this seed where nothing else is asked for.
  std::optional<std::uint64_t> moves_at_random{};
  /// Characters 1, 2, ...; character 0 begins at `start` and does what `input` says.
  std::vector<OtherCharacter> others;
  /// What it must come to with its own input and number of steps. A change of the scene clears them.
  std::vector<Answer> answers{};
  /// Part of the scenery is made of pixels: a contender that draws the level draws these, `pixels_per_metre` of them,
  /// or none.
  bool has_pixels = false;
  /// Its solid pixels are the scenery, for everybody. What else its pixels say of a collision is for the technique that
  /// can read that. None: the scenery has no tiles.
  std::shared_ptr<const PixelTileSet> tiles{};
  std::vector<Decoration> decoration{};
  /// The picture of the character, rows from the top, `#` for a pixel that collides: for a contender that compares
  /// pictures. Its size is that of the character's box, `pixels_per_metre` fine. Empty: the pixels of the hull.
  std::vector<std::string> sprite{};
  /// Maps only: their box [m]. A character that leaves it by more than 10 m is put back at the start.
  std::optional<Box2> respawn_box;
  /// Its numbers, by the keys that rows have (`dt_s`, `thickness_m`), in order.
  std::vector<std::pair<std::string, double>> parameters{};
  std::string given{};   ///< Name or file as it was asked for.
  std::string source{};  ///< `FILE#HASH` of the file's bytes, or `builtin:NAME#HASH` of the scene as JSON.
  /// What a loader left out or could not place, in words (tiles unknown to the tileset, for instance).
  std::vector<std::string> notes;
};

[[nodiscard]] inline std::size_t character_count(const Scene& scene) { return 1 + scene.others.size(); }
/// Where a character begins.
[[nodiscard]] inline const Start& start_of(const Scene& scene, std::size_t character) {
  return character == 0 ? scene.start : scene.others[character - 1].start;
}
/// What the scene's characters want by themselves, in as many steps.
[[nodiscard]] Script script_of(const Scene& scene, int steps);
[[nodiscard]] inline Script script_of(const Scene& scene) { return script_of(scene, scene.steps); }
/// What they want with random input: character k as by `random_input(seed + k, steps)`.
[[nodiscard]] Script random_script(const Scene& scene, std::uint64_t seed, int steps);

/// The scenery as it is `time` seconds after the start: every collider stands where its mover has
/// taken it (rounded), and none moves.
[[nodiscard]] SceneryDef scenery_at(const Scene& scene, double time);

/// What an event changes.
void apply(const InputEvent& event, Input& input);

/// The input at a step: the events up to and including it, applied in order.
[[nodiscard]] Input input_at(const std::vector<InputEvent>& events, int step);

/// Walks and jumps at random: each choice (left, right, stand; jump or not) is held for 15 to 120 steps. The same seed
/// gives the same events on every machine.
[[nodiscard]] std::vector<InputEvent> random_input(std::uint64_t seed, int steps);

}  // namespace paperproof::compare
