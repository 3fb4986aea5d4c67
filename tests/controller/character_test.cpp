#include <gtest/gtest.h>
#include <paperproof/character.hpp>

#include <boost/geometry.hpp>
#include <cmath>
#include <limits>
#include <span>
#include <variant>

#include "campaign/random.hpp"
#include "support/exact_points.hpp"
#include "support/refusal.hpp"
#include "support/steps_wanted.hpp"
#include "techniques/side_points.hpp"

namespace paperproof {
namespace {

using Points = std::vector<Vec2d>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Of head, feet, left and right arm.
std::vector<Points> pairs_of(const CharacterShape& shape) {
  std::vector<Points> pairs;
  for (const Side side : {Side::top, Side::bottom, Side::left, Side::right}) {
    const auto [first, second] = points_of_side(shape.points(), side);
    pairs.push_back({shape.points()[first], shape.points()[second]});
  }
  return pairs;
}

/// What is said to this, or "accepted".
template <class Make>
std::string refusal(const Make& make) {
  return test::refusal_by<InvalidCharacter>(make, "accepted");
}
std::string refusal_of(const Points& points) {
  return refusal([&] { return CharacterShape(points); });
}

TEST(CharacterShape, the_articles_character_is_centred_with_y_up) {
  const CharacterShape shape = CharacterShape::article(1);
  const Points centred{{-5, 20}, {5, 20}, {-5, -20}, {5, -20}, {-10, 10}, {-10, -10}, {10, 10}, {10, -10}};
  EXPECT_EQ(Points(shape.points().begin(), shape.points().end()), centred);
  EXPECT_EQ(pairs_of(shape),
            (std::vector<Points>{
                {{-5, 20}, {5, 20}}, {{-5, -20}, {5, -20}}, {{-10, -10}, {-10, 10}}, {{10, -10}, {10, 10}}}));
  EXPECT_EQ(CharacterShape::article(32).box().lower, Vec2d(-10, -20) / 32);
  EXPECT_EQ(CharacterShape::article(32).box().upper, Vec2d(10, 20) / 32);
}

TEST(CharacterShape, a_side_that_is_a_corner_has_the_same_point_twice) {
  const CharacterShape diamond(Points{{0, 2}, {-1, 0}, {0, -2}, {1, 0}});
  EXPECT_EQ(pairs_of(diamond),
            (std::vector<Points>{{{0, 2}, {0, 2}}, {{0, -2}, {0, -2}}, {{-1, 0}, {-1, 0}}, {{1, 0}, {1, 0}}}));
}

/// Coordinates are whole numbers: nothing is rounded.
bool all_are_corners(const Points& points) {
  using Point = boost::geometry::model::d2::point_xy<double>;
  boost::geometry::model::multi_point<Point> all;
  for (const Vec2d& point : points) all.emplace_back(point.x(), point.y());
  boost::geometry::model::ring<Point> hull;  // closed
  boost::geometry::convex_hull(all, hull);
  return hull.size() == points.size() + 1 && boost::geometry::area(hull) != 0;
}

TEST(CharacterShape, it_accepts_exactly_the_points_that_are_all_corners_of_their_hull) {
  constexpr unsigned seed = 7;
  compare::Random random(seed);
  int accepted = 0;
  const int cases = test::sampled(20000);
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", case " << i);
    Points points(static_cast<std::size_t>(random.integer(3, 6)));
    for (Vec2d& point : points) point = Vec2d{random.integer(-4, 4), random.integer(-4, 4)};
    const bool all_corners = all_are_corners(points);
    ASSERT_EQ(refusal_of(points) == "accepted", all_corners);
    if (!all_corners) continue;
    ++accepted;
    const CharacterShape shape(points);
    const std::span<const Vec2d> hull = shape.hull();
    ASSERT_TRUE(std::is_permutation(hull.begin(), hull.end(), points.begin(), points.end()));
    for (std::size_t k = 0; k < hull.size(); ++k) {
      const auto corner = [&](std::size_t later) { return test::ExactPoint(hull[(k + later) % hull.size()]); };
      ASSERT_GT(test::cross(corner(0), corner(1), corner(2)), 0);
      ASSERT_TRUE(hull[0].y() < hull[k].y() || (hull[0].y() == hull[k].y() && hull[0].x() <= hull[k].x()));
    }
  }
  EXPECT_GE(accepted, cases / 20);
  EXPECT_LE(accepted, cases * 19 / 20);
}

TEST(CharacterShape, refusals_say_what_is_wrong) {
  const double inside = std::nextafter(1.0, 0.0);
  const double outside = std::nextafter(1.0, 2.0);
  const std::string no_corner = "the points of a character must all be corners of their convex hull";
  const std::string no_length = " of the character is not a finite length of at most 2e6 m";
  const std::vector<std::pair<Points, std::string>> refusals{
      {{{0, 0}, {1, 0}}, "a character has 3 to 8 points, this one has 2"},
      {Points(9, Vec2d(0, 0)), "a character has 3 to 8 points, this one has 9"},
      {{{0, 0}, {1, 0}, {0, 0}}, "point 2 of the character repeats point 0"},
      {{{0, 0}, {1, 0}, {outside, 0.5}, {1, 1}}, "accepted"},
      {{{0, 0}, {1, 0}, {1, 0.5}, {1, 1}}, no_corner},
      {{{0, 0}, {1, 0}, {inside, 0.5}, {1, 1}}, no_corner},
      {{{0, 0}, {2e6, 0}, {0, -2e6}}, "accepted"}};
  for (const auto& [points, what] : refusals) EXPECT_EQ(refusal_of(points), what);
  for (const double bad : {nan, infinity, -infinity, std::nextafter(2e6, 3e6)}) {
    EXPECT_EQ(refusal_of({{0, 0}, {bad, 0}, {0, 1}}), "point 1" + no_length);
    EXPECT_EQ(refusal_of({{0, 0}, {1, 0}, {0, bad}}), "point 2" + no_length);
  }
  for (const double bad : {0.0, -32.0, nan, infinity})
    EXPECT_EQ(refusal([&] {
                return CharacterShape::from_pixels(Points{{0, 0}, {1, 0}, {0, 1}}, bad);
              }),
              "pixels_per_metre must be a finite number above zero");
  EXPECT_THROW((void)CharacterShape::from_pixels(Points{}, 32), InvalidCharacter);
}

TEST(CharacterDef, every_value_out_of_range_is_named) {
  struct Field {
    const char* name;
    std::variant<double CharacterDef::*, std::optional<double> CharacterDef::*> value;
    const char* range = "a finite number, zero or more";
    std::vector<double> good{0, 1.5};
    std::vector<double> bad{-1, -5e-324, nan, infinity};
  };
  const std::vector<Field> fields{
      {"walk_speed", &CharacterDef::walk_speed},
      {"acceleration", &CharacterDef::acceleration},
      {"air_acceleration", &CharacterDef::air_acceleration},
      {"jump_speed", &CharacterDef::jump_speed},
      {"max_fall_speed", &CharacterDef::max_fall_speed},
      {"snap", &CharacterDef::snap},
      {"step_height", &CharacterDef::step_height},
      {"wall_reach", &CharacterDef::wall_reach},
      {"coyote_time", &CharacterDef::coyote_time},
      {"jump_buffer", &CharacterDef::jump_buffer},
      {"jump_cut", &CharacterDef::jump_cut, "from 0 to 1", {0, 1}, {-0.1, 1.1, nan}},
      {"max_climb_degrees", &CharacterDef::max_climb_degrees, "from 0 to 89", {0, 89}, {-1, 89.5, nan, infinity}}};
  for (const Field& field : fields) {
    const auto said = [&field](double value) {
      CharacterDef def;
      std::visit([&](auto member) { def.*member = value; }, field.value);
      return refusal([&def] { def.validate(); });
    };
    for (const double value : field.good) EXPECT_EQ(said(value), "accepted") << field.name << " = " << value;
    const std::string wrong = std::string(field.name) + " must be " + field.range;
    for (const double value : field.bad) EXPECT_EQ(said(value), wrong) << value;
  }
  EXPECT_EQ(refusal([] { CharacterDef{}.validate(); }), "accepted");
}

TEST(CharacterShape, of_points_that_are_gone_is_found_where_sanitizers_look_on) {
  if (!test::sanitized) GTEST_SKIP() << "the core is not sanitized here";
  Points points(8);
  const std::span<const Vec2d> gone = points;
  Points().swap(points);
  EXPECT_DEATH(CharacterShape{gone}, "heap-use-after-free");
}

}  // namespace
}  // namespace paperproof
