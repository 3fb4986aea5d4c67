/// One character as another of the same shape sees it.
#pragma once

#include <paperproof/character.hpp>
#include <paperproof/types.hpp>

namespace paperproof::crowd {

/// What a straight relative motion does to a pair.
template <class Scalar>
struct PairSweep {
  bool meets = false;
  Scalar stop = 0;    ///< Where to stop, as a fraction of the motion.
  Scalar impact = 0;  ///< Time of impact as a fraction of the motion; beyond 1 where it stops just before.
  Vec2<Scalar> normal{Vec2<Scalar>::Zero()};  ///< Unit, towards the first of the pair.
};

/// A straight motion from one position to another [m].
template <class Scalar>
struct Leg {
  Vec2<Scalar> from{Vec2<Scalar>::Zero()};
  Vec2<Scalar> to{Vec2<Scalar>::Zero()};
  bool rounded = false;  ///< An end lies between two corners of a way: where it is exactly is no double.
};

/// The first of a pair at p and the second at q overlap exactly when p - q is inside the Minkowski sum of the shape and
/// its mirror image. The facets of that sum have the normals of the hull's edges and their negatives, and along each
///
///     f(p, q) = n·(p - q) - width along n
///
/// is the separation. The narrow phase of `octagon_sweep` says how a motion is tested and why there are several
/// lengths: this is the same, with one kind of facet. Immutable after construction.
template <class Scalar>
class PairSpace {
 public:
  explicit PairSpace(const CharacterShape& shape);

  /// @param least coming nearer than this is meeting [m]. Nearer from the start: coming nearer still is.
  [[nodiscard]] PairSweep<Scalar> sweep(const Leg<Scalar>& first, const Leg<Scalar>& second,
                                        Scalar least) const noexcept;
  /// Separation along the best axis [m]; negative: they overlap.
  [[nodiscard]] Scalar separation(const Vec2<Scalar>& first, const Vec2<Scalar>& second) const noexcept;
  /// Around the shape, relative to its position [m].
  [[nodiscard]] const Box2<Scalar>& box() const noexcept { return box_; }

 private:
  struct Axis {
    Vec2<Scalar> normal;
    Scalar width;
  };
  static constexpr std::size_t max_axes = 2 * CharacterShape::max_points;
  /// Separations along all axes, before and after a motion [m].
  struct Ranges {
    std::array<Scalar, max_axes> start;
    std::array<Scalar, max_axes> end;
    std::size_t best = 0;  ///< Axis of the largest separation before.
    Scalar noise = 0;      ///< Bound of the rounding of a separation [m].
  };

  void add_axis(const Vec2d& normal) noexcept;
  [[nodiscard]] Ranges ranges(const Leg<Scalar>& first, const Leg<Scalar>& second) const noexcept;
  [[nodiscard]] bool gets_no_nearer(const Ranges& f) const noexcept;
  [[nodiscard]] bool certified(const Leg<Scalar>& first, const Leg<Scalar>& second) const noexcept;
  [[nodiscard]] PairSweep<Scalar> sweep_apart(const Ranges& f, Scalar least) const noexcept;

  FixedVector<Vec2d, CharacterShape::max_points> hull_;
  FixedVector<Axis, max_axes> axes_;
  Box2<Scalar> box_;
};

extern template class PairSpace<float>;
extern template class PairSpace<double>;

}  // namespace paperproof::crowd
