/// Colliders that block nothing: when does the character enter them, and when does it leave?
#pragma once

#include "piece_finder.hpp"

#include <paperproof/controller.hpp>

#include <span>
#include <vector>

namespace paperproof {

/// The sensors of one scenery, for one character. Immutable; shareable between threads; never allocates while
/// observing.
///
/// The character is in a sensor while its open interior meets the sensor's interior, or, of a chain, its line: passing
/// a chain of zero thickness takes an interval of time too. A sensor of several convex pieces is one region, whose
/// inner seams are no borders. Entering and leaving alternate. Whether the character is in a sensor at the end of a
/// path depends on the bits of its position and of the sensor's offset there, and on nothing else: a path that begins
/// where the one before ended goes on with what that one ended in, so nothing has to be remembered, and no event is
/// lost or doubled between steps. A path that begins in a sensor, after a teleport too, does not enter it.
template <class Scalar>
class Sensors {
 public:
  using Events = decltype(StepReport<Scalar>::sensors);

  /// `scenery` must outlive the sensors.
  Sensors(const Scenery<Scalar>& scenery, const CharacterShape& shape);

  [[nodiscard]] Candidates<Scalar> make_candidates() const { return finder_.make_candidates(); }

  /// Every event on the way, in order of time (ties: the lower sensor first). Where there are more than `events` holds
  /// the earliest are kept, and it says that it overflowed.
  ///
  /// A fraction is exact but for a few ulp of the distance over the length of the segment; regions of one sensor that
  /// are left and entered within 1e-12 (`float`: 1e-5) of a segment count as one.
  /// @param path straight between its corners, fractions ascending.
  /// @param movers one for each mover of the scenery.
  /// @param candidates made by these sensors, or by others of the same scenery and character.
  void observe(std::span<const PathPoint<Scalar>> path, std::span<const MoverMotion<Scalar>> movers,
               Candidates<Scalar>& candidates, Events& events) const noexcept;

 private:
  /// A straight motion as seen from a sensor that stands still.
  struct Segment {
    Vec2<Scalar> from;
    Vec2<Scalar> to;
    Box2<Scalar> positions;  ///< Around both.
    Box2<Scalar> box;        ///< Around the character on all of it [m].
    Scalar begin = 0;  ///< Fractions of the step.
    Scalar end = 1;

    [[nodiscard]] Scalar fraction(Scalar of_segment) const noexcept {
      return std::min(end, begin + (end - begin) * of_segment);
    }
  };

  [[nodiscard]] Segment seen_from(const Vec2<Scalar>& offset_at_begin, const Vec2<Scalar>& offset_at_end,
                                  const PathPoint<Scalar>& begin, const PathPoint<Scalar>& end) const noexcept;
  void observe(std::span<const PieceIndex> near, const Segment& segment, Events& events) const noexcept;
  void observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment,
               Events& events) const noexcept;

  const Scenery<Scalar>* scenery_;
  PieceFinder<Scalar> finder_;
  std::vector<Box2<Scalar>>
      well_inside_;  ///< By piece: positions from which the character overlaps it for certain [m].
  FixedVector<Vec2<Scalar>, CharacterShape::max_points> outline_;
  Box2<Scalar> box_;
};

extern template class Sensors<float>;
extern template class Sensors<double>;

}  // namespace paperproof
