/// Many characters in one call: each is stepped as it would be alone, by any number of threads.
#include "campaign/shapes.hpp"
#include "controller/states.hpp"
#include "support/allocations.hpp"
#include "support/random_runs.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace paperproof::stepping {
namespace {

using compare::box;

constexpr std::size_t count = 300;  // more than each of seven threads takes at a time

/// Floor, slopes, a ledge, walls, a lift and a sensor.
std::vector<ColliderDef> level() {
  std::vector<ColliderDef> colliders{box(-21, -1, -20, 9), box(20, -1, 21, 9),
                                     chain({{-3, 1.5}, {3, 1.5}}, Vec2d{0, 1}), box(4, 0.5, 6, 1, 0), box(8, 0, 10, 2)};
  colliders.back().sensor = true;
  for (int x = -20; x < 20; ++x) colliders.push_back(box(x, -1, x + 1, 0));
  for (int x = -15; x < 15; x += 6) colliders.push_back(polygon({{x + 0.0, 0}, {x + 1.0, 0}, {x + 1.0, 0.5}}));
  return colliders;
}

/// Characters at random, and what each wants in each step.
template <class Scalar>
struct Many {
  Scenery<Scalar> scenery{SceneryDef{level()}};
  Controller<Scalar> controller{scenery, CharacterDef{}};
  std::vector<CharacterState<Scalar>> states = std::vector<CharacterState<Scalar>>(count);
  std::vector<Input> inputs = std::vector<Input>(count);
  std::vector<StepReport<Scalar>> reports = std::vector<StepReport<Scalar>>(count);
  std::vector<MoverMotion<Scalar>> movers = std::vector<MoverMotion<Scalar>>(1);
  std::vector<Scratch<Scalar>> scratches;

  explicit Many(std::size_t threads) {
    test::Random random(1);
    for (CharacterState<Scalar>& state : states)
      state.position = Vec2d{random.between(-19, 19), random.between(0.7, 4)}.cast<Scalar>();
    while (scratches.size() < threads) scratches.push_back(controller.make_scratch());
  }
  void begin(int step) {
    movers[0] = {movers[0].to, {0, static_cast<Scalar>(step % 40) / 16}};
    for (std::size_t i = 0; i < count; ++i)
      inputs[i] = {.move = static_cast<double>((i + static_cast<std::size_t>(step) / 16) % 3) - 1, .jump = i % 5 == 0};
    // One asks for what is no number.
    inputs[7].move = std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] StepContext<Scalar> context() const { return {{0, -20}, Scalar(1) / 60, movers}; }
  BatchStatus step_all() { return controller.step_all(states, inputs, context(), scratches, reports); }
};

template <class Scalar>
void expect_the_bits_of_single_steps(std::size_t threads) {
  SCOPED_TRACE(threads);
  constexpr int steps = 60;
  Many<Scalar> all(threads);
  Many<Scalar> each(1);
  std::size_t contacts = 0;
  std::size_t sensor_events = 0;
  std::size_t rides = 0;
  for (int step = 0; step < steps; ++step) {
    all.begin(step);
    each.begin(step);
    const std::size_t before = tests::allocations();
    ASSERT_EQ(all.step_all(), BatchStatus::stepped);
    ASSERT_TRUE(threads > 1 || tests::allocations() == before);
    for (std::size_t i = 0; i < count; ++i) {
      StepReport<Scalar>& report = each.reports[i];
      each.controller.step(each.states[i], each.inputs[i], each.context(), each.scratches[0], report);
      ASSERT_TRUE(same_step(all.states[i], all.reports[i], each.states[i], report)) << i << ", step " << step;
      contacts += report.move.contacts.size();
      sensor_events += report.sensors.size();
      rides += report.move.ride.ground != Ride<Scalar>::none;
    }
    ASSERT_EQ(all.reports[7].status, StepStatus::invalid_input);
  }
  EXPECT_GT(contacts, count * steps / 2) << "nearly all must stand";
  EXPECT_GT(sensor_events, 10U);
  EXPECT_GT(rides, 100U);
}

TEST(StepAll, gives_the_bits_of_single_steps_with_any_number_of_scratches_and_with_one_takes_no_memory) {
  for (const std::size_t threads : {1U, 2U, 7U}) {
    expect_the_bits_of_single_steps<double>(threads);
    expect_the_bits_of_single_steps<float>(threads);
  }
}

TEST(StepAll, leaves_out_of_a_report_what_has_no_room_beside_the_scratch) {
  std::vector<ColliderDef> needles;
  for (int i = 0; i < 50; ++i) needles.push_back(box(0.012 * i - 0.3, -1, 0.012 * i - 0.294, 0));
  CharacterDef character;
  character.shape = CharacterShape(box(-0.3, -0.3, 0.3, 0.3).points);
  Stepper<double> stepper(needles, character);
  stepper.at(0, 0.4).with_velocity(0, -20);
  std::vector<CharacterState<double>> states(2, stepper.state);
  const std::vector<Input> inputs(2);
  std::vector<StepReport<double>> reports(2);
  reports[1].move.contacts.reserve(100);
  stepper.controller.step_all(states, inputs, {{0, -20}, 1.0 / 60}, {&stepper.scratch, 1}, reports);
  EXPECT_TRUE(reports[0].move.contacts.overflowed());
  EXPECT_EQ(reports[0].move.contacts.size(), MoveResult<double>::max_contacts);
  EXPECT_FALSE(reports[1].move.contacts.overflowed());
  EXPECT_EQ(reports[1].move.contacts.size(), needles.size());
}

TEST(StepAll, refuses_spans_of_different_sizes_and_foreign_scratch) {
  Many<double> many(2);
  Many<double> other(1);
  std::vector<Scratch<double>> mixed;
  mixed.push_back(many.controller.make_scratch());
  mixed.push_back(std::move(other.scratches[0]));
  many.begin(0);
  for (StepReport<double>& report : many.reports) report.status = StepStatus::crushed;
  const std::vector<CharacterState<double>> before = many.states;
  const auto stepped = [&](std::size_t states, std::size_t inputs, std::span<Scratch<double>> scratches,
                           std::size_t reports) {
    return many.controller.step_all(std::span(many.states).first(states), std::span(many.inputs).first(inputs),
                                    many.context(), scratches, std::span(many.reports).first(reports));
  };
  EXPECT_EQ(stepped(count - 1, count, many.scratches, count), BatchStatus::invalid_input);
  EXPECT_EQ(stepped(count, count - 1, many.scratches, count), BatchStatus::invalid_input);
  EXPECT_EQ(stepped(count, count, many.scratches, count - 1), BatchStatus::invalid_input);
  EXPECT_EQ(stepped(count, count, {}, count), BatchStatus::invalid_input);
  EXPECT_EQ(stepped(count, count, mixed, count), BatchStatus::invalid_input);
  EXPECT_EQ(stepped(0, 0, many.scratches, 0), BatchStatus::stepped) << "nobody is stepped";
  EXPECT_EQ(many.states, before);
  for (const StepReport<double>& report : many.reports) EXPECT_EQ(report.status, StepStatus::crushed);
  many.movers.clear();
  EXPECT_EQ(many.step_all(), BatchStatus::stepped);
  for (const StepReport<double>& report : many.reports)
    EXPECT_EQ(report.status, StepStatus::invalid_input) << "the scenery has a mover";
}

}  // namespace
}  // namespace paperproof::stepping
