/// Every length that is neither input nor result, in one place.
#pragma once

namespace paperproof {

/// In metres, unless stated otherwise. Each comment gives the effect of both extremes. The four lengths and their order
/// were found against an exact oracle: with one threshold alone a walker snags on abutting tiles, with two it does not.
///
/// They rest on what rounding does to a separation, n·(position - offset of the mover) - h with h = max n·v - min n·o
/// over the vertices v and the points o of the character. Each sum, difference and product is rounded once; none is
/// fused. What is given counts as exact: position, displacement, the ends of a mover's way, v, o and n, as every
/// direction may separate. With no coordinate beyond 1e6 m the error is at most
///
///     2.5e-9 at one place, beside a mover too
///     3.4e-9 at the end of a straight motion beside what stands, with the rounding of this place
///     3.5e-9 from a circle: there the length of n counts
///     9e-9 at the end of a motion beside a mover, where neither goes farther than 1e6 m in a step: the relative motion
///          is rounded, and what may be nothing but rounding is dropped from it
///
/// The first three are the 4e-9 below. All are less than `certain`; up to `range` the first three still are, and
/// the last one is not proved to be. Gappa proves this (tests/controller/bounds).
struct Tolerances {
  /// A motion hits where it would come nearer than this. Zero: rounding (about 4e-9 at 1e6 m) lets the character
  /// overlap a solid. Large: narrow openings count as closed. (An opening counts as closed if its clearance is less
  /// than twice this.)
  double hit = 1e-7;
  /// Gap at which a motion is stopped. Below `hit`: the motion hits again while it slides. Large: visible hover.
  double stop = 5e-7;
  /// Up to this gap a stopped character still touches. Equal to `stop`: rounding makes the character creep for ever.
  /// Large: the character touches from afar.
  double touch = 7e-7;
  /// How far beyond the displacement the sweep looks. Zero: a slow approach stops short of `hit` in several steps.
  /// Large: more candidates.
  double look = 1e-3;
  /// Rounding could hide an overlap in a gap below this: the motion then needs an exact certificate. Zero: overlaps by
  /// rounding. Large: slow. 4e-9 is the error at 1e6 m. A slide along a touched surface that stands may enter it a
  /// little: with the error, by less than this if |x| + |y| of the displacement is at most 1e6 m.
  double certain = 1e-8;
  /// A sliding character this much below `stop` is aimed back to it. Zero: the character never slides straight. Beyond
  /// `stop - hit`: the gap drifts away far from the origin.
  double restore = 2e-7;
  /// Positions and steps beyond this are refused: rounding would reach `certain` at twice as much.
  double range = 2e6;
  /// In one step, what moves pushes the character at most so much farther than it goes itself [m]; beyond that it
  /// crushes. Zero: a wall crushes whoever it pushes up a slope. Large: a press flings.
  double push = 0.25;
  /// Not a length: ground that is this much steeper than the climb limit is still walkable [rad]. Zero: the rounding of
  /// its normal decides whether a slope of exactly the limit is climbed. Large: the limit is not the requested one.
  double climb = 1e-8;
};

/// Of `float`, which keeps 24 bits: at 100 m a position is known to 4e-6 m. Nothing is guaranteed; the harness counts
/// violations.
inline constexpr Tolerances tolerances_in_float{.hit = 1e-4,
                                                .stop = 5e-4,
                                                .touch = 7e-4,
                                                .look = 1e-2,
                                                .certain = 1e-5,
                                                .restore = 2e-4,
                                                .range = 2e6,
                                                .push = 0.25,
                                                .climb = 1e-5};

}  // namespace paperproof
