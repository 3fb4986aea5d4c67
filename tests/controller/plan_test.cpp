/// The plan: what may be left out, what may not, and that nothing comes of it but speed.
#include "campaign/shapes.hpp"
#include "controller/states.hpp"
#include "support/random_runs.hpp"
#include "support/refusal.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/plan.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace paperproof {
namespace {

using compare::box;
using stepping::Stepper;

const ColliderDef ground = box(-10, -1, 10, 0);
/// Nothing is known to happen.
constexpr Foreseen nothing{.gravity = false, .jump = false};

Plan plan_for(const SceneryDef& def, const Foreseen& foreseen = nothing) {
  return make_plan(Scenery<double>(def), foreseen);
}

/// What building a controller says, or nothing.
std::string refusal(const SceneryDef& def, const Stages& stages) {
  const Scenery<double> scenery(def);
  return test::refusal_by<std::invalid_argument>([&] { Controller<double>(scenery, {}, {.stages = stages}); });
}

TEST(Plan, of_a_floor_that_nothing_happens_on_leaves_out_every_stage_each_with_a_reason) {
  const Plan plan = plan_for({{ground}});
  EXPECT_EQ(plan.omitted.size(), all_stages.size());
  EXPECT_EQ(plan.stages, (Stages{false, false, false, false, false, false}));
  for (const Omission& omission : plan.omitted) EXPECT_GT(omission.reason.size(), 20U) << name_of(omission.stage);
  EXPECT_EQ(refusal({{ground}}, plan.stages), "");
  const Stages unknown = plan_for({{ground}}, {}).stages;
  EXPECT_TRUE(unknown.gravity && unknown.jump) << "nothing is known of the steps";
}

TEST(Plan, keeps_just_the_stage_that_something_needs_and_no_controller_is_built_without_it) {
  ColliderDef belt = ground;
  belt.surface_speed = -1;
  ColliderDef ledge = compare::chain({{0, 2}, {1, 2}});
  ledge.one_way = Vec2d(0, 1);
  const ColliderDef slope = compare::polygon({{0, 0}, {2, 0}, {2, 1}});
  ColliderDef sensor = slope;  // slopes of solids alone count
  sensor.sensor = true;
  struct Need {
    const char* name;
    Stage stage;
    ColliderDef collider;
    Foreseen foreseen = nothing;
  };
  const std::vector<Need> needs{{"a mover", Stage::movers, box(20, 0, 21, 1, 0)},
                                {"a belt", Stage::movers, belt},
                                {"a ledge", Stage::one_way, ledge},
                                {"a sensor", Stage::sensors, sensor},
                                {"a slope", Stage::slopes, slope},
                                {"a chain an ulp high", Stage::slopes, compare::chain({{0, 2}, {1, 2 + 0x1p-51}})},
                                {"a circle", Stage::slopes, compare::circle({0, 5}, 1)},
                                {"jumps", Stage::jump, ground, {.gravity = false, .jump = true}},
                                {"gravity", Stage::gravity, ground, {.gravity = true, .jump = false}}};
  for (const Need& need : needs) {
    const SceneryDef def{{ground, need.collider}};
    const Plan plan = plan_for(def, need.foreseen);
    EXPECT_EQ(plan.omitted.size(), all_stages.size() - 1) << need.name;
    for (const Omission& omission : plan.omitted) EXPECT_NE(omission.stage, need.stage) << need.name;
    EXPECT_EQ(refusal(def, plan.stages), "") << need.name;
    const std::string said = refusal(def, plan_for({{ground}}).stages);
    const bool of_scenery = need.foreseen.jump == nothing.jump && need.foreseen.gravity == nothing.gravity;
    EXPECT_EQ(said.find(name_of(need.stage)) != std::string::npos, of_scenery) << need.name << ": " << said;
  }
}

TEST(Plan, chooses_the_broad_phase_by_the_number_of_what_stands_still) {
  const auto chosen = [](int still, int moving) {
    SceneryDef def;
    for (int i = 0; i < still + moving; ++i)
      def.colliders.push_back(box(2 * i, 0, 2 * i + 1, 1, i < still ? no_mover : 0));
    return plan_for(def).broad_phase;
  };
  EXPECT_EQ(chosen(16, 1000), BroadPhaseKind::all_pairs);
  EXPECT_EQ(chosen(17, 0), BroadPhaseKind::tree);
  EXPECT_EQ(chosen(10'000, 0), BroadPhaseKind::tree);
}

TEST(Stages, that_were_left_out_make_what_they_were_for_invalid_input) {
  Stepper<double> stepper({ground}, {}, {.stages = {.jump = false, .gravity = false}});
  const CharacterState<double> before = stepper.at(0, 3).state;
  const auto step = [&stepper](bool jump, double gravity) {
    stepper.gravity.y() = gravity;
    return stepper.step({.move = 0.0, .jump = jump});
  };
  EXPECT_EQ(step(true, 0), StepStatus::invalid_input);
  EXPECT_EQ(step(false, -1e-300), StepStatus::invalid_input);
  EXPECT_EQ(step(false, std::numeric_limits<double>::quiet_NaN()), StepStatus::invalid_input);
  EXPECT_EQ(stepper.state, before);
  EXPECT_EQ(step(false, 0), StepStatus::moved);
}

/// Steps at random, by the plan and with every stage. @returns how many stages the plan left out.
template <class Scalar>
std::size_t run_both(const SceneryDef& def, const Foreseen& foreseen, test::Random& random) {
  CharacterDef character;
  character.snap = random.chance(0.3) ? 0.3 : 0;
  character.step_height = random.chance(0.3) ? 0.4 : 0;
  const Plan plan = make_plan(Scenery<Scalar>(def), foreseen);
  Stepper<Scalar> planned(def.colliders, character, {.broad_phase = plan.broad_phase, .stages = plan.stages});
  Stepper<Scalar> full(def.colliders, character);
  full.state.position = random.point(4).cast<Scalar>();
  full.state.velocity = random.point(20).cast<Scalar>();
  planned.state = full.state;
  planned.gravity.y() = full.gravity.y() = Scalar(foreseen.gravity ? -30 : 0);
  std::vector<test::Wanderer> wanderers(full.movers.size());
  Input input;
  for (int step = 0; step < 20; ++step) {
    if (random.chance(0.2)) input.move = random.integer(-1, 1);
    if (foreseen.jump && random.chance(0.2)) input.jump = !input.jump;
    for (std::size_t k = 0; k < wanderers.size(); ++k) {
      const Vec2d at = full.movers[k].to.template cast<double>();
      full.movers[k] = {full.movers[k].to, next_offset(wanderers[k], at, random).template cast<Scalar>()};
    }
    planned.movers = full.movers;
    planned.step(input);
    full.step(input);
    EXPECT_TRUE(stepping::same_step(planned.state, planned.report, full.state, full.report)) << "step " << step;
  }
  return plan.omitted.size();
}

TEST(Plan, planned_and_full_give_the_same_bits_in_10000_random_sceneries) {
  std::array<int, all_stages.size() + 1> omissions{};
  for (std::uint64_t seed = 0; seed < test::sampled(10'000U) && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    test::Random random(seed);
    const auto terrain = test::all_terrains[seed % test::all_terrains.size()];
    SceneryDef def = test::random_terrain(terrain, random, Vec2d(0, 0));
    for (MoverIndex mover = 0; random.chance(0.3); ++mover) test::add_mover(def.colliders, mover, random, {0, 0});
    if (random.chance(0.1)) def.colliders[0].surface_speed = 2;
    def.colliders.push_back(box(-1, -1, 0, 0));
    def.colliders.back().sensor = random.chance(0.2);
    const bool pulls = random.chance(0.7);
    const Foreseen foreseen{.gravity = pulls, .jump = random.chance(0.7)};
    ++omissions[seed % 4 == 0 ? run_both<float>(def, foreseen, random) : run_both<double>(def, foreseen, random)];
  }
  // The sceneries differ in what they need: no number of omissions but none and all is rare.
  for (std::size_t count = 1; count < all_stages.size(); ++count)
    EXPECT_GT(omissions[count], test::sampled(20)) << count;
}

}  // namespace
}  // namespace paperproof
