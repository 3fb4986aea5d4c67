#include "techniques/frame_of_reference.hpp"

#include <paperproof/scenery.hpp>

#include <algorithm>
#include <cmath>

namespace paperproof {

/// Becomes the frame of what carries the character.
void FrameOfReference::go_along(const MoveRequest& request) noexcept {
  const ColliderIndex ground = request.ride.ground;
  if (ground >= scenery_->collider_count()) return;
  mover_ = mover_of(ground);
  wanted_ += surface_motion(ground);
  velocity_ += velocity_of(ground);
  if (mover_ == no_mover) return;
  const Vec2d& offset = movers_[mover_].from;
  // A character that was put somewhere else since then does not stand at its place.
  const bool in_place = offset + request.ride.place == request.position;
  start_ = in_place ? request.ride.place : Vec2d(request.position - offset);
}

Vec2d FrameOfReference::motion(MoverIndex mover) const noexcept {
  const MoverMotion motion = motion_of(mover);
  return motion.to - motion.from;
}

Vec2d FrameOfReference::velocity(MoverIndex mover) const noexcept {
  const Vec2d moved = motion(mover);
  if (moved.isZero(0)) return moved;  // whatever dt is
  return moved / dt_;
}

Vec2d FrameOfReference::velocity_of(ColliderIndex ground) const noexcept {
  const ColliderInfo& collider = scenery_->collider(ground);
  Vec2d result = velocity(collider.mover);
  result.x() += collider.surface_speed;
  return result;
}

Vec2d FrameOfReference::offset(MoverIndex mover, double fraction) const noexcept {
  return motion_of(mover).at(fraction);
}

Vec2d FrameOfReference::in_world(const Vec2d& position, double fraction) const noexcept {
  if (mover_ == no_mover) return position;
  return offset(mover_, fraction) + position;
}

Vec2d FrameOfReference::surface_motion(ColliderIndex ground) const noexcept {
  return {scenery_->collider(ground).surface_speed * dt_, 0};
}

void FrameOfReference::arrive(const Vec2d& position, MoveResult& result) const noexcept {
  result.position = in_world(position, 1);
  Ride& ride = result.ride;
  if (ride.ground == Ride::none) return;
  const MoverIndex mover = mover_of(ride.ground);
  ride.velocity = velocity_of(ride.ground);
  ride.place = result.position;
  if (mover == no_mover) return;
  ride.place = position + shift_at_end(mover);
  result.position = offset(mover, 1) + ride.place;
}

bool FrameOfReference::carries(ColliderIndex ground) const noexcept {
  const ColliderInfo& collider = scenery_->collider(ground);
  return collider.mover != no_mover || collider.surface_speed != 0;
}

bool something_carries(const Scenery& scenery) noexcept {
  return scenery.counts().moving_pieces > 0 || scenery.counts().conveyors > 0;
}

double fastest_surface(const Scenery& scenery) noexcept {
  double fastest = 0;
  for (ColliderIndex i = 0; i < scenery.collider_count(); ++i)
    if (!scenery.collider(i).sensor) fastest = std::max(fastest, std::abs(scenery.collider(i).surface_speed));
  return fastest;
}

}  // namespace paperproof
