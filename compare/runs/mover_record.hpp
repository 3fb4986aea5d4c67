/// How movers go, as a contender of a technique runs them.
#pragma once

#include "runs/technique_parts.hpp"

#include <paperproof/character.hpp>
#include <paperproof/controller.hpp>
#include <paperproof/scenery.hpp>

#include <span>
#include <vector>

namespace paperproof::compare {

/// The motions of the present step, in the scalar that runs, and those of the step before.
class MoverRecord {
 public:
  /// @param scenery must outlive the record.
  MoverRecord(std::size_t movers, const Scenery& scenery, ScalarKind scalar = ScalarKind::binary64)
      : scenery_(&scenery), scalar_(scalar), now_(movers), last_(movers) {}

  /// A step begins. @param movers one for each. @param dt [s]
  void take(std::span<const MoverMotion> movers, double dt) {
    std::swap(now_, last_);
    last_dt_ = dt_;
    for (std::size_t i = 0; i < now_.size(); ++i)
      now_[i] = {as_run(movers[i].from, scalar_), as_run(movers[i].to, scalar_)};
    dt_ = as_run(dt, scalar_);
  }
  [[nodiscard]] std::span<const MoverMotion> motions() const noexcept { return now_; }
  [[nodiscard]] double dt() const noexcept { return dt_; }

  void write(TraceStep& record) const { record.movers.assign(now_.begin(), now_.end()); }

  /// What the ground adds to the displacement of a step that began with this ride [m]. A conveyor's part is what was
  /// left of the ride's velocity in the step before, without its mover's. A character that drops through it goes on as
  /// fast as it went.
  [[nodiscard]] Vec2d carried_by(const Ride& ride, bool drops) const {
    if (ride.ground == Ride::none) return Vec2d::Zero();
    if (drops && scenery_->collider(ride.ground).one_way) return ride.velocity * dt_;
    Vec2d carried = way_of(now_, ride.ground);
    if (scenery_->collider(ride.ground).surface_speed != 0)
      carried += ride.velocity * dt_ - way_of(last_, ride.ground) * (dt_ / last_dt_);
    return carried;
  }

 private:
  /// Of the mover that a collider goes along with [m].
  [[nodiscard]] Vec2d way_of(const std::vector<MoverMotion>& motions, ColliderIndex ground) const {
    const MoverIndex mover = scenery_->collider(ground).mover;
    if (mover == no_mover) return Vec2d::Zero();
    return motions[mover].to - motions[mover].from;
  }

  const Scenery* scenery_;
  ScalarKind scalar_;
  std::vector<MoverMotion> now_;
  std::vector<MoverMotion> last_;
  double dt_ = 0;       ///< Of the present step [s].
  double last_dt_ = 0;  ///< Of the step before [s].
};

/// The surroundings of a step, as a technique takes them.
[[nodiscard]] inline StepContext context_of(const StepInput& input, const MoverRecord& movers) {
  return {.gravity = input.gravity, .dt = movers.dt(), .movers = movers.motions(), .up = input.up};
}

}  // namespace paperproof::compare
