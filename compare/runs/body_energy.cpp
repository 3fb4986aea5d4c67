#include "runs/body_energy.hpp"

#include "oracle/exemptions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::compare {
namespace {

constexpr double turnover_share = 0.01;  ///< Of what is turned over.
constexpr double roundings = 2;          ///< Of a place, in ulp.
constexpr double epsilon = std::numeric_limits<float>::epsilon();

}  // namespace

BodyEnergy::BodyEnergy(const Scene& scene) : scene_(scene) {
  const std::vector<MoverDef>& movers = scene.movers;
  applies_ =
      !movers.empty() && std::ranges::all_of(movers, [](const MoverDef& mover) { return mover.body.has_value(); });
  if (!applies_) return;
  for (MoverIndex i = 0; i < movers.size(); ++i) {
    const bool held =
        std::ranges::any_of(scene.joints, [i](const Joint& joint) { return joint.body == i || joint.other == i; });
    if (!held) loose_mass_ += movers[i].body->mass;
  }
}

double BodyEnergy::in_springs(const TraceStep& step) {
  double energy = 0;
  double rounding = 0;
  for (const Joint& joint : scene_.joints) {
    if (joint.stiffness == 0) continue;
    const Vec2d point = joint.point + step.movers[joint.body].to;
    const Vec2d end = joint.other == no_mover ? joint.end : Vec2d(joint.end + step.movers[joint.other].to);
    const double stretched = (point - end).norm() - joint.length;
    energy += joint.stiffness * stretched * stretched / 2;
    const double ulp = roundings * epsilon * joint.length;
    rounding += joint.stiffness * (std::abs(stretched) + ulp) * ulp;
  }
  rounding_ = std::max(rounding_, rounding);
  return energy;
}

void BodyEnergy::add(const TraceStep& step) {
  if (!applies_) return;
  const double dt = step.dt.value_or(scene_.dt);
  double turned_over = in_springs(step);
  double height = 0;
  for (MoverIndex i = 0; i < step.movers.size(); ++i) {
    const MoverMotion& motion = step.movers[i];
    const double mass = scene_.movers[i].body->mass;
    const Vec2d velocity = (motion.to - motion.from) / dt;
    const double ulp = roundings * epsilon * motion.to.cwiseAbs().maxCoeff();
    turned_over += mass * velocity.squaredNorm() / 2;
    height -= mass * scene_.gravity.dot(motion.to);
    rounding_ = std::max(rounding_, mass * (velocity.norm() * ulp / dt + scene_.gravity.norm() * ulp));
  }
  const double energy = turned_over + height;
  if (any_) gained_ = std::max(gained_, energy - least_);
  least_ = any_ ? std::min(least_, energy) : energy;
  any_ = true;
  most_turned_over_ = std::max(most_turned_over_, turned_over);
}

void BodyEnergy::write(Row& row) const {
  if (!any_) return;
  row.body_energy_gained_j = gained_;
  row.body_energy_bound_j =
      turnover_share * most_turned_over_ + loose_mass_ * scene_.gravity.norm() * box2d_skin + rounding_;
}

}  // namespace paperproof::compare
