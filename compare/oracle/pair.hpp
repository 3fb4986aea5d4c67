/// Two characters of one shape, exactly.
#pragma once

#include <paperproof/report.hpp>

#include <memory>
#include <span>

namespace paperproof::compare {

/// Two open convex shapes overlap where no edge of either has the other wholly outside: with one shape twice these are
/// its edges, looked at from both sides. Every double is the rational it is, places between two corners of a way are
/// exact, and nothing is shared with the controller. What doubles show to be far apart is decided there, with a margin
/// above their rounding. Immutable; may be shared between threads.
class ExactPair {
 public:
  /// @param hull of both, in order, relative to the position [m].
  explicit ExactPair(std::span<const Vec2d> hull);

  [[nodiscard]] bool overlap(const Vec2d& one, const Vec2d& other) const;

  /// Whether they overlap on the straight way from one pair of places to another.
  [[nodiscard]] bool meet_between(const Vec2d& one_from, const Vec2d& other_from, const Vec2d& one_to,
                                  const Vec2d& other_to) const;

  /// Whether they overlap at any moment of a step. Both go evenly between the corners of their ways; parts that take no
  /// time come one after the other, those of the one first.
  /// @param one,other from fraction 0 to 1.
  [[nodiscard]] bool meet(std::span<const PathPoint> one, std::span<const PathPoint> other) const;

  /// Along the best axis, rounded [m]; negative: how deep they overlap.
  [[nodiscard]] double separation(const Vec2d& one, const Vec2d& other) const;

  /// Whether one that goes straight comes no nearer to a place along an axis on which it begins farthest from it,
  /// rounded. @param from,to of its way [m].
  [[nodiscard]] bool recedes(const Vec2d& at, const Vec2d& from, const Vec2d& to) const;

  /// The largest depth at any moment of two ways, rounded [m]; 0 where they do not overlap.
  [[nodiscard]] double deepest(std::span<const PathPoint> one, std::span<const PathPoint> other) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

}  // namespace paperproof::compare
