#include "metrics/rest.hpp"

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

void Rest::add(const TraceStep& step) {
  if (!step.grounded || step.requested.x() != 0 || step.path.empty()) {
    now_ = {};
    return;
  }
  if (++now_.steps > settling_steps) measure(step.path.back().position, sides_of(step.contacts));
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
