/// Finds the one-way chains that a character passes when it drops through.
#pragma once

#include "one_way_surfaces.hpp"
#include "piece_finder.hpp"

#include <paperproof/controller.hpp>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace paperproof {

/// A segment of a one-way chain. It runs so that its blocking normal is on its left.
struct OneWaySegment {
  ColliderIndex chain;
  std::array<Vec2d, 2> ends;  ///< As its mover sees them [m].
  const OneWaySurfaces* surfaces;
  OneWaySurfaces::Index surface;
};

/// Adds the chain of a segment that a leg of the path passes, if this leg begins above the chain's surface; ascending,
/// each once. A chain that is missed by less than a micrometre is added as well, so no chain that exact arithmetic
/// finds is left out.
/// @param path straight between its corners. @param motion of the segment's mover.
void add_if_passed(const OneWaySegment& segment, const CharacterShape& shape, std::span<const PathPoint> path,
                   const MoverMotion& motion, std::vector<ColliderIndex>& passed);

/// The same for all pieces.
/// @param near the solid ones. @param segment_of gives the one-way segment that a piece is, or nothing.
template <class SegmentOf>
void find_passed(const CharacterShape& shape, std::span<const PathPoint> path, const Moving& moving, Nearby near,
                 const SegmentOf& segment_of, std::vector<ColliderIndex>& passed) {
  passed.clear();
  near.for_each_group(box_around(path, {}), Vec2d::Zero(), [&](std::span<const PieceIndex> pieces, MoverIndex mover) {
    const MoverMotion motion = moving.motion_of(mover);
    for (const PieceIndex piece : pieces)
      if (const std::optional<OneWaySegment> segment = segment_of(piece))
        add_if_passed(*segment, shape, path, motion, passed);
  });
}

}  // namespace paperproof
