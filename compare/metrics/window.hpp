/// A look one step back and one step ahead, for matching within one step.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

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
    if (moments_.size() == 3) moments_.erase(moments_.begin());
    moments_.push_back(std::move(next));
    if (moments_.size() > 1) visit(View{moments_, moments_.size() - 2});
  }

  /// The last moment, which never gets a successor.
  template <class Visit>
  void last(Visit&& visit) const {
    if (moments_.empty()) return;
    const std::size_t last = std::min<std::size_t>(moments_.size(), 2);
    visit(View{std::span(moments_).last(last), last - 1});
  }

 private:
  std::vector<Moment> moments_;
};

}  // namespace paperproof::compare::detail
