#include "techniques/discrete/pairs.hpp"

#include <algorithm>
#include <span>

namespace paperproof::discrete {
namespace {

void add_if_overlapping(const Reach& movable, const Reach& fixed, PairList& pairs) {
  if (movable.box.overlaps(fixed.box)) pairs.add({movable.body, fixed.body});
}

void add_movable_if_overlapping(const Reach& one, const Reach& other, PairList& pairs) {
  if (one.box.overlaps(other.box)) pairs.add({std::min(one.body, other.body), std::max(one.body, other.body)});
}

void sort_along(Eigen::Index axis, std::vector<Reach>& reaches) {
  std::sort(reaches.begin(), reaches.end(), [axis](const Reach& a, const Reach& b) {
    const double a_begin = a.box.lower[axis];
    const double b_begin = b.box.lower[axis];
    return a_begin < b_begin || (a_begin == b_begin && a.body < b.body);
  });
}

void sort_along(Eigen::Index axis, Reaches& reaches) {
  sort_along(axis, reaches.movable);
  sort_along(axis, reaches.fixed);
}

/// Reaches, sorted along an axis, of which some are asked for by where they begin.
class Sorted {
 public:
  Sorted(Eigen::Index axis, std::span<const Reach> all) noexcept : axis_(axis), all_(all) {}

  /// The first that begins at this place or after it.
  [[nodiscard]] std::size_t first_at(double place) const noexcept {
    const auto before = [this, place](const Reach& each) { return each.box.lower[axis_] < place; };
    return index_of(std::partition_point(all_.begin(), all_.end(), before));
  }
  /// The first that begins after it.
  [[nodiscard]] std::size_t first_after(double place) const noexcept {
    const auto not_after = [this, place](const Reach& each) { return each.box.lower[axis_] <= place; };
    return index_of(std::partition_point(all_.begin(), all_.end(), not_after));
  }
  [[nodiscard]] std::span<const Reach> between(std::size_t begin, std::size_t end) const noexcept {
    return all_.subspan(begin, end - begin);
  }

 private:
  [[nodiscard]] std::size_t index_of(typename std::span<const Reach>::iterator place) const noexcept {
    return static_cast<std::size_t>(place - all_.begin());
  }

  Eigen::Index axis_;
  std::span<const Reach> all_;
};

/// Each with those that begin within it, so that every two that overlap along the axis come up once.
/// @param movables(one, others) all of them can be moved.
/// @param movable_first(one, others) one that can be moved, and others that cannot.
/// @param fixed_first(one, others) one that cannot be moved, and others that can.
template <class Movables, class MovableFirst, class FixedFirst>
void sweep_along(Eigen::Index axis, const Reaches& reaches, const Movables& movables, const MovableFirst& movable_first,
                 const FixedFirst& fixed_first) {
  const Sorted movable(axis, reaches.movable);
  const Sorted fixed(axis, reaches.fixed);
  for (std::size_t i = 0; i < reaches.movable.size(); ++i) {
    const Reach& one = reaches.movable[i];
    movables(one, movable.between(i + 1, movable.first_after(one.box.upper[axis])));
    movable_first(one, fixed.between(fixed.first_at(one.box.lower[axis]), fixed.first_after(one.box.upper[axis])));
  }
  for (const Reach& one : reaches.fixed)
    fixed_first(one,
                movable.between(movable.first_after(one.box.lower[axis]), movable.first_after(one.box.upper[axis])));
}

/// How many overlap along the axis.
std::size_t compared_along(Eigen::Index axis, const Reaches& reaches) {
  std::size_t compared = 0;
  const auto count = [&](const Reach&, std::span<const Reach> others) { compared += others.size(); };
  sweep_along(axis, reaches, count, count, count);
  return compared;
}

}  // namespace

void find_pairs_one_by_one(const Reaches& reaches, PairList& pairs) {
  for (std::size_t i = 0; i < reaches.movable.size(); ++i) {
    for (std::size_t j = i + 1; j < reaches.movable.size(); ++j)
      add_movable_if_overlapping(reaches.movable[i], reaches.movable[j], pairs);
    for (const Reach& fixed : reaches.fixed) add_if_overlapping(reaches.movable[i], fixed, pairs);
  }
}

void find_pairs_by_sweep(Reaches& reaches, PairList& pairs) {
  sort_along(0, reaches);
  const std::size_t along_x = compared_along(0, reaches);
  sort_along(1, reaches);
  Eigen::Index axis = 1;
  if (along_x <= compared_along(1, reaches)) {
    axis = 0;
    sort_along(axis, reaches);
  }
  using Others = std::span<const Reach>;
  sweep_along(
      axis, reaches,
      [&](const Reach& one, Others others) {
        for (const Reach& other : others) add_movable_if_overlapping(one, other, pairs);
      },
      [&](const Reach& movable, Others others) {
        for (const Reach& fixed : others) add_if_overlapping(movable, fixed, pairs);
      },
      [&](const Reach& fixed, Others others) {
        for (const Reach& movable : others) add_if_overlapping(movable, fixed, pairs);
      });
}

}  // namespace paperproof::discrete
