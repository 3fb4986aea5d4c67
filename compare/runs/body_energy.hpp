/// Energy that bodies gain while nothing puts any in.
#pragma once

#include "records/row.hpp"
#include "records/trace.hpp"
#include "scenes/scene.hpp"

namespace paperproof::compare {

/// Energy of all bodies and springs of a scene, Σ m (v²/2 - g·x) + Σ k (l - l0)²/2 [J]; v is the way of a step by its
/// length.
/// - `body_energy_gained_j`: how far it ever rises above the least value that it had before.
/// - `body_energy_bound_j`: what is no gain: 1 % of the largest energy that was in motion and springs at once; the
///   weight of what no joint holds times Box2D's skin of 20 mm; and rounding: two ulp of the largest offset as a way
///   and as a speed.
///
/// The implicit Euler method, which Box2D's soft constraint is, only loses energy. Absent where something goes along a
/// path, which puts in what it wants. Feed it every step in order.
class BodyEnergy {
 public:
  /// @param scene must outlive this.
  explicit BodyEnergy(const Scene& scene);
  void add(const TraceStep& step);
  void write(Row& row) const;

 private:
  [[nodiscard]] double in_springs(const TraceStep& step);

  const Scene& scene_;
  bool applies_ = false;
  double loose_mass_ = 0;  ///< Of bodies that no joint holds [kg].
  bool any_ = false;
  double least_ = 0;
  double gained_ = 0;
  double most_turned_over_ = 0;  ///< Largest energy in motion and springs [J].
  double rounding_ = 0;          ///< [J]
};

}  // namespace paperproof::compare
