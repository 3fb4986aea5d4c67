/// StepSolver: the whole step, the way through scenery that stands still, and where it leaves the character.
#pragma once

#include "step/response.hpp"
#include "step/step_solver.hpp"

namespace paperproof::octagon_sweep {

/// Whether a way goes into a plane that it touches, rather than along it.
template <class Scalar>
[[nodiscard]] bool enters(const Vec2<Scalar>& way, const Vec2<Scalar>& normal) noexcept {
  const Scalar out = dot(way, normal);
  return out < 0 && out < -along_plane<Scalar> * length_of(way);
}

template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::solve(const MoveRequest<Scalar>& request) noexcept {
  position_ = request.position;
  velocity_ = request.velocity;
  start_ = position_;
  drops_ = request.drop;
  begin_drive(request);
  V wanted = request.displacement;
  if (request.stays) return keep_place(request);
  if (around_.active) wanted = begin_ride(request);
  memory_.contacts_at[0] = 0;
  result_.path.push_back({position_, 0});
  look_along(wanted);
  const bool near = found_.least_separation < Tolerances<Scalar>{}.hit;
  if (near && !prepare_start(request)) {
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
    if (around_.active) {
      travel_among_movers();
      take_back_crushes();
    } else {
      travel();
    }
    result_.grounded = stands();
    if (result_.grounded && !met_ground_ && !wedged_) report_ground(wanted);
    if (settings_.snap > 0) follow_ground_down(request);
    if (around_.active) end_ride();
  }
  end_wait();
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

/// The way itself: stop at what the sweep found, respond, and sweep again with what is left. What is left only shrinks.
template <std::size_t Lanes, class Scalar>
void StepSolver<Lanes, Scalar>::travel() noexcept {
  constexpr Tolerances<Scalar> tolerances{};
  FixedVector<V, 16> held;  // normals met since the last progress
  Drive<Scalar> drive = this->drive();
  Scalar fall = drive.velocity.unsteered.y();  // without steering, when the first of them was met
  V way = motion_.way;                         // with the aim back to the gap
  bool may_aim = true;
  for (int iteration = 0; iteration < settings_.iterations; ++iteration) {
    if (way.x() == 0 && way.y() == 0) return;
    if (iteration > 0) look_along(way);
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

    const Stop<Scalar> stop = found_.stops[0];
    const V normal = space_.normal(stop.piece, stop.axes.normal);
    const Scalar left = 1 - found_.stop;
    if (found_.stop * motion_.length > tolerances.touch) {
      held.clear();
      fall = steered_ != 0 ? drive.velocity.unsteered.y() : drive.velocity.wanted.y();
    }
    for (const V& other : held)
      if (dot(other, normal) > 1 - same_plane<Scalar>) return;  // the same plane again: no progress to be had
    held.push_back(normal);

    respond_to(normal, left, drive);
    // What follows ground does not enter it; a slide may, by what rounding leaves of a motion that ends.
    const std::size_t others = held.size() - (walkable(normal) ? 1 : 0);
    for (const V& other : std::span(held.begin(), others)) {
      if (!enters(drive.way.wanted, other) && !enters(drive.velocity.wanted, other)) continue;
      if (!slip({held.begin(), held.size()}, fall, drive)) return halt();
      break;
    }
    velocity_ = drive.velocity.wanted;
    way = may_aim ? aimed_back(drive.way.wanted, stop) : drive.way.wanted;
  }
  result_.status = MoveStatus::dropped;
}

template <std::size_t Lanes, class Scalar>
[[gnu::always_inline]] inline void StepSolver<Lanes, Scalar>::respond_to(const V& normal, Scalar left,
                                                                           Drive<Scalar>& drive) noexcept {
  const bool ground = walkable(normal);
  if (after_walk_ && !ground && drive.velocity.wanted.y() > 0) after_walk_ = touches_ground();
  const Surface<Scalar> at{normal, ground, after_walk_};
  const V way = drive.way.wanted * left;
  if (steered_ != 0) {
    drive.way = respond(Wish<Scalar>{way, drive.way.unsteered * left}, steered_ * dt_ * (1 - time_), at);
    drive.velocity = respond(drive.velocity, steered_, at);
  } else {
    drive.way.wanted = respond(way, at);
    drive.velocity.wanted = respond(drive.velocity.wanted, at);
  }
  after_walk_ = after_walk_ || at.walkable;
}

/// Between surfaces that hold the motion together: whether a fall slips through them. False: they are a wedge, or there
/// was no fall, or walkable ground ended it.
/// @param held the normals of all that are touched.
/// @param fall the vertical velocity without steering, before the first of them was met [m/s].
template <std::size_t Lanes, class Scalar>
bool StepSolver<Lanes, Scalar>::slip(std::span<const V> held, Scalar fall, Drive<Scalar>& drive) noexcept {
  if (!(fall < 0)) return false;
  FixedVector<HalfPlane<Scalar>, 16> planes;
  for (const V& normal : held) {
    if (walkable(normal)) return false;
    planes.push_back({normal});
  }
  V velocity = nearest_allowed<Scalar>(V(0, fall), {planes.begin(), planes.size()}).value_or(V::Zero());
  const Scalar left = dt_ * (1 - time_);
  if (!(velocity.y() < along_plane<Scalar> * fall)) {
    velocity = {0, fall};
    wedged_ = !falls_between(velocity * left);
    if (wedged_) return false;
  }
  drive = Drive<Scalar>::plain(velocity * left, velocity);
  return true;
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
