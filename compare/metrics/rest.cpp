#include "metrics/rest.hpp"

#include <algorithm>
#include <cmath>

namespace paperproof::compare {
namespace {

constexpr int settling_steps = 30;
constexpr int least_steps = 60;

}  // namespace

void Rest::measure(const Vec2d& position, std::uint8_t sides) {
  if (now_.measured == 0) {
    now_.origin = position;
    now_.range = {position, position};
  } else if (sides != now_.sides) {
    ++now_.toggles;
  }
  const Vec2d offset = position - now_.origin;
  ++now_.measured;
  now_.sides = sides;
  now_.range = now_.range.merged({position, position});
  now_.sum += offset;
  now_.squares += offset.squaredNorm();
}

Rest::Rest(const SceneryDef& scenery) {
  for (const ColliderDef& collider : scenery.colliders) mover_of_.push_back(collider.mover);
}

MoverIndex Rest::carrying(const TraceStep& step) const {
  const auto at_feet = std::find_if(step.contacts.begin(), step.contacts.end(),
                                    [](const Contact<double>& contact) { return contact.side == Side::bottom; });
  return at_feet == step.contacts.end() ? no_mover : mover_of_[at_feet->collider];
}

void Rest::add(const TraceStep& step) {
  const MoverIndex ground = carrying(step);
  Vec2d carried = Vec2d::Zero();
  double wanted = step.requested.x();
  if (ground != no_mover) {
    carried = step.movers[ground].to;
    // A sum of velocities that are divided and multiplied by dt comes back rounded.
    constexpr double rounding = 1e-6;
    wanted -= carried.x() - step.movers[ground].from.x();
    if (std::abs(wanted) <= rounding) wanted = 0;
  }
  if (!step.grounded || wanted != 0 || step.path.empty()) {
    now_ = {};
    return;
  }
  if (ground != now_.ground) {
    now_ = {};
    now_.ground = ground;
  }
  if (++now_.steps > settling_steps)
    measure(step.path.back().position - carried,
            static_cast<std::uint8_t>(sides_of(step.contacts) | sides_of(step.met)));
  if (now_.steps >= least_steps) last_ = now_;
}

void Rest::write(Row& row) const {
  if (!last_) return;
  const double count = last_->measured;
  const Vec2d mean = last_->sum / count;
  row.rest_peak_to_peak_m = (last_->range.upper - last_->range.lower).maxCoeff();
  row.rest_rms_m = std::sqrt(std::max(0.0, last_->squares / count - mean.squaredNorm()));
  row.contact_toggles = 1000 * last_->toggles / count;
}

}  // namespace paperproof::compare
