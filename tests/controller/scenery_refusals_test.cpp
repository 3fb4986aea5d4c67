/// Which definitions of scenery are refused, and in which words.
#include <gtest/gtest.h>

#include <boost/geometry.hpp>

#include <cmath>
#include <limits>

#include "campaign/shapes.hpp"
#include "random_polygons.hpp"
#include "scenery_definitions.hpp"
#include "support/steps_wanted.hpp"

namespace paperproof {
namespace {

using compare::chain;
using compare::circle;
using compare::polygon;
using test::one_way;
using test::Points;
using test::refusal_of;

ColliderDef with_holes(const Points& outline, const std::vector<Points>& holes) {
  return {.points = outline, .holes = holes};
}
ColliderDef circle_of(const Points& points) {
  return {.shape = ColliderDef::Shape::circle, .points = points, .radius = 1};
}

/// As a closed line. Coordinates are whole numbers: nothing is rounded.
bool is_simple(const Points& ring) {
  boost::geometry::model::linestring<boost::geometry::model::d2::point_xy<double>> line;
  for (const Vec2d& vertex : ring) line.emplace_back(vertex.x(), vertex.y());
  line.push_back(line.front());
  return boost::geometry::is_simple(line);
}

TEST(Refusals, exactly_the_rings_that_touch_or_cross_themselves_are_refused) {
  int valid = 0;
  const unsigned cases = test::sampled(20000U);
  for (unsigned seed = 0; seed < cases; ++seed) {
    test::Random random(seed);
    Points ring(3 + random.index(4));
    for (Vec2d& vertex : ring)
      vertex = Vec2d{static_cast<double>(random.index(5)), static_cast<double>(random.index(5))};
    const bool simple = is_simple(ring);
    ASSERT_EQ(refusal_of({{polygon(ring)}}) == "accepted", simple) << "seed " << seed;
    valid += simple;
  }
  EXPECT_GE(valid, cases * 3 / 20);
  EXPECT_LE(valid, cases * 17 / 20);
}

TEST(Refusals, reasons_are_words_a_level_designer_understands) {
  const Points square{{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const Points triangle{{1, 1}, {3, 1}, {1, 3}};
  const Points crossed{{0, 0}, {2, 2}, {2, 0}, {0, 2}};
  const std::string crosses =
      "the outline crosses itself: the side from (0, 0) to (2, 2) meets the side from (2, 0) to (0, 2)";
  ColliderDef one_way_sensor = one_way(polygon(square), {0, 1});
  one_way_sensor.sensor = true;
  ColliderDef hollow = circle({0, 0}, 9);
  hollow.holes = {triangle};
  ColliderDef round_box = polygon(square);
  round_box.radius = 1;
  struct Refused {
    ColliderDef def;
    std::string reason;  ///< Or how it begins, with a blank at its end.
  };
  std::vector<Refused> all{
      {polygon({{0, 0}, {1, 0}}), "the outline needs at least 3 points, it has 2"},
      {polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}}),
       "the outline has the same point twice in a row: points 1 and 2 (counted from 0) are both (1, 0)"},
      {polygon({{0, 0}, {1, 1}, {3, 3}}), "the outline has no area: all its points are on one line"},
      {polygon({{0, 0}, {4, 0}, {2, 0}, {2, 2}}), "the outline folds back onto itself at (4, 0)"},
      {polygon(crossed), crosses},
      {one_way(polygon(crossed), {0, 1}), crosses},
      {polygon({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}), "the outline touches itself: "},
      {with_holes(square, {{{5, 5}, {6, 5}, {5, 6}}}), "hole 0 is not inside the outline"},
      {with_holes(square, {{{1, 1}, {5, 1}, {1, 2}}}), "hole 0 crosses the outline: "},
      {with_holes(square, {{{0, 1}, {1, 1}, {1, 2}}}), "hole 0 touches the outline: "},
      {with_holes(square, {{{1, 1}, {3, 1}, {4, 2}}}), "hole 0 touches the outline: "},
      {with_holes(square, {{{1, 1}, {1, 3}, {std::nextafter(4, 0), 2}}}), "accepted"},
      {with_holes(square, {triangle, {{1.25, 1.25}, {1.5, 1.25}, {1.25, 1.5}}}), "hole 1 is inside hole 0"},
      {with_holes(square, {triangle, {{2, 0.5}, {2, 1.5}, {3, 0.5}}}), "hole 1 crosses hole 0: "},
      {one_way(polygon(square), {0, 0}), "one_way is zero: it must point somewhere"},
      {one_way(chain({{0, 0}, {1, 0}}), {0, 0}), "one_way is zero: it must point somewhere"},
      {one_way_sensor, "a sensor cannot be one-way"},
      {chain({{0, 0}}), "a chain needs at least 2 points, it has 1"},
      {chain({{0, 0}, {0, 0}}),
       "the chain has the same point twice in a row: points 0 and 1 (counted from 0) are both (0, 0)"},
      {circle_of({}), "a circle needs exactly 1 point, its centre; it has 0"},
      {circle_of({{0, 0}, {1, 1}}), "a circle needs exactly 1 point, its centre; it has 2"},
      {hollow, "a circle cannot have holes"},
      {one_way(circle({0, 0}, 1), {0, 1}), "a circle cannot be one-way: "},
      {round_box, "only a circle has a radius"}};
  for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL, 3e6})
    all.push_back({circle({0, 0}, bad), "the radius of a circle must be above 0 and at most 2e6 m, not "});
  for (const auto& [def, reason] : all) {
    const std::string said = refusal_of({{def}});
    EXPECT_EQ(reason.ends_with(' ') ? said.substr(0, reason.size()) : said, reason);
  }
}

TEST(Refusals, coordinates_that_are_not_finite_or_too_far_out_are_named) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string reason = " has a coordinate that is not a finite number of at most 2e6 m";
  for (const double bad : {infinity - infinity, infinity, -infinity, std::nextafter(2e6, 3e6), -1e300}) {
    EXPECT_EQ(refusal_of({{polygon({{0, 0}, {1, bad}, {0, 1}})}}), "point 1" + reason);
    EXPECT_EQ(refusal_of({{with_holes({{0, 0}, {9, 0}, {0, 9}}, {{{1, 1}, {2, 1}, {bad, 2}}})}}),
              "point 2 of hole 0" + reason);
    EXPECT_EQ(refusal_of({{one_way(chain({{0, 0}, {1, 0}}), {bad, 1})}}), "one_way" + reason);
    EXPECT_EQ(refusal_of({{circle({bad, 0}, 1)}}), "point 0" + reason);
  }
  EXPECT_EQ(refusal_of({{polygon({{0, 0}, {2e6, 0}, {0, -2e6}})}}), "accepted");
}

TEST(Refusals, the_collider_that_was_refused_is_named) {
  const ColliderDef good = compare::box(0, 0, 1, 1);
  try {
    const Scenery scenery(SceneryDef{{good, good, polygon({{0, 0}, {1, 0}})}});
    FAIL() << "accepted";
  } catch (const InvalidScenery& refused) {
    EXPECT_EQ(refused.collider(), 2U);
  }
}

}  // namespace
}  // namespace paperproof
