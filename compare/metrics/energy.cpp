#include "metrics/energy.hpp"

#include "oracle/exemptions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace paperproof::compare {
namespace {

/// A wanted motion that is faster than this many times the one without input is steered: float rounds by less.
constexpr double steered_from = 1 + 1e-6;
/// Roundings of v² between two steps, and of a place.
constexpr double roundings_of_speed = 8;
constexpr double roundings_of_place = 2;

bool stands_still(const ColliderDef& collider) { return collider.mover == no_mover && collider.surface_speed == 0; }

}  // namespace

Energy::Energy(const TraceHeader& header, const Vec2d& gravity)
    : gravity_(gravity),
      least_up_(std::cos((header.character.max_climb_degrees + 1e-3) * std::numbers::pi / 180)),
      reach_(own_reach(header)),
      characters_(header.characters) {
  const std::vector<ColliderDef>& colliders = header.scenery.colliders;
  applies_ = std::ranges::all_of(colliders, stands_still);
  epsilon_ = header.scalar == "float" ? static_cast<double>(std::numeric_limits<float>::epsilon())
                                      : std::numeric_limits<double>::epsilon();
}

bool Energy::is_pushed(const Character& who, const TraceStep& step, double dt) const {
  if (!who.known || step.respawn || (!who.free && !step.start_overlap.empty())) return true;
  const Vec2d unsteered = who.velocity + gravity_ * dt;
  const Vec2d wanted = step.requested / dt;
  // A jump in the step after a landing that no contact slowed turns a fall into a rise of the same speed.
  const double rounding = (steered_from - 1) * gravity_.norm() * wanted.norm();
  const bool jumps = gravity_.dot(wanted) < 0 && gravity_.dot(wanted - unsteered) < -rounding;
  return jumps || wanted.squaredNorm() > steered_from * unsteered.squaredNorm();
}

bool Energy::is_on_foot(const Character& who, const TraceStep& step) const {
  return who.grounded || step.grounded ||
         std::ranges::any_of(step.contacts, [this](const Contact& contact) { return contact.normal.y() >= least_up_; });
}

void Energy::add(const TraceStep& step, double dt) {
  if (!applies_) return;
  Character& who = characters_[step.character];
  const Vec2d& from = step.path.front().position;
  const Vec2d& to = step.path.back().position;
  now_.put_in = now_.put_in || is_pushed(who, step, dt);
  const double after = step.velocity.squaredNorm() / 2 - gravity_.dot(to);
  const double forward = (step.velocity.x() * step.velocity.x() - who.velocity.x() * who.velocity.x()) / 2;
  const bool walks = is_on_foot(who, step) && to.x() != from.x();
  now_.gain += walks ? std::min(after - who.energy, forward) : after - who.energy;
  now_.energy += after;
  now_.walks = now_.walks || walks;
  fastest_ = std::max(fastest_, step.velocity.squaredNorm());
  outermost_ = std::max({outermost_, from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff()});
  who = {.known = true,
         .free = who.free || step.start_overlap.empty(),
         .grounded = step.grounded,
         .velocity = step.velocity,
         .energy = after};
  if (step.character + 1 < characters_.size()) return;
  conclude(now_);
  now_ = {};
}

void Energy::conclude(const Sum& sum) {
  if (sum.put_in || !any_ || sum.walks) {
    if (!sum.put_in && any_) gained_ = std::max(gained_, sum.gain);
    any_ = true;
    least_ = sum.energy;
    return;
  }
  gained_ = std::max(gained_, sum.energy - least_);
  least_ = std::min(least_, sum.energy);
}

void Energy::write(Row& row) const {
  if (!any_) return;
  row.energy_gained_j_kg = gained_;
  row.energy_bound_j_kg = gravity_.norm() * (reach_ + roundings_of_place * epsilon_ * outermost_) +
                          roundings_of_speed * epsilon_ * fastest_;
}

}  // namespace paperproof::compare
