/// StepSolver: the whole step, its loop of sweep and response, and the ground at its end.
#pragma once

#include "step/response.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::solve(Part part, const StepRequest<Scalar>& request) noexcept {
  position_ = request.position;
  velocity_ = request.velocity;
  start_ = position_;
  drops_ = request.drop;
  begin_motion(request);
  if (request.filter != nullptr && movers_.phases.size() > 0) [[unlikely]]
    ignore_filtered(*request.filter);
  V wanted = request.displacement;
  if (part == Part::stay) return stay_in_place(request);
  if (movers_.active) wanted = begin_ride(request);
  wanted_ = wanted;
  const Scalar walk = up_.across_of(velocity_);
  memory_.reported_at[0] = {};
  result_.path.push_back({position_, 0});
  sweep_along(wanted);
  const bool near = found_.least_separation < Tolerances<Scalar>{}.hit;
  if (near) movers_.look_at_all();  // the way out of a solid may be longer than the step
  if (near && !prepare_start(part, request)) {
    result_.status = MoveStatus::stuck;
    halt();
    if (movers_.active) {
      note_colliders_left();
      wait(false);
      if (!result_.crushed.empty()) undo_crushes();
    }
  } else {
    if (movers_.active) {
      if (near) moving_.ride.place += position_ - request.position;  // the gap was restored
      if (moving_.overlapping > 0) {
        halt();
        wanted = V::Zero();
        steered_ = 0;
        moving_.anchored = false;
      }
    }
    if (near) sweep_along(wanted);
    if (request.grounded && !found_.hit) stop_at_touched_ground();
    travel();
    if (!result_.crushed.empty()) undo_crushes();
    find_ground();
    if (result_.grounded && !met_ground_ && !wedged_) land(wanted);
    if (settings_.step_height > 0) climb_stairs(request, wanted, walk);
    if (request.grounded && !result_.grounded) follow_ground_down(request);
    if (movers_.active) end_ride();
  }
  if (!memory_.marked.empty()) find_movers_that_still_overlap();
  if (result_.contacts.size() > 1) order_contacts();
  push_corner(1);
  result_.position = position_;
  result_.velocity = velocity_;
}

/// Stops a motion at ground that is touched now and at the end of the motion. Under tiny gravity a walk enters its
/// ground by less than the sweep sees. It would leave the ground, sink until the sweep hits it, and be put back, over
/// and over.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::stop_at_touched_ground() noexcept {
  const V from = position_;
  const Scalar begin = time_;
  position_ += motion_.displacement;
  time_ = 1;
  const bool ends_on_ground = touches_ground();
  position_ = from;
  time_ = begin;
  if (!ends_on_ground) return;
  for_each_near({position_, position_}, [this](PieceIndex piece) {
    const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, position_));
    if (!touched_ground(piece) || space_.covered(piece, best.axis)) return;
    V displacement = motion_.displacement;
    if (mover_of(piece) != no_mover) displacement = movers_.relative(displacement, mover_of(piece), time_);
    const LocalMotion motion = make_motion<Lanes>(space_, local(piece, position_), displacement);
    if (!enters(displacement, space_.normal(piece, best.axis)) || !in_way(motion, piece)) return;
    keep_stop({piece, 0, 0, {best.axis, best.axis, false, false}}, motion.length);
  });
  order_stops();
}

/// Of movers. What stands still is left out of the candidates.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::ignore_filtered(const ColliderFilter& filter) noexcept {
  const Scenery<Scalar>& scenery = space_.scenery();
  for (MoverIndex mover = 0; mover < movers_.phases.size(); ++mover) {
    const PieceRange pieces = scenery.pieces_of_mover(mover);
    for (PieceIndex piece = pieces.first; piece < pieces.end; ++piece)
      if (!filter(scenery, collider_of(piece))) memory_.mark(collider_of(piece), filtered);
  }
}

/// Reads this step's steering, its length, and whether it begins as a walk on the ground.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::begin_motion(const StepRequest<Scalar>& request) noexcept {
  steered_ = request.steered;
  dt_ = request.dt;
  leaves_ground_above_ = request.leaves_ground_above;
  // A rise that is steeper than any walkable ground is no climb.
  after_walk_ = climbs_ = request.grounded && up_.up_of(request.velocity) <= std::abs(up_.across_of(request.velocity)) *
                                                                                 settings_.walkable_tangent;
}

/// The desired motion, with and without this step's steering.
template <std::size_t Lanes, class Scalar, class Up>
DesiredMotion<Scalar> StepSolver<Lanes, Scalar, Up>::desired() const noexcept {
  if constexpr (!std::is_same_v<Up, Upright<Scalar>>) {
    const V steered = up_.in_world({steered_, 0});
    return {{motion_.displacement, motion_.displacement - steered * dt_}, {velocity_, velocity_ - steered}};
  }
  return {{motion_.displacement, {motion_.displacement.x() - steered_ * dt_, motion_.displacement.y()}},
          {velocity_, {velocity_.x() - steered_, velocity_.y()}}};
}

/// Advances to the earliest impact, responds to all touched surfaces, and sweeps again with what is left of the
/// displacement.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::travel() noexcept {
  const std::size_t most_corners = memory_.corners.capacity() - 3;
  const std::size_t most_sweeps = 4 * most_corners;  // several impacts may come at one moment
  DesiredMotion<Scalar> desired = this->desired();
  fall_ = up_.up_of(desired.velocity.unsteered);
  V displacement = motion_.displacement;  // of the next sweep: it may also restore the gap to a surface
  bool may_aim = true;
  int impacts = 0;
  for (std::size_t sweeps = 0; sweeps < most_sweeps && result_.path.size() < most_corners; ++sweeps) {
    if (movers_.active) {
      if (sweeps > 0 && goes_beside_circle(desired.displacement.wanted)) return;
    } else if (displacement.x() == 0 && displacement.y() == 0) {
      return;
    }
    if (sweeps > 0) sweep_along(displacement);
    if (found_.hit && found_.stop == 0 &&
        (displacement.x() != desired.displacement.wanted.x() || displacement.y() != desired.displacement.wanted.y())) {
      // The gap cannot be restored here: give that up for this step.
      displacement = desired.displacement.wanted;
      may_aim = false;
      continue;
    }
    const Scalar begin = time_;
    if (!advance(found_.hit ? found_.stop : Scalar(1))) return cut_short();
    if (!found_.hit) return;
    const Stop<Scalar> first = found_.stops[0];  // the response may sweep again
    report(begin);
    if (found_.stop * motion_.length > Tolerances<Scalar>{}.touch)
      fall_ = up_.up_of(steered_ != 0 ? desired.velocity.unsteered : desired.velocity.wanted);
    update_surfaces();
    const Scalar left = 1 - found_.stop;
    desired.displacement.wanted *= left;
    if (steered_ != 0) desired.displacement.unsteered *= left;
    if (++impacts == settings_.iterations) {
      if (result_.status == MoveStatus::moved) result_.status = MoveStatus::dropped;
      if (!movers_.active) return end_at_surfaces(desired);
      // The rest of the displacement is dropped. Movers still push the character.
      desired = DesiredMotion<Scalar>::plain(V::Zero(), V::Zero());
      steered_ = 0;
    }
    const DesiredMotion<Scalar> wanted = desired;
    const bool is_answered = !is_passed_through() && respond_to_surfaces(desired);
    if (!is_answered || (movers_.active && !limit_squeeze(wanted, desired))) {
      if (goes_to_free_position()) return;
      if (!note_crushers()) return wait(true);
      desired = DesiredMotion<Scalar>::plain(V::Zero(), V::Zero());
      steered_ = 0;
    }
    velocity_ = desired.velocity.wanted;
    displacement = may_aim ? with_gap_restored(desired.displacement.wanted, first) : desired.displacement.wanted;
  }
  last_resort(displacement);
}

/// Ends the step here. The velocity still becomes one that the touched surfaces allow: otherwise it would grow from
/// step to step.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::end_at_surfaces(DesiredMotion<Scalar>& desired) noexcept {
  if (respond_to_surfaces(desired))
    velocity_ = desired.velocity.wanted;
  else
    halt();
}

/// Whether the character can fall straight down between two rims that it touches: a shaft may be a little wider than
/// the character. If it is off the middle, it shifts sideways by at most the clearance of the narrowest opening that
/// counts.
/// @param aside unit vector, across the fall.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::shift_to_fall(const V& displacement, const V& aside) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const auto falls = [&] {
    sweep_along(displacement);
    return !found_.hit || found_.stop * motion_.length > tolerances.touch;
  };
  if (falls()) return true;
  if (certify_) return false;
  for (const Scalar by : {tolerances.hit, -tolerances.hit, 2 * tolerances.hit, -2 * tolerances.hit}) {
    const V here = position_;
    position_ += aside * by;
    if (exactly_clear(here, position_) && falls()) {
      push_corner(time_);
      return true;
    }
    position_ = here;
  }
  return false;
}

/// The same along one of the sides of the character, or of its box: where up is slanted a shaft of its width goes
/// aslant.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::fall_along_a_side(const V& displacement, const V& velocity,
                                                      DesiredMotion<Scalar>& desired) noexcept {
  for (std::size_t axis = 0; axis < Lanes; ++axis) {
    const V normal = space_.normal(memory_.surfaces[0].piece, axis);
    const V along{-normal.y(), normal.x()};
    if (!(up_.up_of(along) < 0)) continue;  // each direction belongs to two axes, or to none
    const V way = along * dot(displacement, along);
    if (!shift_to_fall(way, normal)) continue;
    desired = DesiredMotion<Scalar>::plain(way, along * dot(velocity, along));
    return true;
  }
  return false;
}

/// Ends the step here, as the exact certificate or the range forbids the motion. Reports each piece that blocks it.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::cut_short() noexcept {
  if (result_.status == MoveStatus::moved) result_.status = MoveStatus::dropped;
  const V target = motion_.from + motion_.displacement * found_.stop;
  const Scalar end = time_ + (1 - time_) * found_.stop;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (blocks_exactly(piece, target, end)) report_touched(piece);
  });
  halt();
  if (movers_.active) wait(true);
}

/// A slide along a surface that is nearer than `stop`, changed so that it ends at that gap.
template <std::size_t Lanes, class Scalar, class Up>
Vec2<Scalar> StepSolver<Lanes, Scalar, Up>::with_gap_restored(const V& displacement,
                                                              const Stop<Scalar>& at) const noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  if (displacement.x() == 0 && displacement.y() == 0) return displacement;
  const Scalar gap = space_.separation(at.piece, at.axes.normal, local(at.piece, position_));
  if (!(gap < tolerances.stop - tolerances.restore) || gap < 0) return displacement;
  return displacement + space_.normal(at.piece, at.axes.normal) * (tolerances.stop - gap);
}

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::halt() noexcept {
  velocity_ = V::Zero();
}

/// What the character stands on at the end of the step: walkable ground that it touches and that its motion does not
/// leave, or a wedge that ended its fall; or what it slides down.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::find_ground() noexcept {
  if (on_ground_ || wedged_ || (met_ground_ && stands_on(ground_))) {  // the usual case
    const V normal = space_.normal(ground_, ground_axis_);
    note_ground(walkable(normal) ? GroundState::walkable : GroundState::wedge, ground_, normal);
  } else if (!result_.contacts.empty() ||
             (leaves_ground_above_ > 0 && found_.least_kept <= Tolerances<Scalar>{}.touch)) {
    look_for_ground();  // in most steps in the air nothing is near
  }
}

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::look_for_ground() noexcept {
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (!result_.grounded && stands_on(piece)) note_ground(GroundState::walkable, piece, *touched_ground(piece));
  });
  const auto is_steep = [this](const V& normal) { return up_.up_of(normal) > 0 && !walkable(normal); };
  if (result_.grounded || std::none_of(result_.contacts.begin(), result_.contacts.end(),
                                       [&](const Contact<Scalar>& contact) { return is_steep(contact.normal); }))
    return;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, position_));
    const V normal = space_.normal(piece, best.axis);
    const bool touched = std::abs(best.separation) <= Tolerances<Scalar>{}.touch && !space_.covered(piece, best.axis);
    if (!touched || !is_steep(normal) || passes_one_way(piece) || !may_block(piece, position_)) return;
    const bool first = result_.ground.state == GroundState::air;
    if (first || up_.up_of(normal) > up_.up_of(result_.ground.normal)) note_ground(GroundState::steep, piece, normal);
  });
}

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::note_ground_velocity(PieceIndex piece) noexcept {
  result_.ground.velocity = ground_velocity(piece, result_.ground.normal);
}

template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::note_ground(GroundState state, PieceIndex piece, const V& normal) noexcept {
  result_.grounded = state != GroundState::steep;
  result_.ground.state = state;
  result_.ground.collider = collider_of(piece);
  result_.ground.normal = normal;
  result_.ground.velocity = V::Zero();
  if (movers_.active) [[unlikely]]
    note_ground_velocity(piece);
}

/// Lands on the ground that the character touches at the end of a step in which no sweep hit it, and reports it:
/// gravity presses onto it by less than the sweep sees, or a fall ends just there. Ground that the wanted motion leaves
/// is not reported: a character that jumps and hits a ceiling at once stands again, and its only contact is the
/// ceiling. Nor is a one-way surface that the step began beneath.
template <std::size_t Lanes, class Scalar, class Up>
void StepSolver<Lanes, Scalar, Up>::land(const V& wanted) noexcept {
  memory_.surfaces.clear();
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    const V before = start_ - offset(piece, 0);
    const bool was_above = space_.info(piece).one_way_axis == ObstacleInfo::not_one_way ||
                           is_above(space_, piece, before, lost_by(start_, offset(piece, 0)));
    if (!was_above || !stands_on(piece)) return;
    memory_.surfaces.push_back(surface_at(piece, best_axis<Lanes>(space_, piece, local(piece, position_)).axis));
    V displacement = wanted;
    if (mover_of(piece) != no_mover) displacement = movers_.relative(wanted, mover_of(piece), Scalar(0));
    if (enters(displacement, memory_.surfaces.back().normal)) report_touched(piece);
  });
  if (memory_.surfaces.empty()) return;
  DesiredMotion<Scalar> desired = this->desired();
  end_at_surfaces(desired);
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::stands_on(PieceIndex piece) const noexcept {
  const std::optional<V> normal = touched_ground(piece);
  return normal && !leaves(piece, *normal);
}

/// Whether the motion at the end of the step leaves ground that it touches: one more step of it would part them by more
/// than `touch`. Vertices that are rounded make seams of straight ground bend by 1e-12 or 1e-6: they are no crests. A
/// jump leaves at any speed. Round ground falls away below a walk, which does not leave it.
template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::leaves(PieceIndex piece, const V& normal) const noexcept {
  V ground = V::Zero();
  if (mover_of(piece) != no_mover) ground = movers_.displacement(mover_of(piece)) / movers_.dt;
  const Scalar leaving = dot(V(velocity_ - ground), normal);
  if (leaving <= leaves_ground_above_) return false;
  if (leaves_ground_above_ == 0) return leaving > along_plane<Scalar> * (length_of(velocity_) + length_of(ground));
  return !space_.is_circle(piece) || leaving > falls_away_from_tangent(piece, V(velocity_ - ground));
}

/// How fast round ground falls away below a motion that went along a tangent of it at most a step ago [m/s].
/// @param motion relative to it [m/s].
template <std::size_t Lanes, class Scalar, class Up>
Scalar StepSolver<Lanes, Scalar, Up>::falls_away_from_tangent(PieceIndex piece, V motion) const noexcept {
  const Scalar speed = length_of(motion);
  return speed * speed * dt_ / space_.scenery().circle(piece).radius;
}

template <std::size_t Lanes, class Scalar, class Up>
bool StepSolver<Lanes, Scalar, Up>::touches_ground() noexcept {
  return any_near({position_, position_}, [this](PieceIndex piece) { return touched_ground(piece).has_value(); });
}

template <std::size_t Lanes, class Scalar, class Up>
std::optional<Vec2<Scalar>> StepSolver<Lanes, Scalar, Up>::touched_ground(PieceIndex piece) const noexcept {
  if (passes_one_way(piece)) return std::nullopt;
  const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, position_));
  if (!(std::abs(best.separation) <= Tolerances<Scalar>{}.touch)) return std::nullopt;
  const V normal = space_.normal(piece, best.axis);
  return walkable(normal) && may_block(piece, position_) ? std::optional<V>(normal) : std::nullopt;
}

}  // namespace paperproof::octagon_sweep
