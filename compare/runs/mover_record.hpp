/// How movers go, as a contender of a technique runs them.
#pragma once

#include "runs/contender.hpp"

#include <paperproof/character.hpp>
#include <paperproof/controller.hpp>
#include <paperproof/scenery.hpp>

#include <span>
#include <vector>

namespace paperproof::compare {

/// The motions of the present step, in the scalar that runs, and those of the step before.
template <class Scalar>
class MoverRecord {
 public:
  /// @param scenery must outlive the record.
  MoverRecord(std::size_t movers, const Scenery<Scalar>& scenery) : scenery_(&scenery), now_(movers), last_(movers) {}

  /// A step begins. @param movers one for each, in whatever scalar they are known. @param dt [s]
  template <class Motions>
  void take(const Motions& movers, double dt) {
    std::swap(now_, last_);
    last_dt_ = dt_;
    for (std::size_t i = 0; i < now_.size(); ++i)
      now_[i] = {movers[i].from.template cast<Scalar>(), movers[i].to.template cast<Scalar>()};
    dt_ = static_cast<Scalar>(dt);
  }
  [[nodiscard]] std::span<const MoverMotion<Scalar>> motions() const noexcept { return now_; }
  [[nodiscard]] Scalar dt() const noexcept { return dt_; }

  void write(TraceStep& record) const {
    record.movers.clear();
    for (const MoverMotion<Scalar>& motion : now_)
      record.movers.push_back({motion.from.template cast<double>(), motion.to.template cast<double>()});
  }

  /// What the ground adds to the displacement of a step that began with this ride [m]. A conveyor's part is what was
  /// left of the ride's velocity in the step before, without its mover's. A character that drops through it goes on as
  /// fast as it went.
  [[nodiscard]] Vec2d carried_by(const Ride<Scalar>& ride, bool drops) const {
    if (ride.ground == Ride<Scalar>::none) return Vec2d::Zero();
    if (drops && scenery_->collider(ride.ground).one_way)
      return ride.velocity.template cast<double>() * static_cast<double>(dt_);
    Vec2d carried = way_of(now_, ride.ground);
    if (scenery_->collider(ride.ground).surface_speed != 0)
      carried += ride.velocity.template cast<double>() * static_cast<double>(dt_) -
                 way_of(last_, ride.ground) * static_cast<double>(dt_ / last_dt_);
    return carried;
  }

 private:
  /// Of the mover that a collider goes along with [m].
  [[nodiscard]] Vec2d way_of(const std::vector<MoverMotion<Scalar>>& motions, ColliderIndex ground) const {
    const MoverIndex mover = scenery_->collider(ground).mover;
    if (mover == no_mover) return Vec2d::Zero();
    return (motions[mover].to - motions[mover].from).template cast<double>();
  }

  const Scenery<Scalar>* scenery_;
  std::vector<MoverMotion<Scalar>> now_;
  std::vector<MoverMotion<Scalar>> last_;
  Scalar dt_ = 0;       ///< Of the present step [s].
  Scalar last_dt_ = 0;  ///< Of the step before [s].
};

/// The surroundings of a step, as a technique takes them.
template <class Scalar>
[[nodiscard]] StepContext<Scalar> context_of(const StepInput& input, const MoverRecord<Scalar>& movers) {
  return {.gravity = input.gravity.cast<Scalar>(),
          .dt = movers.dt(),
          .movers = movers.motions(),
          .up = input.up.cast<Scalar>()};
}

}  // namespace paperproof::compare
