/// Finds when a character enters and leaves sensors, the colliders that block nothing.
#pragma once

#include "geometry/overlap_time.hpp"
#include "piece_finder.hpp"

#include <paperproof/controller.hpp>

#include <span>
#include <unordered_map>
#include <vector>

namespace paperproof {

/// The sensors near a character, or near several of one shape. Not thread-safe: each thread has its own. It allocates
/// where a sensor comes near for the first time.
///
/// The character is in a sensor while its open interior meets the sensor's interior, or the line of a sensor that is a
/// chain: passing a chain of zero thickness takes an interval of time as well. A sensor of several convex pieces is one
/// region; its inner seams are no borders. Enter and exit events alternate. Whether the character is in a sensor at the
/// end of a path depends on the bits of its position and of the sensor's offset there, and on nothing else. A path that
/// begins where the last path ended therefore begins in the same sensors: nothing has to be remembered, and no event is
/// lost or doubled between steps. A path that begins in a sensor does not enter it, not even after a teleport.
class Sensors final : public OwnMemory, private PieceUser {
 public:
  using Events = std::vector<SensorEvent>;

  /// `scenery` must outlive the sensors.
  Sensors(const Scenery& scenery, const CharacterShape& shape, PieceSearch search = PieceSearch::grid);

  /// Makes ready all sensors around positions in a box.
  void reserve(const Box2& positions) { Nearby(finder_, near_, nullptr, nullptr, this).reserve(positions); }

  /// Every event on the way, in order of time (ties: the lower sensor first).
  ///
  /// A fraction is exact but for a few ulp of the distance over the length of the segment; regions of one sensor that
  /// are left and entered within 1e-12 (`float`: 1e-5) of a segment count as one.
  /// @param path straight between its corners, fractions ascending.
  /// @param filter null: all sensors are there.
  void observe(std::span<const PathPoint> path, const Moving& moving, Events& events,
               const ColliderFilter* filter = nullptr);
  /// The sensors that the character is in at a position, when the motions begin: as events say it.
  /// @param found as many of them as it has room for. @return how many they are.
  [[nodiscard]] std::size_t around(const Vec2d& position, const Moving& moving, const ColliderFilter* filter,
                                   std::span<ColliderIndex> found);

 private:
  /// A straight motion as seen from a sensor that stands still.
  struct Segment {
    Vec2d from;
    Vec2d to;
    Box2 positions;  ///< Around both.
    double begin;    ///< Fractions of the step.
    double end;

    [[nodiscard]] double fraction(double of_segment) const { return std::min(end, begin + (end - begin) * of_segment); }
  };

  [[nodiscard]] static Segment seen_by(const MoverMotion& motion, const PathPoint& begin, const PathPoint& end);
  void observe(ColliderIndex sensor, std::span<const PieceIndex> pieces, const Segment& segment, Events& events);

  void prepare(std::span<PieceIndex> pieces, MoverIndex mover, double angle) override;
  [[nodiscard]] geometry::OverlapTime stay_in(PieceIndex piece, const Segment& segment) const;
  void follow_edits() override;

  /// How a sensor's piece and the character overlap.
  struct Overlap {
    ColliderIndex sensor;
    double angle;      ///< Of its mover [rad].
    Circle circle;     ///< With a radius, if it is one.
    Box2 any;          ///< Positions at which they may overlap; at all others they do not [m].
    Box2 well_inside;  ///< Positions at which they certainly overlap [m]. Of a circle none are known.
    std::vector<geometry::SeparatingAxis> axes;  ///< None for a circle.
  };
  [[nodiscard]] Overlap overlap_with(PieceIndex piece, double angle) const;

  PieceFinder finder_;
  std::vector<Vec2d> outline_;  ///< Of the character.
  Candidates near_;             ///< Of `overlaps_`.
  std::vector<Overlap> overlaps_;
  std::unordered_map<PieceIndex, PieceIndex> known_;  ///< By piece, in `overlaps_`.
  std::vector<geometry::OverlapTime> stays_;          ///< In the pieces of one sensor.
};

}  // namespace paperproof
