/// Which bodies are at risk of colliding: those whose total boxes overlap.
#pragma once

#include <paperproof/types.hpp>

#include <cstdint>
#include <limits>
#include <vector>

namespace paperproof::discrete {

using BodyIndex = std::uint32_t;

/// Two bodies whose total boxes overlap: at risk of colliding. The first can be moved, and is the one with the lower
/// index if the second can be too.
struct Pair {
  BodyIndex first = 0;
  BodyIndex second = 0;

  friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// A body, and what it covers during a frame.
struct Reach {
  Box2 box;
  BodyIndex body = 0;
};

/// Of all bodies of a frame. What cannot be moved makes pairs only with what can.
struct Reaches {
  std::vector<Reach> movable;
  std::vector<Reach> fixed;
};

/// Pairs, up to a number of them; those that come later are left out, and remembered as such.
class PairList {
 public:
  /// Takes the memory for so many, and never more.
  void limit(std::size_t pairs) {
    most_ = pairs;
    pairs_.reserve(pairs);
  }
  void clear() noexcept {
    pairs_.clear();
    overflowed_ = false;
  }
  void add(const Pair& pair) {
    if (pairs_.size() == most_)
      overflowed_ = true;
    else
      pairs_.push_back(pair);
  }
  [[nodiscard]] const std::vector<Pair>& all() const noexcept { return pairs_; }
  [[nodiscard]] bool overflowed() const noexcept { return overflowed_; }

 private:
  std::vector<Pair> pairs_;
  std::size_t most_ = std::numeric_limits<std::size_t>::max();
  bool overflowed_ = false;
};

/// Adds all pairs, by looking at everything that can be moved with everything else: the slow, honest twin, and the
/// faster one where there is little that can be moved.
void find_pairs_one_by_one(const Reaches& reaches, PairList& pairs);

/// The same pairs in another order, by sort and sweep (Baraff 1992, "Dynamic Simulation of Non-Penetrating Rigid
/// Bodies"): boxes are sorted by where they begin along an axis, and each is compared with those that begin within it.
/// The axis is the one along which fewer overlap. Takes no memory.
/// @param reaches are put in another order.
void find_pairs_by_sweep(Reaches& reaches, PairList& pairs);

}  // namespace paperproof::discrete
