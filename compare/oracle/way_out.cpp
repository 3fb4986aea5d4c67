#include "oracle/way_out.hpp"

#include "oracle/box_tree.hpp"
#include "oracle/depth.hpp"

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
double cross_of(const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// What the obstacle covers in configuration space, with `clearance` around it.
Region covered_by(const Obstacle& obstacle, std::span<const Vec2d> octagon, double clearance) {
  const Vec2d seen = obstacle.place.rounded();
  Region region;
  for (const AxisEdge& axis : axis_edges(*obstacle.part, octagon)) {
    const Vec2d normal = left_of(Vec2d(axis.end - axis.start).normalized());
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vec2d& vertex : obstacle.part->points) farthest = std::max(farthest, normal.dot(Vec2d(vertex - seen)));
    double nearest = std::numeric_limits<double>::infinity();
    for (const Vec2d& corner : octagon) nearest = std::min(nearest, normal.dot(corner));
    region.push_back({normal, farthest - nearest + clearance});
  }
  return region;
}

/// What the obstacle hides: behind the facets that face the octagon, and between the tangents.
Region hidden_by(const Obstacle& obstacle, std::span<const Vec2d> octagon, double beside) {
  const Region covered = covered_by(obstacle, octagon, 0);
  const HalfPlane& nearest = *std::min_element(covered.begin(), covered.end(), [](const auto& a, const auto& b) {
    return a.bound < b.bound;  // the larger the separation
  });
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
  const Vec2d seen = obstacle.place.rounded();
  Vec2d left = ahead;
  Vec2d right = ahead;
  bool any = false;
  for (const Vec2d& vertex : obstacle.part->points) {
    for (const Vec2d& corner : octagon) {
      const Vec2d way = (vertex - seen) - corner;
      if (way == Vec2d::Zero()) continue;
      if (!any || to_the_left(way) > to_the_left(left)) left = way;
      if (!any || to_the_left(way) < to_the_left(right)) right = way;
      any = true;
    }
  }
  hidden.push_back({left_of(left.normalized()), beside});
  hidden.push_back({-left_of(right.normalized()), beside});
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
  std::sort(taken.begin(), taken.end(), [](const Interval& a, const Interval& b) { return a.from < b.from; });
  std::vector<Interval> left;
  double reached = whole.from;
  for (const Interval& part : taken) {
    if (part.from > reached) left.push_back({reached, part.from});
    reached = std::max(reached, part.to);
  }
  if (reached < whole.to) left.push_back({reached, whole.to});
  return left;
}

/// All obstacles as regions of ways from one place.
class Plane {
 public:
  Plane(std::span<const Barrier> barriers, std::span<const Vec2d> octagon, double clearance, double beside) {
    std::vector<Box2<double>> boxes;
    std::vector<std::uint32_t> names;
    const Box2<double> shape = Box2<double>::around(octagon);
    for (const Barrier& barrier : barriers) {
      const Obstacle& obstacle = barrier.obstacle;
      if (barrier.bars != Bars::ends) hidden_.push_back(hidden_by(obstacle, octagon, beside));
      if (barrier.bars == Bars::ways) continue;
      names.push_back(static_cast<std::uint32_t>(covered_.size()));
      covered_.push_back(covered_by(obstacle, octagon, clearance));
      may_pass_.push_back(barrier.bars == Bars::ends);
      const Box2<double>& box = obstacle.part->box;
      const Vec2d seen = obstacle.place.rounded();
      boxes.push_back(
          Box2<double>{box.lower - seen - shape.upper, box.upper - seen - shape.lower}.inflated(2 * clearance));
    }
    tree_ = BoxTree(std::move(boxes), std::move(names));
  }

  void add_ends(double reach, std::vector<Vec2d>& ends) const {
    for (std::size_t i = 0; i < covered_.size(); ++i) {
      if (!may_pass_[i]) continue;
      for (const HalfPlane& edge : covered_[i]) add_ends_on(edge, i, reach, ends);
    }
  }

 private:
  void add_ends_on(const HalfPlane& edge, std::size_t own, double reach, std::vector<Vec2d>& ends) const {
    if (!(std::abs(edge.bound) < reach)) return;
    const EdgeLine line(edge);
    const double half = std::sqrt(reach * reach - edge.bound * edge.bound);
    const Interval facet = line.within(covered_[own], {-half, half}, true);
    if (!(facet.from < facet.to)) return;
    std::vector<Interval> taken;
    const auto take = [&](const Region& region) {
      const Interval part = line.within(region, facet);
      if (part.from < part.to) taken.push_back(part);
    };
    const Vec2d first = line.at(facet.from);
    const Vec2d last = line.at(facet.to);
    for (const std::uint32_t other : tree_.meeting({first.cwiseMin(last), first.cwiseMax(last)})) {
      if (other != own) take(covered_[other]);
    }
    if (without(facet, taken).empty()) return;  // as most facets inside a large solid: spare them the shadows
    std::for_each(hidden_.begin(), hidden_.end(), take);
    for (const Interval& part : without(facet, std::move(taken))) {
      ends.push_back(line.at(std::clamp(0.0, part.from, part.to)));
      // Where rounding spoils the nearest end of it, the others may do.
      for (const double share : {0.001, 0.5, 0.999}) ends.push_back(line.at(part.from + share * (part.to - part.from)));
    }
  }

  std::vector<Region> covered_;
  std::vector<bool> may_pass_;  ///< One for each of `covered_`.
  std::vector<Region> hidden_;
  BoxTree tree_;  ///< Of `covered_`.
};

}  // namespace

std::vector<Vec2d> ways_out(std::span<const Barrier> barriers, std::span<const Vec2d> octagon, const Vec2d& at,
                            double reach, double clearance, double beside) {
  std::vector<Vec2d> ends;
  Plane(barriers, octagon, clearance, beside).add_ends(reach, ends);
  std::erase_if(ends, [&](const Vec2d& way) { return !(way.norm() <= reach); });
  std::stable_sort(ends.begin(), ends.end(),
                   [](const Vec2d& a, const Vec2d& b) { return a.squaredNorm() < b.squaredNorm(); });
  for (Vec2d& end : ends) end += at;
  return ends;
}

}  // namespace paperproof::compare::detail
