#include "oracle/way_out.hpp"

#include "oracle/box_tree.hpp"
#include "oracle/depth.hpp"
#include "oracle/up.hpp"

#include <algorithm>

namespace paperproof::compare::detail {
namespace {

/// Lines that differ by less in their direction are parallel.
constexpr double parallel = 0x1p-46;
/// Of two facets in one line neither covers the other: what differs by no more is one line [m].
constexpr double same_line = 1e-8;

/// The ways w with normal · w < bound, from where the octagon is.
struct HalfPlane {
  Vec2d normal;
  double bound;  ///< [m]
};
using Region = std::vector<HalfPlane>;

/// Part of a line, from the foot of the perpendicular [m].
struct Interval {
  double from;
  double to;
};

Vec2d left_of(const Vec2d& v) { return {-v.y(), v.x()}; }

/// What the barrier covers in configuration space, with `clearance` around it. Exact, and rounded once.
Region covered_by(const Barrier& barrier, std::span<const Vec2d> octagon, double clearance) {
  const int unit = common_unit(*barrier.part, octagon, barrier.end);
  const std::vector<Integer> separations = scaled_separations(*barrier.part, octagon, barrier.end, unit);
  Region region;
  for (const AxisEdge& axis : axis_edges(*barrier.part, octagon)) {
    const Vec2d edge = axis.end - axis.start;
    const double separation = std::ldexp(ratio(separations[region.size()], Integer(1)), 2 * unit) / edge.norm();
    region.push_back({left_of(edge.normalized()), clearance - separation});
  }
  return region;
}

/// What the barrier hides from where the octagon begins: behind the facets that face it, and between the tangents.
Region hidden_by(const Barrier& barrier, double beside) {
  const std::span<const Vec2d> shape = barrier.shape;
  Barrier seen = barrier;
  seen.end = *barrier.from;
  const Region covered = covered_by(seen, shape, 0);
  const HalfPlane& nearest = *std::ranges::min_element(covered, {}, &HalfPlane::bound);  // the larger the separation
  Region hidden{nearest};
  for (const HalfPlane& facet : covered) {
    if (facet.bound < 0) hidden.push_back(facet);
  }
  // No corner is behind the octagon, seen along this normal, so that the tangents are less than half a turn apart.
  const Vec2d ahead = -nearest.normal;
  const auto to_the_left = [&](const Vec2d& way) {
    const double aside = cross_of(ahead, way);
    const double far = std::abs(aside) + std::max(0.0, ahead.dot(way));
    return far > 0 ? aside / far : 0;  // grows with the angle
  };
  const Vec2d from = barrier.from->rounded();
  Vec2d left = ahead;
  Vec2d right = ahead;
  bool any = false;
  for (const Vec2d& vertex : barrier.part->points) {
    for (const Vec2d& corner : shape) {
      const Vec2d way = (vertex - from) - corner;
      if (way == Vec2d::Zero()) continue;
      if (!any || to_the_left(way) > to_the_left(left)) left = way;
      if (!any || to_the_left(way) < to_the_left(right)) right = way;
      any = true;
    }
  }
  hidden.push_back({left_of(left.normalized()), beside});
  hidden.push_back({-left_of(right.normalized()), beside});
  // Seen from where the octagon would be at the end if it stayed: meanwhile the part has moved.
  const Vec2d moved = from - barrier.end.rounded();
  for (HalfPlane& half : hidden) half.bound += half.normal.dot(moved);
  return hidden;
}

/// A line of which every point is looked at: normal · w = bound.
struct EdgeLine {
  explicit EdgeLine(const HalfPlane& edge) : foot(edge.normal * edge.bound), along(left_of(edge.normal)) {}
  Vec2d foot;
  Vec2d along;

  [[nodiscard]] Vec2d at(double place) const { return foot + along * place; }
  /// The part of it that lies in a region, as far as that is within `all`; `from` is not less than `to` where none is.
  /// @param own it bounds the region itself.
  [[nodiscard]] Interval within(const Region& region, Interval all, bool own = false) const {
    for (const HalfPlane& half : region) {
      const double rate = half.normal.dot(along);
      const double left = half.bound - half.normal.dot(foot);
      if (std::abs(rate) < parallel) {
        if (left <= (own ? -same_line : same_line)) return {0, 0};
      } else if (rate > 0) {
        all.to = std::min(all.to, left / rate);
      } else {
        all.from = std::max(all.from, left / rate);
      }
      if (!(all.from < all.to)) break;
    }
    return all;
  }
};

/// What of a part is left when others are taken away.
std::vector<Interval> without(const Interval& whole, std::vector<Interval> taken) {
  std::ranges::sort(taken, {}, &Interval::from);
  std::vector<Interval> left;
  double reached = whole.from;
  for (const Interval& part : taken) {
    if (part.from > reached) left.push_back({reached, part.from});
    reached = std::max(reached, part.to);
  }
  if (reached < whole.to) left.push_back({reached, whole.to});
  return left;
}

/// All barriers as regions of ways from one place.
class Plane {
 public:
  Plane(std::span<const Barrier> barriers, std::span<const Vec2d> octagon, const EndSearch& search) : search_(search) {
    std::vector<Box2> boxes;
    std::vector<std::uint32_t> names;
    const Box2 shape = Box2::around(octagon);
    for (const Barrier& barrier : barriers) {
      if (barrier.from) hidden_.push_back(hidden_by(barrier, search.beside));
      if (!barrier.bars_ends) continue;
      names.push_back(static_cast<std::uint32_t>(covered_.size()));
      covered_.push_back(covered_by(barrier, octagon, search.clearance));
      may_pass_.push_back(!barrier.from);
      if (barrier.exact != barrier.part) {
        // Beside the disc itself there may be room where there is none beside the polygon around it.
        const Axis out = best_axis(*barrier.exact, octagon, barrier.end);
        beside_discs_.emplace_back(out.normal * (search.clearance - out.separation));
      }
      const Box2& box = barrier.part->box;
      const Vec2d seen = barrier.end.rounded();
      boxes.push_back(
          Box2{box.lower - seen - shape.upper, box.upper - seen - shape.lower}.inflated(2 * search.clearance));
    }
    tree_ = BoxTree(boxes, names);
  }

  [[nodiscard]] std::vector<Vec2d> ends() const {
    std::vector<Vec2d> ends = beside_discs_;
    if (!search_.from_inside_only) ends.emplace_back(0, 0);
    for (std::size_t i = 0; i < covered_.size(); ++i) {
      if (search_.from_inside_only && !may_pass_[i]) continue;
      for (const HalfPlane& edge : covered_[i]) add_ends_on(edge, covered_[i], ends);
    }
    if (search_.from_inside_only) return ends;
    for (const Region& region : hidden_)
      for (const HalfPlane& edge : region) add_ends_on(edge, region, ends);
    return ends;
  }

 private:
  /// @param own the region that the edge bounds.
  void add_ends_on(const HalfPlane& edge, const Region& own, std::vector<Vec2d>& ends) const {
    if (!(std::abs(edge.bound) < search_.reach)) return;
    const EdgeLine line(edge);
    const double half = std::sqrt(search_.reach * search_.reach - edge.bound * edge.bound);
    const Interval facet = line.within(own, {-half, half}, true);
    if (!(facet.from < facet.to)) return;
    std::vector<Interval> taken;
    const auto take = [&](const Region& region) {
      if (&region == &own) return;
      const Interval part = line.within(region, facet);
      if (part.from < part.to) taken.push_back(part);
    };
    const Vec2d first = line.at(facet.from);
    const Vec2d last = line.at(facet.to);
    for (const std::uint32_t other : tree_.meeting({first.cwiseMin(last), first.cwiseMax(last)})) take(covered_[other]);
    if (without(facet, taken).empty()) return;  // as most facets inside a large solid: spare them the shadows
    std::ranges::for_each(hidden_, take);
    for (const Interval& part : without(facet, std::move(taken))) {
      ends.push_back(line.at(std::clamp(0.0, part.from, part.to)));
      // Where rounding spoils the nearest end of it, the others may do.
      for (const double share : {0.001, 0.5, 0.999}) ends.push_back(line.at(part.from + share * (part.to - part.from)));
    }
  }

  EndSearch search_;
  std::vector<Region> covered_;
  std::vector<bool> may_pass_;  ///< One for each of `covered_`.
  std::vector<Region> hidden_;
  std::vector<Vec2d> beside_discs_;
  BoxTree tree_;  ///< Of `covered_`.
};

}  // namespace

std::vector<Vec2d> ends_of_ways(std::span<const Barrier> barriers, std::span<const Vec2d> octagon,
                                const EndSearch& search) {
  std::vector<Vec2d> ends = Plane(barriers, octagon, search).ends();
  std::erase_if(ends, [&](const Vec2d& way) { return !(way.norm() <= search.reach); });
  std::ranges::stable_sort(ends, [](const Vec2d& a, const Vec2d& b) { return a.squaredNorm() < b.squaredNorm(); });
  return ends;
}

}  // namespace paperproof::compare::detail
