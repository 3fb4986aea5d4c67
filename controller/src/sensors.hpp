/// Colliders that block nothing: when does the character enter them, and when does it leave?
#pragma once

#include "geometry/overlap_time.hpp"
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
    Scalar begin = 0;        ///< Fractions of the step.
    Scalar end = 1;

    [[nodiscard]] Scalar fraction(Scalar of_segment) const noexcept {
      return std::min(end, begin + (end - begin) * of_segment);
    }
  };

  [[nodiscard]] static Segment seen_by(const MoverMotion<Scalar>& motion, const PathPoint<Scalar>& begin,
                                       const PathPoint<Scalar>& end) noexcept;
  /// @param near pieces that stand still, or go along with `motion`, ascending.
  /// @return positions from which the character is in each of them, or out of it, as it is on all of the path.
  Box2<Scalar> observe(std::span<const PieceIndex> near, std::span<const PathPoint<Scalar>> path,
                       const MoverMotion<Scalar>& motion, Box2<Scalar> quiet, Events& events) const noexcept;
  void observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment,
               Events& events) const noexcept;
  /// Leaves of `quiet` the positions from which the character is in a piece, or out of it, as it is on all of a way.
  /// False where that may change on the way.
  [[nodiscard]] bool keep_quiet(PieceIndex piece, const Box2<Scalar>& way, Box2<Scalar>& quiet) const noexcept;

  const Scenery<Scalar>* scenery_;
  PieceFinder<Scalar> finder_;
  /// What a sensor's piece and the character make of each other.
  struct Overlap {
    Box2<Scalar> any;          ///< Positions from which they may overlap: from all others they do not [m].
    Box2<Scalar> well_inside;  ///< Positions from which they overlap for certain [m].
    std::vector<geometry::SeparatingAxis<Scalar>> axes;
  };
  [[nodiscard]] const Overlap& overlap_with(PieceIndex piece) const noexcept {
    return overlaps_[piece - scenery_->sensor_pieces().first];
  }

  std::vector<Overlap> overlaps_;  ///< By piece.
};

extern template class Sensors<float>;
extern template class Sensors<double>;

}  // namespace paperproof
