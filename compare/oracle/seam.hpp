/// Whether what is touched is a side of the solids taken together, or only a seam between them.
#pragma once

#include "oracle/world.hpp"

#include <functional>

namespace paperproof::compare::detail {

/// The same way of the octagon in the frame of any group.
using WayIn = std::function<Way(const Group&)>;

/// The edges near a touch as the touched collider's frame sees them at that moment, those of other movers included.
class Seams {
 public:
  /// @param numerator, denominator of the moment's fraction of the way; the denominator above zero.
  /// @param near encloses what is touched, in the touched collider's frame.
  Seams(const World& world, const Group& own, const WayIn& way_in, const Integer& numerator, const Integer& denominator,
        const Box2& near);

  /// Whether polygons of other colliders abut the edge all along from `first` to `last`.
  [[nodiscard]] bool cover(const Edge& edge, const Vec2d& first, const Vec2d& last) const;

  /// Whether another edge than `own` passes the vertex, and goes on to the left of the direction from `start` to `end`:
  /// then the vertex is no corner of the solids on that side.
  [[nodiscard]] bool pass(const Vec2d& vertex, std::uint32_t own, const Vec2d& start, const Vec2d& end) const;

 private:
  /// A group whose points, less shift / over, are where the touched frame sees them.
  struct Neighbour {
    const Group* group = nullptr;
    bool same_frame = true;
    int unit = 0;
    Integer over = 1;
    Point<Integer> shift;  ///< In units of 2^unit.
    Vec2d rounded_shift{Vec2d::Zero()};
    double rounding = 0;  ///< Of the rounded shift [m].
  };
  /// The sign of (end - start) × (to - from), exact; `to` is in the frame of the neighbour, and all of `start`, `end`
  /// are in one frame.
  [[nodiscard]] static Sign side(const Neighbour& neighbour, const Vec2d& start, const Vec2d& end, const Vec2d& from,
                                 const Vec2d& to);

  const World& world_;
  std::vector<Neighbour> neighbours_;
};

}  // namespace paperproof::compare::detail
