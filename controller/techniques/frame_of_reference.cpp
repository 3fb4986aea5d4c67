#include "techniques/frame_of_reference.hpp"

#include <paperproof/scenery_facts.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof {

/// Becomes the frame of what carries the character.
template <class Scalar>
void FrameOfReference<Scalar>::go_along(const MoveRequest<Scalar>& request) noexcept {
  const ColliderIndex ground = request.ride.ground;
  if (ground >= scenery_->collider_count()) return;
  mover_ = mover_of(ground);
  wanted_ += surface_motion(ground);
  velocity_ += velocity_of(ground);
  if (mover_ == no_mover) return;
  const Vec2<Scalar>& offset = movers_[mover_].from;
  // A character that was put somewhere else since then does not stand at its place.
  const bool in_place = offset + request.ride.place == request.position;
  start_ = in_place ? request.ride.place : Vec2<Scalar>(request.position - offset);
}

template <class Scalar>
Vec2<Scalar> FrameOfReference<Scalar>::motion(MoverIndex mover) const noexcept {
  const MoverMotion<Scalar> motion = motion_of(mover);
  return motion.to - motion.from;
}

template <class Scalar>
Vec2<Scalar> FrameOfReference<Scalar>::velocity(MoverIndex mover) const noexcept {
  const Vec2<Scalar> moved = motion(mover);
  if (moved.isZero(0)) return moved;  // whatever dt is
  return moved / dt_;
}

template <class Scalar>
Vec2<Scalar> FrameOfReference<Scalar>::velocity_of(ColliderIndex ground) const noexcept {
  const ColliderInfo& collider = scenery_->collider(ground);
  Vec2<Scalar> result = velocity(collider.mover);
  result.x() += static_cast<Scalar>(collider.surface_speed);
  return result;
}

template <class Scalar>
Vec2<Scalar> FrameOfReference<Scalar>::offset(MoverIndex mover, Scalar fraction) const noexcept {
  return motion_of(mover).at(fraction);
}

template <class Scalar>
Vec2<Scalar> FrameOfReference<Scalar>::in_world(const Vec2<Scalar>& position, Scalar fraction) const noexcept {
  if (mover_ == no_mover) return position;
  return offset(mover_, fraction) + position;
}

template <class Scalar>
Vec2<Scalar> FrameOfReference<Scalar>::surface_motion(ColliderIndex ground) const noexcept {
  return {static_cast<Scalar>(scenery_->collider(ground).surface_speed) * dt_, 0};
}

template <class Scalar>
void FrameOfReference<Scalar>::arrive(const Vec2<Scalar>& position, MoveResult<Scalar>& result) const noexcept {
  result.position = in_world(position, 1);
  Ride<Scalar>& ride = result.ride;
  if (ride.ground == Ride<Scalar>::none) return;
  const MoverIndex mover = mover_of(ride.ground);
  ride.velocity = velocity_of(ride.ground);
  ride.place = result.position;
  if (mover == no_mover) return;
  ride.place = position + shift_at_end(mover);
  result.position = offset(mover, 1) + ride.place;
}

template <class Scalar>
bool FrameOfReference<Scalar>::carries(ColliderIndex ground) const noexcept {
  const ColliderInfo& collider = scenery_->collider(ground);
  return collider.mover != no_mover || collider.surface_speed != 0;
}

template <class Scalar>
bool something_carries(const Scenery<Scalar>& scenery) noexcept {
  return has_moving_solids(scenery) || has_conveyors(scenery);
}

template <class Scalar>
Scalar fastest_surface(const Scenery<Scalar>& scenery) noexcept {
  Scalar fastest = 0;
  for (const ColliderInfo& collider : scenery.collider_kinds())
    if (!collider.sensor) fastest = std::max(fastest, std::abs(static_cast<Scalar>(collider.surface_speed)));
  return fastest;
}

template float fastest_surface(const Scenery<float>&) noexcept;
template double fastest_surface(const Scenery<double>&) noexcept;
template bool something_carries(const Scenery<float>&) noexcept;
template bool something_carries(const Scenery<double>&) noexcept;
template class FrameOfReference<float>;
template class FrameOfReference<double>;

}  // namespace paperproof
