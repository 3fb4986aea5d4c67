/// The article's discrete collision detection, for any number of moving bodies.
#pragma once

#include "techniques/discrete/body.hpp"

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

/// Two bodies that were pushed apart.
struct SolvedImpact {
  Pair bodies;
  Impact impact;                     ///< As it was before the push.
  Vec2d first_push{Vec2d::Zero()};   ///< [m]
  Vec2d second_push{Vec2d::Zero()};  ///< [m]
};

/// Corrects the movements of one frame.
///
/// Each round finds the total box of every body's current and expected position, groups bodies whose boxes overlap
/// (sort and sweep: Baraff 1992, "Dynamic Simulation of Non-Penetrating Rigid Bodies") into time-of-impact islands
/// (union-find; what cannot be moved joins no two islands), and solves each island in order of time of impact: the two
/// bodies are pushed apart along the normal, by their inverse masses and to a small gap, and lose the speed with which
/// they approach. A correction can cause new collisions, so rounds are repeated, a number of times that the caller
/// sets. Only the start and the expected end of the frame are looked at: paper is passed.
///
/// Results depend on the bodies and their order only. One solver per thread: it owns the memory that it works in, which
/// grows to what the largest frame needed.
class Solver {
 public:
  /// @param gap between bodies that were pushed apart [m]. Zero: rounding leaves them overlapping.
  /// @param touch up to this overlap at the start of a frame bodies only touch [m].
  Solver(double gap, double touch) noexcept : gap_(gap), touch_(touch) {}

  /// Takes all memory that frames of this size need, so that none is taken later.
  /// @param pairs no more than so many are looked at in a round from now on: see `overflowed`.
  void reserve(std::size_t bodies, std::size_t pairs);

  /// One round. @return whether anything was pushed.
  bool solve_once(std::span<Body> bodies);

  /// What the last round pushed apart, island by island, in order of time of impact.
  [[nodiscard]] std::span<const SolvedImpact> solved() const noexcept { return solved_; }
  /// At risk of colliding in the last round, ascending.
  [[nodiscard]] std::span<const Pair> pairs() const noexcept { return pairs_; }
  /// There were more of them in the last round than `reserve` allowed: it did not look at all of them.
  [[nodiscard]] bool overflowed() const noexcept { return overflowed_; }
  /// The island of each body in the last round: the lowest index in it. What cannot be moved is an island of its own.
  [[nodiscard]] BodyIndex island_of(BodyIndex body) const noexcept { return parents_[body]; }

 private:
  /// A body, and what it covers during a frame.
  struct Reach {
    Box2 box;
    BodyIndex body = 0;
    bool can_be_moved = false;
    std::size_t next_movable = 0;  ///< In the order below, of those after it; or their number.
  };
  struct Planned {
    BodyIndex island = 0;
    double time = 0;
    Pair bodies;
  };

  void find_pairs(std::span<const Body> bodies);
  void find_islands(std::span<const Body> bodies);
  void plan(std::span<const Body> bodies);
  void push_apart(SolvedImpact& solved, Body& first, Body& second) const noexcept;

  double gap_;
  double touch_;
  std::vector<Reach> reaches_;  ///< In the order in which they begin along an axis.
  std::vector<Pair> pairs_;
  std::size_t most_pairs_ = std::numeric_limits<std::size_t>::max();
  bool overflowed_ = false;
  std::vector<BodyIndex> parents_;  ///< Never larger than the body's own index: a root is the lowest of its island.
  std::vector<Planned> planned_;
  std::vector<SolvedImpact> solved_;
};

}  // namespace paperproof::discrete
