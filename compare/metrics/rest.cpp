#include "metrics/rest.hpp"

#include "metrics/jitter.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace paperproof::compare {
namespace {

constexpr int least_steps = 60;
constexpr std::size_t spectrum_steps = 512;

}  // namespace

void Rest::measure(const Vec2d& position, unsigned sides) {
  if (now_.measured == 0) {
    now_.origin = position;
    now_.range = {position, position};
  } else if (sides != now_.sides) {
    ++now_.toggles;
  }
  const Vec2d offset = position - now_.origin;
  ++now_.measured;
  now_.sides = sides;
  now_.range = now_.range.with(position);
  now_.sum += offset;
  now_.squares += offset.squaredNorm();
  now_.latest.push_back(offset);
  if (now_.latest.size() > spectrum_steps) now_.latest.pop_front();
}

Rest::Rest(const SceneryDef& scenery) {
  for (const ColliderDef& collider : scenery.colliders) mover_of_.push_back(collider.mover);
}

MoverIndex Rest::carrying(const TraceStep& step) const {
  const auto at_feet =
      std::ranges::find_if(step.contacts, [](const Contact& contact) { return contact.side == Side::bottom; });
  return at_feet == step.contacts.end() ? no_mover : mover_of_[at_feet->collider];
}

void Rest::end(MoverIndex ground) {
  if (now_.steps >= least_steps) last_ = std::move(now_);
  now_ = {};
  now_.ground = ground;
  gap_.clear();
  gap_lasts_ = 0;
}

void Rest::count(const Vec2d& position, unsigned sides) {
  if (++now_.steps > settling_steps) measure(position, sides);
}

void Rest::add(const TraceStep& step, double dt) {
  // In the air it is still relative to what it stood on.
  const MoverIndex ground = step.grounded ? carrying(step) : now_.ground;
  Vec2d carried = Vec2d::Zero();
  double wanted = step.requested.x();
  if (ground != no_mover) {
    carried = step.movers[ground].to;
    // A sum of velocities that are divided and multiplied by dt comes back rounded.
    constexpr double rounding = 1e-6;
    wanted -= carried.x() - step.movers[ground].from.x();
    if (std::abs(wanted) <= rounding) wanted = 0;
  }
  const bool may_rest = wanted == 0 && !step.path.empty();
  if (!may_rest || ground != now_.ground) end(ground);
  if (!may_rest || (!step.grounded && now_.steps == 0)) return;
  const Airborne here{step.path.back().position - carried, sides_of(step.contacts) | sides_of(step.met)};
  if (!step.grounded) {
    gap_.push_back(here);
    gap_lasts_ += dt;
    constexpr double rounding = 1e-9;
    if (gap_lasts_ > longest_gap + rounding) end(no_mover);
    return;
  }
  for (const Airborne& each : gap_) count(each.position, each.sides);
  gap_.clear();
  gap_lasts_ = 0;
  count(here.position, here.sides);
}

void Rest::write(Row& row) const {
  if (now_.steps < least_steps && !last_) return;
  const Phase& rest = now_.steps >= least_steps ? now_ : *last_;
  const double count = rest.measured;
  const Vec2d mean = rest.sum / count;
  row.rest_peak_to_peak_m = rest.range.size().maxCoeff();
  row.rest_rms_m = std::sqrt(std::max(0.0, rest.squares / count - mean.squaredNorm()));
  row.contact_toggles = 1000 * rest.toggles / count;
  row.rest_sign_changes = 0;
  for (const int axis : {0, 1}) {
    std::vector<double> along;
    for (const Vec2d& offset : rest.latest) along.push_back(offset[axis]);
    row.rest_sign_changes = std::max(*row.rest_sign_changes, sign_changes(along));
    if (const std::optional<double> share = upper_band_share(along))
      row.rest_upper_band = std::max(row.rest_upper_band.value_or(0), *share);
  }
}

}  // namespace paperproof::compare
