/// What Box2D would answer with an abort (the package's asserts are on) or with NaN is refused before it gets there.
#include "fixtures.hpp"
#include "levels.hpp"
#include "support/steps_wanted.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace paperproof::box2d::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

Scenery ground() { return level({box(-5, -1, 5, 0)}); }

TEST(InvalidDefinitions, a_bad_position_step_or_place_is_refused_and_changes_nothing) {
  ReferenceWorld world(ground(), {}, {0, 2});
  world.step({1, 1}, frame);
  const Vec2d before = world.position();
  for (const double bad : {nan, infinity, -infinity, 1e10}) {
    EXPECT_THROW(ReferenceWorld(ground(), {}, {bad, 0}), InvalidDefinition);
    EXPECT_THROW(ReferenceWorld(ground(), {}, {0, bad}), InvalidDefinition);
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
  EXPECT_THROW(ReferenceWorld(ground(), {}, {0, 2}, {.velocity_iterations = 0}), InvalidDefinition);
  EXPECT_THROW(ReferenceWorld(ground(), {}, {0, 2}, {.position_iterations = -3}), InvalidDefinition);
}

TEST(InvalidDefinitions, shapes_that_box2d_would_weld_or_that_are_flat_in_float_are_refused) {
  const auto square = [](double side) { return CharacterDef{.shape = CharacterShape(box(0, 0, side, side).points)}; };
  // Box2D welds below half its slop of 5 mm.
  EXPECT_THROW(ReferenceWorld(ground(), square(0.0024), {0, 2}), InvalidDefinition);
  EXPECT_NO_THROW(ReferenceWorld(ground(), square(0.0026), {0, 2}));
  // A corner 1e-9 above the line between its neighbours: a hull in double, a line in float.
  const std::vector<Vec2d> flat{{0, 0}, {1, 0}, {1, 1}, {0.5, 1 + 1e-9}, {0, 1}};
  EXPECT_THROW(ReferenceWorld(ground(), {.shape = CharacterShape(flat)}, {0, 2}), InvalidDefinition);
  for (const std::vector<Vec2d>& bad : {std::vector<Vec2d>{{0, 0}, {1, 0}, {2, 0}},
                                        {{0, 0}, {1, 0}, {nan, 1}},
                                        {{0, 0}, {1, 0}},
                                        std::vector<Vec2d>(9, Vec2d(0, 0))})
    EXPECT_THROW((void)character_polygon(bad), InvalidDefinition);
  const double far = 1e6;  // Floats are 6 cm apart there.
  EXPECT_THROW(ReferenceWorld(level({box(far, far, far + 1e-3, far + 1e-3)}), {}, {0, 2}), InvalidDefinition);
  EXPECT_THROW(ReferenceWorld(level({chain({{far, far}, {far + 1e-3, far}})}), {}, {0, 2}), InvalidDefinition);
}

/// Lengths from nothing to the limits, most of them sane.
double any_length(Random& random) {
  const std::array odd{0.0, nan, random.log_between(1e-300, 1e300), random.log_between(1e-12, 1e-2),
                       random.log_between(1e2, 3e6)};
  const auto which = static_cast<std::size_t>(random.below(12));
  return which < odd.size() ? odd[which] : random.between(-5, 5);
}

Vec2d any_point(Random& random) { return {any_length(random), any_length(random)}; }

/// Corners around the origin, one in `wild` of them anywhere, and some twice.
std::vector<Vec2d> any_ring(Random& random, int corners, double size, int wild) {
  std::vector<Vec2d> points;
  for (int i = 0; i < corners; ++i) {
    points.emplace_back(size * towards(2 * std::numbers::pi * i / corners));
    if (random.below(wild) == 0) points.back() = any_point(random);
    if (random.below(wild) == 0) points.push_back(points.back());
  }
  return points;
}

ColliderDef any_collider(Random& random) {
  const Vec2d centre = random.point(4);
  const int corners = random.integer(1, 12);
  std::vector<Vec2d> points = any_ring(random, corners, random.log_between(1e-9, 10), 40);
  const double squash = random.below(3) == 0 ? 1e-4 : 1.0;
  for (Vec2d& point : points) point = centre + random.between(0.5, 1) * Vec2d(point.x(), squash * point.y());
  ColliderDef collider = random.below(3) == 0 ? chain(points) : polygon(points);
  if (random.below(4) == 0) collider.one_way = random.below(5) == 0 ? any_point(random) : towards(random.angle());
  return collider;
}

struct Outcomes {
  int refused_worlds = 0;
  int refused_steps = 0;
  int steps = 0;
  int steps_with_contact = 0;
};

void try_step(ReferenceWorld& world, Random& random, Outcomes& outcomes) {
  const double dt = random.below(10) == 0 ? any_length(random) : frame;
  const Vec2d velocity = random.below(10) == 0 ? any_point(random) : Vec2d(60 * towards(random.angle()));
  try {
    const TwinStep& step = world.step(velocity, dt);
    ++outcomes.steps;
    outcomes.steps_with_contact += !step.contacts.empty();
    ASSERT_TRUE(world.position().allFinite() && step.velocity.allFinite());
    for (const Contact& contact : step.contacts) {
      ASSERT_TRUE(contact.point.allFinite() && contact.normal.allFinite() && std::isfinite(contact.separation));
      ASSERT_TRUE(contact.fraction >= 0 && contact.fraction <= 1);
    }
  } catch (const InvalidDefinition&) {
    ++outcomes.refused_steps;
  }
}

/// Refused with words or run with finite numbers; an abort or a NaN fails the test.
void try_world(Random& random, Outcomes& outcomes) {
  try {
    // Half of the worlds are a closed room, so that the character meets something.
    std::vector<ColliderDef> colliders;
    if (random.below(2) == 0) colliders.push_back(with_hole(box(-9, -9, 9, 9), box(-6, -6, 6, 6)));
    for (int i = random.below(4); i > 0; --i) colliders.push_back(any_collider(random));
    const Vec2d start = random.below(10) == 0 ? any_point(random) : random.point(4);
    CharacterDef character;
    const int corners = random.integer(-6, 9);
    if (corners > 1) character.shape = CharacterShape(any_ring(random, corners, random.log_between(1e-4, 10), 60));
    ReferenceWorld world(level(std::move(colliders)), character, start, {.mode = modes.at(random.chance(0.5))});
    for (int k = 0; k < 20; ++k) try_step(world, random, outcomes);
  } catch (const std::invalid_argument& refused) {
    EXPECT_GT(std::string(refused.what()).size(), 10U);
    ++outcomes.refused_worlds;
  }
}

TEST(InvalidDefinitions, random_definitions_never_abort_and_never_give_a_nan) {
  Outcomes outcomes;
  const unsigned definitions = paperproof::test::sampled(20000U);
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
