/// Proof, without rounding, that a straight motion stays clear of a piece.
#pragma once

#include "geometry/exact.hpp"
#include "step/configuration_space.hpp"

namespace paperproof::octagon_sweep {

/// A position as a piece sees it that has not moved, unrounded: the sum of all terms.
class ExactPosition {
 public:
  /// Of a piece that stands still.
  template <class Scalar>
  explicit ExactPosition(const Vec2<Scalar>& position) noexcept {
    add(position.template cast<double>());
  }
  /// Of a piece of a mover at a fraction of the step.
  template <class Scalar>
  ExactPosition(const Vec2<Scalar>& position, const MoverMotion<Scalar>& motion, Scalar time) noexcept
      : ExactPosition(position) {
    const Vec2d from = motion.from.template cast<double>();
    const Vec2d to = motion.to.template cast<double>();
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
template <class Scalar>
[[nodiscard]] bool overlaps_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                                    const Vec2<Scalar>& position) noexcept;
template <class Scalar>
[[nodiscard]] bool overlaps_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                                    const ExactPosition& position) noexcept;

/// Whether one line separates octagon and piece at both ends of a straight motion, exactly. Separations are linear, so
/// the whole motion is then clear. (That no single line does so does not prove an overlap: the answer is then `false`
/// all the same.) Beside a circle also whether the motion comes no nearer from an end that is clear.
template <class Scalar>
[[nodiscard]] bool clear_of_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece, const Vec2<Scalar>& from,
                                    const Vec2<Scalar>& to) noexcept;
/// The same on a motion in the world during a part of the step, also beside a piece that moves.
/// @param movers motions in the whole step. @param begin,end of that part, as fractions of the step.
template <class Scalar>
[[nodiscard]] bool clear_of_exactly(const ConfigurationSpace<Scalar>& space, PieceIndex piece,
                                    std::span<const MoverMotion<Scalar>> movers, const Vec2<Scalar>& from, Scalar begin,
                                    const Vec2<Scalar>& to, Scalar end) noexcept;

}  // namespace paperproof::octagon_sweep
