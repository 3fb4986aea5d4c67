/// What Box2D would answer with an abort (the package's asserts are on) or with NaN is refused before it gets there.
#include "fixtures.hpp"
#include "levels.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace paperproof::box2d::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Scenery<double> ground() { return level({box(-5, -1, 5, 0)}); }

CharacterDef character_of(std::span<const Vec2d> corners) {
  CharacterDef character;
  character.shape = CharacterShape(corners);
  return character;
}

TEST(InvalidDefinitions, a_position_that_is_not_a_number_is_refused) {
  for (const double bad : {nan, infinity, -infinity, 1e10, 1e300}) {
    EXPECT_THROW(ReferenceWorld(ground(), {}, {bad, 0}), InvalidDefinition);
    EXPECT_THROW(ReferenceWorld(ground(), {}, {0, bad}), InvalidDefinition);
  }
}

TEST(InvalidDefinitions, a_bad_step_or_place_is_refused_and_changes_nothing) {
  ReferenceWorld world(ground(), {}, {0, 2});
  world.step({1, 1}, frame);
  const Vec2d before = world.position();
  for (const double bad : {nan, infinity, -infinity, 1e10}) {
    EXPECT_THROW(world.step({bad, 0}, frame), InvalidDefinition);
    EXPECT_THROW(world.step({0, bad}, frame), InvalidDefinition);
    EXPECT_THROW(world.step({0, 0}, bad), InvalidDefinition);
    EXPECT_THROW(world.place({bad, 0}, {0, 0}), InvalidDefinition);
    EXPECT_THROW(world.place({0, 0}, {0, bad}), InvalidDefinition);
  }
  for (const double bad : {0.0, -frame, 1e-300}) EXPECT_THROW(world.step({0, 0}, bad), InvalidDefinition);
  EXPECT_EQ(world.position(), before);
  world.step({0, 1}, frame);
  EXPECT_NEAR(world.position().y(), before.y() + frame, 1e-6);
}

TEST(InvalidDefinitions, iterations_that_do_nothing_are_refused) {
  EXPECT_THROW(ReferenceWorld(ground(), {}, {0, 2}, {.velocity_iterations = 0}), InvalidDefinition);
  EXPECT_THROW(ReferenceWorld(ground(), {}, {0, 2}, {.position_iterations = -3}), InvalidDefinition);
}

TEST(InvalidDefinitions, a_character_that_box2d_would_weld_is_refused_and_one_just_larger_is_not) {
  const auto square = [](double side) { return std::vector<Vec2d>{{0, 0}, {side, 0}, {side, side}, {0, side}}; };
  // Box2D welds below half its slop of 5 mm.
  EXPECT_THROW(ReferenceWorld(ground(), character_of(square(0.0024)), {0, 2}), InvalidDefinition);
  EXPECT_NO_THROW(ReferenceWorld(ground(), character_of(square(0.0026)), {0, 2}));
  EXPECT_THROW(ReferenceWorld(ground(), character_of(square(1e-9)), {0, 2}), InvalidDefinition);
}

TEST(InvalidDefinitions, a_character_that_is_flat_in_float_is_refused) {
  // A corner 1e-9 above the line between its neighbours: a hull in double, a line in float.
  const std::vector<Vec2d> flat{{0, 0}, {1, 0}, {1, 1}, {0.5, 1 + 1e-9}, {0, 1}};
  EXPECT_THROW(ReferenceWorld(ground(), character_of(flat), {0, 2}), InvalidDefinition);
  EXPECT_THROW((void)character_polygon(std::vector<Vec2d>{{0, 0}, {1, 0}, {2, 0}}), InvalidDefinition);
  EXPECT_THROW((void)character_polygon(std::vector<Vec2d>{{0, 0}, {1, 0}, {nan, 1}}), InvalidDefinition);
  EXPECT_THROW((void)character_polygon(std::vector<Vec2d>{{0, 0}, {1, 0}}), InvalidDefinition);
  EXPECT_THROW((void)character_polygon(std::vector<Vec2d>(9, Vec2d(0, 0))), InvalidDefinition);
}

TEST(InvalidDefinitions, a_collider_that_is_one_point_in_float_is_refused) {
  const double far = 1e6;  // Floats are 6 cm apart there.
  EXPECT_THROW(ReferenceWorld(level({box(far, far, far + 1e-3, far + 1e-3)}), {}, {0, 2}), InvalidDefinition);
  EXPECT_THROW(ReferenceWorld(level({chain({{far, far}, {far + 1e-3, far}})}), {}, {0, 2}), InvalidDefinition);
}

/// Lengths from nothing to the limits, most of them sane.
double any_length(Random& random) {
  switch (random.below(12)) {
    case 0:
      return 0;
    case 1:
      return nan;
    case 2:
      return std::pow(10, random.between(-300, 300));
    case 3:
      return std::pow(10, random.between(-12, -2));
    case 4:
      return std::pow(10, random.between(2, 6.5));
    default:
      return random.between(-5, 5);
  }
}

Vec2d any_point(Random& random) { return {any_length(random), any_length(random)}; }

ColliderDef any_collider(Random& random) {
  const Vec2d centre{random.between(-4, 4), random.between(-4, 4)};
  const double size = std::pow(10, random.between(-9, 1));
  std::vector<Vec2d> points;
  const std::size_t count = 1 + random.below(12);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const double squash = random.below(3) == 0 ? 1e-4 : 1.0;
    points.push_back(centre + size * Vec2d(std::cos(angle), squash * std::sin(angle)) * random.between(0.5, 1));
    if (random.below(40) == 0) points.back() = any_point(random);
    if (random.below(20) == 0) points.push_back(points.back());
  }
  ColliderDef collider = random.below(3) == 0 ? chain(points) : polygon(points);
  if (random.below(4) == 0) collider.one_way = random.below(5) == 0 ? any_point(random) : random.direction();
  return collider;
}

CharacterDef any_character(Random& random) {
  CharacterDef character;
  if (random.below(2) == 0) return character;
  const double size = std::pow(10, random.between(-4, 1));
  std::vector<Vec2d> corners;
  const std::size_t count = 2 + random.below(8);
  for (std::size_t i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    corners.push_back(size * Vec2d(std::cos(angle), std::sin(angle)));
    if (random.below(60) == 0) corners.back() = any_point(random);
  }
  character.shape = CharacterShape(corners);
  return character;
}

struct Outcomes {
  int refused_worlds = 0;
  int refused_steps = 0;
  int steps = 0;
  int steps_with_contact = 0;
};

void check_numbers(const ReferenceWorld& world, const TwinStep& step) {
  ASSERT_TRUE(world.position().allFinite());
  ASSERT_TRUE(step.velocity.allFinite());
  for (const Contact<double>& contact : step.contacts) {
    ASSERT_TRUE(contact.point.allFinite() && contact.normal.allFinite());
    ASSERT_TRUE(contact.fraction >= 0 && contact.fraction <= 1);
    ASSERT_TRUE(std::isfinite(contact.separation));
  }
}

void try_step(ReferenceWorld& world, Random& random, Outcomes& outcomes) {
  const double dt = random.below(10) == 0 ? any_length(random) : frame;
  const Vec2d velocity = random.below(10) == 0 ? any_point(random) : Vec2d(60 * random.direction());
  try {
    const TwinStep& step = world.step(velocity, dt);
    ++outcomes.steps;
    if (!step.contacts.empty()) ++outcomes.steps_with_contact;
    check_numbers(world, step);
  } catch (const InvalidDefinition&) {
    ++outcomes.refused_steps;
  }
}

/// Refused with words or run with finite numbers; an abort or a NaN fails the test.
void try_world(Random& random, Outcomes& outcomes) {
  try {
    // Half of the worlds are a closed room, so that the character meets something.
    std::vector<ColliderDef> colliders;
    if (random.below(2) == 0) colliders.push_back(polygon(rectangle(-9, -9, 9, 9), {rectangle(-6, -6, 6, 6)}));
    for (std::size_t i = random.below(4); i > 0; --i) colliders.push_back(any_collider(random));
    const SceneryMode mode = random.below(2) == 0 ? SceneryMode::chain_loops : SceneryMode::pieces;
    const Vec2d start = random.below(10) == 0 ? any_point(random) : Vec2d{random.between(-4, 4), random.between(-4, 4)};
    ReferenceWorld world(level(std::move(colliders)), any_character(random), start, {.mode = mode});
    for (int k = 0; k < 20; ++k) try_step(world, random, outcomes);
  } catch (const std::invalid_argument& refused) {
    EXPECT_GT(std::string(refused.what()).size(), 10U);
    ++outcomes.refused_worlds;
  }
}

TEST(InvalidDefinitions, random_definitions_never_abort_and_never_give_a_nan) {
  Outcomes outcomes;
  constexpr int definitions = paperproof::test::sampled(20000);
  for (std::uint64_t seed = 0; seed < definitions; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    ASSERT_NO_FATAL_FAILURE(try_world(random, outcomes));
  }
  EXPECT_GT(outcomes.refused_worlds, definitions / 5);
  EXPECT_GT(outcomes.refused_steps, definitions / 4);
  EXPECT_GT(outcomes.steps, definitions * 3);
  EXPECT_GT(outcomes.steps_with_contact, definitions / 4);
}

}  // namespace
}  // namespace paperproof::box2d::test
