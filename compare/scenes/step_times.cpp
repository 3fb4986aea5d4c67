#include "scenes/step_times.hpp"

#include <algorithm>

namespace paperproof::compare {

/// What rounding takes from a sum is kept apart and added to each (A. Neumaier, 1974).
StepTimes::StepTimes(double dt, std::vector<double> dt_list) : dt_(dt), lengths_(std::move(dt_list)), sums_{0} {
  double sum = 0;
  double lost = 0;
  for (const double length : lengths_) {
    const double next = sum + length;
    lost += sum >= length ? (sum - next) + length : (length - next) + sum;
    sum = next;
    sums_.push_back(sum + lost);
  }
}

double StepTimes::length(int step) const noexcept {
  return vary() ? lengths_[static_cast<std::size_t>(step) % lengths_.size()] : dt_;
}

double StepTimes::begin_of(std::int64_t step) const noexcept {
  if (!vary()) return static_cast<double>(step) * dt_;
  const auto count = static_cast<std::int64_t>(lengths_.size());
  return static_cast<double>(step / count) * sums_.back() + sums_[static_cast<std::size_t>(step % count)];
}

double StepTimes::shortest() const noexcept {
  return vary() ? *std::min_element(lengths_.begin(), lengths_.end()) : dt_;
}

double StepTimes::longest() const noexcept {
  return vary() ? *std::max_element(lengths_.begin(), lengths_.end()) : dt_;
}

}  // namespace paperproof::compare
