/// Which definitions of scenery are refused, beside those of a scene file.
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

/// What a scene file can say is in tests/compare/tables/json_scenes.json.
TEST(Refusals, of_what_no_scene_file_has_are_in_words) {
  const Points triangle{{1, 1}, {3, 1}, {1, 3}};
  ColliderDef round = circle({0, 0}, 1);
  round.points.clear();
  EXPECT_EQ(refusal_of({{round}}), "a circle needs exactly 1 point, its centre; it has 0");
  round.points = {{0, 0}, {1, 1}};
  EXPECT_EQ(refusal_of({{round}}), "a circle needs exactly 1 point, its centre; it has 2");
  round.shape = ColliderDef::Shape::polygon;
  round.points = triangle;
  EXPECT_EQ(refusal_of({{round}}), "only a circle has a radius");
  ColliderDef hollow = circle({0, 0}, 9);
  hollow.holes = {triangle};
  EXPECT_EQ(refusal_of({{hollow}}), "a circle cannot have holes");
  EXPECT_TRUE(refusal_of({{one_way(circle({0, 0}, 1), {0, 1})}}).starts_with("a circle cannot be one-way: "));
  EXPECT_EQ(refusal_of({{polygon({{0, 0}, {1, 0}})}}), "the outline needs at least 3 points, it has 2");
  EXPECT_EQ(refusal_of({{chain({{0, 0}})}}), "a chain needs at least 2 points, it has 1");
  for (const double bad : {-1.0, std::nan(""), HUGE_VAL})
    EXPECT_TRUE(refusal_of({{circle({0, 0}, bad)}}).starts_with("the radius of a circle must be above 0 "));
}

TEST(Refusals, coordinates_that_are_not_finite_or_too_far_out_are_named) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string reason = " has a coordinate that is not a finite number of at most 2e6 m";
  for (const double bad : {infinity - infinity, infinity, -infinity, std::nextafter(2e6, 3e6), -1e300}) {
    EXPECT_EQ(refusal_of({{polygon({{0, 0}, {1, bad}, {0, 1}})}}), "point 1" + reason);
    EXPECT_EQ(refusal_of({{{.points = {{0, 0}, {9, 0}, {0, 9}}, .holes = {{{1, 1}, {2, 1}, {bad, 2}}}}}}),
              "point 2 of hole 0" + reason);
    EXPECT_EQ(refusal_of({{one_way(chain({{0, 0}, {1, 0}}), {bad, 1})}}), "one_way" + reason);
    EXPECT_EQ(refusal_of({{circle({bad, 0}, 1)}}), "point 0" + reason);
  }
  EXPECT_EQ(refusal_of({{polygon({{0, 0}, {2e6, 0}, {0, -2e6}})}}), "accepted");
}

}  // namespace
}  // namespace paperproof
