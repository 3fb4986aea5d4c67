#include "runs/technique_contestant.hpp"

#include "runs/technique_parts.hpp"

#include <paperproof/controller.hpp>

#include <algorithm>

namespace paperproof::compare {
namespace {

template <class Scalar>
class TechniqueContestant final : public Contestant {
 public:
  TechniqueContestant(TechniqueKind kind, const Scene& scene, const Scenery<double>& scenery, const Planning& planning)
      : scenery_(scenery),
        plan_(plan_of(scenery_.get(), scene.character, planning)),
        controller_(scenery_.get(), rules_for(kind, scene.character), definition_of(kind, scene, plan_)),
        scratch_(controller_.make_scratch()),
        gravity_(scene.gravity.cast<Scalar>()),
        motions_(scene.movers.size()),
        header_(header_of(kind, scenery_.get(), scene, plan_)) {
    place_at_start(*this, scene);
  }

  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }

  void step(const StepInput& input, std::span<TraceStep> records) override {
    TraceStep& record = records.front();
    const Ride<Scalar> ride = state_.ride;
    const Vec2d rode = motion_of(ride.ground);
    const Scalar last_dt = dt_;
    step_unrecorded(input);
    write_report(report_, state_, record);
    record.requested = report_.requested.template cast<double>() + carried_by(ride, rode, last_dt);
    record.movers.clear();
    for (const MoverMotion<Scalar>& motion : motions_)
      record.movers.push_back({motion.from.template cast<double>(), motion.to.template cast<double>()});
    refuse_unusable(report_.status);
  }

  void step_unrecorded(const StepInput& input) override {
    for (std::size_t i = 0; i < motions_.size(); ++i)
      motions_[i] = {input.movers[i].from.template cast<Scalar>(), input.movers[i].to.template cast<Scalar>()};
    dt_ = static_cast<Scalar>(input.dt);
    controller_.step(state_, input.players.front(), gravity_, dt_, motions_, scratch_, report_);
  }

  [[nodiscard]] Pose pose(std::size_t) const override { return pose_of(state_); }

  [[nodiscard]] std::size_t memory_bytes() const override { return controller_.technique().memory_bytes(); }

  void place(const Pose& pose, std::size_t) override { state_ = state_at<Scalar>(pose); }

 private:
  /// Of the mover that a collider goes along with, in the present step or, before it, in the last one [m].
  [[nodiscard]] Vec2d motion_of(ColliderIndex ground) const {
    if (ground == Ride<Scalar>::none) return Vec2d::Zero();
    const MoverIndex mover = header_.scenery.colliders[ground].mover;
    if (mover == no_mover) return Vec2d::Zero();
    return (motions_[mover].to - motions_[mover].from).template cast<double>();
  }

  /// What the ground adds to the displacement of this step [m]. A conveyor's part is what was left of the ride's
  /// velocity in the last step, `rode` in `last_dt` seconds apart.
  [[nodiscard]] Vec2d carried_by(const Ride<Scalar>& ride, const Vec2d& rode, Scalar last_dt) const {
    if (ride.ground == Ride<Scalar>::none) return Vec2d::Zero();
    Vec2d carried = motion_of(ride.ground);
    if (header_.scenery.colliders[ride.ground].surface_speed != 0)
      carried +=
          ride.velocity.template cast<double>() * static_cast<double>(dt_) - rode * static_cast<double>(dt_ / last_dt);
    return carried;
  }

  OwnScenery<Scalar> scenery_;
  Plan plan_;
  Controller<Scalar> controller_;
  Scratch<Scalar> scratch_;
  Vec2<Scalar> gravity_;
  Scalar dt_ = 0;                             ///< Of the present step.
  std::vector<MoverMotion<Scalar>> motions_;  ///< Of the present step.
  TraceHeader header_;
  CharacterState<Scalar> state_;
  StepReport<Scalar> report_;
};

}  // namespace

std::unique_ptr<Contestant> make_technique_contestant(TechniqueKind kind, ScalarKind scalar, const Scene& scene,
                                                      const Scenery<double>& scenery, const Planning& planning) {
  if (scalar == ScalarKind::binary32)
    return std::make_unique<TechniqueContestant<float>>(kind, scene, scenery, planning);
  return std::make_unique<TechniqueContestant<double>>(kind, scene, scenery, planning);
}

}  // namespace paperproof::compare
