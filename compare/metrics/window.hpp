/// A look one step back and one step ahead, for matching within one step.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>

namespace paperproof::compare::detail {

/// Keeps the last three moments of a run; memory does not grow with its length.
template <class Moment>
class Window {
 public:
  /// Where a moment lies among its neighbours: `around[centre]` with up to one on either side.
  struct View {
    std::span<const Moment> around;
    std::size_t centre = 0;
    [[nodiscard]] const Moment& now() const { return around[centre]; }
  };

  /// Takes the next moment; `visit` is called with the one before it, which now has both its neighbours.
  template <class Visit>
  void add(Moment next, Visit&& visit) {
    if (size_ == 3) {
      std::rotate(moments_.begin(), moments_.begin() + 1, moments_.end());
      --size_;
    }
    moments_[size_++] = std::move(next);
    if (size_ > 1) visit(View{std::span(moments_.data(), size_), size_ - 2});
  }

  /// The last moment, which never gets a successor.
  template <class Visit>
  void last(Visit&& visit) const {
    if (size_ == 0) return;
    const std::size_t first = size_ == 3 ? 1 : 0;
    visit(View{std::span(moments_.data() + first, size_ - first), size_ - 1 - first});
  }

 private:
  std::array<Moment, 3> moments_{};
  std::size_t size_ = 0;
};

}  // namespace paperproof::compare::detail
