#include <gtest/gtest.h>
#include <paperproof/character.hpp>

#include <cmath>
#include <limits>
#include <random>

#include "exact_reference.hpp"
#include "support/steps_wanted.hpp"

namespace paperproof {
namespace {

using Points = std::vector<Vec2d>;

Points points_of(const CharacterShape& shape, CharacterShape::Pair pair) {
  return {shape.points()[pair[0]], shape.points()[pair[1]]};
}

std::string refusal_of(const Points& points) {
  try {
    const CharacterShape shape(points);
  } catch (const InvalidCharacter& refused) {
    return refused.what();
  }
  return "accepted";
}

TEST(CharacterShape, the_articles_character_is_centred_with_y_up) {
  const CharacterShape shape = CharacterShape::article(32);
  const Points sprite_px{{5, 0}, {15, 0}, {5, 40}, {15, 40}, {0, 10}, {0, 30}, {20, 10}, {20, 30}};
  const Vec2d centre_px(20 / 2.0, 40 / 2.0);
  ASSERT_EQ(shape.points().size(), sprite_px.size());
  for (std::size_t i = 0; i < sprite_px.size(); ++i) {
    EXPECT_EQ(shape.points()[i].x(), (sprite_px[i].x() - centre_px.x()) / 32);
    EXPECT_EQ(shape.points()[i].y(), (centre_px.y() - sprite_px[i].y()) / 32);
  }
  EXPECT_EQ(shape.box().lower, Vec2d(-10.0 / 32, -20.0 / 32));
  EXPECT_EQ(shape.box().upper, Vec2d(10.0 / 32, 20.0 / 32));
}

TEST(CharacterShape, the_pairs_of_the_articles_character_are_head_feet_and_arms) {
  const CharacterShape shape = CharacterShape::article(1);
  EXPECT_EQ(points_of(shape, shape.pair(Side::top)), (Points{{-5, 20}, {5, 20}}));
  EXPECT_EQ(points_of(shape, shape.pair(Side::bottom)), (Points{{-5, -20}, {5, -20}}));
  EXPECT_EQ(points_of(shape, shape.pair(Side::left)), (Points{{-10, -10}, {-10, 10}}));
  EXPECT_EQ(points_of(shape, shape.pair(Side::right)), (Points{{10, -10}, {10, 10}}));
}

TEST(CharacterShape, a_side_that_is_a_corner_has_the_same_point_twice) {
  const CharacterShape diamond(Points{{0, 2}, {-1, 0}, {0, -2}, {1, 0}});
  EXPECT_EQ(diamond.pair(Side::top), (CharacterShape::Pair{0, 0}));
  EXPECT_EQ(diamond.pair(Side::left), (CharacterShape::Pair{1, 1}));
  EXPECT_EQ(diamond.pair(Side::bottom), (CharacterShape::Pair{2, 2}));
  EXPECT_EQ(diamond.pair(Side::right), (CharacterShape::Pair{3, 3}));
}

TEST(CharacterShape, pairs_do_not_depend_on_the_order_of_the_points) {
  Points points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  do {
    const CharacterShape shape(points);
    EXPECT_EQ(points_of(shape, shape.pair(Side::top)), (Points{{-1, 1}, {1, 1}}));
    EXPECT_EQ(points_of(shape, shape.pair(Side::bottom)), (Points{{-1, -1}, {1, -1}}));
    EXPECT_EQ(points_of(shape, shape.pair(Side::left)), (Points{{-1, -1}, {-1, 1}}));
    EXPECT_EQ(points_of(shape, shape.pair(Side::right)), (Points{{1, -1}, {1, 1}}));
    EXPECT_EQ(Points(shape.hull().begin(), shape.hull().end()), (Points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}));
  } while (std::next_permutation(points.begin(), points.end(), [](const Vec2d& a, const Vec2d& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  }));
}

/// Every triple of the given points decides whether they are all corners; the shape must come to the same answer.
TEST(CharacterShape, it_accepts_exactly_the_points_that_are_all_corners_of_their_hull) {
  constexpr unsigned seed = 7;
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> coordinate(-4, 4);
  std::uniform_int_distribution<std::size_t> count(3, 6);
  int accepted = 0;
  int refused = 0;
  constexpr int cases = test::sampled(20000);
  for (int i = 0; i < cases; ++i) {
    Points points(count(random));
    for (Vec2d& point : points) point = Vec2d{coordinate(random), coordinate(random)};
    // A point is a corner exactly if it lies in no triangle, segment or point made of the others.
    const auto covered = [&](std::size_t p) {
      for (std::size_t a = 0; a < points.size(); ++a) {
        for (std::size_t b = 0; b < points.size(); ++b) {
          for (std::size_t c = 0; c < points.size(); ++c) {
            if (a == p || b == p || c == p) continue;
            const auto turn = [&](std::size_t u, std::size_t v, std::size_t w) {
              const Vec2d to_v = points[v] - points[u];
              const Vec2d to_w = points[w] - points[u];
              return to_v.x() * to_w.y() - to_v.y() * to_w.x();
            };
            const bool inside = turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0;
            const bool in_reach = points[p].x() >= std::min({points[a].x(), points[b].x(), points[c].x()}) &&
                                  points[p].x() <= std::max({points[a].x(), points[b].x(), points[c].x()}) &&
                                  points[p].y() >= std::min({points[a].y(), points[b].y(), points[c].y()}) &&
                                  points[p].y() <= std::max({points[a].y(), points[b].y(), points[c].y()});
            if (inside && in_reach) return true;
          }
        }
      }
      return false;
    };
    bool all_corners = true;
    for (std::size_t p = 0; p < points.size(); ++p) all_corners = all_corners && !covered(p);
    ASSERT_EQ(refusal_of(points) == "accepted", all_corners) << "seed " << seed << ", case " << i;
    if (!all_corners) {
      ++refused;
      continue;
    }
    ++accepted;
    const CharacterShape shape(points);
    const std::span<const Vec2d> hull = shape.hull();
    ASSERT_EQ(hull.size(), points.size());
    for (std::size_t k = 0; k < hull.size(); ++k) {
      ASSERT_GT(test::cross(test::ExactPoint(hull[k]), test::ExactPoint(hull[(k + 1) % hull.size()]),
                            test::ExactPoint(hull[(k + 2) % hull.size()])),
                0);
      ASSERT_TRUE(hull[0].y() < hull[k].y() || (hull[0].y() == hull[k].y() && hull[0].x() <= hull[k].x()));
    }
  }
  EXPECT_GE(accepted, cases / 20);
  EXPECT_GE(refused, cases / 20);
}

TEST(CharacterShape, a_point_one_bit_inside_a_side_is_told_from_one_that_is_one_bit_outside) {
  const double inside = std::nextafter(1.0, 0.0);
  const double outside = std::nextafter(1.0, 2.0);
  EXPECT_EQ(refusal_of({{0, 0}, {1, 0}, {outside, 0.5}, {1, 1}}), "accepted");
  EXPECT_NE(refusal_of({{0, 0}, {1, 0}, {1, 0.5}, {1, 1}}), "accepted");
  EXPECT_NE(refusal_of({{0, 0}, {1, 0}, {inside, 0.5}, {1, 1}}), "accepted");
}

TEST(CharacterShape, refusals_say_what_is_wrong) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(refusal_of({{0, 0}, {1, 0}}), "a character has 3 to 8 points, this one has 2");
  EXPECT_EQ(refusal_of(Points(9, Vec2d(0, 0))), "a character has 3 to 8 points, this one has 9");
  EXPECT_EQ(refusal_of({{0, 0}, {1, 0}, {0, 0}}), "point 2 of the character repeats point 0");
  for (const double bad : {nan, infinity, -infinity, 3e6}) {
    EXPECT_EQ(refusal_of({{0, 0}, {bad, 0}, {0, 1}}),
              "point 1 of the character is not a finite length of at most 2e6 m");
    EXPECT_EQ(refusal_of({{0, 0}, {1, 0}, {0, bad}}),
              "point 2 of the character is not a finite length of at most 2e6 m");
  }
  const Points triangle{{0, 0}, {1, 0}, {0, 1}};
  for (const double bad : {0.0, -32.0, nan, infinity}) {
    EXPECT_THROW((void)CharacterShape::from_pixels(triangle, bad), InvalidCharacter);
  }
  EXPECT_THROW((void)CharacterShape::from_pixels(Points{}, 32), InvalidCharacter);
}

TEST(CharacterDef, the_defaults_are_valid) { EXPECT_NO_THROW(CharacterDef{}.validate()); }

TEST(CharacterDef, every_value_out_of_range_is_named) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  struct Field {
    const char* name;
    void (*set)(CharacterDef&, double);
    std::vector<double> good;
    std::vector<double> bad;
  };
  const std::vector<double> zero_or_more{0, 1.5};
  const std::vector<double> not_zero_or_more{-1, -5e-324, nan, infinity};
  const std::vector<Field> fields{
      {"walk_speed", [](CharacterDef& def, double value) { def.walk_speed = value; }, zero_or_more, not_zero_or_more},
      {"acceleration", [](CharacterDef& def, double value) { def.acceleration = value; }, zero_or_more,
       not_zero_or_more},
      {"air_acceleration", [](CharacterDef& def, double value) { def.air_acceleration = value; }, zero_or_more,
       not_zero_or_more},
      {"jump_speed", [](CharacterDef& def, double value) { def.jump_speed = value; }, zero_or_more, not_zero_or_more},
      {"max_fall_speed", [](CharacterDef& def, double value) { def.max_fall_speed = value; }, zero_or_more,
       not_zero_or_more},
      {"max_climb_degrees",
       [](CharacterDef& def, double value) { def.max_climb_degrees = value; },
       {0, 50, 89},
       {-1, 89.5, nan, infinity}},
      {"snap", [](CharacterDef& def, double value) { def.snap = value; }, zero_or_more, not_zero_or_more},
      {"coyote_time", [](CharacterDef& def, double value) { def.coyote_time = value; }, zero_or_more, not_zero_or_more},
      {"jump_buffer", [](CharacterDef& def, double value) { def.jump_buffer = value; }, zero_or_more, not_zero_or_more},
      {"jump_cut", [](CharacterDef& def, double value) { def.jump_cut = value; }, {0, 0.5, 1}, {-0.1, 1.1, nan}},
  };
  for (const Field& field : fields) {
    for (const double value : field.good) {
      CharacterDef def;
      field.set(def, value);
      EXPECT_NO_THROW(def.validate()) << field.name << " = " << value;
    }
    for (const double value : field.bad) {
      CharacterDef def;
      field.set(def, value);
      try {
        def.validate();
        FAIL() << field.name << " = " << value << " was accepted";
      } catch (const InvalidCharacter& refused) {
        EXPECT_EQ(std::string(refused.what()).find(std::string(field.name) + " must be "), 0U) << refused.what();
      }
    }
  }
}

}  // namespace
}  // namespace paperproof
