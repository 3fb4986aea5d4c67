/// Where the motion of one step is worked out: in the world, or together with the mover that carries the character.
#pragma once

#include <paperproof/scenery.hpp>
#include <paperproof/technique.hpp>

namespace paperproof {

/// Positions in this frame are the world's where nothing carries the character. On a mover they are relative to the
/// mover's offset: what stands on it does not move here at all, so no rounding can add up, however long it rides.
///
/// Every mover, and what stands still (`no_mover`), has a *shift*: what is added to a position of this frame to see it
/// from there, that is relative to the places where the pieces of that mover were defined. Shifts go linearly from the
/// start of the step to its end. Const; a view of the scenery and the request.
class FrameOfReference {
 public:
  /// @param request `movers` has one for each mover of the scenery.
  FrameOfReference(const Scenery& scenery, const MoveRequest& request) noexcept
      : scenery_(&scenery),
        movers_(request.movers),
        dt_(request.dt),
        drops_(request.drop),
        start_(request.position),
        wanted_(request.displacement),
        velocity_(request.velocity) {
    if (request.ride.ground != Ride::none) go_along(request);
  }

  /// Where the character is when the step begins [m].
  [[nodiscard]] const Vec2d& start() const noexcept { return start_; }
  /// The motion that is wanted in this frame [m], a conveyor under the character included.
  [[nodiscard]] const Vec2d& wanted() const noexcept { return wanted_; }
  /// The velocity behind it, in the world [m/s].
  [[nodiscard]] const Vec2d& velocity() const noexcept { return velocity_; }

  /// How a mover, or `no_mover`, goes during the step, in the world [m].
  [[nodiscard]] Vec2d motion(MoverIndex mover) const noexcept;
  /// The same in metres per second.
  [[nodiscard]] Vec2d velocity(MoverIndex mover) const noexcept;
  /// Of a collider, a conveyor's surface included [m/s].
  [[nodiscard]] Vec2d velocity_of(ColliderIndex ground) const noexcept;

  [[nodiscard]] Vec2d shift_at_start(MoverIndex mover) const noexcept {
    if (mover == mover_) return Vec2d::Zero();
    return motion_of(mover_).from - motion_of(mover).from;
  }
  [[nodiscard]] Vec2d shift_at_end(MoverIndex mover) const noexcept {
    if (mover == mover_) return Vec2d::Zero();
    return motion_of(mover_).to - motion_of(mover).to;
  }

  /// A position of this frame, at a fraction of the step, in the world. At the end it is exactly `to + place`.
  [[nodiscard]] Vec2d in_world(const Vec2d& position, double fraction) const noexcept;
  /// Where the pieces of a mover are at a fraction of the step, relative to where they were defined [m].
  [[nodiscard]] Vec2d offset(MoverIndex mover, double fraction) const noexcept;

  /// Fills in the result's position, and its ride where its `ride.ground` is set.
  /// @param position where the step ends, in this frame.
  void arrive(const Vec2d& position, MoveResult& result) const noexcept;

  /// How far a conveyor's surface goes during the step [m]: along x, whatever its slope.
  [[nodiscard]] Vec2d surface_motion(ColliderIndex ground) const noexcept;

  /// One-way chains hold nobody in this step.
  [[nodiscard]] bool drops() const noexcept { return drops_; }
  /// What stands on it is carried.
  [[nodiscard]] bool carries(ColliderIndex ground) const noexcept;
  [[nodiscard]] MoverIndex mover_of(ColliderIndex collider) const noexcept {
    return scenery_->collider(collider).mover;
  }
  /// The mover whose frame this is; `no_mover` for the world's.
  [[nodiscard]] MoverIndex mover() const noexcept { return mover_; }
  /// How a mover goes during the step; `no_mover` stays at zero.
  [[nodiscard]] MoverMotion motion_of(MoverIndex mover) const noexcept {
    return mover == no_mover ? MoverMotion{} : movers_[mover];
  }

 private:
  void go_along(const MoveRequest& request) noexcept;

  const Scenery* scenery_;
  std::span<const MoverMotion> movers_;
  double dt_;
  bool drops_;
  MoverIndex mover_ = no_mover;
  Vec2d start_;
  Vec2d wanted_;
  Vec2d velocity_;
};

/// The scenery has movers that block, or conveyors.
[[nodiscard]] bool something_carries(const Scenery& scenery) noexcept;

/// The highest speed of a conveyor's surface, to whichever side [m/s].
[[nodiscard]] double fastest_surface(const Scenery& scenery) noexcept;

}  // namespace paperproof
