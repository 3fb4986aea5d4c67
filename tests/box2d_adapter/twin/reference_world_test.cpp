/// Characters in the twin: what moves there, and what a step reports. How they go by formulas is in
/// tests/situations/box2d.json.
#include "collider_lookup.hpp"
#include "levels.hpp"

#include <box2d/b2_body.h>
#include <box2d/b2_world.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

namespace paperproof::box2d::test {
namespace {

const Vec2d standing{0, half_height + rest_gap};

Scenery floor() { return level({box(-5, -1, 5, 0)}); }

TEST(ReferenceWorld, cites_the_package_and_says_truly_whether_its_asserts_are_on) {
  EXPECT_EQ(box2d_version(), "2.4.1") << "not what the library calls itself";
  EXPECT_NE(box2d_build(), "");
  const auto ask_for_nonsense = [] {
    b2World world({0, 0});
    b2BodyDef body;
    body.position.x = std::numeric_limits<float>::quiet_NaN();
    world.CreateBody(&body);
    std::exit(0);
  };
  if (box2d_asserts() == "on") {
    EXPECT_DEATH(ask_for_nonsense(), "Assert");
  } else if (box2d_asserts() == "off") {
    EXPECT_EXIT(ask_for_nonsense(), testing::ExitedWithCode(0), "");
  } else {
    EXPECT_EQ(box2d_asserts(), "unknown");
  }
}

TEST(ReferenceWorld, says_what_it_made_of_the_scenery_rounded_to_float) {
  const std::vector<ColliderDef> tiles{box(0.1, 0, 1, 1), box(1, 0, 2, 1), chain({{5, 0}, {6, 0}, {7, 1}})};
  for (const SceneryMode mode : modes) {
    const ReferenceWorld world(level(tiles), {}, {0, 5}, {.mode = mode});
    const bool loops = mode == SceneryMode::chain_loops;
    EXPECT_EQ(world.size().loops, loops ? 1U : 0U);
    EXPECT_EQ(world.size().fixtures, loops ? 1U + 2U : 2U + 2U);
    EXPECT_EQ(world.as_run().colliders[0].points[0], Vec2d(static_cast<double>(0.1F), 0));
    EXPECT_EQ(world.points_as_run().size(), CharacterDef{}.shape.hull().size());
  }
}

TEST(ReferenceWorld, has_no_fixture_for_what_is_one_way_along_itself) {
  ColliderDef wall = chain({{0, -4}, {0, 4}});
  wall.one_way = Vec2d(0, 1);
  EXPECT_EQ(ReferenceWorld(level({wall}), {}, {-2, 0}).size().fixtures, 0U);
}

TEST(StepContacts, come_at_the_exact_time_of_impact_ahead_by_at_most_the_skin_and_the_path_holds_it) {
  Random random(9);
  for (int i = 0; i < 300; ++i) {
    const double speed = random.between(10, 110);
    const double way = speed * frame;
    const double drop = random.between(touch_gap + 0.001, way);
    ReferenceWorld world(floor(), {}, {0, half_height + drop});
    const TwinStep& step = world.step({speed / 3, -speed}, frame);
    ASSERT_EQ(step.contacts.size(), 1U) << "seed 9, " << i;
    EXPECT_NEAR(step.contacts[0].point.y(), 0, 1e-5) << "seed 9, " << i;
    const double fraction = step.contacts[0].fraction;
    EXPECT_LE(fraction, drop / way + 1e-5) << "seed 9, " << i;
    EXPECT_GE(fraction, (drop - touch_gap - 0.001) / way) << "seed 9, " << i;
    ASSERT_EQ(step.path.size(), 3U) << "seed 9, " << i;
    EXPECT_EQ(step.path[0].fraction, 0);
    EXPECT_EQ(step.path[1].fraction, fraction);
    EXPECT_NEAR(step.path[1].position.x(), way / 3 * fraction, 1e-4) << "seed 9, " << i;
    EXPECT_EQ(step.path[2].fraction, 1);
    EXPECT_EQ(step.path[2].position, world.position());
  }
}

/// At constant speed, in one step after the other.
std::vector<MoverMotion> steady(const Vec2d& velocity, int step) {
  return {{velocity * (step * frame), velocity * ((step + 1) * frame)}};
}

TEST(TwinMovers, begin_anew_where_the_story_does) {
  ReferenceWorld world(level({box(-5, -1, 5, 0), box(-3, 0, -2, 2, 0)}), {}, {0, 1});
  std::vector<Vec2d> places;
  for (int step = 0; step < 240; ++step) {
    if (step % 120 == 0) world.place({0, 1}, {0, 0});
    const TwinStep& twin = world.step({0, -1}, frame, steady({2, 0}, step % 120));
    places.push_back(world.position());
    EXPECT_TRUE(step % 120 > 0 || (twin.movers[0].from == Vec2d(0, 0) && twin.contacts.empty())) << step;
  }
  EXPECT_TRUE(std::equal(places.begin(), places.begin() + 120, places.begin() + 120));
}

TEST(TwinMovers, are_refused_where_they_are_not_one_for_each_or_not_finite_and_flagged_beyond_the_cap) {
  ReferenceWorld world(level({box(0, 0, 1, 1, 0)}), {}, {50, 50});
  const std::vector<MoverMotion> nan{{{0, 0}, {0, std::nan("")}}};
  for (const auto& bad : {std::vector<MoverMotion>(0), std::vector<MoverMotion>(2), nan})
    EXPECT_THROW((void)world.step({0, 0}, frame, bad), InvalidDefinition);
  EXPECT_EQ(world.position(), Vec2d(50, 50));
  const double cap_speed = max_travel_per_step / frame;
  EXPECT_FALSE(world.step({0, 0}, frame, steady({0.99 * cap_speed, 0}, 0)).capped);
  EXPECT_TRUE(world.step({0, 0}, frame, steady({1.01 * cap_speed, 0}, 1)).capped);
  const auto turned = [&](double angle) {
    return world.step({0, 0}, frame, std::array{MoverMotion{.to_angle = angle}}).capped;
  };
  EXPECT_FALSE(turned(1.5));
  EXPECT_TRUE(turned(1.6)) << "a quarter of a circle";
  EXPECT_THROW(turned(std::nan("")), InvalidDefinition);
}

TEST(Characters, another_number_of_velocities_is_refused_and_one_is_placed) {
  ReferenceWorld world(floor(), {}, std::array{Vec2d(0, 3), Vec2d(9, 3)});
  EXPECT_THROW(world.step({1, 0}, frame), InvalidDefinition);
  world.place({5, 5}, {0, 0}, 1);
  EXPECT_EQ(world.position(1), Vec2d(5, 5));
  EXPECT_EQ(world.position(0), Vec2d(0, 3));
}

/// To the boundary of a rectangle, from either side.
double distance_to_boundary(const ColliderDef& rectangle, const Vec2d& point) {
  const Vec2d outside = (rectangle.points[0] - point).cwiseMax(point - rectangle.points[2]);
  return outside.maxCoeff() > 0 ? outside.cwiseMax(0.0).norm() : -outside.maxCoeff();
}

ColliderLookup lookup_of(const std::vector<ColliderDef>& colliders) {
  std::vector<ColliderIndex> names(colliders.size());
  std::iota(names.begin(), names.end(), ColliderIndex{0});
  return {SceneryDef{colliders}, names};
}

TEST(ColliderLookup, agrees_with_a_search_through_all_edges) {
  Random random(10);
  std::vector<ColliderDef> colliders;
  for (int i = 0; i < 200; ++i) {
    const Vec2d low = random.point(10);
    const Vec2d high = low + random.point(1.45) + Vec2d(1.55, 1.55);
    colliders.push_back(box(low.x(), low.y(), high.x(), high.y()));
  }
  ColliderLookup lookup = lookup_of(colliders);
  const double reach = 0.1;
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2d point = random.point(11.5) + Vec2d(1.5, 1.5);
    const auto distance = [&](const ColliderDef& collider) { return distance_to_boundary(collider, point); };
    const double least = distance(*std::ranges::min_element(colliders, {}, distance));
    const std::optional<ColliderIndex> answer = lookup.nearest(point, reach);
    ASSERT_EQ(answer.has_value(), least < reach) << "seed 10, " << i;
    if (!answer) continue;
    ++found;
    EXPECT_LE(distance(colliders[*answer]), least + ColliderLookup::same_distance) << "seed 10, " << i;
  }
  EXPECT_GT(found, 400);
  EXPECT_LT(found, 1900);
}

TEST(ColliderLookup, a_shared_edge_belongs_to_the_lowest_index) {
  ColliderLookup lookup = lookup_of({box(5, 5, 6, 6), box(1, 0, 2, 1), box(0, 0, 1, 1)});
  EXPECT_EQ(lookup.nearest({1, 0.5}, 0.02), std::optional<ColliderIndex>(1));
  EXPECT_EQ(lookup.nearest({0, 0.5}, 0.02), std::optional<ColliderIndex>(2));
  EXPECT_EQ(lookup.nearest({3, 0.5}, 0.02), std::nullopt);
}

}  // namespace
}  // namespace paperproof::box2d::test
