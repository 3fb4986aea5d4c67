/// StepSolver: the way among movers.
///
/// Everything is swept in order of time of impact: a motion w over the rest of the step is, as a mover sees it that
/// goes by d in that time, the motion w - d. Every surface that is touched holds the character: with normal n it allows
/// what keeps n·w >= n·d. Where the response to one surface after the other does not satisfy all, the nearest allowed
/// motion is taken. Where there is none, room is looked for (step_room.hpp); without room the character stays, and what
/// moves into it is reported as a crush.
#pragma once

#include "step/half_planes.hpp"
#include "step/response.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

template <std::size_t Lanes, class Scalar>
template <Covered covered>
void StepSolver<Lanes, Scalar>::look_at_movers() noexcept {
  // The sweep looks this far beyond the end of a motion (twice: it goes by the larger component).
  constexpr Scalar look = 2 * Tolerances<Scalar>{}.look;
  for (MoverIndex mover = 0; mover < around_.near; ++mover) {
    const V offset = around_.offset(mover, time_);
    const V from = motion_.from - offset;
    const V way = around_.relative(motion_.way, mover, time_);
    const V to = from + way;
    const Box2<Scalar> box = space_.touched_from(Box2<Scalar>{from.cwiseMin(to), from.cwiseMax(to)}.inflated(look));
    if (!box.overlaps(around_.phases.whole(mover))) continue;
    LocalMotion seen = make_motion<Lanes>(space_, from, way);
    seen.rest = lost_by(motion_.from, offset);
    sweep<covered>(seen, around_.phases.query(mover, box, memory_.of_mover));
  }
}

/// What has crushed the character, or is on it since an earlier step, goes through it for the rest of the step.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::ignored(PieceIndex piece) const noexcept {
  return !memory_.marked.empty() && memory_.is(collider_of(piece), moving_.ignored);
}

/// Whether a motion keeps off a piece along the axis that holds it. The axis alone is then proof.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::kept_clear_by_hold(const LocalMotion& motion, PieceIndex piece) const noexcept {
  constexpr Scalar noise = std::numeric_limits<Scalar>::epsilon() * 32;
  for (const Hold<Scalar>& hold : memory_.holds) {
    if (hold.piece != piece) continue;
    if (moving_.looks_past_holds) return true;
    const Scalar start = space_.separation(piece, hold.axis, motion.from);
    const Scalar out = hold.normal.x() * motion.way.x() + hold.normal.y() * motion.way.y();
    Scalar size = std::abs(motion_.way.x()) + std::abs(motion_.way.y());
    if (hold.mover != no_mover) size += around_.course(hold.mover).cwiseAbs().sum();
    return start >= Tolerances<Scalar>{}.certain && (out >= -noise * size || start + out >= Tolerances<Scalar>{}.hit);
  }
  return false;
}

/// Forgets surfaces that are no longer touched, and adds those of the last sweep, as far as it kept them.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::update_holds() noexcept {
  constexpr Scalar touch = Tolerances<Scalar>{}.touch;
  const auto less_up = [](const Hold<Scalar>& a, const Hold<Scalar>& b) { return a.normal.y() < b.normal.y(); };
  auto& holds = memory_.holds;
  holds.swap(memory_.holds_before);
  holds.clear();
  for (const Stop<Scalar>& stop : found_.stops)
    holds.push_back({stop.piece, stop.axes.normal, space_.normal(stop.piece, stop.axes.normal), mover_of(stop.piece)});
  for (const Hold<Scalar>& hold : memory_.holds_before) {
    const bool again = std::any_of(found_.stops.begin(), found_.stops.end(),
                                   [&hold](const Stop<Scalar>& stop) { return stop.piece == hold.piece; });
    if (again || ignored(hold.piece)) continue;
    const V at = local(hold.piece, position_);
    const bool touched = best_axis<Lanes>(space_, hold.piece, at).separation <= touch &&
                         std::abs(space_.separation(hold.piece, hold.axis, at)) <= touch;
    if (touched || moving_.looks_past_holds) holds.push_back(hold);
  }
  if (holds.size() > 1) std::swap(holds[0], *std::max_element(holds.begin(), holds.end(), less_up));
}

/// How far the surface still goes in this step [m].
template <std::size_t Lanes, class Scalar>
Vec2<Scalar> StepSolver<Lanes, Scalar>::rest_of(const Hold<Scalar>& hold) const noexcept {
  if (hold.mover == no_mover) return V::Zero();
  return around_.rest(hold.mover, time_);
}

/// [m/s]
template <std::size_t Lanes, class Scalar>
Vec2<Scalar> StepSolver<Lanes, Scalar>::velocity_of(const Hold<Scalar>& hold) const noexcept {
  if (hold.mover == no_mover) return V::Zero();
  return around_.course(hold.mover) / around_.dt;
}

template <class Scalar>
[[nodiscard]] HalfPlane<Scalar> behind(const Vec2<Scalar>& normal, const Vec2<Scalar>& motion) noexcept {
  return {normal, normal.x() * motion.x() + normal.y() * motion.y()};
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::allowed(const Drive<Scalar>& drive, const Hold<Scalar>& hold) const noexcept {
  return behind(hold.normal, rest_of(hold)).allows(drive.way.wanted) &&
         behind(hold.normal, velocity_of(hold)).allows(drive.velocity.wanted);
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::allowed(const Drive<Scalar>& drive) const noexcept {
  return std::all_of(memory_.holds.begin(), memory_.holds.end(),
                     [&](const Hold<Scalar>& hold) { return allowed(drive, hold); });
}

/// The response to a surface, as it is seen from there: ground one stands on takes one along; from any other surface
/// only its motion along its normal is felt, and so from another character.
template <std::size_t Lanes, class Scalar>
Drive<Scalar> StepSolver<Lanes, Scalar>::response_to(const Hold<Scalar>& hold, const Drive<Scalar>& drive,
                                                     bool after_walk) const noexcept {
  const Surface<Scalar> at{hold.normal, walkable(hold.normal), after_walk};
  const auto response = [&](const Wish<Scalar>& wish, const V& surface, Scalar steered) -> Wish<Scalar> {
    V frame = surface;
    if (!at.walkable || !carries(hold.piece)) frame = hold.normal * behind(hold.normal, surface).least;
    const Wish<Scalar> relative{wish.wanted - frame, wish.unsteered - frame};
    if (dot(relative.wanted, hold.normal) >= 0) return wish;
    const Wish<Scalar> result = respond(relative, steered, at);
    return {result.wanted + frame, result.unsteered + frame};
  };
  return {response(drive.way, rest_of(hold), steered_ * dt_ * (1 - time_)),
          response(drive.velocity, velocity_of(hold), steered_)};
}

/// The first surface, and then another one that the answer would enter.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::respond_one_by_one(Drive<Scalar>& drive) const noexcept {
  const Drive<Scalar> wanted = drive;
  const Hold<Scalar>& first = memory_.holds[0];
  const Drive<Scalar> alone = response_to(first, wanted, after_walk_);
  drive = alone;
  if (allowed(drive)) return true;
  for (const Hold<Scalar>& hold : memory_.holds) {
    if (allowed(alone, hold)) continue;
    drive = response_to(hold, alone, after_walk_ || walkable(first.normal));
    if (allowed(drive)) return true;
    drive = response_to(first, response_to(hold, wanted, after_walk_), after_walk_ || walkable(hold.normal));
    if (allowed(drive)) return true;
  }
  drive = wanted;
  return false;
}

/// Surfaces of one body that leave no way between them: a fall may still slip through them; else the motion ends there,
/// relative to that body.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::respond_in_crease(Drive<Scalar>& drive) noexcept {
  const Hold<Scalar>& first = memory_.holds[0];
  const Drive<Scalar> alone = response_to(first, drive, after_walk_);
  for (const Hold<Scalar>& hold : memory_.holds)
    if (!allowed(alone, hold) && rest_of(hold) != rest_of(first)) return false;
  const V velocity = velocity_of(first);
  const Drive<Scalar> still = Drive<Scalar>::plain(rest_of(first), velocity);
  if (!allowed(still)) return false;
  const Scalar fall = fall_ - velocity.y();
  const bool on_ground = std::any_of(memory_.holds.begin(), memory_.holds.end(),
                                     [this](const Hold<Scalar>& hold) { return walkable(hold.normal); });
  drive = still;
  wedged_ = fall < 0;
  if (fall >= 0 || on_ground) return true;
  const V way{0, fall * dt_ * (1 - time_)};
  const std::optional<Drive<Scalar>> falling = nearest_allowed_to(still.way.wanted + way, velocity + V(0, fall));
  const auto slips = [&] {
    return falling->velocity.wanted.y() - velocity.y() < along_plane<Scalar> * (fall - length_of(velocity));
  };
  if (falling && slips())
    drive = *falling;
  else if (velocity == V::Zero() && falls_between(way))
    drive = Drive<Scalar>::plain(way, {0, fall});
  else
    return true;
  wedged_ = false;
  return true;
}

/// The nearest motion that all surfaces allow; with steering, and with what there is of horizontal momentum, only where
/// that does not hold a fall: between two steep surfaces it would become a climb.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::respond_together(Drive<Scalar>& drive) const noexcept {
  const Wish<Scalar> way = drive.way;
  const Wish<Scalar> velocity = drive.velocity;
  const auto wanted = nearest_allowed_to(way.wanted, velocity.wanted);
  if (!wanted) {
    drive.velocity.wanted = drive.velocity.unsteered = V::Zero();
    return false;
  }
  drive = *wanted;
  const auto falls_by = [&](const V& way_down, const V& velocity_down) {
    const auto falling = nearest_allowed_to(way_down, velocity_down);
    if (falling && falling->way.wanted.y() < drive.way.wanted.y()) drive = *falling;
  };
  falls_by(way.unsteered, velocity.unsteered);
  if (way.unsteered.y() < 0) falls_by({0, way.unsteered.y()}, {0, velocity.unsteered.y()});
  return true;
}

/// Nothing where the surfaces have no motion in common.
template <std::size_t Lanes, class Scalar>
std::optional<Drive<Scalar>> StepSolver<Lanes, Scalar>::nearest_allowed_to(const V& way,
                                                                           const V& velocity) const noexcept {
  std::vector<HalfPlane<Scalar>>& ways = memory_.ways;
  std::vector<HalfPlane<Scalar>>& velocities = memory_.velocities;
  ways.clear();
  velocities.clear();
  for (const Hold<Scalar>& hold : memory_.holds) {
    add_plane(behind(hold.normal, rest_of(hold)), ways);
    add_plane(behind(hold.normal, velocity_of(hold)), velocities);
  }
  const auto allowed_way = nearest_allowed<Scalar>(way, {ways.begin(), ways.end()});
  if (!allowed_way) return std::nullopt;
  const auto allowed_velocity = nearest_allowed<Scalar>(velocity, {velocities.begin(), velocities.end()});
  return Drive<Scalar>::plain(*allowed_way, allowed_velocity.value_or(V::Zero()));
}

/// To one surface that stands still.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::respond_to_surface(const V& normal, Drive<Scalar>& drive) const noexcept {
  const Surface<Scalar> at{normal, walkable(normal), after_walk_};
  if (steered_ != 0) {
    drive.way = respond(drive.way, steered_ * dt_ * (1 - time_), at);
    drive.velocity = respond(drive.velocity, steered_, at);
  } else {
    drive.way.wanted = respond(drive.way.wanted, at);
    drive.velocity.wanted = respond(drive.velocity.wanted, at);
  }
  // What follows ground does not enter it; a slide may, by what rounding leaves of a motion that ends.
  if (!at.walkable && (enters(drive.way.wanted, normal) || enters(drive.velocity.wanted, normal)))
    drive = Drive<Scalar>::plain(V::Zero(), V::Zero());
  return true;
}

/// To several surfaces, or to one that moves.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::respond_to_all(Drive<Scalar>& drive) noexcept {
  if (steered_ == 0) drive = Drive<Scalar>::plain(drive.way.wanted, drive.velocity.wanted);
  return respond_one_by_one(drive) || respond_in_crease(drive) || respond_together(drive);
}

/// False where the surfaces leave no motion.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::respond_to_holds(Drive<Scalar>& drive) noexcept {
  const Hold<Scalar>& first = memory_.holds[0];
  wedged_ = false;
  if (around_.active && drive.velocity.wanted.x() == 0 && takes_along(first)) {
    mount(first);
    drive = Drive<Scalar>::plain(ground_rest(first.piece, first.normal), moving_.ride.velocity);
    steered_ = 0;
  }
  const bool on_ground = walkable(first.normal);
  if (after_walk_ && !on_ground && drive.velocity.wanted.y() > 0) after_walk_ = touches_ground();
  const bool possible = memory_.holds.size() == 1 && first.mover == no_mover ? respond_to_surface(first.normal, drive)
                                                                             : respond_to_all(drive);
  after_walk_ = after_walk_ || on_ground;
  return possible;
}

/// The path has no more corners: the last one is at the end of the step. With what it was doing, with what holds it, or
/// wherever there is room.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::last_resort(const V& way) noexcept {
  if (result_.status == MoveStatus::moved) result_.status = MoveStatus::dropped;
  if (!around_.active) return;
  const auto goes = [this](const V& last) {
    look_along(last);
    return !found_.hit && advance(1);
  };
  if (goes(way)) return;
  if (!pinned()) {
    for (const Hold<Scalar>& hold : memory_.holds)
      if (goes(rest_of(hold))) return;
  }
  stay(true);
}

}  // namespace paperproof::octagon_sweep
