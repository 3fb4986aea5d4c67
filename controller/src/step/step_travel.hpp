/// StepSolver: the whole step, the way through scenery that stands still, and where it leaves the character.
#pragma once

#include "step/response.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::solve(Part part, const MoveRequest<Scalar>& request) noexcept {
  position_ = request.position;
  velocity_ = request.velocity;
  start_ = position_;
  drops_ = request.drop;
  begin_drive(request);
  V wanted = request.displacement;
  if (part == Part::stay) return keep_place(request);
  if (around_.active) wanted = begin_ride(request);
  memory_.contacts_at[0] = 0;
  result_.path.push_back({position_, 0});
  look_along(wanted);
  const bool near = found_.least_separation < Tolerances<Scalar>{}.hit;
  if (near) around_.look_at_movers();  // a way out may be longer than the step
  if (near && !prepare_start(part, request)) {
    result_.status = MoveStatus::stuck;
    halt();
    if (around_.active) {
      note_what_is_left();
      stay(false);
      take_back_crushes();
    }
  } else {
    if (around_.active) {
      if (near) moving_.ride.place += position_ - request.position;  // it rests where its gaps were restored
      if (moving_.on_it > 0) {
        halt();
        wanted = V::Zero();
        steered_ = 0;
        moving_.anchored = false;
      }
    }
    if (near) look_along(wanted);
    if (request.grounded && !found_.hit) keep_ground();
    travel();
    if (!result_.crushed.empty()) take_back_crushes();
    result_.grounded = stands();
    if (result_.grounded && !met_ground_ && !wedged_) report_ground(wanted);
    if (settings_.snap > 0) follow_ground_down(request);
    if (around_.active) end_ride();
  }
  if (!memory_.marked.empty()) end_wait();
  push_corner(1);
  result_.position = position_;
  result_.velocity = velocity_;
}

/// Ground that was touched and is still touched where the motion ends stops a motion into it, as it stops one that is
/// straight down. A walk goes into its ground by less than the sweep sees where gravity is tiny: it would leave the
/// ground, sink until it is met, and be put back, over and over.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::keep_ground() noexcept {
  const V from = position_;
  const Scalar begin = time_;
  position_ += motion_.way;
  time_ = 1;
  const bool ends_on_ground = touches_ground();
  position_ = from;
  time_ = begin;
  if (!ends_on_ground) return;
  for_each_near({position_, position_}, [this](PieceIndex piece) {
    const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, position_));
    if (!touched_ground(piece) || space_.covered(piece, best.axis)) return;
    V way = motion_.way;
    if (mover_of(piece) != no_mover) way = around_.relative(way, mover_of(piece), time_);
    const LocalMotion motion = make_motion<Lanes>(space_, local(piece, position_), way);
    if (!enters(way, space_.normal(piece, best.axis)) || !in_way(motion, piece)) return;
    keep({piece, 0, 0, {best.axis, best.axis, false, false}}, motion.length);
  });
  order_stops();
}

/// Notes this step's steering and length, and whether it begins as a walk on the ground.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::begin_drive(const MoveRequest<Scalar>& request) noexcept {
  steered_ = request.steered;
  dt_ = request.dt;
  // A rise that is steeper than any ground comes from elsewhere.
  after_walk_ = climbs_ =
      request.grounded && request.velocity.y() <= std::abs(request.velocity.x()) * settings_.walkable_tangent;
}

/// What the step wants, and what it would want without steering.
template <std::size_t Lanes, class Scalar>
Drive<Scalar> StepSolver<Lanes, Scalar>::drive() const noexcept {
  return {{motion_.way, {motion_.way.x() - steered_ * dt_, motion_.way.y()}},
          {velocity_, {velocity_.x() - steered_, velocity_.y()}}};
}

/// The way itself: stop at what the sweep found, respond to all surfaces that are touched, and sweep again with what is
/// left.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::travel() noexcept {
  const std::size_t most_corners = memory_.corners.capacity() - 3;
  const std::size_t most_sweeps = 4 * most_corners;  // impacts at one moment, and moments
  Drive<Scalar> drive = this->drive();
  fall_ = drive.velocity.unsteered.y();
  V way = motion_.way;  // with the aim back to the gap
  bool may_aim = true;
  int impacts = 0;
  for (std::size_t sweeps = 0; sweeps < most_sweeps && result_.path.size() < most_corners; ++sweeps) {
    if (!around_.active && way.x() == 0 && way.y() == 0) return;
    if (sweeps > 0) look_along(way);
    if (found_.hit && found_.stop == 0 && (way.x() != drive.way.wanted.x() || way.y() != drive.way.wanted.y())) {
      // There is no room to restore the gap: give that up for this step.
      way = drive.way.wanted;
      may_aim = false;
      continue;
    }
    const Scalar begin = time_;
    if (!advance(found_.hit ? found_.stop : Scalar(1))) return cut_short();
    if (!found_.hit) return;
    report(begin);
    if (found_.stop * motion_.length > Tolerances<Scalar>{}.touch)
      fall_ = steered_ != 0 ? drive.velocity.unsteered.y() : drive.velocity.wanted.y();
    update_holds();
    const Scalar left = 1 - found_.stop;
    drive.way.wanted *= left;
    if (steered_ != 0) drive.way.unsteered *= left;
    if (++impacts == settings_.iterations) {
      if (result_.status == MoveStatus::moved) result_.status = MoveStatus::dropped;
      if (!around_.active) return;
      // What it wants itself is dropped; what moves into it goes on moving.
      drive = Drive<Scalar>::plain(V::Zero(), V::Zero());
      steered_ = 0;
    }
    if (pinned() || !respond_to_holds(drive)) {
      if (gives_way()) return;
      if (!crush_what_presses()) return stay(true);
      drive = Drive<Scalar>::plain(V::Zero(), V::Zero());
      steered_ = 0;
    }
    velocity_ = drive.velocity.wanted;
    way = may_aim ? aimed_back(drive.way.wanted, found_.stops[0]) : drive.way.wanted;
  }
  last_resort(way);
}

/// Whether the character falls straight down between rims that it rests on: in a shaft that is a little wider than the
/// character its walls keep it clear. Where it is off the middle it shifts by as much as the narrowest opening leaves.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::falls_between(const V& way) noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  const auto falls = [&] {
    look_along(way);
    return !found_.hit || found_.stop * motion_.length > tolerances.touch;
  };
  if (falls()) return true;
  if (certify_) return false;
  for (const Scalar aside : {tolerances.hit, -tolerances.hit, 2 * tolerances.hit, -2 * tolerances.hit}) {
    const V here = position_;
    position_.x() += aside;
    if (clear_way(here, position_) && falls()) {
      push_corner(time_);
      return true;
    }
    position_ = here;
  }
  return false;
}

/// The exact certificate or the range forbids the motion: the step ends here, and names each piece that is touched and
/// in the way.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::cut_short() noexcept {
  if (result_.status == MoveStatus::moved) result_.status = MoveStatus::dropped;
  const V target = motion_.from + motion_.way * found_.stop;
  const Scalar end = time_ + (1 - time_) * found_.stop;
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (bars(piece, target, end)) report_touched(piece);
  });
  halt();
  if (around_.active) stay(true);
}

/// A slide along a plane that is nearer than it should be ends at the right gap.
template <std::size_t Lanes, class Scalar>
Vec2<Scalar> StepSolver<Lanes, Scalar>::aimed_back(const V& way, const Stop<Scalar>& at) const noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  if (way.x() == 0 && way.y() == 0) return way;
  const Scalar gap = space_.separation(at.piece, at.axes.normal, local(at.piece, position_));
  if (!(gap < tolerances.stop - tolerances.restore) || gap < 0) return way;
  return way + space_.normal(at.piece, at.axes.normal) * (tolerances.stop - gap);
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::halt() noexcept {
  velocity_ = V::Zero();
}

/// Standing: where the step ends something walkable is touched that the motion does not leave, or a fall ended in a
/// wedge. A step that nothing stopped is in the air: without gravity nothing holds a character to what it touches.
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::stands() noexcept {
  if (on_ground_ || wedged_) return true;
  if (met_ground_ && stands_on(ground_)) return true;  // mostly
  return !result_.contacts.empty() && stands_on_any();
}

/// The ground that the character stands on is among the contacts, also where gravity presses onto it by less than the
/// sweep sees. Ground that the motion of the step does not lead into is none of them: who jumps and bumps its head at
/// once stands again, and met nothing but the ceiling.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::report_ground(const V& wanted) noexcept {
  for_each_near({position_, position_}, [&](PieceIndex piece) {
    if (!stands_on(piece)) return;
    V way = wanted;
    if (mover_of(piece) != no_mover) way = around_.relative(wanted, mover_of(piece), Scalar(0));
    if (enters(way, *touched_ground(piece))) report_touched(piece);
  });
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::stands_on_any() noexcept {
  bool any = false;
  for_each_near({position_, position_}, [&](PieceIndex piece) { any = any || stands_on(piece); });
  return any;
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::stands_on(PieceIndex piece) const noexcept {
  const std::optional<V> normal = touched_ground(piece);
  if (!normal) return false;
  V ground = V::Zero();
  if (mover_of(piece) != no_mover) ground = around_.course(mover_of(piece)) / around_.dt;
  const Scalar leaving = dot(V(velocity_ - ground), *normal);
  return leaving <= 0 || leaving <= along_plane<Scalar> * (length_of(velocity_) + length_of(ground));
}

template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::touches_ground() noexcept {
  bool any = false;
  for_each_near({position_, position_}, [&](PieceIndex piece) { any = any || touched_ground(piece); });
  return any;
}

template <std::size_t Lanes, class Scalar>
std::optional<Vec2<Scalar>> StepSolver<Lanes, Scalar>::touched_ground(PieceIndex piece) const noexcept {
  if (dropped(piece)) return std::nullopt;
  const BestAxis<Scalar> best = best_axis<Lanes>(space_, piece, local(piece, position_));
  if (!(std::abs(best.separation) <= Tolerances<Scalar>{}.touch)) return std::nullopt;
  const V normal = space_.normal(piece, best.axis);
  return walkable(normal) && may_block(piece, position_) ? std::optional<V>(normal) : std::nullopt;
}

/// Where a walk left the ground, and there is ground not far below.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::follow_ground_down(const MoveRequest<Scalar>& request) noexcept {
  if (!request.grounded || result_.grounded) return;
  if (pinned()) return;  // it stays where it was crushed
  V travelled = position_ - request.position;
  const V left_ground = moving_.ride.velocity;  // of what was walked on
  travelled -= left_ground * request.dt;
  // What rises has left the ground on purpose, unless it only climbs: over a crest a walk goes on.
  if (velocity_.y() > left_ground.y() && !climbs_) return;
  const Scalar steepest = std::abs(travelled.x()) * settings_.walkable_tangent + Tolerances<Scalar>{}.touch;
  look_along({0, -std::min(settings_.snap, steepest)});
  if (!found_.hit) return;
  const PieceIndex piece = found_.stops[0].piece;
  const std::size_t axis = found_.stops[0].axes.normal;
  const V normal = space_.normal(piece, axis);
  if (!walkable(normal) || !advance(found_.stop)) return;
  result_.grounded = true;
  report_contact(piece, axis, time_, result_.contacts.size());
  const V ground = ground_velocity(piece, normal);
  velocity_ = follow(velocity_.x() - ground.x(), normal) + ground;
}

}  // namespace paperproof::octagon_sweep
