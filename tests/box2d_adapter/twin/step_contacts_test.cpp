/// What a step of the twin reports: which collider, which side, when, and the way that was travelled.
#include "collider_lookup.hpp"
#include "levels.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace paperproof::box2d::test {
namespace {

const Vec2d gravity{0, -10};

std::vector<ColliderIndex> colliders_of(const TwinStep& step) {
  std::vector<ColliderIndex> result;
  for (const Contact<double>& contact : step.contacts) result.push_back(contact.collider);
  return result;
}

TEST(StepContacts, each_side_is_named_from_the_character) {
  struct Case {
    ColliderDef wall;
    Vec2d velocity;
    Side side;
    Vec2d normal;
  };
  const std::vector<Case> cases{{box(-5, -3, 5, -2), {0, -60}, Side::bottom, {0, 1}},
                                {box(-5, 2, 5, 3), {0, 60}, Side::top, {0, -1}},
                                {box(2, -5, 3, 5), {60, 0}, Side::right, {-1, 0}},
                                {box(-3, -5, -2, 5), {-60, 0}, Side::left, {1, 0}}};
  for (const SceneryMode mode : {SceneryMode::chain_loops, SceneryMode::pieces}) {
    for (const Case& expected : cases) {
      ReferenceWorld world(level({box(90, 90, 91, 91), expected.wall}), {}, {0, 0}, {.mode = mode});
      const TwinStep* step = nullptr;
      for (int k = 0; k < 3 && (step == nullptr || step->contacts.empty()); ++k) {
        step = &world.step(expected.velocity, frame);
      }
      ASSERT_EQ(step->contacts.size(), 1U);
      EXPECT_EQ(step->contacts[0].side, expected.side);
      EXPECT_EQ(step->contacts[0].collider, 1U);
      EXPECT_LT((step->contacts[0].normal - expected.normal).cwiseAbs().maxCoeff(), 1e-6);
      EXPECT_NEAR(std::abs(step->contacts[0].point.dot(expected.normal)), 2, 1e-5);
    }
  }
}

TEST(StepContacts, the_fraction_is_the_exact_time_of_impact_ahead_by_at_most_the_skin) {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const double speed = random.between(10, 110);
    const double displacement = speed * frame;
    const double drop = random.between(touch_gap + 0.001, displacement);
    ReferenceWorld world(level({box(-5, -1, 5, 0)}), {}, {0, half_height() + drop});
    const TwinStep& step = world.step({0, -speed}, frame);
    const double exact = drop / displacement;
    ASSERT_EQ(step.contacts.size(), 1U) << "seed 9, " << i;
    EXPECT_LE(step.contacts[0].fraction, exact + 1e-5) << "seed 9, " << i;
    EXPECT_GE(step.contacts[0].fraction, exact - (touch_gap + 0.001) / displacement) << "seed 9, " << i;
  }
}

TEST(StepContacts, resting_beside_a_wall_without_pushing_is_no_contact_with_it) {
  const double wall = CharacterDef{}.shape.box().upper.x() + rest_gap;
  ReferenceWorld world(level({box(-5, -1, 5, 0), box(wall, 0, wall + 1, 5)}), {}, {0, half_height() + rest_gap});
  run(world, {0, 0}, gravity, 60, [](const TwinStep& step) {
    for (const Contact<double>& contact : step.contacts) EXPECT_EQ(contact.side, Side::bottom);
    EXPECT_EQ(step.contacts.size(), 1U);
  });
  const TwinStep& pushing = world.step({2, -10 * frame}, frame);
  ASSERT_EQ(pushing.contacts.size(), 2U);
  EXPECT_EQ(pushing.contacts[1].side, Side::right);
  EXPECT_EQ(pushing.contacts[1].collider, 1U);
}

TEST(StepContacts, a_place_beside_a_wall_is_no_contact_with_it) {
  const double wall = CharacterDef{}.shape.box().upper.x() + rest_gap;
  ReferenceWorld world(level({box(wall, -50, wall + 1, 50)}), {}, {-5, 0});
  world.place({0, 0}, {0, 0});
  EXPECT_TRUE(world.step({0, -5}, frame).contacts.empty());
}

TEST(StepContacts, a_jump_leaves_the_ground_at_once) {
  ReferenceWorld world(level({box(-5, -1, 5, 0)}), {}, {0, half_height() + rest_gap});
  run(world, {0, 0}, gravity, 10);
  const TwinStep& jump = world.step({0, 12}, frame);
  EXPECT_FALSE(jump.grounded);
  EXPECT_TRUE(jump.contacts.empty());
}

TEST(StepContacts, ground_counts_as_such_up_to_the_climb_limit) {
  CharacterDef character;
  character.max_climb_degrees = 40;
  for (const double degrees : {38.0, 39.9, 40.1, 42.0}) {
    const double slope = std::tan(degrees * std::numbers::pi / 180);
    ReferenceWorld world(level({polygon({{-8, 0}, {8, 0}, {8, 16 * slope}})}), character, {0, 8 * slope + 2});
    bool grounded = false;
    run(world, {0, 0}, gravity, 60, [&](const TwinStep& step) { grounded = grounded || step.grounded; });
    EXPECT_EQ(grounded, degrees < 40) << degrees;
  }
}

TEST(StepContacts, feet_on_two_tiles_of_one_outline_touch_both) {
  ReferenceWorld world(level({box(-1, -1, 0, 0), box(0, -1, 1, 0)}), {}, {0, half_height() + rest_gap});
  const TwinStep& step = world.step(gravity * frame, frame);
  EXPECT_EQ(colliders_of(step), (std::vector<ColliderIndex>{0, 1}));
}

TEST(StepContacts, every_tile_of_a_row_is_named_while_walking_over_it) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 10; ++i) tiles.push_back(box(i, -1, i + 1, 0));
  ReferenceWorld world(level(tiles), {}, {1, half_height() + rest_gap});
  run(world, {4, 0}, gravity, 110, [&world](const TwinStep& step) {
    const double foot = CharacterDef{}.shape.points()[3].x();  // Half of the flat between the feet.
    for (const Contact<double>& contact : step.contacts) {
      // The manifold is that of the step's start.
      const double left = std::floor(world.position().x() - 4 * frame - foot - 0.001);
      const double right = std::floor(world.position().x() + foot + 0.001);
      EXPECT_GE(contact.collider, left);
      EXPECT_LE(contact.collider, right);
    }
    EXPECT_FALSE(step.contacts.empty());
  });
}

TEST(StepContacts, the_path_runs_from_start_to_end_in_time_and_holds_the_impact) {
  ReferenceWorld world(level({box(-5, -1, 5, 0)}), {}, {0, 2});
  world.step({30, -100}, frame);
  const TwinStep& step = world.step({30, -100}, frame);
  const std::vector<PathPoint<double>>& path = step.path;
  ASSERT_GE(path.size(), 2U);
  EXPECT_EQ(path.front().fraction, 0);
  EXPECT_EQ(path.back().fraction, 1);
  EXPECT_EQ(path.back().position, world.position());
  EXPECT_TRUE(
      std::is_sorted(path.begin(), path.end(), [](const auto& a, const auto& b) { return a.fraction < b.fraction; }));
  ReferenceWorld again(level({box(-5, -1, 5, 0)}), {}, {0, 2});
  const TwinStep& impact = again.step({30, -100}, frame);
  // From 2 m at 100 m/s: the feet meet the ground at (2 - half height) / (100/60) of the step.
  const double exact = (2 - half_height()) / (100 * frame);
  ASSERT_EQ(impact.path.size(), 3U);
  EXPECT_NEAR(impact.path[1].fraction, exact, (touch_gap + 0.001) / (100 * frame));
  EXPECT_NEAR(impact.path[1].position.x(), 30 * frame * impact.path[1].fraction, 1e-4);
}

/// To the boundary of a rectangle, from either side.
double distance_to_boundary(const ColliderDef& rectangle, const Vec2d& point) {
  const Vec2d outside = (rectangle.points[0] - point).cwiseMax(point - rectangle.points[2]);
  const Vec2d beyond = outside.cwiseMax(0.0);
  return outside.maxCoeff() > 0 ? std::sqrt(beyond.squaredNorm()) : -outside.maxCoeff();
}

std::vector<ColliderIndex> numbered(std::size_t count) {
  std::vector<ColliderIndex> names(count);
  std::iota(names.begin(), names.end(), ColliderIndex{0});
  return names;
}

TEST(ColliderLookup, agrees_with_a_search_through_all_edges) {
  Random random(10);
  std::vector<ColliderDef> colliders;
  for (int i = 0; i < 200; ++i) {
    const Vec2d low{random.between(-10, 10), random.between(-10, 10)};
    const Vec2d high = low + Vec2d{random.between(0.1, 3), random.between(0.1, 3)};
    colliders.push_back(box(low.x(), low.y(), high.x(), high.y()));
  }
  ColliderLookup lookup(SceneryDef{colliders}, numbered(colliders.size()));
  const double reach = 0.1;
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2d point{random.between(-10, 13), random.between(-10, 13)};
    double least = reach;
    std::optional<ColliderIndex> expected;
    for (ColliderIndex c = 0; c < colliders.size(); ++c) {
      const double distance = distance_to_boundary(colliders[c], point);
      if (distance < least) {
        least = distance;
        expected = c;
      }
    }
    const std::optional<ColliderIndex> answer = lookup.nearest(point, reach);
    ASSERT_EQ(answer.has_value(), expected.has_value()) << "seed 10, " << i;
    if (!answer) continue;
    ++found;
    const double distance = distance_to_boundary(colliders[*answer], point);
    EXPECT_LE(distance, least + ColliderLookup::same_distance) << "seed 10, " << i;
  }
  EXPECT_GT(found, 400);
  EXPECT_LT(found, 1900);
}

TEST(ColliderLookup, a_shared_edge_belongs_to_the_lowest_index) {
  ColliderLookup lookup(SceneryDef{{box(5, 5, 6, 6), box(1, 0, 2, 1), box(0, 0, 1, 1)}}, numbered(3));
  EXPECT_EQ(lookup.nearest({1, 0.5}, 0.02), std::optional<ColliderIndex>(1));
  EXPECT_EQ(lookup.nearest({0, 0.5}, 0.02), std::optional<ColliderIndex>(2));
  EXPECT_EQ(lookup.nearest({3, 0.5}, 0.02), std::nullopt);
}

}  // namespace
}  // namespace paperproof::box2d::test
