/// Many characters in one call: each is stepped as it would be alone, by any number of threads.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace paperproof::stepping {
namespace {

using test::Random;

constexpr std::size_t count = 300;  // more than each of seven threads takes at a time
constexpr int steps = 60;

/// Floor, slopes, a ledge, walls, and a lift.
std::vector<ColliderDef> level() {
  std::vector<ColliderDef> colliders;
  for (int x = -20; x < 20; ++x) colliders.push_back(rectangle(x, -1, x + 1, 0));
  for (int x = -15; x < 15; x += 6) colliders.push_back(polygon({{x + 0.0, 0}, {x + 1.0, 0}, {x + 1.0, 0.5}}));
  colliders.push_back(chain({{-3, 1.5}, {3, 1.5}}, Vec2d{0, 1}));
  colliders.push_back(rectangle(-21, -1, -20, 9));
  colliders.push_back(rectangle(20, -1, 21, 9));
  colliders.push_back(rectangle(4, 0.5, 6, 1));
  colliders.back().mover = 0;
  colliders.push_back(rectangle(8, 0, 10, 2));
  colliders.back().sensor = true;
  return colliders;
}

template <class Scalar>
std::vector<MoverMotion<Scalar>> movers_of_step(int step) {
  const auto height = [](int at) { return Vec2<Scalar>(0, static_cast<Scalar>(at % 40) / 16); };
  return {{height(step), height(step + 1)}};
}

/// Characters at random, and what each wants in each step.
template <class Scalar>
struct Many {
  Scenery<Scalar> scenery{SceneryDef{level()}};
  Controller<Scalar> controller{scenery, CharacterDef{}};
  std::vector<CharacterState<Scalar>> states = std::vector<CharacterState<Scalar>>(count);
  std::vector<Input> inputs = std::vector<Input>(count);
  std::vector<StepReport<Scalar>> reports = std::vector<StepReport<Scalar>>(count);
  Vec2<Scalar> gravity{0, -20};
  Scalar dt = Scalar(1) / 60;

  Many() {
    Random random(1);
    for (CharacterState<Scalar>& state : states)
      state.position = {static_cast<Scalar>(random.between(-19, 19)), static_cast<Scalar>(random.between(0.7, 4))};
  }
  void press(int step) {
    for (std::size_t i = 0; i < count; ++i)
      inputs[i] = {.move = static_cast<double>((i + static_cast<std::size_t>(step) / 16) % 3) - 1, .jump = i % 5 == 0};
    // One asks for what is no number.
    inputs[7].move = std::numeric_limits<double>::quiet_NaN();
  }
  BatchStatus step_all(int step, std::span<Scratch<Scalar>> scratches) {
    press(step);
    return controller.step_all(states, inputs, {gravity, dt, movers_of_step<Scalar>(step)}, scratches, reports);
  }
  [[nodiscard]] std::vector<Scratch<Scalar>> scratches(std::size_t wanted) const {
    std::vector<Scratch<Scalar>> made;
    for (std::size_t i = 0; i < wanted; ++i) made.push_back(controller.make_scratch());
    return made;
  }
};

template <class Scalar>
bool same_report(const StepReport<Scalar>& a, const StepReport<Scalar>& b) {
  const auto same_corner = [](const PathPoint<Scalar>& p, const PathPoint<Scalar>& q) {
    return same_bits(p.position, q.position) && same_bits(p.fraction, q.fraction);
  };
  const auto same_contact = [](const Contact<Scalar>& c, const Contact<Scalar>& d) {
    return c.collider == d.collider && same_bits(c.point, d.point) && same_bits(c.normal, d.normal) &&
           same_bits(c.fraction, d.fraction) && same_bits(c.separation, d.separation);
  };
  const auto same_event = [](const SensorEvent<Scalar>& e, const SensorEvent<Scalar>& f) {
    return e.sensor == f.sensor && e.change == f.change && same_bits(e.fraction, f.fraction);
  };
  if (a.status != b.status) return false;
  if (a.status == StepStatus::invalid_input) return true;
  return std::ranges::equal(a.move.path, b.move.path, same_corner) &&
         std::ranges::equal(a.move.contacts, b.move.contacts, same_contact) &&
         std::ranges::equal(a.sensors, b.sensors, same_event);
}

template <class Scalar>
void expect_the_bits_of_single_steps(std::size_t threads) {
  Many<Scalar> all;
  Many<Scalar> each;
  std::vector<Scratch<Scalar>> scratches = all.scratches(threads);
  Scratch<Scalar> scratch = each.controller.make_scratch();
  std::size_t contacts = 0;
  std::size_t sensor_events = 0;
  std::size_t rides = 0;
  for (int step = 0; step < steps; ++step) {
    ASSERT_EQ(all.step_all(step, scratches), BatchStatus::stepped);
    each.press(step);
    for (std::size_t i = 0; i < count; ++i) {
      StepReport<Scalar>& report = each.reports[i];
      each.controller.step(each.states[i], each.inputs[i], {each.gravity, each.dt, movers_of_step<Scalar>(step)},
                           scratch, report);
      ASSERT_TRUE(same_bits(all.states[i], each.states[i])) << "character " << i << ", step " << step;
      ASSERT_TRUE(same_report(all.reports[i], report)) << "character " << i << ", step " << step;
      contacts += report.move.contacts.size();
      sensor_events += report.sensors.size();
      rides += report.move.ride.ground != Ride<Scalar>::none ? 1 : 0;
    }
    ASSERT_EQ(all.reports[7].status, StepStatus::invalid_input);
  }
  EXPECT_GT(contacts, count * steps / 2) << "nearly all must stand";
  EXPECT_GT(sensor_events, 10U);
  EXPECT_GT(rides, 100U);
}

TEST(StepAll, gives_the_bits_of_single_steps_with_any_number_of_scratches) {
  for (const std::size_t threads : {1U, 2U, 3U, 7U}) {
    SCOPED_TRACE(threads);
    expect_the_bits_of_single_steps<double>(threads);
    expect_the_bits_of_single_steps<float>(threads);
  }
}

TEST(StepAll, with_one_scratch_allocates_nothing) {
  Many<double> many;
  std::vector<Scratch<double>> scratches = many.scratches(1);
  const std::vector<MoverMotion<double>> movers = movers_of_step<double>(0);
  many.press(0);
  const std::size_t before = tests::allocations();
  many.controller.step_all(many.states, many.inputs, {many.gravity, many.dt, movers}, scratches, many.reports);
  EXPECT_EQ(tests::allocations(), before);
}

TEST(StepAll, of_nobody_changes_nothing) {
  Many<double> many;
  std::vector<Scratch<double>> scratches = many.scratches(2);
  EXPECT_EQ(many.controller.step_all({}, {}, {many.gravity, many.dt, movers_of_step<double>(0)}, scratches, {}),
            BatchStatus::stepped);
}

TEST(StepAll, leaves_out_of_a_report_what_has_no_room_beside_the_scratch) {
  std::vector<ColliderDef> needles;
  for (int i = 0; i < 50; ++i) needles.push_back(rectangle(0.012 * i - 0.3, -1, 0.012 * i - 0.294, 0));
  const Scenery<double> scenery(SceneryDef{needles});
  const std::vector<Vec2d> square{{-0.3, -0.3}, {0.3, -0.3}, {0.3, 0.3}, {-0.3, 0.3}};
  CharacterDef character;
  character.shape = CharacterShape(square);
  const Controller<double> controller(scenery, character);
  std::vector<Scratch<double>> scratches;
  scratches.push_back(controller.make_scratch());
  std::vector<CharacterState<double>> states(2);
  for (CharacterState<double>& state : states) {
    state.position = {0, 0.4};
    state.velocity = {0, -20};
  }
  const std::vector<Input> inputs(2);
  std::vector<StepReport<double>> reports(2);
  reports[1].move.contacts.reserve(100);
  controller.step_all(states, inputs, {{0, -20}, 1.0 / 60, {}}, scratches, reports);
  EXPECT_TRUE(reports[0].move.contacts.overflowed());
  EXPECT_EQ(reports[0].move.contacts.size(), MoveResult<double>::max_contacts);
  EXPECT_FALSE(reports[1].move.contacts.overflowed());
  EXPECT_EQ(reports[1].move.contacts.size(), needles.size());
}

TEST(StepAll, refuses_spans_of_different_sizes_and_foreign_scratch) {
  Many<double> many;
  Many<double> other;
  std::vector<Scratch<double>> own = many.scratches(2);
  std::vector<Scratch<double>> mixed = many.scratches(1);
  mixed.push_back(other.controller.make_scratch());
  many.press(0);
  for (StepReport<double>& report : many.reports) report.status = StepStatus::crushed;
  const std::vector<CharacterState<double>> before = many.states;
  const std::vector<MoverMotion<double>> movers = movers_of_step<double>(0);
  const auto refused = [&](std::size_t states, std::size_t inputs, std::span<Scratch<double>> scratches,
                           std::size_t reports) {
    return many.controller.step_all(std::span(many.states).first(states), std::span(many.inputs).first(inputs),
                                    {many.gravity, many.dt, movers}, scratches,
                                    std::span(many.reports).first(reports)) == BatchStatus::invalid_input;
  };
  EXPECT_TRUE(refused(count - 1, count, own, count));
  EXPECT_TRUE(refused(count, count - 1, own, count));
  EXPECT_TRUE(refused(count, count, own, count - 1));
  EXPECT_TRUE(refused(count, count, {}, count));
  EXPECT_TRUE(refused(count, count, mixed, count));
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_TRUE(same_bits(many.states[i], before[i]));
    EXPECT_EQ(many.reports[i].status, StepStatus::crushed);
  }
  EXPECT_FALSE(refused(count, count, own, count));
}

TEST(StepAll, refuses_each_character_where_the_movers_are_not_those_of_the_scenery) {
  Many<double> many;
  std::vector<Scratch<double>> scratches = many.scratches(2);
  many.press(0);
  EXPECT_EQ(many.controller.step_all(many.states, many.inputs, {many.gravity, many.dt, {}}, scratches, many.reports),
            BatchStatus::stepped);
  for (const StepReport<double>& report : many.reports) EXPECT_EQ(report.status, StepStatus::invalid_input);
}

}  // namespace
}  // namespace paperproof::stepping
