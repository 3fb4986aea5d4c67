/// Draws the runs of each kind. The same seed draws the same run on every machine; no draw reads what a run does.
#pragma once

#include "campaign/play_levels.hpp"
#include "campaign/random.hpp"
#include "campaign/random_run.hpp"
#include "campaign/terrain.hpp"

#include <array>
#include <cstdint>
#include <string_view>

namespace paperproof::compare {

/// What turns in a run.
enum class Turning : std::uint8_t {
  planks,    ///< Turn about their middle, evenly, at up to 30 rad/s.
  see_saws,  ///< Turn to and fro about a point on them.
  wheels,    ///< Polygons of 5 to 12 corners, some with notches, that turn and go along.
  presses,   ///< Boxes that come down, turning, onto the floor, the walls and each other.
  papers,    ///< From a line to 5 cm thick, about any point, turning and going along.
  balls,     ///< One or two circles, about any point, turning and going along.
};
inline constexpr std::array<std::string_view, 6> turning_names{"planks",  "see_saws", "wheels",
                                                               "presses", "papers",   "balls"};

/// A line that goes to the right.
enum class Line : std::uint8_t {
  hill,      ///< Of two to eight flanks of up to 89 degrees.
  arch,      ///< Of up to 64 segments.
  sawtooth,  ///< Of teeth that lean.
  ramp,      ///< Straight, but for the rounding of its corners.
};
inline constexpr std::array<std::string_view, 4> line_names{"hill", "arch", "sawtooth", "ramp"};

/// Launches at 1e-3 to 1e6 m per step among solids that stand, up to 1e6 m from the origin; some begin inside.
/// @param up_turns between steps, now and then.
[[nodiscard]] RandomRun draw_still(Terrain terrain, std::uint64_t seed, bool up_turns);

/// The same among up to 64 movers that wander about at up to 1e6 m per step.
[[nodiscard]] RandomRun draw_among_movers(Terrain terrain, std::uint64_t seed, bool up_turns);

[[nodiscard]] RandomRun draw_among_turning(Turning family, std::uint64_t seed);

/// A chamber about as large as the character; two to four presses go in and out of it and leave no room.
/// @param rims each press has walls at its sides, and is a bucket.
[[nodiscard]] RandomRun draw_among_presses(bool rims, std::uint64_t seed);

/// Keys held and jumps at random, for ten seconds. @param rate steps per second.
[[nodiscard]] RandomRun draw_play(PlayLevel level, int rate, std::uint64_t seed);

/// The same for eight seconds under a gravity up to 60 degrees off up. In half of the runs nothing steers.
[[nodiscard]] RandomRun draw_slanted(PlayLevel level, std::uint64_t seed);

/// Play with stairs that are climbed, ground that is followed down, and a lift or press that goes to and fro.
[[nodiscard]] RandomRun draw_stairs(PlayLevel level, std::uint64_t seed);

/// Over kerbs, stairs, slopes, belts, boards, lifts and ferries, with `step_height` and mostly with a `snap`.
[[nodiscard]] RandomRun draw_course(std::uint64_t seed);

/// Two to sixteen characters in a tight room. A run of fewer than two characters has no steps.
[[nodiscard]] RandomRun draw_crowd(std::uint64_t seed);

/// Two to ten characters among lifts, cabins, presses and papers.
[[nodiscard]] RandomRun draw_crowd_among_movers(std::uint64_t seed);

/// Above a line, below it, or on it before a corner: it is a solid, a chain, tiles, or one-way in any parts.
[[nodiscard]] RandomRun draw_on_line(Line line, std::uint64_t seed);

/// One flight past the corner of a triangle, from 0.1 m beside it to 0.1 m into it, down to an ulp.
[[nodiscard]] RandomRun draw_near_a_corner(std::uint64_t seed);

/// Flights through sensors, with coordinates that doubles add exactly.
[[nodiscard]] RandomRun draw_through_sensors(std::uint64_t seed);

/// Walls, floors and plates at up to 2e-7 m on opposite sides. @param rests all that could move.
[[nodiscard]] RandomRun draw_exact_fit(bool rests, std::uint64_t seed);

/// A window in a wall, or a slot in a floor, larger than the character by at most 1e-6 m, or smaller; and as near to
/// it.
[[nodiscard]] RandomRun draw_opening(std::uint64_t seed);

/// A one-way mover that meets the character as a step ends, but for rounding, and goes on.
[[nodiscard]] RandomRun draw_touched_by_ledge(std::uint64_t seed);

/// One step from among solids, or from inside of them; in half of the runs with a frame around.
[[nodiscard]] RandomRun draw_inside(Terrain terrain, std::uint64_t seed);

}  // namespace paperproof::compare
