/// Which definitions of scenery are refused, and in which words.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "exact_reference.hpp"
#include "random_polygons.hpp"
#include "scenery_definitions.hpp"
#include "support/steps_wanted.hpp"

namespace paperproof {
namespace {

using test::Points;
using test::Polygon;
using test::Rational;
using test::refusal_of;
using test::scenery_of;
using test::Where;
using test::where_is;

/// Do two sides have a point in common that they need not have? Solves for it in rational numbers, apart from the
/// cases on one line, and so shares nothing with the check under test.
bool sides_meet(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  const test::ExactPoint p(a), q(b), r(c), s(d);
  const Rational ux = q.x - p.x, uy = q.y - p.y, vx = s.x - r.x, vy = s.y - r.y;
  const Rational wx = r.x - p.x, wy = r.y - p.y;
  const Rational determinant = ux * vy - uy * vx;
  if (determinant != 0) {
    const Rational along_first = (wx * vy - wy * vx) / determinant;
    const Rational along_second = (wx * uy - wy * ux) / determinant;
    return along_first >= 0 && along_first <= 1 && along_second >= 0 && along_second <= 1;
  }
  if (ux * wy - uy * wx != 0) return false;
  const Rational length = ux * ux + uy * uy;
  const Rational from = (wx * ux + wy * uy) / length;
  const Rational to = from + (vx * ux + vy * uy) / length;
  return std::max(from, to) >= 0 && std::min(from, to) <= 1;
}

bool is_simple(const Points& ring) {
  const std::size_t size = ring.size();
  for (std::size_t i = 0; i < size; ++i) {
    if (ring[i] == ring[(i + 1) % size]) return false;
  }
  for (std::size_t i = 0; i < size; ++i) {
    const Vec2d& end = ring[(i + 1) % size];
    for (std::size_t j = i + 1; j < size; ++j) {
      const bool follows = j == i + 1;
      const bool precedes = (j + 1) % size == i;
      if (!follows && !precedes) {
        if (sides_meet(ring[i], end, ring[j], ring[(j + 1) % size])) return false;
      }
      // Neighbours share one point; more only where the second runs back along the first.
      if (follows && sides_meet(ring[i], end, 0.5 * (end + ring[(j + 1) % size]), ring[(j + 1) % size])) return false;
      if (follows && sides_meet(ring[i], 0.5 * (ring[i] + end), end, ring[(j + 1) % size])) return false;
    }
    const Vec2d& after = ring[(i + 2) % size];
    const Vec2d back = ring[i] - end;
    const Vec2d on = after - end;
    if (back.x() * on.y() == back.y() * on.x() && back.dot(on) > 0) return false;
  }
  return true;
}

TEST(Refusals, exactly_the_rings_that_touch_or_cross_themselves_are_refused) {
  int valid = 0;
  int invalid = 0;
  constexpr int cases = test::sampled(20000);
  for (unsigned seed = 0; seed < cases; ++seed) {
    test::Random random(seed);
    Points ring(3 + random.index(4));
    for (Vec2d& vertex : ring)
      vertex = Vec2d{static_cast<double>(random.index(5)), static_cast<double>(random.index(5))};
    const bool simple = is_simple(ring);
    ASSERT_EQ(refusal_of(scenery_of(Polygon{ring, {}})) == "accepted", simple) << "seed " << seed;
    ++(simple ? valid : invalid);
  }
  EXPECT_GE(valid, cases * 3 / 20);
  EXPECT_GE(invalid, cases * 3 / 20);
}

TEST(Refusals, exactly_the_holes_that_are_strictly_inside_are_accepted) {
  int valid = 0;
  int invalid = 0;
  constexpr int cases = test::sampled(20000);
  for (unsigned seed = 0; seed < cases; ++seed) {
    test::Random random(seed);
    const Points outer{{0, 0}, {8, 0}, {8, 8}, {4, 3}, {0, 8}};
    Points hole(3);
    for (Vec2d& vertex : hole) {
      vertex = Vec2d{static_cast<double>(random.index(9)) - 0.5, static_cast<double>(random.index(8))};
    }
    if (!is_simple(hole)) continue;
    bool inside = true;
    for (std::size_t i = 0; i < hole.size(); ++i) {
      inside = inside && where_is(hole[i], outer) == Where::inside;
      for (std::size_t j = 0; j < outer.size(); ++j) {
        inside = inside && !sides_meet(hole[i], hole[(i + 1) % 3], outer[j], outer[(j + 1) % outer.size()]);
      }
    }
    ASSERT_EQ(refusal_of(scenery_of(Polygon{outer, {hole}})) == "accepted", inside) << "seed " << seed;
    ++(inside ? valid : invalid);
  }
  EXPECT_GE(valid, cases / 25);
  EXPECT_GE(invalid, cases / 25);
}

TEST(Refusals, reasons_are_words_a_level_designer_understands) {
  const Points square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto polygon = [&](const Points& ring) { return refusal_of(scenery_of(Polygon{ring, {}})); };
  const auto with_holes = [&](const std::vector<Points>& holes) {
    return refusal_of(scenery_of(Polygon{square, holes}));
  };
  EXPECT_EQ(polygon({{0, 0}, {1, 0}}), "the outline needs at least 3 points, it has 2");
  EXPECT_EQ(polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}),
            "the outline has the same point twice in a row: points 1 and 2 (counted from 0) are both (1, 0)");
  EXPECT_EQ(polygon({{0, 0}, {1, 1}, {3, 3}}), "the outline has no area: all its points are on one line");
  EXPECT_EQ(polygon({{0, 0}, {4, 0}, {2, 0}, {2, 2}}), "the outline folds back onto itself at (4, 0)");
  EXPECT_EQ(polygon({{0, 0}, {2, 2}, {2, 0}, {0, 2}}),
            "the outline crosses itself: the side from (0, 0) to (2, 2) meets the side from (2, 0) to (0, 2)");
  EXPECT_EQ(polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}).find("the outline touches itself: "), 0U);
  EXPECT_EQ(with_holes({{{5, 5}, {6, 5}, {5, 6}}}), "hole 0 is not inside the outline");
  EXPECT_EQ(with_holes({{{1, 1}, {5, 1}, {1, 2}}}).find("hole 0 crosses the outline: "), 0U);
  EXPECT_EQ(with_holes({{{0, 1}, {1, 1}, {1, 2}}}).find("hole 0 touches the outline: "), 0U);
  EXPECT_EQ(with_holes({{{1, 1}, {3, 1}, {1, 3}}, {{1.25, 1.25}, {1.5, 1.25}, {1.25, 1.5}}}),
            "hole 1 is inside hole 0");
  EXPECT_EQ(with_holes({{{1, 1}, {3, 1}, {1, 3}}, {{2, 0.5}, {2, 1.5}, {3, 0.5}}}).find("hole 1 crosses hole 0: "), 0U);
  EXPECT_EQ(refusal_of({{{.points = square, .one_way = Vec2d(0, 0)}}}), "one_way is zero: it must point somewhere");
  EXPECT_EQ(refusal_of({{{.points = square, .one_way = Vec2d(0, 1), .sensor = true}}}), "a sensor cannot be one-way");
  EXPECT_EQ(refusal_of({{{.points = {{0, 0}, {2, 2}, {2, 0}, {0, 2}}, .one_way = Vec2d(0, 1)}}}),
            "the outline crosses itself: the side from (0, 0) to (2, 2) meets the side from (2, 0) to (0, 2)");
  EXPECT_EQ(refusal_of(scenery_of({{0, 0}}, {})), "a chain needs at least 2 points, it has 1");
  EXPECT_EQ(refusal_of(scenery_of({{0, 0}, {0, 0}}, {})),
            "the chain has the same point twice in a row: points 0 and 1 (counted from 0) are both (0, 0)");
  EXPECT_EQ(refusal_of(scenery_of({{0, 0}, {1, 0}}, Vec2d(0, 0))), "one_way is zero: it must point somewhere");
}

TEST(Refusals, coordinates_that_are_not_finite_or_too_far_out_are_named) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string reason = " has a coordinate that is not a finite number of at most 2e6 m";
  for (const double bad : {nan, infinity, -infinity, std::nextafter(2e6, 3e6), -1e300}) {
    EXPECT_EQ(refusal_of(scenery_of(Polygon{{{0, 0}, {1, bad}, {0, 1}}, {}})), "point 1" + reason);
    EXPECT_EQ(refusal_of<float>(scenery_of(Polygon{{{0, 0}, {1, bad}, {0, 1}}, {}})), "point 1" + reason);
    EXPECT_EQ(refusal_of(scenery_of(Polygon{{{0, 0}, {9, 0}, {0, 9}}, {{{1, 1}, {2, 1}, {bad, 2}}}})),
              "point 2 of hole 0" + reason);
    EXPECT_EQ(refusal_of(scenery_of({{0, 0}, {1, 0}}, Vec2d(bad, 1))), "one_way" + reason);
  }
  EXPECT_EQ(refusal_of(scenery_of(Polygon{{{0, 0}, {2e6, 0}, {0, -2e6}}, {}})), "accepted");
}

TEST(Refusals, the_collider_that_was_refused_is_named) {
  SceneryDef def;
  for (int i = 0; i < 3; ++i) def.colliders.push_back({.points = {{0, 0}, {1, 0}, {0, 1}}});
  def.colliders[2].points.pop_back();
  try {
    const Scenery<double> scenery(def);
    FAIL() << "accepted";
  } catch (const InvalidScenery& refused) {
    EXPECT_EQ(refused.collider(), 2U);
  }
}

}  // namespace
}  // namespace paperproof
