/// The level of the table in controller/README.md: unit tiles, slopes and platforms, as many as asked for.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/scenery.hpp>

#include <box2d/b2_body.h>
#include <box2d/b2_world.h>

#include <memory>
#include <vector>

namespace paperproof::benchmarks {

inline constexpr double frame = 1.0 / 60;  ///< [s]
inline constexpr double gravity_y = -30;   ///< [m/s²]

/// A level is made of sections, side by side and one above the other, as nearly square as may be, between two walls.
struct Level {
  SceneryDef scenery;
  int sections = 0;
  int sections_per_storey = 0;

  /// Where the ground of a section begins, at its left end [m].
  [[nodiscard]] Vec2d origin(int section) const;
  /// A character that nearly touches the ground near the left end of a section [m].
  [[nodiscard]] Vec2d start(int section) const;
  /// Near the middle.
  [[nodiscard]] Vec2d start() const;
};

/// As many pieces as asked for, or a few more.
[[nodiscard]] Level make_level(std::int64_t pieces);
/// And so many sensors of a square metre above the ground: wherever a character goes it enters and leaves some.
[[nodiscard]] Level make_level_with_sensors(std::int64_t pieces, std::int64_t sensors);

/// All pieces as fixtures of one static body, with their tree.
[[nodiscard]] std::unique_ptr<b2World> make_box2d_level(const Level& level);
/// The character as a body that no other character meets. @param position [m].
b2Body& add_box2d_character(b2World& world, const CharacterDef& character, const Vec2d& position);

/// A step of a frame, with the iterations that Box2D's manual names.
inline void advance(b2World& world) { world.Step(static_cast<float>(frame), 8, 3); }

/// Walks and jumps at random.
[[nodiscard]] std::vector<Input> random_walk(std::uint64_t seed, int steps);

}  // namespace paperproof::benchmarks
