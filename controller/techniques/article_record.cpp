#include "techniques/article_record.hpp"

namespace paperproof::article {

FrameRecord::FrameRecord(const Parts& parts, const MoveRequest& request, MoveResult& result) noexcept
    : parts_(parts), result_(result), frame_(*parts.scenery, request), least_(frame_.wanted()), most_(frame_.wanted()) {
  result_.clear();
  result_.velocity = frame_.velocity();
  result_.path.push_back({request.position, 0});
}

void FrameRecord::include(Eigen::Index component, double along) noexcept {
  least_[component] = std::min(least_[component], along);
  most_[component] = std::max(most_[component], along);
}

void FrameRecord::report(const CollisionPointHit& hit, const PieceGroup& group, Side side, double fraction) noexcept {
  if (!add_contact(*parts_.scenery, hit.on, side, fraction, result_)) return;
  touches_.push_back({hit.collision_point, group.mover, hit.on.point});
  if (group.mover != no_mover) result_.contacts.back().point += frame_.offset(group.mover, fraction);
}

void FrameRecord::stop(Side side, const PieceGroup& group, const PointHit& hit) noexcept {
  const Vec2d velocity = frame_.velocity(group.mover);
  if (shortens())
    result_.velocity = velocity;
  else
    result_.velocity[component_of(side)] = velocity[component_of(side)];
  if (group.mover != no_mover && !frame_.motion(group.mover).isZero(0)) add_pusher(hit);
  if (side != Side::bottom) return;
  result_.grounded = true;
  const ColliderIndex ground = collider_of(hit);
  result_.ride.ground = frame_.carries(ground) ? ground : Ride::none;
}

void FrameRecord::measure_gaps(const Vec2d& position) noexcept {
  for (std::size_t i = 0; i < result_.contacts.size(); ++i) {
    Contact& contact = result_.contacts[i];
    const Touch& touch = touches_[i];
    const Vec2d seen = position + frame_.shift_at_end(touch.mover);
    const Vec2d gap = seen + parts_.points.offsets[touch.collision_point] - touch.point;
    contact.separation = gap.dot(contact.normal);
  }
}

}  // namespace paperproof::article
