/// Where there is room for a character that movers press.
///
/// A straight uniform motion begins at c somewhere in the step and ends at q when the step ends. A piece, whose mover
/// goes on meanwhile, sees a straight motion too, from c' to q'. It meets the obstacle exactly if q' is in the shadow
/// that the obstacle has from c': behind those of its facets that face c', between the two tangents from there. A
/// shadow is convex, and so is the obstacle itself with a gap around it. What is outside all of them is free and can be
/// reached, and the nearest such position lies on a line that bounds one of them: at the foot of the perpendicular, or
/// where the last of the others stops to cover the line. So every such line is cut by all regions.
#pragma once

#include "step/narrow_phase.hpp"

#include <paperproof/tolerances.hpp>

#include <algorithm>
#include <vector>

namespace paperproof::octagon_sweep {

/// Kept where there is little room, of the hit distance: room must be a little more than what counts as closed. One:
/// far from the origin, where 4e-9 m are rounding, none is found. Large: what would do is not seen.
inline constexpr double least_room = 1.25;

/// Of the plane of the positions when the step ends, relative to one of them.
template <class Scalar>
struct TakenLine {
  Vec2<Scalar> normal;
  Scalar bound;      ///< Taken is w where normal · w < bound [m].
  bool may_be_edge;  ///< Of the free space: other lines lie inside other regions all along.
};

/// Taken is what is behind all of its lines.
struct TakenRegion {
  std::uint32_t first = 0;
  std::uint32_t end = 0;
};

/// Part of a line, along (-normal.y, normal.x) from its foot [m].
template <class Scalar>
struct PartOfLine {
  Scalar from;
  Scalar to;
};

/// Memory for the lines and regions of all pieces of a scenery.
template <class Scalar>
struct RoomMemory {
  RoomMemory() = default;
  explicit RoomMemory(const ConfigurationSpace<Scalar>& space) {
    std::size_t needed = 0;
    const PieceIndex pieces = space.scenery().sensor_pieces().first;
    // Twice the axes, for the shadow and for the piece itself, and two tangents and the direction of a one-way chain.
    for (PieceIndex piece = 0; piece < pieces; ++piece) needed += 2 * space.axis_count(piece) + 3;
    lines.reserve(needed);
    regions.reserve(std::size_t{2} * pieces);
    order.reserve(regions.capacity());
    parts.reserve(regions.capacity() + 1);
  }
  std::vector<TakenLine<Scalar>> lines;  ///< Never grows.
  std::vector<TakenRegion> regions;      ///< Never grows.
  std::vector<std::uint32_t> order;      ///< Never grows.
  /// Never grows: it begins with one part, and each region cuts one in two at most.
  std::vector<PartOfLine<Scalar>> parts;
};

/// The positions that cannot be reached from one corner of the way, and those that are not free.
template <class Scalar>
class TakenPositions {
 public:
  /// @param gap that is left to what is solid when the step ends [m].
  TakenPositions(const ConfigurationSpace<Scalar>& space, RoomMemory<Scalar>& memory, Scalar gap) noexcept
      : space_(space),
        lines_(memory.lines),
        regions_(memory.regions),
        order_(memory.order),
        free_(memory.parts),
        gap_(gap) {
    lines_.clear();
    regions_.clear();
    order_.clear();
  }

  /// @param from the corner, as the piece sees it at that time.
  /// @param end the position that all others are relative to, as the piece sees it when the step ends.
  /// @return false where nothing can be reached from the corner, as it is inside the piece.
  [[nodiscard]] bool add(PieceIndex piece, const Vec2<Scalar>& from, const Vec2<Scalar>& end) noexcept {
    const ObstacleInfo& info = space_.info(piece);
    const bool solid = info.one_way_axis == ObstacleInfo::not_one_way;
    if (!solid && !space_.surfaces().may_be_above(info.surface, from, Tolerances<Scalar>{}.certain)) return true;
    Scalar start = -std::numeric_limits<Scalar>::infinity();
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      start = std::max(start, space_.separation(piece, axis, from));
    if (start < 0 && solid) return false;
    add_shadow(piece, from, end, start);
    if (solid) add_piece(piece, end);
    return true;
  }

  /// Adds the piece itself and no shadow: it is not in the way.
  void add_end(PieceIndex piece, const Vec2<Scalar>& end) noexcept { add_piece(piece, end); }

  /// Calls `consider(w)` for positions that may be the nearest free one, relative to `end`, and less than `nearest`
  /// away.
  /// @param nearest may shrink meanwhile [m].
  template <class Consider>
  void for_each_position(const Scalar& nearest, const Consider& consider) noexcept {
    for (std::uint32_t region = 0; region < regions_.size(); ++region) order_.push_back(region);
    if (!taken(Vec2<Scalar>::Zero())) consider(Vec2<Scalar>(Vec2<Scalar>::Zero()));
    for (std::size_t region = 0; region < regions_.size(); ++region)
      for (std::uint32_t k = regions_[region].first; k < regions_[region].end; ++k)
        if (lines_[k].may_be_edge && std::abs(lines_[k].bound) < nearest)
          consider_along(lines_[k], region, nearest, consider);
  }

 private:
  /// A way keeps this many times more from what it passes than what would stop it: for its rounding.
  static constexpr Scalar margin = Scalar(least_room);
  /// Lines that differ by less in their direction are parallel.
  static constexpr Scalar parallel = std::numeric_limits<Scalar>::epsilon() * 64;

  using Part = PartOfLine<Scalar>;

  void begin_region() noexcept {
    const auto first = static_cast<std::uint32_t>(lines_.size());
    regions_.push_back({first, first});
  }
  void add_line(const Vec2<Scalar>& normal, Scalar bound, bool may_be_edge) noexcept {
    lines_.push_back({normal, bound, may_be_edge});
    ++regions_.back().end;
  }

  void add_piece(PieceIndex piece, const Vec2<Scalar>& end) noexcept {
    begin_region();
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis) {
      const Vec2<Scalar> n = space_.normal(piece, axis);
      if (n.x() != 0 || n.y() != 0)
        add_line(n, gap_ - space_.separation(piece, axis, end), !space_.covered(piece, axis));
    }
  }

  /// @param start separation at `from` [m].
  void add_shadow(PieceIndex piece, const Vec2<Scalar>& from, const Vec2<Scalar>& end, Scalar start) noexcept {
    begin_region();
    const std::uint8_t one_way = space_.info(piece).one_way_axis;
    const bool solid = one_way == ObstacleInfo::not_one_way;
    const Vec2<Scalar> moved = end - from;
    const Scalar level = std::min(Tolerances<Scalar>{}.hit, start);
    for (std::size_t axis = 0; axis < space_.axis_count(piece); ++axis)
      if (space_.separation(piece, axis, from) >= level)
        add_line(space_.normal(piece, axis), (solid ? level : gap_) - space_.separation(piece, axis, end), !solid);
    if (!solid) {
      // What is above its surface meets it against its normal, or another part of the surface first.
      const Vec2<Scalar> n = space_.normal(piece, one_way);
      add_line(n, -(n.x() * moved.x() + n.y() * moved.y()), true);
    }
    add_tangents(piece, from, moved, std::max(Scalar(0), level) * margin);
  }

  /// @param width that is kept from the piece [m].
  void add_tangents(PieceIndex piece, const Vec2<Scalar>& from, const Vec2<Scalar>& moved, Scalar width) noexcept {
    Vec2<Scalar> left = Vec2<Scalar>::Zero();
    Vec2<Scalar> right = Vec2<Scalar>::Zero();
    bool any = false;
    for (const Vec2<Scalar>& v : space_.scenery().vertices_of(piece)) {
      for (const Vec2<Scalar>& o : space_.hull()) {
        const Vec2<Scalar> to = v - from - o;
        const Scalar length = length_of(to);
        if (!(length > 0)) continue;
        const Vec2<Scalar> aside = Vec2<Scalar>{-to.y(), to.x()} * (width / length);
        const Vec2<Scalar> passing_left = to + aside;
        const Vec2<Scalar> passing_right = to - aside;
        if (!any || left.x() * passing_left.y() - left.y() * passing_left.x() > 0) left = passing_left;
        if (!any || right.x() * passing_right.y() - right.y() * passing_right.x() < 0) right = passing_right;
        any = true;
      }
    }
    add_tangent({-left.y(), left.x()}, moved);
    add_tangent({right.y(), -right.x()}, moved);
  }

  void add_tangent(const Vec2<Scalar>& outward, const Vec2<Scalar>& moved) noexcept {
    const Scalar length = length_of(outward);
    if (!(length > 0)) return;
    const Vec2<Scalar> n = outward / length;
    add_line(n, -(n.x() * moved.x() + n.y() * moved.y()), true);
  }

  [[nodiscard]] bool taken(const Vec2<Scalar>& w) const noexcept {
    return std::any_of(regions_.begin(), regions_.end(), [&](const TakenRegion& region) {
      return std::all_of(lines_.begin() + region.first, lines_.begin() + region.end,
                         [&](const TakenLine<Scalar>& line) {
                           return line.normal.x() * w.x() + line.normal.y() * w.y() < line.bound;
                         });
    });
  }

  template <class Consider>
  void consider_along(const TakenLine<Scalar>& line, std::size_t own, const Scalar& nearest,
                      const Consider& consider) noexcept {
    const Vec2<Scalar> foot = line.normal * line.bound;
    const Vec2<Scalar> along{-line.normal.y(), line.normal.x()};
    const Scalar half = std::sqrt(nearest * nearest - line.bound * line.bound);
    free_.assign(1, {-half, half});
    for (std::uint32_t& region : order_) {
      if (region == own) continue;
      const Part covered = covered_by(regions_[region], foot, along, half);
      if (!(covered.from < covered.to)) continue;
      take(covered);
      if (!free_.empty()) continue;
      // What covers one line often covers the next.
      std::swap(region, order_.front());
      return;
    }
    for (const Part& part : free_) {
      consider(Vec2<Scalar>(foot + along * std::clamp(Scalar(0), part.from, part.to)));
      // Where rounding spoils the edge of it, its middle may do.
      consider(Vec2<Scalar>(foot + along * ((part.from + part.to) / 2)));
    }
  }

  /// Which part of a line is inside a region; `from` is not less than `to` where none is.
  [[nodiscard]] Part covered_by(const TakenRegion& region, const Vec2<Scalar>& foot, const Vec2<Scalar>& along,
                                Scalar half) const noexcept {
    Part part{-half, half};
    for (std::uint32_t k = region.first; k < region.end && part.from < part.to; ++k) {
      const TakenLine<Scalar>& line = lines_[k];
      const Scalar rate = line.normal.x() * along.x() + line.normal.y() * along.y();
      const Scalar depth = line.bound - (line.normal.x() * foot.x() + line.normal.y() * foot.y());
      if (std::abs(rate) < parallel) {
        // Of two facets in one line neither covers the other.
        if (depth <= Tolerances<Scalar>{}.certain) part.to = part.from;
      } else if (rate > 0) {
        part.to = std::min(part.to, depth / rate);
      } else {
        part.from = std::max(part.from, depth / rate);
      }
    }
    return part;
  }

  void take(const Part& covered) noexcept {
    for (std::size_t i = 0; i < free_.size();) {
      Part& part = free_[i];
      if (covered.to <= part.from || covered.from >= part.to) {
        ++i;
        continue;
      }
      const bool before = covered.from > part.from;
      const bool after = covered.to < part.to;
      if (before && after) free_.push_back({covered.to, part.to});
      if (before) {
        part.to = covered.from;
        ++i;
      } else if (after) {
        part.from = covered.to;
        ++i;
      } else {
        part = free_.back();
        free_.pop_back();
      }
    }
  }

  const ConfigurationSpace<Scalar>& space_;
  std::vector<TakenLine<Scalar>>& lines_;
  std::vector<TakenRegion>& regions_;
  std::vector<std::uint32_t>& order_;  ///< In which regions are asked what they cover.
  std::vector<Part>& free_;            ///< Parts of the present line.
  Scalar gap_;
};

}  // namespace paperproof::octagon_sweep
