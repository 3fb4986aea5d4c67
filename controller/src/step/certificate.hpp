/// Proof, without rounding, that a straight motion stays clear of a piece.
#pragma once

#include "geometry/exact.hpp"
#include "step/configuration_space.hpp"

namespace paperproof::octagon_sweep::PAPERPROOF_REAL {

/// A position as a piece sees it that has not moved, unrounded: the sum of all terms.
class ExactPosition {
 public:
  /// Of a piece that stands still.
  explicit ExactPosition(const Vec2& position) noexcept { add(position.cast<double>()); }
  /// Of a piece of a mover at a fraction of the step.
  ExactPosition(const Vec2& position, const MoverMotion& motion, Real time) noexcept : ExactPosition(position) {
    const Vec2d from = motion.from;
    const Vec2d to = motion.to;
    add(time < 1 ? -from : -to);
    if (time > 0 && time < 1)
      for (const Vec2d& part : geometry::part_of_way(from, to, static_cast<double>(time))) add(-part);
  }
  [[nodiscard]] std::span<const Vec2d> terms() const noexcept { return {terms_.begin(), terms_.end()}; }

 private:
  void add(const Vec2d& term) noexcept {
    terms_.push_back({geometry::without_traces(term.x()), geometry::without_traces(term.y())});
  }
  FixedVector<Vec2d, geometry::most_terms - 1> terms_;
};

/// Whether the octagon's open interior meets the piece at `position`, exactly: the separating axis theorem with signs
/// of exact determinants. Allocates nothing.
[[nodiscard]] bool overlaps_exactly(const ConfigurationSpace& space, PieceIndex piece, const Vec2& position) noexcept;
[[nodiscard]] bool overlaps_exactly(const ConfigurationSpace& space, PieceIndex piece,
                                    const ExactPosition& position) noexcept;

/// Whether one line separates octagon and piece at both ends of a straight motion, exactly. Separations are linear, so
/// the whole motion is then clear. (That no single line does so does not prove an overlap: the answer is then `false`
/// all the same.) Beside a circle also whether the motion comes no nearer from an end that is clear.
[[nodiscard]] bool clear_of_exactly(const ConfigurationSpace& space, PieceIndex piece, const Vec2& from,
                                    const Vec2& to) noexcept;
/// The same on a motion in the world during a part of the step, also beside a piece that moves.
/// @param movers motions in the whole step. @param begin,end of that part, as fractions of the step.
[[nodiscard]] bool clear_of_exactly(const ConfigurationSpace& space, PieceIndex piece,
                                    std::span<const MoverMotion> movers, const Vec2& from, Real begin, const Vec2& to,
                                    Real end) noexcept;

}  // namespace paperproof::octagon_sweep::PAPERPROOF_REAL
