/// When the steps of a scene begin and how long they are.
#pragma once

#include "scenes/scene.hpp"

#include <cstdint>
#include <vector>

namespace paperproof::compare {

/// All from absolute times: rounding does not add up, and one step begins when the one before ends, bit for bit.
/// Immutable.
class StepTimes {
 public:
  /// All of the scene's `dt`, or of its `dt_list`, which begins anew when it is through.
  explicit StepTimes(const Scene& scene) : StepTimes(scene.dt, scene.dt_list) {}
  StepTimes(double dt, std::vector<double> dt_list);

  /// The steps have lengths of their own.
  [[nodiscard]] bool vary() const noexcept { return !lengths_.empty(); }
  /// Of one step [s].
  [[nodiscard]] double length(int step) const noexcept;
  /// When it begins, and when it ends [s], from the start of the scene.
  [[nodiscard]] double begin(int step) const noexcept { return begin_of(step); }
  [[nodiscard]] double end(int step) const noexcept { return begin_of(std::int64_t{step} + 1); }
  [[nodiscard]] double shortest() const noexcept;
  [[nodiscard]] double longest() const noexcept;

 private:
  [[nodiscard]] double begin_of(std::int64_t step) const noexcept;

  double dt_;
  std::vector<double> lengths_;
  std::vector<double> sums_;  ///< Of the first lengths, from none to all of them, each rounded as if it were alone.
};

}  // namespace paperproof::compare
