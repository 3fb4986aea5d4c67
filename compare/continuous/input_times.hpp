/// What the character wants, by time instead of by step.
#pragma once

#include "scenes/scene.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace paperproof::compare::continuous {

/// An event of step k takes effect when that step begins. The events must outlive this.
class InputTimes {
 public:
  InputTimes(const Scene& scene, const std::vector<InputEvent>& events) : events_(events) {
    for (const InputEvent& event : events) times_.push_back(begin_of(scene, event.step));
    end_ = begin_of(scene, scene.steps);
  }

  /// Of the last step [s].
  [[nodiscard]] const Real& end() const { return end_; }
  /// The next event after a time, or the end.
  [[nodiscard]] Real next_after(const Real& time) const {
    const auto next = std::ranges::upper_bound(times_, time);
    return next == times_.end() ? end_ : std::min(*next, end_);
  }

  /// Of the events of one step the last word holds.
  void take_until(const Real& time) {
    bool down = down_;
    for (; taken_ < events_.size() && times_[taken_] <= time; ++taken_) {
      const InputEvent& event = events_[taken_];
      if (event.move) move_ = std::clamp(*event.move, -1.0, 1.0);
      down = event.jump.value_or(down);
    }
    pending_ = down && (pending_ || !down_);
    down_ = down;
  }

  [[nodiscard]] const std::optional<Real>& move() const { return move_; }
  /// Takes a waiting jump: true once for each press.
  [[nodiscard]] bool jump() { return std::exchange(pending_, false); }

 private:
  static Real begin_of(const Scene& scene, int step) {
    if (scene.dt_list.empty()) return Real(scene.dt) * step;
    Real sum = 0;
    for (int k = 0; k < step; ++k) sum += Real(scene.dt_list[static_cast<std::size_t>(k) % scene.dt_list.size()]);
    return sum;
  }

  const std::vector<InputEvent>& events_;
  std::vector<Real> times_;
  Real end_{0};
  std::size_t taken_ = 0;
  std::optional<Real> move_;
  bool pending_ = false;
  bool down_ = false;
};

}  // namespace paperproof::compare::continuous
