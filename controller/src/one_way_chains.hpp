/// Finds the one-way chains that a character passes when it drops through.
#pragma once

#include "one_way_surfaces.hpp"
#include "piece_finder.hpp"

#include <paperproof/controller.hpp>

#include <array>
#include <optional>
#include <span>

namespace paperproof {

/// A segment of a one-way chain. It runs so that its blocking normal is on its left.
struct OneWaySegment {
  ColliderIndex chain;
  std::array<Vec2d, 2> ends;  ///< As its mover sees them [m].
  const OneWaySurfaces* surfaces;
  OneWaySurfaces::Index surface;
};

/// Which one-way chains does one character pass? Immutable; shareable between threads.
class OneWayChains {
 public:
  using Passed = std::vector<ColliderIndex>;

  explicit OneWayChains(const CharacterShape& shape);

  /// Finds the chains with a segment that a leg of the path passes, if this leg begins above the chain's surface;
  /// ascending. A chain that is missed by less than a micrometre is named as well, so no chain that exact arithmetic
  /// finds is left out.
  /// @param path straight between its corners. @param near the solid pieces.
  /// @param segment_of gives the one-way segment that a piece is, or nothing.
  template <class SegmentOf>
  void find_passed(std::span<const PathPoint> path, const Moving& moving, Nearby near, const SegmentOf& segment_of,
                   Passed& passed) const {
    passed.clear();
    near.for_each_group(box_around(path, {}), Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
      const MoverMotion motion = moving.motion_of(mover);
      for (const PieceIndex piece : pieces)
        if (const std::optional<OneWaySegment> segment = segment_of(piece)) look_at(*segment, path, motion, passed);
    });
  }

 private:
  void look_at(const OneWaySegment& segment, std::span<const PathPoint> path, const MoverMotion& motion,
               Passed& passed) const;
  [[nodiscard]] bool passes(const OneWaySegment& segment, const Vec2d& from, const Vec2d& to) const;

  FixedVector<Vec2d, CharacterShape::max_points> outline_;  ///< The character's outline,
  FixedVector<Vec2d, CharacterShape::max_points> grown_;    ///< and a slightly larger one.
};

}  // namespace paperproof
