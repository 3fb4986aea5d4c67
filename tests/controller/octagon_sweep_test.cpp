/// When octagon_sweep meets something, against the formula of each scene.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace paperproof::stepping {
namespace {

constexpr double degree = std::numbers::pi / 180;
/// The gap that is promised at a contact [m].
constexpr double largest_gap = 1e-6;

/// How far the article's octagon reaches along a unit vector [m].
double reach_along(const Vec2d& n) {
  const CharacterShape shape = CharacterShape::article();
  double reach = 0;
  for (const Vec2d& point : shape.points()) reach = std::max(reach, n.dot(point));
  return reach;
}

TEST(ArticleScene, the_pixel_meets_the_platform_after_six_tenths_of_its_step) {
  // 30 px of 50 px: t = 0.6. The article's platform is 5 px thick, so both ends of the step are free.
  CharacterDef pixel;
  pixel.shape = single_pixel();
  Stepper<double> bullet({rectangle(-100 * px, -5 * px, 100 * px, 0)}, pixel);
  const MoveResult<double>& move = bullet.at(0, 30.5 * px).fly(0, -50 * px);
  ASSERT_EQ(move.contacts.size(), 1U);
  EXPECT_NEAR(move.contacts[0].fraction, 0.6, 1e-12);
  EXPECT_EQ(move.contacts[0].normal, Vec2d(0, 1));
  EXPECT_EQ(move.contacts[0].side, Side::bottom);
  const double gap = move.position.y() - 0.5 * px;
  EXPECT_GT(gap, 0);
  EXPECT_LE(gap, largest_gap);
  EXPECT_NEAR(move.contacts[0].separation, gap, 1e-15);
  EXPECT_NEAR(move.contacts[0].point.y(), 0, 1e-15);
  EXPECT_EQ(move.velocity, Vec2d(0, 0));
}

TEST(ArticleScene, is_the_same_at_every_speed) {
  CharacterDef pixel;
  pixel.shape = single_pixel();
  for (const double speed : {30.5, 31.0, 50.0, 1e3, 1e4, 1e5, 3e7}) {  // px per step
    Stepper<double> bullet({rectangle(-9, -5 * px, 9, 0)}, pixel);
    const MoveResult<double>& move = bullet.at(0, 30.5 * px).fly(0, -speed * px);
    ASSERT_EQ(move.contacts.size(), 1U) << speed;
    EXPECT_NEAR(move.contacts[0].fraction * speed / 30, 1, 1e-12) << speed;
    EXPECT_GT(move.position.y(), 0.5 * px);
    EXPECT_LE(move.position.y(), 0.5 * px + largest_gap);
  }
}

TEST(GrazingImpact, comes_after_distance_over_speed_times_sine) {
  constexpr double distance = 0.25;
  for (const double angle : {10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 0.003, 0.001}) {
    const double sine = std::sin(angle * degree);
    const double length = 2 * distance / sine;  // would take it as far in as it is away
    Stepper<double> flyer({rectangle(half_width + distance, -10, half_width + distance + 1, 1.1 * length)});
    const MoveResult<double>& move = flyer.at(0, 0).fly(length * sine, length * std::cos(angle * degree));
    ASSERT_EQ(move.contacts.size(), 1U) << angle;
    EXPECT_NEAR(move.contacts[0].fraction * length * sine / distance, 1, 1e-9) << angle << " degrees";
    EXPECT_EQ(move.contacts[0].side, Side::right);
    // It stops at the gap, although the way to it is 1 / sin longer; then it goes on along the wall.
    EXPECT_LT(move.position.x(), distance);
    EXPECT_GE(move.position.x(), distance - largest_gap);
    EXPECT_GT(move.position.y(), 0);
  }
}

/// A wall of 1 cm with its face `distance` from the octagon's nearest point at the origin, n towards the wall.
ColliderDef wall_facing(const Vec2d& n, double distance) {
  const double face = reach_along(n) + distance;
  const auto at = [&n](double along_normal, double along_wall) {
    return Vec2d{along_normal * n.x() - along_wall * n.y(), along_normal * n.y() + along_wall * n.x()};
  };
  return polygon({at(face, -9), at(face + 0.01, -9), at(face + 0.01, 9), at(face, 9)});
}

TEST(RotatedWall, is_met_after_distance_over_speed_along_its_normal) {
  constexpr double distance = 1.5;
  double least = 1;
  double most = 0;
  for (int tenths = 0; tenths <= 900; ++tenths) {
    const double angle = tenths * 0.1 * degree;
    const Vec2d n{std::cos(angle), std::sin(angle)};
    const double off = 0.4;  // [rad] between the way and the normal
    const Vec2d way = Vec2d{std::cos(angle + off), std::sin(angle + off)} * 4;
    Stepper<double> flyer({wall_facing(n, distance)});
    const MoveResult<double>& move = flyer.at(0, 0).fly(way.x(), way.y());
    ASSERT_FALSE(move.contacts.empty()) << tenths;
    const double expected = distance / way.dot(n);
    ASSERT_NEAR(move.contacts[0].fraction / expected, 1, 1e-12) << tenths << " tenths of a degree";
    ASSERT_NEAR(move.contacts[0].normal.dot(n), -1, 1e-15);
    least = std::min(least, move.contacts[0].fraction);
    most = std::max(most, move.contacts[0].fraction);
    const double gap = distance - move.position.dot(n);
    ASSERT_GT(gap, 0) << "it never gets past the face";
  }
  EXPECT_LE(most - least, 1e-12 * most) << "the angle between way and wall is always the same";
}

TEST(ParallelPass, is_no_contact_however_near) {
  for (const double clearance : {0.0, 1e-9, 1e-8, 1e-7, 1e-6, 1e-3, 0.03}) {
    Stepper<double> flyer({rectangle(half_width + clearance, -10, 9, 100)});
    const MoveResult<double>& move = flyer.at(0, 0).fly(0, 10);
    EXPECT_TRUE(move.contacts.empty()) << clearance;
    EXPECT_EQ(move.position.y(), 10) << clearance;
    EXPECT_EQ(move.velocity, Vec2d(0, 10)) << clearance;
    if (clearance >= 1e-7)
      EXPECT_EQ(move.position.x(), 0) << clearance;
    else
      EXPECT_NEAR(move.position.x(), clearance - Tolerances<double>{}.stop, 1e-12) << "room was made at the start";
  }
}

/// Past the upper right corner of a box, so that the left foot meets it or not.
MoveResult<double> past_a_corner(double top) {
  Stepper<double> flyer({rectangle(-2.25, top - 2, -0.25, top)});
  return flyer.at(-2, 2).fly(4, -4);
}

TEST(CornerAgainstCorner, is_met_if_the_swept_octagon_comes_nearer_than_a_contact) {
  // Along (1, 1): the position stays at 0, the left foot (-5, -20) px at -25 px, and so does the corner (-8 px, top).
  const double touching = -25 * px + 0.25;
  const auto hits = [&](double nearer) { return !past_a_corner(touching + nearer).contacts.empty(); };
  // Around the corner the octagon's normals are (0, 1) and (2, 1) / sqrt(5). Where both separations are the hit
  // distance h, x = (sqrt(5) - 1) / 2 h and y = h: along (1, 1) that corner reaches (1 + sqrt(5)) / 2 h further.
  const double reach = (1 + std::sqrt(5.0)) / 2 * Tolerances<double>{}.hit;
  EXPECT_TRUE(hits(px));
  EXPECT_TRUE(hits(1e-6));
  EXPECT_FALSE(hits(-1e-6)) << "clear by more than what counts as a contact";
  EXPECT_TRUE(hits(-0.99 * reach));
  EXPECT_FALSE(hits(-1.01 * reach));
  EXPECT_EQ(past_a_corner(touching - 1e-6).position, Vec2d(2, -2)) << "and not held up";
}

TEST(CornerAgainstCorner, an_ulp_to_either_side_leaves_the_corner_free) {
  const double touching = -25 * px + 0.25;
  double top = touching;
  for (int i = 0; i < 8; ++i) top = std::nextafter(top, -1.0);
  for (int ulps = -8; ulps <= 8; ++ulps, top = std::nextafter(top, 1.0)) {
    const MoveResult<double> move = past_a_corner(top);
    for (const PathPoint<double>& corner : move.path) {
      // Every number here is a small multiple of 2^-60: long double adds them without rounding.
      const long double along = (static_cast<long double>(corner.position.x()) + corner.position.y()) - 25.0L / 32;
      const bool beside = corner.position.x() - 10.0L / 32 >= -0.25L;
      const bool above = corner.position.y() - 20.0L / 32 >= static_cast<long double>(top);
      EXPECT_TRUE(along >= -0.25L + static_cast<long double>(top) || beside || above)
          << ulps << " ulps, at " << corner.position.transpose();
    }
  }
}

TEST(SeveralWalls, the_first_one_stops_and_the_others_are_not_met) {
  std::vector<ColliderDef> papers;
  for (int i = 5; i >= 1; --i) papers.push_back(chain({{1.0 * i, -9}, {1.0 * i, 9}}));
  Stepper<double> flyer(papers);
  const MoveResult<double>& move = flyer.at(0, 0).fly(100, 0);
  ASSERT_EQ(move.contacts.size(), 1U);
  EXPECT_EQ(move.contacts[0].collider, 4U) << "the nearest, which was placed last";
  EXPECT_NEAR(move.contacts[0].fraction, (1 - half_width) / 100, 1e-15);
}

TEST(Float, meets_the_scenes_within_its_own_tolerances) {
  CharacterDef pixel;
  pixel.shape = single_pixel();
  Stepper<float> bullet({rectangle(-100 * px, -5 * px, 100 * px, 0)}, pixel);
  const MoveResult<float>& move = bullet.at(0, 30.5 * px).fly(0, -50 * px);
  ASSERT_EQ(move.contacts.size(), 1U);
  EXPECT_NEAR(move.contacts[0].fraction, 0.6F, 4 * std::numeric_limits<float>::epsilon());
  EXPECT_GT(move.position.y(), 0.5F * px);
  EXPECT_LE(move.position.y(), 0.5F * px + Tolerances<float>{}.touch);

  int met = 0;
  for (int tenths = 0; tenths <= 900; ++tenths) {
    const double angle = tenths * 0.1 * degree;
    const Vec2d n{std::cos(angle), std::sin(angle)};
    Stepper<float> flyer({wall_facing(n, 1.5)});
    const MoveResult<float>& into = flyer.at(0, 0).fly(n.x() * 3, n.y() * 3);
    if (into.contacts.empty()) continue;
    ++met;
    // Vertices up to 9.3 m away are rounded by half of 2^-20 m, which the face turns into as much; then a few ulp.
    EXPECT_NEAR(into.contacts[0].fraction, 0.5, 4e-6 / 3) << tenths;
    EXPECT_LT(into.position.cast<double>().dot(n), 1.5) << tenths;
  }
  EXPECT_EQ(met, 901) << "of 901 walls in float";
}

TEST(RiseBelowAMicrometre, beside_the_feet_is_reported_with_the_gap_that_is_there) {
  // Falls straight down beside a rise that is too small for a facet of its own: the slanted side between foot and arm,
  // with normal (-2, 1) / sqrt(5), is what the rise is near to. At (0, rise) that side is
  // ((-2 x + y) - rise - 30 px) / sqrt(5) away.
  constexpr double rise = 8e-7;
  constexpr double aside = 8e-7;
  Stepper<double> faller({rectangle(-4, -1, 0, 0), rectangle(0, -1, 4, rise)});
  const MoveResult<double>& move = faller.at(-5 * px - aside, 1).fly(0, -1);
  ASSERT_EQ(move.contacts.size(), 2U);
  for (const Contact<double>& contact : move.contacts) {
    const bool is_rise = contact.collider == 1;
    const Vec2d normal = is_rise ? Vec2d(Vec2d{-2, 1} / std::sqrt(5.0)) : Vec2d{0, 1};
    EXPECT_LE((contact.normal - normal).norm(), 1e-15);
    const Vec2d& p = move.position;
    const double gap = is_rise ? (-2 * p.x() + p.y() - rise - 30 * px) / std::sqrt(5.0) : p.y() - half_height;
    EXPECT_NEAR(contact.separation, gap, 1e-15);
    EXPECT_GT(contact.separation, 0);
    EXPECT_LE(contact.separation, largest_gap);
  }
}

}  // namespace
}  // namespace paperproof::stepping
