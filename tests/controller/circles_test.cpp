/// Circles as obstacles, against the formula of each scene.
#include "geometry/circle.hpp"

#include "controller/together.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace paperproof::stepping {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double frame = 1.0 / 60;
/// The gap that is promised at a contact [m].
constexpr double largest_gap = 1e-6;
/// The shape of the article's character: its foot ends here, and the slanted side above it there [m].
constexpr double foot = 5 * px;
const Vec2d foot_corner{foot, -half_height};
const Vec2d hip{half_width, -10 * px};

ColliderDef circle(double x, double y, double radius, MoverIndex mover = no_mover) {
  return {.shape = ColliderDef::Shape::circle, .points = {{x, y}}, .mover = mover, .radius = radius};
}

/// Inscribed in a circle, or around it.
ColliderDef polygon_like(const ColliderDef& circle, int corners, bool around) {
  const double half = std::numbers::pi / corners;
  std::vector<Vec2d> points;
  for (int i = 0; i < corners; ++i) {
    const Vec2d direction{std::cos(2 * half * i), std::sin(2 * half * i)};
    points.push_back(circle.points[0] + direction * (around ? circle.radius / std::cos(half) : circle.radius));
  }
  return polygon(points);
}

bool is_gap(double gap) { return gap > 0 && gap <= largest_gap; }

// The distance, and the time of approach.

/// By the edges alone, without a case more than a polygon has.
double slow_separation(std::span<const Vec2d> outline, const Vec2d& at, const Circle<double>& circle) {
  const Vec2d centre = circle.centre - at;
  double outside = std::numeric_limits<double>::infinity();
  double inside = -outside;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2d edge = outline[(k + 1) % outline.size()] - outline[k];
    const Vec2d arm = centre - outline[k];
    const double share = std::clamp(arm.dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    outside = std::min(outside, (arm - edge * share).norm());
    inside = std::max(inside, (edge.y() * arm.x() - edge.x() * arm.y()) / edge.norm());
  }
  return (inside < 0 ? inside : outside) - circle.radius;
}

/// Whether this is the normal of no edge.
bool is_corner(std::span<const Vec2d> outline, const Vec2d& normal) {
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const Vec2d edge = outline[(k + 1) % outline.size()] - outline[k];
    if (std::abs(edge.dot(normal)) < 1e-12) return false;
  }
  return true;
}

TEST(NearCircle, has_the_distance_of_a_slow_twin) {
  test::Random random(1);
  int inside = 0;
  int corners = 0;
  const CharacterDef character;
  const std::span<const Vec2d> outline = character.shape.hull();
  for (int i = 0; i < 10'000; ++i) {
    const Circle<double> circle{{random.between(-1, 1), random.between(-1, 1)}, random.log_between(1e-4, 1e3)};
    const Vec2d at = circle.centre + Vec2d{random.between(-1, 1), random.between(-1, 1)};
    const auto near = geometry::near_circle<double>(outline, at, circle);
    ASSERT_NEAR(near.separation, slow_separation(outline, at, circle), 1e-13 * (1 + circle.radius)) << i;
    ASSERT_NEAR(near.normal.norm(), 1, 1e-15);
    // The normal leads to where they just touch.
    const Vec2d out = at - near.normal * near.separation;
    ASSERT_NEAR(slow_separation(outline, out, circle), 0, 1e-12 * (1 + circle.radius)) << i;
    inside += near.separation < -circle.radius;
    corners += is_corner(outline, near.normal);
  }
  EXPECT_GT(inside, 500) << "the centre was inside the outline";
  EXPECT_GT(corners, 2000);
  EXPECT_LT(corners, 7000);
}

TEST(Approach, is_that_of_a_slow_twin_and_never_later) {
  test::Random random(2);
  int hits = 0;
  const CharacterDef character;
  const std::span<const Vec2d> outline = character.shape.hull();
  constexpr int cases = 10'000;
  for (int i = 0; i < cases; ++i) {
    const Circle<double> circle{{random.between(-3, 3), random.between(-3, 3)}, random.log_between(1e-3, 2)};
    const Vec2d from{random.between(-8, 8), random.between(-8, 8)};
    if (slow_separation(outline, from, circle) <= 0.01) continue;
    const Vec2d aim = circle.centre + 2 * Vec2d{random.between(-1, 1), random.between(-1, 1)};
    const Vec2d way = (aim - from) * random.between(0.7, 2);
    const auto separation_at = [&](double time) { return slow_separation(outline, from + way * time, circle); };
    // The separation is convex: a third of the time with the greater end is left out, again and again.
    double low = 0;
    double high = 1;
    for (int k = 0; k < 200; ++k) {
      const double a = low + (high - low) / 3;
      const double b = high - (high - low) / 3;
      (separation_at(a) < separation_at(b) ? high : low) = separation_at(a) < separation_at(b) ? b : a;
    }
    const double nearest = separation_at(low);
    const auto found = geometry::approach<double>(outline, from, way, circle, 0);
    if (std::abs(nearest) < 1e-9) continue;  // too near to tell
    ASSERT_EQ(found.has_value(), nearest < 0) << i;
    if (!found) continue;
    ++hits;
    double free = 0;
    for (double inside = low; inside - free > 1e-15;) {
      const double middle = (free + inside) / 2;
      (separation_at(middle) > 0 ? free : inside) = middle;
      if (middle == free && middle == inside) break;
      if (inside - free < 4e-16) break;
    }
    ASSERT_NEAR(separation_at(found->time), 0, 1e-13) << i;
    ASSERT_NEAR(found->time, free, 1e-6) << i;
    ASSERT_GT(separation_at(found->time), -1e-14) << i;
  }
  EXPECT_GT(hits, cases * 3 / 10);
  EXPECT_LT(hits, cases * 7 / 10);
}

// Landing, sliding, walking.

TEST(LandingOnACircle, ends_on_its_top) {
  Stepper<double> stepper({circle(0, -2, 2)});
  stepper.at(0, 3).steps(120);
  EXPECT_TRUE(stepper.state.grounded);
  EXPECT_EQ(stepper.state.ground.state, GroundState::walkable);
  EXPECT_EQ(stepper.state.ground.normal, Vec2d(0, 1));
  EXPECT_EQ(stepper.state.position.x(), 0);
  EXPECT_TRUE(is_gap(stepper.state.position.y() - half_height));
}

TEST(LandingOnACircle, comes_when_the_corner_of_the_foot_meets_the_arc) {
  // The corner of the foot is 1 m left of the centre: the arc is sqrt(r^2 - 1) above it there.
  const double x = -1 - foot;
  const double touching = std::sqrt(4.0 - 1) + half_height;
  Stepper<double> stepper({circle(0, 0, 2)});
  const MoveResult<double>& move = stepper.at(x, 5).fly(0, -4);
  ASSERT_EQ(move.contacts.size(), 1U);
  const Contact<double>& contact = move.contacts[0];
  EXPECT_NEAR(contact.fraction, (5 - touching) / 4, 1e-14);
  EXPECT_NEAR(contact.normal.x(), -0.5, 1e-6);
  EXPECT_NEAR(contact.normal.norm(), 1, 1e-15);
  EXPECT_NEAR(contact.point.norm(), 2, 1e-15);
  EXPECT_NEAR((contact.point - Vec2d(-1, std::sqrt(3.0))).norm(), 0, 1e-6);
  EXPECT_TRUE(is_gap(contact.separation));
  EXPECT_EQ(contact.side, Side::bottom);
}

TEST(LandingOnACircle, comes_when_the_slanted_side_meets_the_arc) {
  // The side from the foot to the hip faces a small circle along its normal.
  const Vec2d middle = (foot_corner + hip) / 2;
  const Vec2d n = Vec2d{2, -1} / std::sqrt(5.0);
  const double radius = 0.02;
  const double distance = 0.75;
  const Vec2d centre = middle + n * (radius + distance);
  Stepper<double> stepper({circle(centre.x(), centre.y(), radius)});
  const Vec2d way = n * 2;
  const MoveResult<double>& move = stepper.at(0, 0).fly(way.x(), way.y());
  ASSERT_EQ(move.contacts.size(), 1U);
  EXPECT_NEAR(move.contacts[0].fraction, distance / 2, 1e-14);
  EXPECT_NEAR((move.contacts[0].normal + n).norm(), 0, 1e-15);
  EXPECT_NEAR((move.contacts[0].point - (centre - n * radius)).norm(), 0, 1e-6);
}

TEST(GroundOfACircle, is_walkable_up_to_the_climb_limit_and_steep_beyond) {
  for (const double degrees : {0.0, 20.0, 49.0, 51.0, 70.0, 85.0}) {
    const double angle = degrees * std::numbers::pi / 180;
    const Vec2d n{-std::sin(angle), std::cos(angle)};
    Stepper<double> stepper({circle(0, 0, 3)});
    stepper.dt = 1e-3;  // so that it does not slide away from the arc
    const Vec2d touching = n * 3 - Vec2d(foot, -half_height) * (degrees < 63 ? 1 : 0) - hip * (degrees < 63 ? 0 : 1);
    stepper.at(touching.x() + n.x() * 1e-6, touching.y() + n.y() * 1e-6).step();
    EXPECT_EQ(stepper.state.ground.state, degrees < 50 ? GroundState::walkable : GroundState::steep) << degrees;
    EXPECT_EQ(stepper.state.grounded, degrees < 50) << degrees;
    EXPECT_NEAR((stepper.state.ground.normal - n).norm(), 0, 2e-3) << degrees;
  }
}

TEST(SlidingRoundACircle, touches_it_all_the_way_and_keeps_its_gap) {
  // Each step is a tangent, which leaves the arc by its square: the snap follows it down.
  CharacterDef character;
  character.snap = 0.1;
  Stepper<double> stepper({circle(0, -10, 10)}, character);
  stepper.gravity = {0, -30};
  stepper.at(-2, half_height + 1).steps(60);
  ASSERT_TRUE(stepper.state.grounded);
  int grounded = 0;
  for (int i = 0; i < 40; ++i) {
    stepper.step({.move = 1.0});
    grounded += stepper.state.grounded;
    const Vec2d centre = Vec2d(0, -10) - stepper.state.position;
    const double gap =
        slow_separation(stepper.controller.character().shape.hull(), stepper.state.position, {{0, -10}, 10});
    EXPECT_TRUE(is_gap(gap)) << i << ": " << gap << " at " << centre.transpose();
  }
  EXPECT_EQ(grounded, 40);
  EXPECT_GT(stepper.state.position.x(), 1) << "it went over the top";
}

TEST(SlidingRoundACircle, down_a_steep_side_speeds_up_and_lets_go) {
  Stepper<double> stepper({circle(0, 0, 3)});
  stepper.at(2.6, 3.2).steps(30);
  EXPECT_FALSE(stepper.state.grounded);
  EXPECT_GT(stepper.state.velocity.x(), 0);
  EXPECT_LT(stepper.state.velocity.y(), -1);
  stepper.steps(60);
  EXPECT_LT(stepper.state.position.y(), -3);
  EXPECT_EQ(stepper.state.ground.state, GroundState::air);
}

TEST(SlidingRoundACircle, a_hit_takes_the_speed_along_the_normal_and_leaves_the_rest) {
  Stepper<double> stepper({circle(0, 0, 3)});
  const Vec2d way{0, -4};
  const MoveResult<double>& move = stepper.at(2.7, 3.2).fly(way.x(), way.y());
  ASSERT_EQ(move.contacts.size(), 1U);
  const Vec2d n = move.contacts[0].normal;
  EXPECT_NEAR(n.x(), (2.7 - foot) / 3, 1e-6);
  EXPECT_NEAR((move.velocity - (way - n * n.dot(way))).norm(), 0, 1e-12);
}

TEST(BumpOfACircle, is_walked_over_where_it_is_not_steep) {
  // A circle of 4 m that looks out of the floor by 10 cm: it rises by acos(3.9 / 4), 13 degrees.
  CharacterDef character;
  character.snap = 0.1;
  Stepper<double> stepper({rectangle(-9, -1, 9, 0), circle(0, -3.9, 4)}, character);
  stepper.at(-3, half_height + 0.01).steps(30);
  double highest = 0;
  for (int i = 0; i < 90; ++i) {
    stepper.step({.move = 1.0});
    EXPECT_TRUE(stepper.state.grounded) << i;
    highest = std::max(highest, stepper.state.position.y() - half_height);
  }
  EXPECT_NEAR(highest, 0.1, 1e-3);
  EXPECT_GT(stepper.state.position.x(), 3);
  EXPECT_NEAR(stepper.state.position.y(), half_height, largest_gap);
}

TEST(BumpOfACircle, of_a_tenth_of_a_millimetre_stops_nobody_who_climbs_kerbs) {
  for (const double height : {1e-4, 1e-3, 0.05, 0.2}) {
    CharacterDef character;
    character.step_height = 0.3;
    character.snap = 0.3;
    Stepper<double> stepper({rectangle(-9, -1, 9, 0), circle(0, 0, height)}, character);
    stepper.at(-2, half_height + 1e-6).steps(10);
    for (int i = 0; i < 60; ++i) stepper.step({.move = 1.0});
    EXPECT_GT(stepper.state.position.x(), 2) << height;
    EXPECT_TRUE(stepper.state.grounded) << height;
    EXPECT_NEAR(stepper.state.position.y(), half_height, largest_gap) << height;
  }
}

TEST(BumpOfACircle, that_is_steep_stops_a_walk) {
  Stepper<double> stepper({rectangle(-9, -1, 9, 0), circle(0, 0, 0.5)});
  stepper.at(-2, half_height + 1e-6).steps(10);
  for (int i = 0; i < 60; ++i) stepper.step({.move = 1.0});
  EXPECT_LT(stepper.state.position.x(), 0);
  EXPECT_TRUE(stepper.state.grounded);
  EXPECT_NEAR(stepper.state.position.y(), half_height, largest_gap) << "it is no climb";
}

TEST(BetweenTwoCircles, a_fall_ends_in_a_wedge_that_holds) {
  // Too steep to stand on: the sides touch 45 degrees and more up the arcs.
  Stepper<double> stepper({circle(-1.2, 0, 1), circle(1.2, 0, 1)});
  stepper.at(0.1, 3).steps(120);
  EXPECT_TRUE(stepper.state.grounded);
  EXPECT_NEAR(stepper.state.position.x(), 0, 1e-5);
  const Vec2d before = stepper.state.position;
  stepper.steps(1000);
  EXPECT_EQ(stepper.state.position, before) << "not a bit";
  EXPECT_EQ(stepper.state.velocity, Vec2d(0, 0));
  const auto gap = [&](double x) {
    return slow_separation(stepper.controller.character().shape.hull(), stepper.state.position, {{x, 0}, 1});
  };
  EXPECT_TRUE(is_gap(gap(-1.2)));
  EXPECT_TRUE(is_gap(gap(1.2)));
}

TEST(BetweenTwoCircles, with_room_for_its_width_it_falls_through) {
  for (const double room : {1e-6, 1e-3, 0.1}) {
    const double x = 1 + half_width + room;
    Stepper<double> stepper({circle(-x, 0, 1), circle(x, 0, 1)});
    stepper.at(0, 3).steps(120);
    EXPECT_LT(stepper.state.position.y(), -2) << room;
  }
}

TEST(RestOnACircle, changes_no_bit) {
  for (const double x : {0.0, 0.3, -0.7, 1.1}) {
    Stepper<double> stepper({circle(0, -2, 2)});
    stepper.at(x, 1).steps(120);
    ASSERT_TRUE(stepper.state.grounded) << x;
    const CharacterState<double> before = stepper.state;
    stepper.steps(10'000);
    EXPECT_TRUE(same_bits(before, stepper.state)) << x;
  }
}

// Grazing, bullets, sizes.

TEST(GrazingACircle, is_a_contact_only_nearer_than_one) {
  // Flies to the right above a circle: the foot passes at this height over its top.
  for (const double height : {-1e-3, -1e-6, 0.0, 1e-6, 2e-6, 1e-3}) {
    Stepper<double> stepper({circle(0, 0, 1)});
    const MoveResult<double>& move = stepper.at(-4, 1 + half_height + height).fly(8, 0);
    EXPECT_EQ(move.contacts.empty(), height > Tolerances<double>{}.hit) << height;
    if (move.contacts.empty()) {
      EXPECT_EQ(move.position.x(), 4) << height;
    }
    for (std::size_t k = 0; k + 1 < move.path.size(); ++k)
      for (int share = 0; share <= 1000; ++share) {
        const Vec2d at = move.path[k].position + (move.path[k + 1].position - move.path[k].position) * (share / 1000.0);
        ASSERT_GT(slow_separation(stepper.controller.character().shape.hull(), at, {{0, 0}, 1}), 0) << height;
      }
  }
}

TEST(BulletAtACircle, of_a_millimetre_is_stopped_at_any_speed) {
  CharacterDef pixel;
  pixel.shape = single_pixel();
  for (const double radius : {1e-4, 1e-3, 0.01}) {
    for (const double speed : {1.0, 1e2, 1e4, 1e6}) {
      Stepper<double> bullet({circle(0.3, 0, radius)}, pixel);
      const MoveResult<double>& move = bullet.at(-0.5, 0).fly(speed, 0);
      ASSERT_EQ(move.contacts.size(), 1U) << radius << " at " << speed;
      EXPECT_NEAR(move.contacts[0].fraction * speed, 0.8 - radius - px / 2, 1e-9) << radius << " at " << speed;
      EXPECT_TRUE(is_gap(0.3 - radius - px / 2 - move.position.x())) << radius << " at " << speed;
      EXPECT_EQ(move.contacts[0].normal, Vec2d(-1, 0));
    }
  }
}

TEST(BulletAtACircle, passes_a_millimetre_beside_it) {
  CharacterDef pixel;
  pixel.shape = single_pixel();
  for (const double speed : {1.0, 1e2, 1e4, 1e6}) {
    Stepper<double> bullet({circle(0.3, px / 2 + 0.002, 0.001)}, pixel);
    const MoveResult<double>& move = bullet.at(-0.5, 0).fly(speed, 0);
    EXPECT_TRUE(move.contacts.empty()) << speed;
    EXPECT_EQ(move.position.x(), -0.5 + speed) << speed;
  }
}

TEST(CircleOfAHundredKilometres, is_ground_like_a_floor) {
  Stepper<double> stepper({circle(0, -1e5, 1e5)});
  stepper.at(0, 2).steps(120);
  EXPECT_TRUE(stepper.state.grounded);
  EXPECT_TRUE(is_gap(stepper.state.position.y() - half_height));
  for (int i = 0; i < 300; ++i) {
    stepper.step({.move = 1.0});
    ASSERT_TRUE(stepper.state.grounded) << i;
  }
  EXPECT_GT(stepper.state.position.x(), 25);
  EXPECT_NEAR(slow_separation(stepper.controller.character().shape.hull(), stepper.state.position, {{0, -1e5}, 1e5}), 0,
              largest_gap);
}

TEST(CircleFarAway, is_met_as_near_the_origin) {
  for (const Vec2d& origin : {Vec2d(1e6, 0), Vec2d(-1e6, 1e6), Vec2d(12345.678, -98765.4321)}) {
    Stepper<double> stepper({circle(origin.x(), origin.y(), 2)});
    stepper.at(origin.x() + 0.4, origin.y() + 5).steps(120);
    EXPECT_TRUE(stepper.state.grounded);
    const double gap =
        slow_separation(stepper.controller.character().shape.hull(), stepper.state.position, {origin, 2});
    EXPECT_TRUE(is_gap(gap)) << origin.transpose() << ": " << gap;
  }
}

TEST(CircleInFloat, is_landed_on_and_slid_along) {
  Stepper<float> stepper({circle(0, -2, 2)});
  stepper.at(0.25, 3).steps(120);
  EXPECT_TRUE(stepper.state.grounded);
  EXPECT_GT(stepper.state.position.y(), static_cast<float>(half_height) - 0.1F);
  EXPECT_LT(stepper.state.position.y(), static_cast<float>(half_height) + 1e-2F);
  Stepper<float> bullet({circle(0, 0, 1)});
  const MoveResult<float>& move = bullet.at(-4, 0).fly(100, 0);
  ASSERT_EQ(move.contacts.size(), 1U);
  EXPECT_NEAR(move.contacts[0].fraction, (4 - 1 - half_width) / 100, 1e-6);
  EXPECT_LT(move.position.x(), -1 - static_cast<float>(half_width));
}

TEST(CircleInFloat, is_not_entered_by_more_than_its_gap_in_random_play) {
  // Nothing is guaranteed in `float`; near the origin it keeps out all the same.
  test::Random random(5);
  int contacts = 0;
  for (int run = 0; run < 100; ++run) {
    std::vector<ColliderDef> colliders{rectangle(-9, -2, 9, -1), rectangle(-6, -1, -5, 99), rectangle(5, -1, 6, 99)};
    for (int i = random.integer(1, 8); i > 0; --i) {
      const double x = random.between(-4, 4);
      const double y = random.between(-1, 2);
      colliders.push_back(circle(x, y, random.log_between(0.05, 2)));
    }
    Stepper<float> stepper(colliders);
    stepper.at(random.between(-4, 4), 5);
    for (int i = 0; i < 100; ++i) {
      if (random.chance(0.1)) stepper.with_velocity(random.between(-50, 50), -20);
      stepper.step({.move = random.chance(0.5) ? 1.0 : -1.0});
      ASSERT_TRUE(stepper.state.position.allFinite()) << run;
      contacts += static_cast<int>(stepper.report.move.contacts.size());
      const Vec2d at = stepper.state.position.cast<double>();
      for (std::size_t c = 3; c < colliders.size(); ++c) {
        const Circle<double> round{colliders[c].points[0], colliders[c].radius};
        ASSERT_GT(slow_separation(stepper.controller.character().shape.hull(), at, round), -1e-4)
            << "run " << run << ", step " << i;
      }
    }
  }
  EXPECT_GT(contacts, 2000);
}

// Circles that move.

TEST(MovingCircle, pushes_the_character_along) {
  Stepper<double> stepper({circle(-3, 0, 1, 0)});
  stepper.gravity = {0, 0};
  stepper.at(0, 0);
  for (int i = 0; i < 50; ++i) stepper.step_with_mover_by(0.1, 0);
  // Its front is at -3 + 1 + 5 = 3.
  EXPECT_NEAR(stepper.state.position.x(), 3 + half_width, largest_gap);
  EXPECT_EQ(stepper.state.position.y(), 0);
}

TEST(MovingCircle, that_passes_by_a_long_way_in_one_step_hits_at_the_right_time) {
  Stepper<double> stepper({circle(-50, 0, 0.001, 0)});
  stepper.gravity = {0, 0};
  stepper.at(0, 0).step_with_mover_by(100, 0);
  ASSERT_EQ(stepper.report.move.contacts.size(), 1U);
  EXPECT_NEAR(stepper.report.move.contacts[0].fraction, (50 - 0.001 - half_width) / 100, 1e-12);
  EXPECT_NEAR(stepper.state.position.x(), 50 + 0.001 + half_width, largest_gap);
}

TEST(MovingCircle, carries_who_stands_on_it) {
  Stepper<double> stepper({circle(0, -2, 2, 0)});
  stepper.at(0, half_height + 0.01).steps(20);
  ASSERT_TRUE(stepper.state.grounded);
  for (int i = 0; i < 100; ++i) {
    stepper.step_with_mover_by(0.05, i < 50 ? 0.02 : -0.02);
    ASSERT_TRUE(stepper.state.grounded) << i;
  }
  EXPECT_NEAR(stepper.state.position.x(), 5, 1e-9);
  EXPECT_TRUE(is_gap(stepper.state.position.y() - half_height));
  EXPECT_NEAR((stepper.state.ground.velocity - Vec2d(0.05, -0.02) / frame).norm(), 0, 1e-9);
}

TEST(MovingCircle, crushes_against_a_wall) {
  Stepper<double> stepper({circle(-3, 0, 1, 0), rectangle(0.5, -9, 2, 9)});
  stepper.gravity = {0, 0};
  stepper.at(0, 0);
  StepStatus status = StepStatus::moved;
  int steps = 0;
  for (; steps < 40 && status == StepStatus::moved; ++steps) status = stepper.step_with_mover_by(0.1, 0);
  EXPECT_EQ(status, StepStatus::crushed);
  // There is room for its width until the front is at 0.5 - 2 * half_width.
  EXPECT_EQ(steps, static_cast<int>(std::ceil((0.5 - 2 * half_width + 2) / 0.1)));
  ASSERT_EQ(stepper.report.move.crushed.size(), 1U);
  EXPECT_EQ(stepper.report.move.crushed[0], 0U);
}

TEST(MovingCircle, that_leaves_again_frees_whom_it_crushed) {
  Stepper<double> stepper({circle(-3, 0, 1, 0), rectangle(0.5, -9, 2, 9)});
  stepper.gravity = {0, 0};
  stepper.at(0, 0);
  for (int i = 0; i < 25; ++i) stepper.step_with_mover_by(0.1, 0);
  EXPECT_TRUE(stepper.state.crushed);
  for (int i = 0; i < 25; ++i) stepper.step_with_mover_by(-0.1, 0);
  EXPECT_FALSE(stepper.state.crushed);
  EXPECT_EQ(stepper.step_with_mover_by(0, 0), StepStatus::moved);
}

TEST(MovingCircle, that_comes_down_on_the_edge_of_the_head_pushes_aside_no_faster_than_it_comes) {
  // Its tangent is nearly level there: along this the character would go 14 m in a step.
  Stepper<double> stepper({circle(-half_width - 0.5, half_height + 0.6, 0.5, 0), rectangle(-9, -9, 99, -half_height)});
  stepper.at(0, largest_gap);
  double fastest = 0;
  double farthest = 0;
  for (int i = 0; i < 40; ++i) {
    const Vec2d before = stepper.state.position;
    ASSERT_EQ(stepper.step_with_mover_by(0.05, -0.03), StepStatus::moved) << i;
    farthest = std::max(farthest, (stepper.state.position - before).norm());
    fastest = std::max(fastest, stepper.state.velocity.norm() * frame);
    const Circle<double> there{stepper.scenery->circle(0).centre + stepper.movers[0].to, 0.5};
    ASSERT_GT(slow_separation(stepper.controller.character().shape.hull(), stepper.state.position, there), 0) << i;
  }
  EXPECT_GT(stepper.state.position.x(), 1);
  EXPECT_LT(fastest, 2 * std::hypot(0.05, 0.03));
  EXPECT_LT(farthest, 0.5);
}

TEST(BetweenASlopeAndACircle, that_sinks_who_slides_down_goes_as_fast_as_it_lets) {
  CharacterDef character;
  character.max_climb_degrees = 12;
  const Vec2d slope = Vec2d(0.65, -0.158).normalized();
  Stepper<double> stepper({polygon({{0.65, -0.158}, {0, 0}, {-0.1, -1}, {0.6, -1}}), circle(0.82, -0.363, 0.386, 0)},
                          character);
  stepper.at(0.2, 1.2).steps(120);
  ASSERT_EQ(stepper.state.ground.state, GroundState::wedge);
  for (int i = 0; i < 20; ++i) {
    const Vec2d before = stepper.state.position;
    const Circle<double> circle{stepper.scenery->circle(1).centre + stepper.movers[0].to, 0.386};
    const Vec2d normal =
        geometry::near_circle<double>(stepper.controller.character().shape.hull(), before, circle).normal;
    stepper.step_with_mover_by(0, -0.0004);
    const double possible = normal.dot(Vec2d(0, -0.0004)) / normal.dot(slope);
    EXPECT_NEAR((stepper.state.position - before).dot(slope), possible, 0.05 * possible) << i;
  }
}

TEST(SlopeOfACircle, a_little_steeper_than_the_climb_limit_is_slid_down_with_the_key_uphill) {
  for (const double share : {1.001, 1.03, 1.3}) {
    CharacterDef character;
    character.max_climb_degrees = 0.1;
    Stepper<double> stepper({circle(0, -100, 100)}, character);
    const double angle = share * character.max_climb_degrees * std::numbers::pi / 180;
    // The corner of the foot that is uphill is the one that touches.
    const double x = -100 * std::sin(angle) - foot;
    stepper.at(x, half_height + 100 * std::cos(angle) - 100 + 1e-6);
    for (int i = 0; i < 60; ++i) stepper.step({.move = 1});
    EXPECT_EQ(stepper.state.ground.state, GroundState::steep) << share;
    const double by = x - stepper.state.position.x();
    EXPECT_NEAR(by, 0.5 * 10 * std::sin(angle), 0.1 * by) << share;
  }
}

TEST(ConveyorOnACircle, moves_who_stands_on_it_along_its_tangent) {
  ColliderDef belt = circle(0, -100, 100);
  belt.surface_speed = 2;
  Stepper<double> stepper({belt});
  stepper.at(0, half_height + 0.01).steps(30);
  const double before = stepper.state.position.x();
  stepper.steps(30);
  EXPECT_NEAR(stepper.state.position.x() - before, 1, 0.01);
}

// A start inside.

TEST(StartInsideACircle, goes_out_along_the_nearest_normal) {
  test::Random random(3);
  int corners = 0;
  for (int i = 0; i < 500; ++i) {
    const double radius = random.log_between(0.01, 20);
    const double angle = random.angle();
    const double far = radius * random.between(0, 1) + half_height * random.between(0, 0.5);
    Stepper<double> stepper({circle(0, 0, radius)});
    stepper.gravity = {0, 0};
    const Vec2d from = Vec2d{std::cos(angle), std::sin(angle)} * far;
    const std::span<const Vec2d> hull = stepper.controller.character().shape.hull();
    const auto near = geometry::near_circle<double>(hull, from, {{0, 0}, radius});
    if (!(near.separation < -1e-6)) continue;
    corners += is_corner(hull, near.normal);
    ASSERT_EQ(stepper.at(from.x(), from.y()).step(), StepStatus::moved);
    const Vec2d out = from - near.normal * near.separation;
    EXPECT_NEAR((stepper.state.position - out).norm(), 0, largest_gap) << i << ", radius " << radius;
    EXPECT_TRUE(is_gap(slow_separation(hull, stepper.state.position, {{0, 0}, radius}))) << i;
  }
  EXPECT_GT(corners, 50);
}

TEST(StartInsideACircle, goes_out_to_the_side_of_the_last_free_position) {
  for (const double side : {-1.0, 1.0}) {
    Stepper<double> stepper({circle(0, 0, 2)});
    stepper.gravity = {0, 0};
    stepper.at(0.3, 0);
    stepper.state.last_free = {4 * side, 0};
    stepper.state.has_last_free = true;
    EXPECT_EQ(stepper.step(), StepStatus::moved);
    EXPECT_GT(stepper.state.position.x() * side, 1.5);
  }
}

TEST(StartInsideACircle, goes_along_the_floor_where_the_shortest_way_leads_into_it) {
  Stepper<double> stepper({rectangle(-9, -1, 9, 0), circle(0, 1.2, 0.6)});
  stepper.gravity = {0, 0};
  stepper.at(0.4, half_height + 1e-6);
  EXPECT_EQ(stepper.step(), StepStatus::moved);
  EXPECT_TRUE(stepper.state.position.y() - half_height > 0);
  const double gap =
      slow_separation(stepper.controller.character().shape.hull(), stepper.state.position, {{0, 1.2}, 0.6});
  EXPECT_GT(gap, 0);
  // Out of the circle alone it would go down and to the right. Along the floor to where the arc ends.
  double inside = 0.4;
  double outside = 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (inside + outside) / 2;
    const bool is_out =
        slow_separation(stepper.controller.character().shape.hull(), {middle, half_height}, {{0, 1.2}, 0.6}) > 0;
    (is_out ? outside : inside) = middle;
  }
  EXPECT_NEAR(stepper.state.position.x(), outside, 2e-6);
  EXPECT_NEAR(stepper.state.position.y(), half_height, 2e-6);
}

TEST(StartInsideTiles, goes_to_where_a_facet_meets_the_arc_of_a_circle_that_is_not_overlapped) {
  std::vector<ColliderDef> colliders{circle(1.0412749953638631, -1.5716481127112392, 0.35763210798085809)};
  for (const Vec2d& corner : {Vec2d(0, 0), Vec2d(0.5, 0), Vec2d(1, 0), Vec2d(1.5, 0), Vec2d(0.5, 0.5)})
    colliders.push_back(rectangle(corner.x(), corner.y(), corner.x() + 0.5, corner.y() + 0.5));
  Stepper<double> stepper(std::move(colliders));
  stepper.gravity = {0, 0};
  EXPECT_EQ(stepper.at(0.85549703461439552, -0.20590779895981548).step(), StepStatus::moved);
  EXPECT_NEAR(stepper.state.position.y(), -half_height, 2e-6);
  EXPECT_LT(stepper.state.position.x(), 0.85549703461439552);
  EXPECT_TRUE(is_gap(slow_separation(stepper.controller.character().shape.hull(), stepper.state.position,
                                     stepper.scenery->circle(0))));
}

TEST(StartInsideTwoCircles, goes_to_where_their_arcs_cross) {
  // Up between them it is nearer than beside one of them.
  Stepper<double> stepper({circle(-0.8, 0, 1), circle(0.8, 0, 1), rectangle(-9, -9, 9, -0.9)});
  stepper.gravity = {0, 0};
  EXPECT_EQ(stepper.at(0.05, 0.9).step(), StepStatus::moved);
  // Both corners of the foot are on an arc: (0.8 - foot)^2 + y^2 = 1.
  EXPECT_NEAR(stepper.state.position.x(), 0, 2e-6);
  EXPECT_NEAR(stepper.state.position.y() - half_height, std::sqrt(1 - (0.8 - foot) * (0.8 - foot)), 2e-6);
}

TEST(StartInsideACircle, that_walls_enclose_is_stuck) {
  Stepper<double> stepper({circle(0, 0, 1), rectangle(-3, -3, -0.5, 3), rectangle(0.5, -3, 3, 3),
                           rectangle(-3, 0.8, 3, 3), rectangle(-3, -3, 3, -0.8)});
  stepper.gravity = {0, 0};
  EXPECT_EQ(stepper.at(0, 0).step(), StepStatus::stuck);
  EXPECT_EQ(stepper.state.position, Vec2d(0, 0));
}

TEST(TouchingACircle, exactly_is_no_overlap_and_an_ulp_less_is_one) {
  Stepper<double> stepper({circle(0, -2, 2)});
  const auto overlaps_at = [&](double x, double y) {
    return stepper.controller.overlaps({x, y}, {{0, 0}, frame}, stepper.scratch) == std::size_t{1};
  };
  EXPECT_FALSE(overlaps_at(0, half_height));
  EXPECT_TRUE(overlaps_at(0, std::nextafter(half_height, 0.0)));
  // A corner on the arc: 3-4-5, and everything else is a power of two.
  Stepper<double> corner({circle(0, 0, 5)});
  const Vec2d touching = Vec2d(3, 4) - Vec2d(-foot, -half_height);
  const auto overlaps = [&](const Vec2d& at) {
    return corner.controller.overlaps(at, {{0, 0}, frame}, corner.scratch) == std::size_t{1};
  };
  EXPECT_FALSE(overlaps(touching));
  EXPECT_TRUE(overlaps({touching.x(), std::nextafter(touching.y(), 0.0)}));
  EXPECT_TRUE(overlaps({std::nextafter(touching.x(), 0.0), touching.y()}));
  EXPECT_FALSE(overlaps({touching.x(), std::nextafter(touching.y(), 9.0)}));
}

TEST(TouchingACircle, exactly_it_may_go_away_and_along) {
  for (const Vec2d& way : {Vec2d(0, 1), Vec2d(1, 0), Vec2d(-1, 0), Vec2d(0.6, 0.8), Vec2d(0.8, -0.6)}) {
    Stepper<double> stepper({circle(0, 0, 5)});
    const Vec2d touching = Vec2d(3, 4) - Vec2d(-foot, -half_height);
    const MoveResult<double>& move = stepper.at(touching.x(), touching.y()).fly(way.x(), way.y());
    EXPECT_EQ(move.status, MoveStatus::moved) << way.transpose();
    if (way.dot(Vec2d(0.6, 0.8)) >= 0) {
      EXPECT_NEAR((move.position - touching - way).norm(), 0, largest_gap) << way.transpose();
    }
    EXPECT_TRUE(slow_separation(stepper.controller.character().shape.hull(), move.position, {{0, 0}, 5}) > 0);
  }
}

// Sensors, questions, refusals.

TEST(CircleSensor, is_entered_and_left_where_the_outline_meets_it) {
  ColliderDef sensor = circle(0, 0, 0.5);
  sensor.sensor = true;
  Stepper<double> stepper({sensor});
  const MoveResult<double>& move = stepper.at(-5, 0).fly(10, 0);
  EXPECT_TRUE(move.contacts.empty());
  ASSERT_EQ(stepper.report.sensors.size(), 2U);
  EXPECT_EQ(stepper.report.sensors[0].change, SensorEvent<double>::Change::enter);
  EXPECT_NEAR(stepper.report.sensors[0].fraction, (5 - 0.5 - half_width) / 10, 1e-12);
  EXPECT_EQ(stepper.report.sensors[1].change, SensorEvent<double>::Change::exit);
  EXPECT_NEAR(stepper.report.sensors[1].fraction, (5 + 0.5 + half_width) / 10, 1e-12);
}

TEST(CircleSensor, that_is_only_grazed_by_its_box_is_not_entered) {
  ColliderDef sensor = circle(0, 0, 0.5);
  sensor.sensor = true;
  Stepper<double> stepper({sensor});
  // The corner of the foot goes past the arc at 45 degrees, just outside.
  const double past = 0.5 * std::sqrt(2.0) + 1e-9;
  stepper.at(past / 2 + foot - 3, past / 2 + half_height + 3).fly(6, -6);
  EXPECT_TRUE(stepper.report.sensors.empty());
  stepper = Stepper<double>({sensor});
  stepper.at(past / 2 + foot - 3, past / 2 + half_height + 3 - 1e-3).fly(6, -6);
  EXPECT_EQ(stepper.report.sensors.size(), 2U);
}

TEST(QuestionsAboutACircle, are_answered_as_by_formula) {
  Stepper<double> stepper({circle(4, 0, 1), circle(0, 50, 2)});
  const StepContext<double> context{{0, 0}, frame};
  const auto hit = stepper.controller.cast({0, 0}, {8, 0}, context, stepper.scratch);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->collider, 0U);
  EXPECT_NEAR(hit->fraction, (4 - 1 - half_width) / 8, 1e-14);
  EXPECT_EQ(hit->normal, Vec2d(-1, 0));
  EXPECT_NEAR((hit->point - Vec2d(3, 0)).norm(), 0, 1e-12);
  EXPECT_FALSE(stepper.controller.cast({0, 0}, {2, 0}, context, stepper.scratch).has_value());
  EXPECT_FALSE(stepper.controller.cast({0, 3}, {8, 0}, context, stepper.scratch).has_value());

  EXPECT_EQ(stepper.controller.overlaps({3, 0}, context, stepper.scratch), std::size_t{1});
  EXPECT_EQ(stepper.controller.overlaps({3 - half_width - 0.01, 0}, context, stepper.scratch), std::size_t{0});
  // Within the box of the circle, and outside of the circle.
  EXPECT_EQ(stepper.controller.overlaps({4 + 0.8 + foot, 0.8 + half_height}, context, stepper.scratch), std::size_t{0});

  const auto near = stepper.controller.nearest({2, 0}, 1, context, stepper.scratch);
  ASSERT_TRUE(near.has_value());
  EXPECT_NEAR(near->separation, 1 - half_width, 1e-14);
  EXPECT_NEAR((near->point - Vec2d(3, 0)).norm(), 0, 1e-14);
  EXPECT_FALSE(stepper.controller.nearest({2, 0}, 0.5, context, stepper.scratch).has_value());
  // A corner is nearest: along the line through the centre.
  const Vec2d at = Vec2d(4 + 0.9, 0.9) - Vec2d(-foot, -half_height);
  const auto corner = stepper.controller.nearest(at, 1, context, stepper.scratch);
  ASSERT_TRUE(corner.has_value());
  EXPECT_NEAR(corner->separation, 0.9 * std::sqrt(2.0) - 1, 1e-14);
  EXPECT_NEAR((corner->normal - Vec2d(1, 1).normalized()).norm(), 0, 1e-15);

  std::array<Contact<double>, 4> found;
  EXPECT_EQ(stepper.controller.contacts_at({4, 1 + half_height}, 1e-3, context, stepper.scratch, found), 1U);
  EXPECT_EQ(found[0].normal, Vec2d(0, 1));
  EXPECT_NEAR(found[0].separation, 0, 1e-15);
}

TEST(CircleDefinition, is_refused_in_words) {
  const auto refusal_of = [](const SceneryDef& def) -> std::string {
    try {
      const Scenery<double> scenery(def);
    } catch (const InvalidScenery& refused) {
      return refused.what();
    }
    return "accepted";
  };
  const ColliderDef good = circle(0, 0, 1);
  EXPECT_EQ(refusal_of({{good}}), "accepted");
  ColliderDef bad = good;
  for (const double radius : {0.0, -1.0, nan, std::numeric_limits<double>::infinity(), 3e6}) {
    bad.radius = radius;
    EXPECT_NE(refusal_of({{bad}}).find("the radius of a circle must be above 0 and at most 2e6 m"), std::string::npos)
        << radius << ": " << refusal_of({{bad}});
  }
  bad = good;
  bad.points = {};
  EXPECT_EQ(refusal_of({{bad}}), "a circle needs exactly 1 point, its centre; it has 0");
  bad.points = {{0, 0}, {1, 1}};
  EXPECT_EQ(refusal_of({{bad}}), "a circle needs exactly 1 point, its centre; it has 2");
  bad.points = {{nan, 0}};
  EXPECT_NE(refusal_of({{bad}}), "accepted");
  bad = good;
  bad.holes = {{{0, 0}, {1, 0}, {0, 1}}};
  EXPECT_EQ(refusal_of({{bad}}), "a circle cannot have holes");
  bad = good;
  bad.one_way = Vec2d(0, 1);
  EXPECT_NE(refusal_of({{bad}}).find("a circle cannot be one-way"), std::string::npos);
  bad = rectangle(0, 0, 1, 1);
  bad.radius = 1;
  EXPECT_EQ(refusal_of({{bad}}), "only a circle has a radius");
}

TEST(CircleDefinition, is_given_back_as_it_runs) {
  const Scenery<double> scenery(SceneryDef{{circle(1, 2, 0.1)}});
  EXPECT_EQ(scenery.as_run(0).points, (std::vector<Vec2d>{{1, 2}}));
  EXPECT_EQ(scenery.as_run(0).radius, 0.1);
  EXPECT_EQ(scenery.as_run(0).shape, ColliderDef::Shape::circle);
  const Scenery<float> rounded(SceneryDef{{circle(1, 2, 0.1)}});
  EXPECT_EQ(rounded.as_run(0).radius, static_cast<double>(0.1F));
}

TEST(CircleDefinition, of_a_radius_that_is_zero_in_float_is_refused) {
  EXPECT_THROW(Scenery<float>(SceneryDef{{circle(0, 0, 1e-60)}}), InvalidScenery);
}

TEST(CirclesForOtherTechniques, are_refused_in_words) {
  const Scenery<double> scenery(SceneryDef{{circle(0, 0, 1)}});
  for (const std::string_view kind : {"wind_back", "penetration_resolution", "speculative", "discrete"}) {
    try {
      const auto controller = make_controller(scenery, CharacterDef{}, {.name = kind});
      ADD_FAILURE() << kind;
    } catch (const NotExpressible& refusal) {
      EXPECT_NE(std::string(refusal.what()).find("knows no circles"), std::string::npos) << refusal.what();
    }
  }
}

// Beside polygons, in a crowd, without allocating.

TEST(CircleAndPolygonOf64, are_met_at_nearly_the_same_times) {
  test::Random random(4);
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const ColliderDef round = circle(random.between(-2, 2), random.between(-2, 2), random.log_between(0.1, 3));
    Stepper<double> exact({round});
    Stepper<double> smaller({polygon_like(round, 64, false)});
    Stepper<double> larger({polygon_like(round, 64, true)});
    const Vec2d from = 9 * Vec2d{1, 0.3 * random.between(-1, 1)};
    const Vec2d way = Vec2d{random.between(-2, 2), random.between(-2, 2)} - from;
    const auto time = [&](Stepper<double>& stepper) {
      const auto hit = stepper.controller.cast(from, way, {{0, 0}, frame}, stepper.scratch);
      return hit ? hit->fraction : 2.0;
    };
    EXPECT_LE(time(larger), time(exact) + 1e-7) << i;
    EXPECT_LE(time(exact), time(smaller) + 1e-7) << i;
    if (time(smaller) > 1) continue;
    ++hits;
    EXPECT_NEAR(slow_separation(exact.controller.character().shape.hull(), from + way * time(larger),
                                {round.points[0], round.radius}),
                0, 0.0013 * round.radius)
        << i;
  }
  EXPECT_GT(hits, 100);
}

TEST(CircleAndPolygonOf64, carry_a_walk_to_nearly_the_same_places) {
  const ColliderDef round = circle(0, -8, 8);
  CharacterDef character;
  character.snap = 0.2;
  Stepper<double> exact({round}, character);
  Stepper<double> smaller({polygon_like(round, 64, false)}, character);
  Stepper<double> larger({polygon_like(round, 64, true)}, character);
  const double off = 8 * (1 / std::cos(std::numbers::pi / 64) - 1);
  for (Stepper<double>* stepper : {&exact, &smaller, &larger}) stepper->at(-2, 1).steps(60);
  for (int i = 0; i < 60; ++i) {
    for (Stepper<double>* stepper : {&exact, &smaller, &larger}) stepper->step({.move = 1.0});
    EXPECT_NEAR((exact.state.position - smaller.state.position).norm(), 0, 20 * off) << i;
    EXPECT_NEAR((exact.state.position - larger.state.position).norm(), 0, 20 * off) << i;
    EXPECT_TRUE(exact.state.grounded) << i;
  }
  EXPECT_GT(exact.state.position.x(), 2);
}

TEST(CrowdOnACircle, lands_and_stays_apart) {
  Together two({{-0.5, 3}, {0.5, 3}}, {circle(0, -5, 5)});
  two.gravity = {0, -30};
  two.dt = frame;
  two.steps(120);
  for (const CharacterState<double>& state : two.states) {
    EXPECT_TRUE(state.grounded);
    const CharacterDef character;
    const double gap = slow_separation(character.shape.hull(), state.position, {{0, -5}, 5});
    EXPECT_TRUE(is_gap(gap)) << gap;
  }
  EXPECT_GT(two.gap(0, 1), 0);
}

TEST(CrowdOnACircle, is_pushed_off_it_together) {
  Together two({{0, 0}, {0.7, 0}}, {circle(-3, 0, 1, 0)});
  two.dt = frame;
  for (int i = 0; i < 40; ++i) two.step_with_movers_by({{0.1, 0}});
  EXPECT_NEAR(two.states[0].position.x(), -3 + 1 + 4 + half_width, largest_gap);
  EXPECT_TRUE(gap_of_a_contact(two.gap(0, 1)));
}

TEST(StepsAmongCircles, allocate_nothing) {
  std::vector<ColliderDef> colliders{rectangle(-9, -1, 9, 0)};
  for (int i = 0; i < 30; ++i) colliders.push_back(circle(0.5 * i - 7, 0.02 * i, 0.3, i % 3 == 0 ? 0U : no_mover));
  CharacterDef character;
  character.snap = character.step_height = 0.2;
  Stepper<double> stepper(colliders, character);
  stepper.at(0, 3).step();
  const std::size_t before = tests::allocations();
  for (int i = 0; i < 300; ++i)
    stepper.step_with_mover_by(0, i % 20 < 10 ? 0.05 : -0.05, {.move = i % 100 < 50 ? 1.0 : -1.0});
  EXPECT_EQ(tests::allocations(), before);
}

TEST(CirclesInAPlan, are_slopes) {
  const Scenery<double> scenery(SceneryDef{{circle(0, 0, 1)}});
  EXPECT_TRUE(make_plan(scenery).stages.slopes);
  SweepDef without;
  without.stages.slopes = false;
  EXPECT_THROW(Controller<double>(scenery, CharacterDef{}, without), std::invalid_argument);
}

}  // namespace
}  // namespace paperproof::stepping
