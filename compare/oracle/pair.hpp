/// Two characters of one shape, exactly.
#pragma once

#include "oracle/exact.hpp"
#include "oracle/number.hpp"

#include <paperproof/report.hpp>

#include <boost/multiprecision/cpp_int.hpp>

#include <optional>
#include <span>
#include <vector>

namespace paperproof::compare {

using Rational = boost::multiprecision::cpp_rational;

/// Two open convex shapes overlap where no edge of either has the other wholly outside: with one shape twice these are
/// its edges, looked at from both sides. Every double is the rational it is, places between two corners of a way are
/// exact, and nothing is shared with the controller. What doubles show to be far apart is decided there, with a margin
/// above their rounding. Immutable; may be shared between threads.
class ExactPair {
 public:
  /// @param hull of both, in order, relative to the position [m].
  explicit ExactPair(std::span<const Vec2d> hull);

  [[nodiscard]] bool overlap(const Vec2d& one, const Vec2d& other) const;

  /// Whether they overlap on the straight way from one pair of places to another.
  [[nodiscard]] bool meet_between(const Vec2d& one_from, const Vec2d& other_from, const Vec2d& one_to,
                                  const Vec2d& other_to) const;

  /// Whether they overlap at any moment of a step. Both go evenly between the corners of their ways; parts that take no
  /// time come one after the other, those of the one first.
  /// @param one,other from fraction 0 to 1.
  [[nodiscard]] bool meet(std::span<const PathPoint> one, std::span<const PathPoint> other) const;

  /// Along the best axis, rounded [m]; negative: how deep they overlap.
  [[nodiscard]] double separation(const Vec2d& one, const Vec2d& other) const;

  /// The largest depth at any moment of two ways, rounded [m]; 0 where they do not overlap.
  [[nodiscard]] double deepest(std::span<const PathPoint> one, std::span<const PathPoint> other) const;

 private:
  using Point = detail::Point<Rational>;
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

    [[nodiscard]] Point at(double fraction) const;
    [[nodiscard]] Vec2d near(double fraction) const;  ///< The same, rounded.
    [[nodiscard]] Point first() const { return jump ? exact(from.position) : at(begin); }
    [[nodiscard]] Point last() const { return jump ? exact(to.position) : at(end); }
  };
  using Way = std::span<const PathPoint>;

  /// Calls `visit(part, part)` for what the two do at the same time, in order, until it returns true.
  template <class Visit>
  static bool any_part(Way one, Way other, const Visit& visit);
  [[nodiscard]] static Part part_of(Way way, std::size_t corner, double now, double end);
  [[nodiscard]] static Point exact(const Vec2d& v) { return {Rational(v.x()), Rational(v.y())}; }
  [[nodiscard]] bool surely_apart(const Part& one, const Part& other) const;
  [[nodiscard]] bool meet_on(const Part& one, const Part& other) const;
  /// Whether the way of the difference of the two, from start to end, leads inside.
  [[nodiscard]] bool leads_inside(const Point& start, const Point& end) const;
  [[nodiscard]] double separation_of(const Vec2d& difference) const;

  std::vector<Side> sides_;
};

}  // namespace paperproof::compare
