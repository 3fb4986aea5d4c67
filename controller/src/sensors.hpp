/// Finds when a character enters and leaves sensors, the colliders that block nothing.
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
/// The character is in a sensor while its open interior meets the sensor's interior, or the line of a sensor that is a
/// chain: passing a chain of zero thickness takes an interval of time as well. A sensor of several convex pieces is one
/// region; its inner seams are no borders. Enter and exit events alternate. Whether the character is in a sensor at the
/// end of a path depends on the bits of its position and of the sensor's offset there, and on nothing else. A path that
/// begins where the last path ended therefore begins in the same sensors: nothing has to be remembered, and no event is
/// lost or doubled between steps. A path that begins in a sensor does not enter it, not even after a teleport.
template <class Scalar>
class Sensors {
 public:
  using Events = decltype(StepReport<Scalar>::sensors);

  /// `scenery` must outlive the sensors.
  Sensors(const Scenery<Scalar>& scenery, const CharacterShape& shape, PieceSearch search = PieceSearch::tree);

  [[nodiscard]] Candidates<Scalar> make_candidates() const { return finder_.make_candidates(); }

  /// Every event on the way, in order of time (ties: the lower sensor first). If `events` is full, it keeps the
  /// earliest events and has overflowed.
  ///
  /// A fraction is exact but for a few ulp of the distance over the length of the segment; regions of one sensor that
  /// are left and entered within 1e-12 (`float`: 1e-5) of a segment count as one.
  /// @param path straight between its corners, fractions ascending.
  /// @param movers one for each mover of the scenery. @param filter null: all sensors are there.
  /// @param candidates made by these sensors, or by others of the same scenery and character.
  void observe(std::span<const PathPoint<Scalar>> path, std::span<const MoverMotion<Scalar>> movers,
               Candidates<Scalar>& candidates, Events& events, const ColliderFilter* filter = nullptr) const noexcept;

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
  /// @return positions at which the character is in, or out of, each of these pieces just as on the whole path.
  Box2<Scalar> observe(std::span<const PieceIndex> near, std::span<const PathPoint<Scalar>> path,
                       const MoverMotion<Scalar>& motion, Box2<Scalar> quiet, const ColliderFilter* filter,
                       Events& events) const noexcept;
  void observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment,
               Events& events) const noexcept;
  /// Reduces `quiet` to the positions at which the character is in, or out of, a piece just as on the whole way.
  /// Returns false if this may change on the way.
  [[nodiscard]] bool keep_quiet(PieceIndex piece, const Box2<Scalar>& way, Box2<Scalar>& quiet) const noexcept;

  const Scenery<Scalar>* scenery_;
  PieceFinder<Scalar> finder_;
  /// How a sensor's piece and the character overlap.
  struct Overlap {
    Box2<Scalar> any;          ///< Positions at which they may overlap; at all others they do not [m].
    Box2<Scalar> well_inside;  ///< Positions at which they certainly overlap [m]. Of a circle none are known.
    std::vector<geometry::SeparatingAxis<Scalar>> axes;  ///< None for a circle.
  };
  [[nodiscard]] const Overlap& overlap_with(PieceIndex piece) const noexcept {
    return overlaps_[piece - scenery_->sensor_pieces().first];
  }

  std::vector<Overlap> overlaps_;      ///< By piece.
  std::vector<Vec2<Scalar>> outline_;  ///< Of the character.
};

extern template class Sensors<float>;
extern template class Sensors<double>;

}  // namespace paperproof
