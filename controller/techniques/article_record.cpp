#include "techniques/article_record.hpp"

namespace paperproof::article {

template <class Scalar>
FrameRecord<Scalar>::FrameRecord(const Parts<Scalar>& parts, const MoveRequest<Scalar>& request,
                                 MoveResult<Scalar>& result) noexcept
    : parts_(parts), result_(result), frame_(*parts.scenery, request), least_(frame_.wanted()), most_(frame_.wanted()) {
  result_.clear();
  result_.velocity = frame_.velocity();
  result_.path.push_back({request.position, 0});
}

template <class Scalar>
void FrameRecord<Scalar>::include(Eigen::Index component, Scalar along) noexcept {
  least_[component] = std::min(least_[component], along);
  most_[component] = std::max(most_[component], along);
}

template <class Scalar>
void FrameRecord<Scalar>::report(const CollisionPointHit<Scalar>& hit, const PieceGroup<Scalar>& group, Side side,
                                 Scalar fraction) noexcept {
  if (!add_contact(*parts_.scenery, hit.on, side, fraction, result_)) return;
  touches_.push_back({hit.collision_point, group.mover, hit.on.point});
  if (group.mover != no_mover) result_.contacts.back().point += frame_.offset(group.mover, fraction);
}

template <class Scalar>
void FrameRecord<Scalar>::stop(Side side, const PieceGroup<Scalar>& group, const PointHit<Scalar>& hit) noexcept {
  const Vec2<Scalar> velocity = frame_.velocity(group.mover);
  if (shortens())
    result_.velocity = velocity;
  else
    result_.velocity[component_of(side)] = velocity[component_of(side)];
  if (group.mover != no_mover && !frame_.motion(group.mover).isZero(0)) add_pusher(hit);
  if (side != Side::bottom) return;
  result_.grounded = true;
  const ColliderIndex ground = collider_of(hit);
  result_.ride.ground = frame_.carries(ground) ? ground : Ride<Scalar>::none;
}

template <class Scalar>
void FrameRecord<Scalar>::measure_gaps(const Vec2<Scalar>& position) noexcept {
  for (std::size_t i = 0; i < result_.contacts.size(); ++i) {
    Contact<Scalar>& contact = result_.contacts[i];
    const Touch& touch = touches_[i];
    const Vec2<Scalar> seen = position + frame_.shift_at_end(touch.mover);
    const Vec2<Scalar> gap = seen + parts_.points.offsets[touch.collision_point] - touch.point;
    contact.separation = gap.dot(contact.normal);
  }
}

template class FrameRecord<float>;
template class FrameRecord<double>;

}  // namespace paperproof::article
