#include "oracle/pair.hpp"

#include "oracle/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace paperproof::compare {

using detail::Convert;
using detail::Integer;
using Point = detail::Point<Integer>;

namespace {

/// The largest depth on a way is closed in on by thirds this often: the interval shrinks to less than rounding.
constexpr int refinements = 90;

/// Above the rounding of a few sums and products of numbers of this size [m].
double margin_at(double size) { return 64 * std::numeric_limits<double>::epsilon() * size; }

double largest(const Vec2d& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace

ExactPair::ExactPair(std::span<const Vec2d> hull) : unit_(detail::lowest_bit_of(hull)) {
  const Convert<Integer> number{unit_};
  const auto exact = [&](const Vec2d& v) { return detail::convert(number, v); };
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const Vec2d& start = hull[k];
    const Vec2d edge = hull[(k + 1) % hull.size()] - start;
    Side side{.edge = exact(hull[(k + 1) % hull.size()]) - exact(start),
              .reach = 0,
              .normal = Vec2d(edge.y(), -edge.x()) / edge.norm(),
              .width = 0};
    for (const Vec2d& corner : hull) {
      side.reach = std::max(side.reach, abs(cross(side.edge, exact(corner) - exact(start))));
      side.width = std::max(side.width, std::abs(side.normal.dot(corner - start)));
    }
    sides_.push_back(std::move(side));
  }
}

Vec2d ExactPair::Part::near(double fraction) const {
  if (fraction == from.fraction) return from.position;
  return from.position + (fraction - from.fraction) / (to.fraction - from.fraction) * (to.position - from.position);
}

/// A character that has arrived waits there until the step ends.
ExactPair::Part ExactPair::part_of(Way way, std::size_t corner, double now, double end) {
  if (corner + 1 < way.size()) return {way[corner], way[corner + 1], now, end, false};
  return {way[corner], {way[corner].position, std::max(end, 1.0)}, now, end, false};
}

template <class Visit>
bool ExactPair::any_part(Way one, Way other, const Visit& visit) {
  std::size_t a = 0;
  std::size_t b = 0;
  double now = 0;
  const auto jumps = [&now](Way way, std::size_t corner) {
    return corner + 1 < way.size() && way[corner + 1].fraction <= now;
  };
  const auto end_of = [](Way way, std::size_t corner) {
    return corner + 1 < way.size() ? way[corner + 1].fraction : std::numeric_limits<double>::infinity();
  };
  while (a + 1 < one.size() || b + 1 < other.size()) {
    const bool one_jumps = jumps(one, a);
    const bool other_jumps = !one_jumps && jumps(other, b);
    const bool at_once = one_jumps || other_jumps;
    const double end = at_once ? now : std::min(end_of(one, a), end_of(other, b));
    Part of_one = part_of(one, a, now, end);
    Part of_other = part_of(other, b, now, end);
    of_one.jump = one_jumps;
    of_other.jump = other_jumps;
    if (visit(of_one, of_other)) return true;
    if (one_jumps || (!at_once && end_of(one, a) == end)) ++a;
    if (other_jumps || (!at_once && end_of(other, b) == end)) ++b;
    now = end;
  }
  return false;
}

/// By the normals of the sides, over the whole of what leads from corner to corner.
bool ExactPair::surely_apart(const Part& one, const Part& other) const {
  const double size = std::max(
      {largest(one.from.position), largest(one.to.position), largest(other.from.position), largest(other.to.position)});
  return std::any_of(sides_.begin(), sides_.end(), [&](const Side& side) {
    const auto range = [&side](const Part& part) {
      return std::minmax({side.normal.dot(part.from.position), side.normal.dot(part.to.position)});
    };
    const auto [one_low, one_high] = range(one);
    const auto [other_low, other_high] = range(other);
    return std::max(one_low - other_high, other_low - one_high) > side.width + margin_at(size + side.width);
  });
}

namespace {

/// A place, times `over`, which is above zero.
struct Spot {
  Point at;
  Integer over;

  friend Spot operator-(const Spot& a, const Spot& b) {
    return {scaled(b.over, a.at) - scaled(a.over, b.at), a.over * b.over};
  }
};

/// The place at a moment of what leads evenly from one corner to the next.
Spot spot_at(const PathPoint& from, const PathPoint& to, double fraction, const Convert<Integer>& place) {
  const Point start = convert(place, from.position);
  const Point end = convert(place, to.position);
  if (fraction == from.fraction) return {start, 1};
  if (fraction == to.fraction) return {end, 1};
  const Convert<Integer> time{
      std::min({detail::lowest_bit(from.fraction), detail::lowest_bit(to.fraction), detail::lowest_bit(fraction)})};
  const Integer all = time(to.fraction) - time(from.fraction);
  return {scaled(all, start) + scaled(time(fraction) - time(from.fraction), end - start), all};
}

}  // namespace

/// Whether the way of the difference of the two, from start to end, leads inside of all sides.
bool ExactPair::meet_on(const Part& one, const Part& other) const {
  if (surely_apart(one, other)) return false;
  int unit = unit_;
  for (const Part* part : {&one, &other})
    unit = std::min({unit, detail::lowest_bit(part->from.position), detail::lowest_bit(part->to.position)});
  const auto spot = [&](const Part& part, bool at_end) {
    if (part.jump) return Spot{detail::convert(Convert<Integer>{unit}, (at_end ? part.to : part.from).position), 1};
    return spot_at(part.from, part.to, at_end ? part.end : part.begin, {unit});
  };
  const Spot start = spot(one, false) - spot(other, false);
  const Spot end = spot(one, true) - spot(other, true);
  std::vector<Integer> before;
  std::vector<Integer> after;
  for (const Side& side : sides_) {
    const Integer reach = (side.reach * start.over * end.over) << (unit_ - unit);
    const Integer start_off = cross(side.edge, start.at) * end.over;
    const Integer end_off = cross(side.edge, end.at) * start.over;
    for (const int sign : {1, -1}) {
      // Inside where above zero. What is right of the edge is beyond it.
      before.push_back(sign * start_off + reach);
      after.push_back(sign * end_off + reach);
      if (before.back() <= 0 && after.back() <= 0) return false;
    }
  }
  return detail::enters_all<Integer>(before, after) == detail::Answer::yes;
}

bool ExactPair::overlap(const Vec2d& one, const Vec2d& other) const { return meet_between(one, other, one, other); }

bool ExactPair::meet_between(const Vec2d& one_from, const Vec2d& other_from, const Vec2d& one_to,
                             const Vec2d& other_to) const {
  return meet_on({{one_from, 0}, {one_to, 1}, 0, 1}, {{other_from, 0}, {other_to, 1}, 0, 1});
}

bool ExactPair::meet(Way one, Way other) const {
  return any_part(one, other, [this](const Part& a, const Part& b) { return meet_on(a, b); });
}

double ExactPair::separation_of(const Vec2d& difference) const {
  double best = -std::numeric_limits<double>::infinity();
  for (const Side& side : sides_) best = std::max(best, std::abs(side.normal.dot(difference)) - side.width);
  return best;
}

double ExactPair::separation(const Vec2d& one, const Vec2d& other) const { return separation_of(one - other); }

/// On a straight way the separation is convex: there is one deepest place, closed in on by thirds.
double ExactPair::deepest(Way one, Way other) const {
  double deepest = 0;
  any_part(one, other, [&](const Part& a, const Part& b) {
    const auto ends = [](const Part& part) {
      return part.jump ? std::pair(part.from.position, part.to.position)
                       : std::pair(part.near(part.begin), part.near(part.end));
    };
    const auto [one_from, one_to] = ends(a);
    const auto [other_from, other_to] = ends(b);
    const Vec2d start = one_from - other_from;
    const Vec2d way = (one_to - other_to) - start;
    const auto depth_at = [&](double t) { return -separation_of(start + t * way); };
    double low = 0;
    double high = 1;
    for (int i = 0; i < refinements; ++i) {
      const double third = (high - low) / 3;
      if (depth_at(low + third) < depth_at(high - third))
        low += third;
      else
        high -= third;
    }
    deepest = std::max({deepest, depth_at(0), depth_at(1), depth_at((low + high) / 2)});
    return false;
  });
  return deepest;
}

}  // namespace paperproof::compare
