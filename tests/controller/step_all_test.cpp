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

/// Characters that climb and follow the ground, at random among a floor, slopes, circles, a lift and a sensor, and what
/// each wants in each step.
struct Many {
  Stepper<double> one{level(), {.snap = 0.2, .step_height = 0.2}};
  std::vector<CharacterState<double>> states = std::vector<CharacterState<double>>(count);
  std::vector<Input> inputs = std::vector<Input>(count);
  std::vector<StepReport<double>> reports = std::vector<StepReport<double>>(count);
  std::vector<Scratch<double>> scratches;

  explicit Many(std::size_t threads) {
    test::Random random(1);
    for (CharacterState<double>& state : states)
      state.position = Vec2d{random.between(-19, 19), random.between(0.7, 4)};
    while (scratches.size() < threads) scratches.push_back(one.controller.make_scratch());
  }
  static std::vector<ColliderDef> level() {
    std::vector<ColliderDef> colliders{box(-20, -1, 20, 0), box(4, 0.5, 6, 1, 0), box(8, 0, 10, 2)};
    colliders.back().sensor = true;
    for (int x = -15; x < 15; x += 6) colliders.push_back(polygon({{x + 0.0, 0}, {x + 1.0, 0}, {x + 1.0, 0.5}}));
    for (int x = -18; x < -13; ++x) colliders.push_back(compare::circle({x + 0.5, 0}, 0.3, x % 2 == 0 ? 0U : no_mover));
    return colliders;
  }
  void begin(int step) {
    one.movers[0] = {one.movers[0].to, {0, step % 40 / 16.0}};
    for (std::size_t i = 0; i < count; ++i)
      inputs[i] = {.move = static_cast<double>((i + static_cast<std::size_t>(step) / 16) % 3) - 1, .jump = i % 5 == 0};
    // One asks for what is no number.
    inputs[7].move = std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] StepContext<double> context() const { return {{0, -20}, 1.0 / 60, one.movers}; }
  BatchStatus step_all() { return one.controller.step_all(states, inputs, context(), scratches, reports); }
};

TEST(StepAll, gives_the_bits_of_single_steps_with_any_number_of_scratches_and_with_one_takes_no_memory) {
  constexpr int steps = 60;
  for (const std::size_t threads : {1U, 2U, 7U}) {
    SCOPED_TRACE(threads);
    Many all(threads);
    Many each(1);
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
        StepReport<double>& report = each.reports[i];
        each.one.controller.step(each.states[i], each.inputs[i], each.context(), each.scratches[0], report);
        ASSERT_TRUE(same_step(all.states[i], all.reports[i], each.states[i], report)) << i << ", step " << step;
        contacts += report.move.contacts.size();
        sensor_events += report.sensors.size();
        rides += report.move.ride.ground != Ride<double>::none;
      }
      ASSERT_EQ(all.reports[7].status, StepStatus::invalid_input);
    }
    EXPECT_GT(contacts, count * steps / 3) << "many must stand";
    EXPECT_GT(sensor_events, 10U);
    EXPECT_GT(rides, 100U);
  }
}

TEST(StepAll, leaves_out_of_a_report_what_has_no_room_beside_the_scratch) {
  std::vector<ColliderDef> needles;
  for (int i = 0; i < 50; ++i) needles.push_back(box(0.012 * i - 0.3, -1, 0.012 * i - 0.294, 0));
  Stepper<double> stepper(needles, of_shape(CharacterShape(box(-0.3, -0.3, 0.3, 0.3).points)));
  std::vector<CharacterState<double>> states(2, stepper.at(0, 0.4).with_velocity(0, -20).state);
  std::vector<StepReport<double>> reports(2);
  reports[1].move.contacts.reserve(100);
  stepper.controller.step_all(states, std::vector<Input>(2), {{0, -20}, 1.0 / 60}, {&stepper.scratch, 1}, reports);
  EXPECT_TRUE(reports[0].move.contacts.overflowed());
  EXPECT_EQ(reports[0].move.contacts.size(), MoveResult<double>::max_contacts);
  EXPECT_EQ(reports[1].move.contacts.size(), needles.size());
}

TEST(StepAll, refuses_spans_of_different_sizes_and_foreign_scratch) {
  struct Call {
    std::size_t states, inputs, reports;
    std::span<Scratch<double>> scratches;
    BatchStatus status = BatchStatus::invalid_input;
  };
  Many many(2);
  Many other(1);
  std::vector<Scratch<double>> mixed;
  mixed.push_back(many.one.controller.make_scratch());
  mixed.push_back(std::move(other.scratches[0]));
  many.begin(0);
  const std::vector<CharacterState<double>> before = many.states;
  for (const Call& call : {Call{count - 1, count, count, many.scratches}, Call{count, count - 1, count, many.scratches},
                           Call{count, count, count - 1, many.scratches}, Call{count, count, count, {}},
                           Call{count, count, count, mixed}, Call{0, 0, 0, many.scratches, BatchStatus::stepped}})
    EXPECT_EQ(many.one.controller.step_all(std::span(many.states).first(call.states),
                                           std::span(many.inputs).first(call.inputs), many.context(), call.scratches,
                                           std::span(many.reports).first(call.reports)),
              call.status);
  EXPECT_EQ(many.states, before);
  many.one.movers.clear();
  EXPECT_EQ(many.step_all(), BatchStatus::stepped);
  for (const StepReport<double>& report : many.reports)
    EXPECT_EQ(report.status, StepStatus::invalid_input) << "the scenery has a mover";
}

}  // namespace
}  // namespace paperproof::stepping
