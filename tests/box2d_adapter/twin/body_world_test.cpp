/// Bodies that Box2D moves: they fall, rest, are lifted and hit as Box2D has it, and bad definitions never reach it.
#include "levels.hpp"

#include <paperproof/box2d/body_world.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace paperproof::box2d::test {
namespace {

ColliderDef of_mover(ColliderDef collider, MoverIndex mover) {
  collider.mover = mover;
  return collider;
}

/// A world in which the colliders behind the first are bodies.
struct Bodies {
  Bodies(std::vector<ColliderDef> colliders, const std::vector<BodyDef>& defs, const Vec2d& gravity)
      : world(level(with_movers(std::move(colliders))), std::vector<std::optional<BodyDef>>(defs.begin(), defs.end()),
              gravity),
        motions(defs.size()) {}

  static std::vector<ColliderDef> with_movers(std::vector<ColliderDef> colliders) {
    for (std::size_t i = 1; i < colliders.size(); ++i) colliders[i].mover = static_cast<MoverIndex>(i - 1);
    return colliders;
  }

  void step() {
    const std::vector<MoverMotion<double>> before = motions;
    world.step(frame, motions);
    for (std::size_t i = 0; i < motions.size(); ++i) EXPECT_EQ(motions[i].from, before[i].to);
  }

  BodyWorld world;
  std::vector<MoverMotion<double>> motions;
};

TEST(BodyWorld, a_body_falls_by_the_sum_of_its_steps) {
  Bodies bodies({box(-9, -100, 9, -99), box(0, 0, 1, 1)}, {{.velocity = {3, 0}}}, {0, -10});
  for (int n = 1; n <= 60; ++n) {
    bodies.step();
    EXPECT_NEAR(bodies.motions[0].to.x(), 3 * n * frame, 1e-5);
    EXPECT_NEAR(bodies.motions[0].to.y(), -10 * frame * frame * n * (n + 1) / 2, 1e-5) << n;
  }
}

TEST(BodyWorld, a_body_comes_to_rest_on_what_stands_within_box2ds_gap) {
  Bodies bodies({box(-9, -1, 9, 0), box(0, 0.5, 1, 1.5)}, {{.mass = 7}}, {0, -10});
  for (int n = 0; n < 120; ++n) bodies.step();
  EXPECT_NEAR(0.5 + bodies.motions[0].to.y(), rest_gap, 0.006);
  const Vec2d at_rest = bodies.motions[0].to;
  for (int n = 0; n < 60; ++n) bodies.step();
  EXPECT_NEAR((bodies.motions[0].to - at_rest).norm(), 0, 1e-6);
}

TEST(BodyWorld, equal_masses_exchange_their_velocities_and_a_heavy_one_goes_on) {
  for (const double mass : {1.0, 1000.0}) {
    Bodies bodies({box(-9, -9, 9, -8), box(0, 0, 1, 1), box(2, 0, 3, 1)},
                  {{.mass = mass, .restitution = 1, .velocity = {6, 0}}, {.mass = 1, .restitution = 1}}, {0, 0});
    for (int n = 0; n < 60; ++n) bodies.step();
    const auto speed = [&bodies](std::size_t i) { return (bodies.motions[i].to - bodies.motions[i].from).x() / frame; };
    EXPECT_NEAR(speed(0), 6 * (mass - 1) / (mass + 1), 0.02) << mass;
    EXPECT_NEAR(speed(1), 6 * 2 * mass / (mass + 1), 0.02) << mass;
  }
}

TEST(BodyWorld, friction_of_a_body_and_of_scenery_mix_to_the_root_of_their_product) {
  // On the flat a body slows down by mu g, mu = sqrt(0.45 * 0.2) = 0.3: from 3 m/s it stops within 1.5 m.
  Bodies bodies({box(-9, -1, 9, 0), box(0, rest_gap, 1, 1)}, {{.friction = 0.45, .velocity = {3, 0}}}, {0, -10});
  for (int n = 0; n < 120; ++n) bodies.step();
  EXPECT_NEAR(bodies.motions[0].to.x(), 3 * 3 / (2 * 0.3 * 10), 0.05);
}

TEST(BodyWorld, what_goes_along_a_path_lifts_a_body_and_is_not_changed) {
  const Scenery<double> scenery =
      level({of_mover(box(-2, -1, 2, 0), 0), of_mover(box(0, rest_gap, 1, 1 + rest_gap), 1)});
  const std::vector<std::optional<BodyDef>> defs{std::nullopt, BodyDef{}};
  BodyWorld world(scenery, defs, {0, -10});
  std::vector<MoverMotion<double>> motions(2);
  for (int n = 0; n < 120; ++n) {
    const MoverMotion<double> lift{{0, 2 * n * frame}, {0, 2 * (n + 1) * frame}};
    motions[0] = lift;
    world.step(frame, motions);
    EXPECT_EQ(motions[0].from, lift.from);
    EXPECT_EQ(motions[0].to, lift.to);
    EXPECT_NEAR(motions[1].to.y(), motions[0].to.y(), 0.01) << n;
  }
}

TEST(BodyWorld, bad_definitions_are_refused_before_box2d_sees_them) {
  const auto world_of = [](const BodyDef& def) {
    return Bodies({box(-9, -9, 9, -8), box(0, 0, 1, 1)}, {def}, {0, -10});
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(world_of({}));
  for (const double mass : {0.0, -1.0, nan, 1e10}) EXPECT_THROW(world_of({.mass = mass}), InvalidDefinition) << mass;
  for (const double friction : {-1.0, nan}) EXPECT_THROW(world_of({.friction = friction}), InvalidDefinition);
  for (const double rise : {-0.1, 1.1, nan}) EXPECT_THROW(world_of({.restitution = rise}), InvalidDefinition);
  EXPECT_THROW(world_of({.velocity = {nan, 0}}), InvalidDefinition);
  EXPECT_THROW(Bodies({box(-9, -9, 9, -8), box(0, 0, 1, 1)}, {{}}, {0, nan}), InvalidDefinition);
  const std::vector<std::optional<BodyDef>> two(2);
  EXPECT_THROW(BodyWorld(level({box(-9, -9, 9, -8), of_mover(box(0, 0, 1, 1), 0)}), two, {0, 0}), InvalidDefinition);
}

TEST(BodyWorld, a_bad_step_is_refused_and_nothing_is_stepped) {
  Bodies bodies({box(-9, -9, 9, -8), box(0, 0, 1, 1)}, {{}}, {0, -10});
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<MoverMotion<double>> two(2);
  EXPECT_THROW(bodies.world.step(0, bodies.motions), InvalidDefinition);
  EXPECT_THROW(bodies.world.step(nan, bodies.motions), InvalidDefinition);
  EXPECT_THROW(bodies.world.step(frame, two), InvalidDefinition);
  bodies.step();
  EXPECT_EQ(bodies.motions[0].from, Vec2d(0, 0));
}

TEST(BodyWorld, two_worlds_go_the_same_way_bit_for_bit) {
  const auto pile = [] {
    std::vector<ColliderDef> colliders{box(-9, -1, 9, 0)};
    std::vector<BodyDef> defs;
    for (int i = 0; i < 6; ++i) {
      const double x = (i % 2) * 0.4;
      colliders.push_back(box(x, i + 0.1, x + 1, i + 1));
      defs.push_back({.mass = i % 3 == 0 ? 10.0 : 1.0});
    }
    return Bodies(std::move(colliders), defs, {0, -10});
  };
  Bodies one = pile();
  Bodies two = pile();
  for (int n = 0; n < 300; ++n) {
    one.step();
    two.step();
    for (std::size_t i = 0; i < 6; ++i) ASSERT_EQ(one.motions[i].to, two.motions[i].to) << n << " " << i;
  }
}

}  // namespace
}  // namespace paperproof::box2d::test
