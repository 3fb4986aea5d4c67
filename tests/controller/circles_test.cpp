/// Circles as obstacles: distances and times against slow twins, questions, `float`. What a step among circles comes to
/// is in tests/situations/circles.json.
#include "geometry/circle.hpp"

#include "campaign/shapes.hpp"
#include "controller/stepping.hpp"
#include "support/random_runs.hpp"

#include <paperproof/in_float.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace paperproof::stepping {
namespace {

using compare::circle;

constexpr double foot = 5 * px;  ///< From the middle of the article's character to its end [m].

const CharacterShape article = CharacterShape::article();
const std::span<const Vec2d> outline = article.hull();

// The distance, and the time of approach.

/// By the edges alone, without a case more than a polygon has.
double slow_separation(const Vec2d& at, const Circle& circle) {
  const Vec2d centre = circle.centre - at;
  double outside = infinity;
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

TEST(NearCircle, has_the_distance_of_a_slow_twin) {
  test::Random random(1);
  int inside = 0;
  int corners = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Circle circle{{random.between(-1, 1), random.between(-1, 1)}, random.log_between(1e-4, 1e3)};
    const Vec2d at = circle.centre + Vec2d{random.between(-1, 1), random.between(-1, 1)};
    const auto near = geometry::near_circle(outline, at, circle);
    ASSERT_NEAR(near.separation, slow_separation(at, circle), 1e-13 * (1 + circle.radius)) << i;
    ASSERT_NEAR(near.normal.norm(), 1, 1e-15);
    // The normal leads to where they just touch.
    const Vec2d out = at - near.normal * near.separation;
    ASSERT_NEAR(slow_separation(out, circle), 0, 1e-12 * (1 + circle.radius)) << i;
    inside += near.separation < -circle.radius;
    const Vec2d n = near.normal.cwiseAbs();
    corners += n.x() * n.y() * std::abs(n.x() - 2 * n.y()) > 1e-12;  // edges face (1, 0), (0, 1) and (2, 1)
  }
  EXPECT_GT(inside, 500) << "the centre was inside the outline";
  EXPECT_GT(corners, 2000);
  EXPECT_LT(corners, 7000);
}

TEST(Approach, is_that_of_a_slow_twin_and_never_later) {
  test::Random random(2);
  int hits = 0;
  constexpr int cases = 10'000;
  for (int i = 0; i < cases; ++i) {
    const Circle circle{{random.between(-3, 3), random.between(-3, 3)}, random.log_between(1e-3, 2)};
    const Vec2d from{random.between(-8, 8), random.between(-8, 8)};
    if (slow_separation(from, circle) <= 0.01) continue;
    const Vec2d aim = circle.centre + 2 * Vec2d{random.between(-1, 1), random.between(-1, 1)};
    const Vec2d way = (aim - from) * random.between(0.7, 2);
    const auto separation_at = [&](double time) { return slow_separation(from + way * time, circle); };
    // The separation is convex: a third of the time with the greater end is left out, again and again.
    double low = 0;
    double high = 1;
    for (int k = 0; k < 200; ++k) {
      const double a = low + (high - low) / 3;
      const double b = high - (high - low) / 3;
      (separation_at(a) < separation_at(b) ? high : low) = separation_at(a) < separation_at(b) ? b : a;
    }
    const double nearest = separation_at(low);
    const auto found = geometry::approach(outline, from, way, circle, 0);
    if (std::abs(nearest) < 1e-9) continue;  // too near to tell
    ASSERT_EQ(found.has_value(), nearest < 0) << i;
    if (!found) continue;
    ++hits;
    ASSERT_NEAR(separation_at(found->time), 0, 1e-13) << i;
    ASSERT_LE(found->time, low) << i;
    ASSERT_GT(separation_at(found->time), -1e-14) << i;
  }
  EXPECT_GT(hits, cases * 3 / 10);
  EXPECT_LT(hits, cases * 7 / 10);
}

/// Its steps compute in `float`. @param colliders are rounded to `float`.
Stepper in_float(std::vector<ColliderDef> colliders) {
  for (ColliderDef& collider : colliders) {
    for (Vec2d& point : collider.points) point = point.cast<float>().cast<double>();
    collider.radius = static_cast<double>(static_cast<float>(collider.radius));
  }
  return Stepper(std::make_unique<Scenery>(SceneryDef{std::move(colliders)}),
                 [&](const Scenery& level) { return TechniqueController(make_controller_in_float(level, {})); });
}

TEST(CircleInFloat, is_not_entered_by_more_than_its_gap_in_random_play) {
  // Nothing is guaranteed in `float`; near the origin it keeps out all the same.
  test::Random random(5);
  int contacts = 0;
  for (int run = 0; run < 100; ++run) {
    std::vector<ColliderDef> colliders{box(-9, -2, 9, -1), box(-6, -1, -5, 99), box(5, -1, 6, 99)};
    for (int i = random.integer(1, 8); i > 0; --i) {
      const double x = random.between(-4, 4);
      const double y = random.between(-1, 2);
      colliders.push_back(circle({x, y}, random.log_between(0.05, 2)));
    }
    Stepper stepper = in_float(colliders);
    stepper.at(random.between(-4, 4), 5);
    for (int i = 0; i < 100; ++i) {
      if (random.chance(0.1)) stepper.with_velocity(random.between(-50, 50), -20);
      stepper.step({.move = random.chance(0.5) ? 1.0 : -1.0});
      ASSERT_TRUE(stepper.state.position.allFinite()) << run;
      contacts += static_cast<int>(stepper.report.move.contacts.size());
      const Vec2d at = stepper.state.position;
      for (std::size_t c = 3; c < colliders.size(); ++c) {
        const Circle round{colliders[c].points[0], colliders[c].radius};
        ASSERT_GT(slow_separation(at, round), -1e-4) << "run " << run << ", step " << i;
      }
    }
  }
  EXPECT_GT(contacts, 2000);
}

TEST(TouchingACircle, exactly_is_no_overlap_and_an_ulp_less_is_one) {
  Stepper stepper({circle({0, 0}, 5)});
  const auto overlaps = [&](double x, double y) -> bool {
    return stepper.sweep().overlaps({x, y}, stepper.context(), stepper.scratch) == std::size_t{1};
  };
  EXPECT_FALSE(overlaps(0, 5 + half_height));
  EXPECT_TRUE(overlaps(0, std::nextafter(5 + half_height, 0.0)));
  // A corner on the arc: 3-4-5, and everything else is a power of two.
  const Vec2d at = Vec2d(3, 4) - Vec2d(-foot, -half_height);
  EXPECT_FALSE(overlaps(at.x(), at.y()));
  EXPECT_TRUE(overlaps(at.x(), std::nextafter(at.y(), 0.0)));
  EXPECT_TRUE(overlaps(std::nextafter(at.x(), 0.0), at.y()));
  EXPECT_FALSE(overlaps(at.x(), std::nextafter(at.y(), 9.0)));
}

/// What is overlapped, how far, and when, is asked of circles in tests/agreement/query_test.cpp.
TEST(QuestionsAboutACircle, are_answered_with_points_and_normals_by_formula) {
  Stepper stepper({circle({4, 0}, 1), circle({0, 50}, 2)});
  const StepContext context = stepper.context();
  const auto hit = stepper.sweep().cast({0, 0}, {8, 0}, context, stepper.scratch);
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->normal, Vec2d(-1, 0));
  EXPECT_NEAR((hit->point - Vec2d(3, 0)).norm(), 0, 1e-12);
  const auto near = stepper.sweep().nearest({2, 0}, 1, context, stepper.scratch);
  ASSERT_TRUE(near.has_value());
  EXPECT_NEAR((near->point - Vec2d(3, 0)).norm(), 0, 1e-14);
  // A corner is nearest: along the line through the centre.
  std::array<Contact, 4> found;
  const Vec2d at = Vec2d(4 + 0.9, 0.9) - Vec2d(-foot, -half_height);
  ASSERT_EQ(stepper.sweep().contacts_at(at, 1, context, stepper.scratch, found), 1U);
  EXPECT_NEAR(found[0].separation, 0.9 * std::sqrt(2.0) - 1, 1e-14);
  EXPECT_NEAR((found[0].normal - Vec2d(1, 1).normalized()).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace paperproof::stepping
