/// The plan: what may be left out, what may not, and that nothing comes of it but speed.
#include "controller/stepping.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/plan.hpp>

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

namespace paperproof {
namespace {

using stepping::rectangle;

SceneryDef floor_only() { return {{rectangle(-10, -1, 10, 0)}}; }
/// Nothing is known to happen.
constexpr Foreseen nothing{.gravity = false, .jump = false};

Plan plan_for(const SceneryDef& def, const Foreseen& foreseen = nothing) {
  return make_plan(Scenery<double>(def), foreseen);
}

std::vector<Stage> left_out(const Plan& plan) {
  std::vector<Stage> stages;
  for (const Omission& omission : plan.omitted) stages.push_back(omission.stage);
  return stages;
}

std::vector<Stage> all_but(Stage kept) {
  std::vector<Stage> stages(all_stages.begin(), all_stages.end());
  std::erase(stages, kept);
  return stages;
}

TEST(Plan, of_a_floor_that_nothing_happens_on_leaves_out_every_stage_each_with_a_reason) {
  const Plan plan = plan_for(floor_only());
  EXPECT_EQ(left_out(plan), std::vector<Stage>(all_stages.begin(), all_stages.end()));
  EXPECT_EQ(plan.stages, (Stages{false, false, false, false, false, false}));
  for (const Omission& omission : plan.omitted) EXPECT_GT(omission.reason.size(), 20U) << name_of(omission.stage);
}

TEST(Plan, keeps_gravity_and_jumps_where_nothing_is_known_of_the_steps) {
  const Plan plan = plan_for(floor_only(), {});
  EXPECT_TRUE(plan.stages.gravity);
  EXPECT_TRUE(plan.stages.jump);
}

struct Kept {
  const char* name;
  Stage stage;
  std::function<void(SceneryDef&, Foreseen&)> change;
};

void PrintTo(const Kept& kept, std::ostream* stream) { *stream << kept.name; }

class PlanKeeps : public testing::TestWithParam<Kept> {};

TEST_P(PlanKeeps, just_the_stage_that_the_change_needs) {
  SceneryDef def = floor_only();
  Foreseen foreseen = nothing;
  GetParam().change(def, foreseen);
  EXPECT_EQ(left_out(plan_for(def, foreseen)), all_but(GetParam().stage));
}

ColliderDef moving(ColliderDef def) {
  def.mover = 0;
  return def;
}

INSTANTIATE_TEST_SUITE_P(
    Each, PlanKeeps,
    testing::Values(
        Kept{"a_mover", Stage::movers,
             [](SceneryDef& def, auto&) { def.colliders.push_back(moving(rectangle(20, 0, 21, 1))); }},
        Kept{"a_conveyor", Stage::movers, [](SceneryDef& def, auto&) { def.colliders[0].surface_speed = -1; }},
        Kept{"a_one_way_chain", Stage::one_way,
             [](SceneryDef& def, auto&) {
               def.colliders.push_back(
                   {.shape = ColliderDef::Shape::chain, .points = {{0, 2}, {1, 2}}, .one_way = Vec2d(0, 1)});
             }},
        Kept{"a_sensor", Stage::sensors,
             [](SceneryDef& def, auto&) {
               def.colliders.push_back(rectangle(0, 1, 1, 2));
               def.colliders.back().sensor = true;
             }},
        Kept{"a_slope", Stage::slopes,
             [](SceneryDef& def, auto&) {
               def.colliders.push_back({.points = {{0, 0}, {2, 0}, {2, 1}}});
             }},
        Kept{"a_sloping_chain_an_ulp_high", Stage::slopes,
             [](SceneryDef& def, auto&) {
               def.colliders.push_back({.shape = ColliderDef::Shape::chain, .points = {{0, 2}, {1, 2 + 0x1p-51}}});
             }},
        Kept{"jumps", Stage::jump, [](SceneryDef&, Foreseen& foreseen) { foreseen.jump = true; }},
        Kept{"gravity", Stage::gravity, [](SceneryDef&, Foreseen& foreseen) { foreseen.gravity = true; }}),
    [](const testing::TestParamInfo<Kept>& kept) { return std::string(kept.param.name); });

TEST(Plan, takes_the_diagonal_by_which_a_concave_polygon_is_cut_for_a_slope) {
  // An L of level and upright edges: its two convex parts meet along a diagonal, or not, as the cut falls. Kept is
  // right either way; left out only where no piece has a diagonal.
  const Scenery<double> ell(SceneryDef{{{.points = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}}}});
  bool diagonal = false;
  for (PieceIndex piece = 0; piece < ell.pieces().size(); ++piece) {
    const auto vertices = ell.vertices_of(piece);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const Vec2d edge = vertices[(i + 1) % vertices.size()] - vertices[i];
      diagonal = diagonal || (edge.x() != 0 && edge.y() != 0);
    }
  }
  EXPECT_EQ(make_plan(ell).stages.slopes, diagonal);
}

TEST(Plan, looks_at_slopes_of_solids_only) {
  SceneryDef def = floor_only();
  def.colliders.push_back({.points = {{0, 0}, {2, 0}, {2, 1}}, .sensor = true});
  EXPECT_FALSE(plan_for(def).stages.slopes);
}

TEST(Plan, chooses_the_broad_phase_by_the_number_of_what_stands_still) {
  const auto boxes = [](int count) {
    SceneryDef def;
    for (int i = 0; i < count; ++i) def.colliders.push_back(rectangle(2 * i, 0, 2 * i + 1, 1));
    return def;
  };
  EXPECT_EQ(plan_for(boxes(16)).broad_phase, BroadPhaseKind::all_pairs);
  EXPECT_EQ(plan_for(boxes(17)).broad_phase, BroadPhaseKind::tree);
  EXPECT_EQ(plan_for(boxes(10'000)).broad_phase, BroadPhaseKind::tree);
  SceneryDef many = boxes(1000);
  for (ColliderDef& def : many.colliders) def.mover = 0;
  many.colliders.push_back(rectangle(0, 5, 1, 6));
  EXPECT_EQ(plan_for(many).broad_phase, BroadPhaseKind::all_pairs);
}

// --- what is built by it

/// What building says about an omission, or nothing.
std::string refusal(const SceneryDef& def, const Stages& stages) {
  const Scenery<double> scenery(def);
  try {
    const Controller<double> controller(scenery, {}, {.stages = stages});
    return {};
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
}

TEST(Stages, cannot_be_left_out_where_the_scenery_needs_them) {
  SceneryDef mover = floor_only();
  mover.colliders.push_back(moving(rectangle(20, 0, 21, 1)));
  EXPECT_NE(refusal(mover, {.movers = false}).find("movers"), std::string::npos);
  SceneryDef one_way = floor_only();
  one_way.colliders.push_back({.shape = ColliderDef::Shape::chain, .points = {{0, 2}, {1, 2}}, .one_way = Vec2d(0, 1)});
  EXPECT_NE(refusal(one_way, {.one_way = false}).find("one_way"), std::string::npos);
  SceneryDef sensor = floor_only();
  sensor.colliders.push_back(rectangle(0, 1, 1, 2));
  sensor.colliders.back().sensor = true;
  EXPECT_NE(refusal(sensor, {.sensors = false}).find("sensors"), std::string::npos);
  SceneryDef slope = floor_only();
  slope.colliders.push_back({.points = {{0, 0}, {2, 0}, {2, 1}}});
  EXPECT_NE(refusal(slope, {.slopes = false}).find("slopes"), std::string::npos);
  EXPECT_EQ(refusal(floor_only(), plan_for(floor_only()).stages), "");
}

TEST(Stages, that_were_left_out_make_what_they_were_for_invalid_input) {
  const Scenery<double> scenery(floor_only());
  const Controller<double> controller(scenery, CharacterDef{}, {.stages = {.jump = false, .gravity = false}});
  Scratch<double> scratch = controller.make_scratch();
  CharacterState<double> state;
  state.position = {0, 3};
  const CharacterState<double> before = state;
  StepReport<double> report;
  EXPECT_EQ(controller.step(state, {.move = 0.0, .jump = true}, {{0, 0}, 0.1}, scratch, report),
            StepStatus::invalid_input);
  EXPECT_EQ(controller.step(state, {}, {{0, -1e-300}, 0.1}, scratch, report), StepStatus::invalid_input);
  EXPECT_EQ(controller.step(state, {}, {{0, std::numeric_limits<double>::quiet_NaN()}, 0.1}, scratch, report),
            StepStatus::invalid_input);
  EXPECT_EQ(state, before);
  EXPECT_EQ(controller.step(state, {}, {{0, 0}, 0.1}, scratch, report), StepStatus::moved);
}

// --- planned and full, bit for bit

template <class Scalar>
bool same(const Vec2<Scalar>& a, const Vec2<Scalar>& b) {
  return std::memcmp(a.data(), b.data(), sizeof(a)) == 0;
}

template <class Scalar>
testing::AssertionResult same_bits(const CharacterState<Scalar>& a, const StepReport<Scalar>& one,
                                   const CharacterState<Scalar>& b, const StepReport<Scalar>& two) {
  const bool flags = a == b && one.status == two.status;
  bool bits = same(a.position, b.position) && same(a.velocity, b.velocity) && same(one.requested, two.requested) &&
              one.move.path.size() == two.move.path.size() && one.move.contacts.size() == two.move.contacts.size() &&
              one.sensors.size() == two.sensors.size();
  for (std::size_t i = 0; bits && i < one.move.path.size(); ++i)
    bits = same(one.move.path[i].position, two.move.path[i].position) &&
           one.move.path[i].fraction == two.move.path[i].fraction;
  for (std::size_t i = 0; bits && i < one.move.contacts.size(); ++i) {
    const Contact<Scalar>& c = one.move.contacts[i];
    const Contact<Scalar>& d = two.move.contacts[i];
    bits = c.collider == d.collider && c.side == d.side && same(c.point, d.point) && same(c.normal, d.normal) &&
           c.fraction == d.fraction && c.separation == d.separation;
  }
  if (flags && bits) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "planned ends at (" << a.position.transpose() << "), full at ("
                                     << b.position.transpose() << ")";
}

/// A scenery of some family, at times with a one-way chain, a mover, a sensor or a conveyor added.
SceneryDef varied_scenery(test::Random& random) {
  const auto family =
      test::all_terrains[static_cast<std::size_t>(random.integer(0, static_cast<int>(test::all_terrains.size()) - 1))];
  SceneryDef def = test::random_terrain(family, random, Vec2d(0, 0));
  if (random.chance(0.3)) {
    const double x = random.between(-3, 2);
    const double y = random.between(-2, 3);
    def.colliders.push_back({.shape = ColliderDef::Shape::chain, .points = {{x, y}, {x + 2, y}}});
    if (random.chance(0.5)) def.colliders.back().one_way = Vec2d(0, 1);
  }
  if (random.chance(0.3)) {
    const double x = random.between(-4, 3);
    def.colliders.push_back(moving(rectangle(x, 3, x + 1, 3.5)));
  }
  if (random.chance(0.1)) def.colliders[0].surface_speed = 2;
  if (random.chance(0.2)) {
    def.colliders.push_back(rectangle(-1, -1, 0, 0));
    def.colliders.back().sensor = true;
  }
  return def;
}

struct Play {
  Foreseen foreseen;
  Vec2d gravity;
  double snap = 0;
  std::vector<Input> inputs;
  Vec2d position;
  Vec2d velocity;
  Vec2d mover_way;  ///< In each step [m].
};

Play random_play(test::Random& random) {
  Play run;
  run.foreseen = {.gravity = random.chance(0.7), .jump = random.chance(0.7)};
  run.gravity = run.foreseen.gravity ? Vec2d(0, -30) : Vec2d(0, 0);
  run.snap = random.chance(0.3) ? 0.3 : 0;
  run.position = {random.between(-4, 4), random.between(-3, 5)};
  run.velocity = {random.between(-20, 20), random.between(-20, 20)};
  run.mover_way = {random.between(-0.2, 0.2), random.between(-0.4, 0.1)};
  Input input;
  for (int i = 0; i < 20; ++i) {
    if (random.chance(0.2)) input.move = random.integer(-1, 1);
    if (run.foreseen.jump && random.chance(0.2)) input.jump = !input.jump;
    run.inputs.push_back(input);
  }
  return run;
}

/// @returns how many stages the plan left out.
template <class Scalar>
std::size_t run_both(const SceneryDef& def, const Play& run) {
  const Scenery<Scalar> scenery(def);
  CharacterDef character;
  character.snap = run.snap;
  const Plan plan = make_plan(scenery, run.foreseen);
  const Controller<Scalar> planned(scenery, character, {.broad_phase = plan.broad_phase, .stages = plan.stages});
  const Controller<Scalar> full(scenery, character);
  Scratch<Scalar> planned_scratch = planned.make_scratch();
  Scratch<Scalar> full_scratch = full.make_scratch();
  CharacterState<Scalar> a;
  a.position = run.position.cast<Scalar>();
  a.velocity = run.velocity.cast<Scalar>();
  CharacterState<Scalar> b = a;
  const Vec2<Scalar> gravity = run.gravity.cast<Scalar>();
  StepReport<Scalar> one;
  StepReport<Scalar> two;
  MoverMotion<Scalar> motion;
  for (const Input& input : run.inputs) {
    motion.from = motion.to;
    motion.to += run.mover_way.cast<Scalar>();
    const std::span<const MoverMotion<Scalar>> movers(&motion, scenery.mover_count());
    planned.step(a, input, {gravity, Scalar(1) / 60, movers}, planned_scratch, one);
    full.step(b, input, {gravity, Scalar(1) / 60, movers}, full_scratch, two);
    const testing::AssertionResult equal = same_bits(a, one, b, two);
    EXPECT_TRUE(equal);
    if (!equal) break;
  }
  return plan.omitted.size();
}

TEST(Plan, planned_and_full_give_the_same_bits_in_10000_random_sceneries) {
  test::Random random(20);
  std::array<int, all_stages.size() + 1> omissions{};
  for (int i = 0; i < test::sampled(10'000) && !testing::Test::HasFailure(); ++i) {
    const SceneryDef def = varied_scenery(random);
    const Play run = random_play(random);
    SCOPED_TRACE(i);
    ++omissions[i % 4 == 0 ? run_both<float>(def, run) : run_both<double>(def, run)];
  }
  // The sceneries differ in what they need: no number of omissions but none and all is rare.
  for (std::size_t count = 1; count < all_stages.size(); ++count)
    EXPECT_GT(omissions[count], test::sampled(20)) << count;
}

}  // namespace
}  // namespace paperproof
