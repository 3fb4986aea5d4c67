#include "oracle/pair.hpp"

#include "oracle/number.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace paperproof::compare {
namespace {

/// The largest depth on a way is closed in on by thirds this often: the interval shrinks to less than rounding.
constexpr int refinements = 90;

/// Above the rounding of a few sums and products of numbers of this size [m].
double margin_at(double size) { return 64 * std::numeric_limits<double>::epsilon() * size; }

double largest(const Vec2d& v) { return v.cwiseAbs().maxCoeff(); }

using Rational = boost::multiprecision::cpp_rational;
using Point = detail::Point<Rational>;
using Corners = std::span<const PathPoint>;

Point exact(const Vec2d& v) { return {Rational(v.x()), Rational(v.y())}; }

/// An edge of the shape: the two are apart along it where |edge x difference| is at least `reach`.
struct Side {
  Point edge;
  Rational reach;
  Vec2d normal;  ///< Unit, to the right of the edge; rounded, as the width is.
  double width;  ///< Of the shape along the normal [m].
};

/// From `begin` to `end` of what leads evenly from one corner to the next; a jump takes no time and goes all the way.
struct Part {
  PathPoint from;
  PathPoint to;
  double begin = 0;
  double end = 0;
  bool jump = false;

  [[nodiscard]] Point first() const { return jump ? exact(from.position) : at(begin); }
  [[nodiscard]] Point last() const { return jump ? exact(to.position) : at(end); }
  [[nodiscard]] Point at(double fraction) const {
    if (fraction == from.fraction) return exact(from.position);
    if (fraction == to.fraction) return exact(to.position);
    const Rational share =
        (Rational(fraction) - Rational(from.fraction)) / (Rational(to.fraction) - Rational(from.fraction));
    const Point start = exact(from.position);
    const Point way = exact(to.position) - start;
    return {start.x + way.x * share, start.y + way.y * share};
  }
  /// The same, rounded.
  [[nodiscard]] Vec2d near(double fraction) const {
    if (fraction == from.fraction) return from.position;
    return from.position + (fraction - from.fraction) / (to.fraction - from.fraction) * (to.position - from.position);
  }
};

/// A character that has arrived waits there until the step ends.
Part part_of(Corners way, std::size_t corner, double now, double end, bool jump) {
  if (corner + 1 < way.size()) return {way[corner], way[corner + 1], now, end, jump};
  return {way[corner], {way[corner].position, std::max(end, 1.0)}, now, end, jump};
}

/// Calls `visit(part, part)` for what the two do at the same time, in order, until it returns true.
template <class Visit>
bool any_part(Corners one, Corners other, const Visit& visit) {
  std::size_t a = 0;
  std::size_t b = 0;
  double now = 0;
  const auto jumps = [&now](Corners way, std::size_t corner) {
    return corner + 1 < way.size() && way[corner + 1].fraction <= now;
  };
  const auto end_of = [](Corners way, std::size_t corner) {
    return corner + 1 < way.size() ? way[corner + 1].fraction : std::numeric_limits<double>::infinity();
  };
  while (a + 1 < one.size() || b + 1 < other.size()) {
    const bool one_jumps = jumps(one, a);
    const bool other_jumps = !one_jumps && jumps(other, b);
    const bool at_once = one_jumps || other_jumps;
    const double end = at_once ? now : std::min(end_of(one, a), end_of(other, b));
    if (visit(part_of(one, a, now, end, one_jumps), part_of(other, b, now, end, other_jumps))) return true;
    if (one_jumps || (!at_once && end_of(one, a) == end)) ++a;
    if (other_jumps || (!at_once && end_of(other, b) == end)) ++b;
    now = end;
  }
  return false;
}

}  // namespace

struct ExactPair::Impl {
  std::vector<Side> sides;

  explicit Impl(std::span<const Vec2d> hull) {
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const Vec2d& start = hull[k];
      const Vec2d edge = hull[(k + 1) % hull.size()] - start;
      Side side{.edge = exact(hull[(k + 1) % hull.size()]) - exact(start),
                .reach = 0,
                .normal = Vec2d(edge.y(), -edge.x()) / edge.norm(),
                .width = 0};
      for (const Vec2d& corner : hull) {
        side.reach = std::max(side.reach, Rational(abs(cross(side.edge, exact(corner) - exact(start)))));
        side.width = std::max(side.width, std::abs(side.normal.dot(corner - start)));
      }
      sides.push_back(std::move(side));
    }
  }

  /// By the normals of the sides, over the whole of what leads from corner to corner.
  [[nodiscard]] bool surely_apart(const Part& one, const Part& other) const {
    const double size = std::max({largest(one.from.position), largest(one.to.position), largest(other.from.position),
                                  largest(other.to.position)});
    return std::ranges::any_of(sides, [&](const Side& side) {
      const auto range = [&side](const Part& part) {
        return std::minmax({side.normal.dot(part.from.position), side.normal.dot(part.to.position)});
      };
      const auto [one_low, one_high] = range(one);
      const auto [other_low, other_high] = range(other);
      return std::max(one_low - other_high, other_low - one_high) > side.width + margin_at(size + side.width);
    });
  }

  /// Whether the way of the difference of the two, from start to end, leads inside.
  /// Cyrus and Beck 1978, with strict insides: what is left of the way's parameters after every side is more than a
  /// point, or the way is a single point that is inside.
  [[nodiscard]] bool leads_inside(const Point& start, const Point& end) const {
    Rational entry = 0;
    Rational exit = 1;
    const bool still = start.x == end.x && start.y == end.y;
    for (const Side& side : sides) {
      const Rational start_off = cross(side.edge, start);
      const Rational end_off = cross(side.edge, end);
      for (const int sign : {1, -1}) {
        // Inside where above zero. What is right of the edge is beyond it.
        const Rational before = start_off * sign + side.reach;
        const Rational after = end_off * sign + side.reach;
        if (before <= 0 && after <= 0) return false;
        if (still) continue;
        if (before <= 0) entry = std::max(entry, Rational(before / (before - after)));
        if (after <= 0) exit = std::min(exit, Rational(before / (before - after)));
      }
    }
    return still || entry < exit;
  }

  [[nodiscard]] bool meet_on(const Part& one, const Part& other) const {
    return !surely_apart(one, other) && leads_inside(one.first() - other.first(), one.last() - other.last());
  }

  [[nodiscard]] double separation_of(const Vec2d& difference) const {
    double best = -std::numeric_limits<double>::infinity();
    for (const Side& side : sides) best = std::max(best, std::abs(side.normal.dot(difference)) - side.width);
    return best;
  }
};

ExactPair::ExactPair(std::span<const Vec2d> hull) : impl_(std::make_shared<const Impl>(hull)) {}

bool ExactPair::overlap(const Vec2d& one, const Vec2d& other) const { return meet_between(one, other, one, other); }

bool ExactPair::meet_between(const Vec2d& one_from, const Vec2d& other_from, const Vec2d& one_to,
                             const Vec2d& other_to) const {
  return impl_->meet_on({{one_from, 0}, {one_to, 1}, 0, 1}, {{other_from, 0}, {other_to, 1}, 0, 1});
}

bool ExactPair::meet(Corners one, Corners other) const {
  return any_part(one, other, [this](const Part& a, const Part& b) { return impl_->meet_on(a, b); });
}

double ExactPair::separation(const Vec2d& one, const Vec2d& other) const { return impl_->separation_of(one - other); }

bool ExactPair::recedes(const Vec2d& at, const Vec2d& from, const Vec2d& to) const {
  constexpr double noise = 1e-12;
  const double farthest = separation(at, from) - noise;
  return std::ranges::any_of(impl_->sides, [&](const auto& side) {
    const double begins = side.normal.dot(at - from);
    const double ends = side.normal.dot(at - to) * (begins < 0 ? -1 : 1);
    return std::abs(begins) - side.width >= farthest && ends >= std::abs(begins) - noise;
  });
}

/// On a straight way the separation is convex: there is one deepest place, closed in on by thirds.
double ExactPair::deepest(Corners one, Corners other) const {
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
    const auto depth_at = [&](double t) { return -impl_->separation_of(start + t * way); };
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
