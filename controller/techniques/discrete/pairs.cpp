#include "techniques/discrete/pairs.hpp"

#include <algorithm>
#include <span>

namespace paperproof::discrete {
namespace {

template <class Scalar>
void add_if_overlapping(const Reach<Scalar>& movable, const Reach<Scalar>& fixed, PairList& pairs) {
  if (movable.box.overlaps(fixed.box)) pairs.add({movable.body, fixed.body});
}

template <class Scalar>
void add_movable_if_overlapping(const Reach<Scalar>& one, const Reach<Scalar>& other, PairList& pairs) {
  if (one.box.overlaps(other.box)) pairs.add({std::min(one.body, other.body), std::max(one.body, other.body)});
}

template <class Scalar>
void sort_along(Eigen::Index axis, std::vector<Reach<Scalar>>& reaches) {
  std::sort(reaches.begin(), reaches.end(), [axis](const Reach<Scalar>& a, const Reach<Scalar>& b) {
    const Scalar a_begin = a.box.lower[axis];
    const Scalar b_begin = b.box.lower[axis];
    return a_begin < b_begin || (a_begin == b_begin && a.body < b.body);
  });
}

template <class Scalar>
void sort_along(Eigen::Index axis, Reaches<Scalar>& reaches) {
  sort_along(axis, reaches.movable);
  sort_along(axis, reaches.fixed);
}

/// Reaches, sorted along an axis, of which some are asked for by where they begin.
template <class Scalar>
class Sorted {
 public:
  Sorted(Eigen::Index axis, std::span<const Reach<Scalar>> all) noexcept : axis_(axis), all_(all) {}

  /// The first that begins at this place or after it.
  [[nodiscard]] std::size_t first_at(Scalar place) const noexcept {
    const auto before = [this, place](const Reach<Scalar>& each) { return each.box.lower[axis_] < place; };
    return index_of(std::partition_point(all_.begin(), all_.end(), before));
  }
  /// The first that begins after it.
  [[nodiscard]] std::size_t first_after(Scalar place) const noexcept {
    const auto not_after = [this, place](const Reach<Scalar>& each) { return each.box.lower[axis_] <= place; };
    return index_of(std::partition_point(all_.begin(), all_.end(), not_after));
  }
  [[nodiscard]] std::span<const Reach<Scalar>> between(std::size_t begin, std::size_t end) const noexcept {
    return all_.subspan(begin, end - begin);
  }

 private:
  [[nodiscard]] std::size_t index_of(typename std::span<const Reach<Scalar>>::iterator place) const noexcept {
    return static_cast<std::size_t>(place - all_.begin());
  }

  Eigen::Index axis_;
  std::span<const Reach<Scalar>> all_;
};

/// Each with those that begin within it, so that every two that overlap along the axis come up once.
/// @param movables(one, others) all of them can be moved.
/// @param movable_first(one, others) one that can be moved, and others that cannot.
/// @param fixed_first(one, others) one that cannot be moved, and others that can.
template <class Scalar, class Movables, class MovableFirst, class FixedFirst>
void sweep_along(Eigen::Index axis, const Reaches<Scalar>& reaches, const Movables& movables,
                 const MovableFirst& movable_first, const FixedFirst& fixed_first) {
  const Sorted<Scalar> movable(axis, reaches.movable);
  const Sorted<Scalar> fixed(axis, reaches.fixed);
  for (std::size_t i = 0; i < reaches.movable.size(); ++i) {
    const Reach<Scalar>& one = reaches.movable[i];
    movables(one, movable.between(i + 1, movable.first_after(one.box.upper[axis])));
    movable_first(one, fixed.between(fixed.first_at(one.box.lower[axis]), fixed.first_after(one.box.upper[axis])));
  }
  for (const Reach<Scalar>& one : reaches.fixed)
    fixed_first(one,
                movable.between(movable.first_after(one.box.lower[axis]), movable.first_after(one.box.upper[axis])));
}

/// How many overlap along the axis.
template <class Scalar>
std::size_t compared_along(Eigen::Index axis, const Reaches<Scalar>& reaches) {
  std::size_t compared = 0;
  const auto count = [&](const Reach<Scalar>&, std::span<const Reach<Scalar>> others) { compared += others.size(); };
  sweep_along(axis, reaches, count, count, count);
  return compared;
}

}  // namespace

template <class Scalar>
void find_pairs_one_by_one(const Reaches<Scalar>& reaches, PairList& pairs) {
  for (std::size_t i = 0; i < reaches.movable.size(); ++i) {
    for (std::size_t j = i + 1; j < reaches.movable.size(); ++j)
      add_movable_if_overlapping(reaches.movable[i], reaches.movable[j], pairs);
    for (const Reach<Scalar>& fixed : reaches.fixed) add_if_overlapping(reaches.movable[i], fixed, pairs);
  }
}

template <class Scalar>
void find_pairs_by_sweep(Reaches<Scalar>& reaches, PairList& pairs) {
  sort_along(0, reaches);
  const std::size_t along_x = compared_along(0, reaches);
  sort_along(1, reaches);
  Eigen::Index axis = 1;
  if (along_x <= compared_along(1, reaches)) {
    axis = 0;
    sort_along(axis, reaches);
  }
  using Others = std::span<const Reach<Scalar>>;
  sweep_along(
      axis, reaches,
      [&](const Reach<Scalar>& one, Others others) {
        for (const Reach<Scalar>& other : others) add_movable_if_overlapping(one, other, pairs);
      },
      [&](const Reach<Scalar>& movable, Others others) {
        for (const Reach<Scalar>& fixed : others) add_if_overlapping(movable, fixed, pairs);
      },
      [&](const Reach<Scalar>& fixed, Others others) {
        for (const Reach<Scalar>& movable : others) add_if_overlapping(movable, fixed, pairs);
      });
}

#define PAPERPROOF_INSTANTIATE(Scalar)                                    \
  template void find_pairs_one_by_one(const Reaches<Scalar>&, PairList&); \
  template void find_pairs_by_sweep(Reaches<Scalar>&, PairList&)
PAPERPROOF_INSTANTIATE(float);
PAPERPROOF_INSTANTIATE(double);
#undef PAPERPROOF_INSTANTIATE

}  // namespace paperproof::discrete
