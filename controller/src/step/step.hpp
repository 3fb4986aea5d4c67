/// One step of the octagon sweep.
///
/// A step goes this way (step_solve.hpp):
///   1. step_ride.hpp: a rider adds the motion of its ground to the desired displacement.
///   2. step_sweep.hpp: the octagon is swept to the earliest time of impact. Every obstacle has its own motion; what
///      stands still has none.
///   3. step_start.hpp: a start that overlaps something, or is nearer than it should be, is made free: the first sweep
///      has seen that, and is made again from there.
///   4. step_response.hpp: the desired motion becomes one that all touched surfaces allow. The rest of it goes back
///   to 2.
///   5. step_free_position.hpp, step_crush.hpp: where movers leave no motion at all, the step looks for the nearest
///      free position; where there is none, the movers crush the character.
///   6. step_solve.hpp: does the character stand on ground?
///   7. step_stairs.hpp: is there a stair to climb, or ground to follow a little below?
///
/// `Step` is a plain struct, and all of these are functions that take it; each is defined before it is called, so that
/// no file needs a later one. They are in headers, and one source includes them all: a function that is called from one
/// place is inlined. What nearly every step does is flattened (an eighth of its instructions), and what hardly any does
/// is kept out of it (3 %, and a fifth of the compile time).
#pragma once

#include "inlining.hpp"
#include "step/free_position.hpp"
#include "step/narrow_phase.hpp"
#include "step/octagon_sweep.hpp"
#include "step/one_way.hpp"
#include "step/response.hpp"
#include "step/step_memory.hpp"

#include <optional>

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// What a technique knows before the first step.
struct Settings {
  Real walkable_cosine;   ///< Least upward component of a normal that is walked on.
  Real walkable_tangent;  ///< Steepest walkable slope, as rise over run.
  Real snap;              ///< How far down ground is followed [m].
  Real step_height;       ///< How high a walker climbs [m].
  Real max_fall_speed;    ///< Ground that falls faster leaves its rider behind [m/s]; infinite: none does.
  int iterations;
};

/// What a sweep over all pieces found.
struct SweepResult {
  bool hit;
  Real stop;              ///< Fraction of the motion that is free.
  Real least_separation;  ///< Of all pieces that block, at the start of the motion [m]. Any value above `hit` where all
                          ///< of them are further away than that.
  Real least_kept;        ///< By a box direction over the whole motion, of all pieces [m].
  /// The pieces that stop it there. If there are more than fit, the others are reported too, and the next sweep meets
  /// them again.
  FixedVector<Stop, MoveResult::max_contacts> stops;

  void clear() {
    hit = false;
    stop = 1;
    least_separation = least_kept = std::numeric_limits<Real>::infinity();
    stops.clear();
  }
};

/// The displacement that is wanted, and the velocity behind it. Each response changes both alike.
struct DesiredMotion {
  Desired displacement;  ///< For the rest of the step [m].
  Desired velocity;      ///< [m/s]

  /// Without steering.
  [[nodiscard]] static DesiredMotion plain(const Vec2& displacement, const Vec2& velocity) {
    return {{displacement, displacement}, {velocity, velocity}};
  }
};

/// What a step knows about its ride and about movers that crush.
struct MoverState {
  Ride ride{};                            ///< What carries the character in this step, with its velocity in this step.
  MoverIndex carrier = no_mover;          ///< The mover of that; none for a conveyor that stands still.
  PieceIndex ridden = 0;                  ///< The piece of that.
  bool anchored = false;                  ///< The character has not moved relative to what carries it.
  bool waits = false;                     ///< See `wait`.
  std::uint8_t ignored = passes_through;  ///< Colliders with one of these roles do not block.
  std::size_t overlapping = 0;            ///< How many movers overlap the character since an earlier step.
  bool side_lost = false;                 ///< From which side of one of them the character came is not known.
  std::optional<Vec2> last_free{};        ///< The last free position before the step, if there was one.
  Real stopped = 0;                       ///< When surfaces last left no motion, as a fraction of the step.
  std::size_t corners_before_crush = 0;   ///< Of the path, when the first mover crushed; and
  StepStatus status_before_crush = StepStatus::moved;  ///< the status until then.
};

/// All that a step knows.
struct Step {
  // As an aggregate, all of it would be zero first: an eighth of a step.
  Step(const StepRequest& what, const Settings& by, const Nearby& around, const MoversInStep& among, StepMemory& kept,
       MoveResult& into)
      : request(what),
        space(kept.space),
        settings(by),
        near(around),
        movers(among),
        memory(kept),
        up(what.around.up),
        result(into) {
    memory.clear();
  }

  const StepRequest& request;
  const ConfigurationSpace& space;
  const Settings& settings;
  Nearby near;
  MoversInStep movers;
  StepMemory& memory;
  const UpFrame& up;
  MoveResult& result;

  Motion motion;              ///< Of the last sweep.
  SweepResult found;          ///< What the last sweep hit.
  Vec2 start{Vec2::Zero()};   ///< Where the step began, or the way out of a solid ended, before gaps were restored.
                              ///< Times of impact count from there.
  Vec2 wanted{Vec2::Zero()};  ///< Displacement in the step, that of the ground included, before anything was met [m].
  Vec2 position{Vec2::Zero()};
  Vec2 velocity{Vec2::Zero()};
  Real time = 0;           ///< Fraction of the step that is spent.
  Real latest_impact = 0;  ///< See `Reported`.
  Real fall = 0;     ///< Velocity upwards without steering, before the surfaces that are touched now were met [m/s].
  Real steered = 0;  ///< The part of the horizontal velocity that this step's steering added [m/s].
  Real leaves_ground_above = 0;  ///< A motion leaves ground that it goes away from faster than this [m/s].
  bool certify = false;          ///< Something is nearer than rounding: every motion needs an exact certificate.
  bool climbs = false;           ///< The step began on ground, with no more upward speed than climbing gives.
  bool after_walk = false;       ///< See `respond`.
  bool wedged = false;           ///< A fall ended between surfaces that are touched together.
  bool met_ground = false;       ///< Walkable ground was hit in this step,
  bool on_ground = false;        ///< and the character has not moved since, nor hit anything else.
  PieceIndex ground = 0;         ///< That ground, where `met_ground`; the surface that points up most, where `wedged`;
  std::size_t ground_axis = 0;   ///< and the axis of its normal.
  MoverState moving;
};

/// Whether a mover passes through the character. It then moves only to a free position.
[[nodiscard]] inline bool is_passed_through(const Step& step) {
  return step.moving.overlapping > 0 || !step.result.crushed.empty();
}

/// Displacement of a surface in the rest of the step [m].
[[nodiscard]] inline Vec2 remaining_of(const Step& step, const TouchedSurface& surface) {
  return step.movers.remaining(surface.mover, step.time);
}

/// Whether a surface moves into a character that stays where it is, by more than rounding.
[[nodiscard]] inline bool moves_in(const Step& step, const TouchedSurface& surface) {
  return dot(remaining_of(step, surface), surface.normal) > tolerances.certain;
}

/// Displacement of the mover of a collider in the step [m].
[[nodiscard]] inline Vec2 displacement_of(const Step& step, ColliderIndex collider) {
  return step.movers.displacement(step.movers.of(step.space.scenery(), collider));
}

[[nodiscard]] inline MoverIndex mover_of(const Step& step, PieceIndex piece) {
  return step.space.info(piece).source.mover;
}

[[nodiscard]] inline TouchedSurface surface_at(const Step& step, PieceIndex piece, std::size_t axis) {
  return {piece, mover_of(step, piece), axis, step.space.normal(piece, axis), step.space.offset(piece, axis)};
}

[[nodiscard]] inline ColliderIndex collider_of(const Step& step, PieceIndex piece) {
  return step.space.info(piece).source.collider;
}

/// Whether a mover crushed the character, or overlaps it since an earlier step: it is ignored for the rest of the step.
[[nodiscard]] inline bool ignored(const Step& step, PieceIndex piece) {
  return step.memory.is(collider_of(step, piece), step.moving.ignored);
}

/// Ground that falls faster than the character may.
[[nodiscard]] inline bool falls_away(const Step& step, const Vec2& ground) {
  return step.up.up_of(ground) < -step.settings.max_fall_speed;
}

/// What the turning of a circle adds to the speed of its surface [m/s].
[[nodiscard]] PAPERPROOF_COLD inline Real speed_of_rim(const Step& step, PieceIndex piece) {
  const double turn = step.movers.moving.motions[mover_of(step, piece)].turn();
  return static_cast<Real>(-turn / static_cast<double>(step.movers.dt) * step.space.circle(piece).radius);
}

[[nodiscard]] inline Real surface_speed(const Step& step, PieceIndex piece) {
  const Obstacle& obstacle = step.space.info(piece);
  Real speed = static_cast<Real>(obstacle.collider->surface_speed);
  if (obstacle.source.is_circle() && obstacle.source.mover != no_mover) [[unlikely]]
    speed += speed_of_rim(step, piece);
  return speed;
}

[[nodiscard]] inline bool carries(const Step& step, PieceIndex piece) {
  return mover_of(step, piece) != no_mover || surface_speed(step, piece) != 0;
}

[[nodiscard]] inline bool walkable(const Step& step, const Vec2& normal) {
  return step.up.up_of(normal) >= step.settings.walkable_cosine;
}

inline void halt(Step& step) { step.velocity = Vec2::Zero(); }

[[nodiscard]] inline Vec2 offset(const Step& step, PieceIndex piece, Real time) {
  return step.movers.offset(mover_of(step, piece), time);
}

/// Offset of the mover of a piece now, at fraction `time`; zero for a piece that stands still.
[[nodiscard]] inline Vec2 offset(const Step& step, PieceIndex piece) { return offset(step, piece, step.time); }

/// Whether a piece can stop a motion at all. In a step that drops no one-way segment does.
[[nodiscard]] inline bool in_way(const Step& step, const Motion& motion, PieceIndex piece) {
  return blocks(step.space, motion, piece) && !(step.request.drop && step.space.info(piece).is_one_way());
}

/// A position relative to the mover of a piece: the piece itself is stored at offset zero.
[[nodiscard]] inline Vec2 local(const Step& step, PieceIndex piece, const Vec2& p) {
  return mover_of(step, piece) == no_mover ? p : Vec2(p - offset(step, piece));
}

/// Stores for the last corner of the path how many contacts are reported, and the latest impact among them.
inline void note_reported(Step& step) {
  Reported& now = step.memory.reported_at[step.result.path.size() - 1];
  now.contacts = step.result.contacts.size();
  now.impact = step.latest_impact;
}

/// Stores for the last corner of the path how the motion goes on, where movers may take it back to there.
inline void note_velocity(Step& step, const Desired& velocity) {
  if (!step.movers.active) return;
  Reported& now = step.memory.reported_at[step.result.path.size() - 1];
  now.velocity = {velocity.wanted, step.steered != 0 ? velocity.unsteered : velocity.wanted};
  now.steered = step.steered;
}

PAPERPROOF_INLINE void push_corner(Step& step, Real fraction) {
  if (!step.result.path.empty() && step.result.path.back().fraction == fraction &&
      step.result.path.back().position == step.position)
    return;
  step.result.path.push_back({step.position, fraction});
  note_reported(step);
}

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
