/// Sensors: too many events, bits of the motion, calls beside steps, memory. When a character enters and leaves them is
/// in tests/situations/sensors.json.
#include "controller/stepping.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

namespace paperproof::stepping {
namespace {

using Change = SensorEvent::Change;

ColliderDef sensor(ColliderDef def, MoverIndex mover = no_mover) {
  def.sensor = true;
  def.mover = mover;
  return def;
}

TEST(SensorOrder, is_that_of_time_for_any_number_of_events) {
  std::vector<ColliderDef> row;
  for (int i = 19; i >= 0; --i) row.push_back(sensor(box(2 * i + 1, -1, 2 * i + 1.5, 1)));
  Stepper stepper(row);
  stepper.sweep().reserve({{0, 0}, {100, 0}}, stepper.scratch);
  stepper.at(0, 0).fly(100, 0);
  const std::size_t before = tests::allocations();
  for (const double way : {0.5, 4.0, 20.0, 100.0}) stepper.at(0, 0).fly(way, 0);
  EXPECT_EQ(tests::allocations(), before) << "the report has grown already";
  const auto& events = stepper.report.sensors;
  ASSERT_EQ(events.size(), 40U);
  for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].sensor, 19 - i / 2) << i;
}

/// A motion that meets something solid, all of it whole squares, and a sensor on its way.
struct Visit {
  const char* what;
  ColliderDef sensor;
  Vec2d from;
  Vec2d velocity;
  Vec2d gravity{0, 0};
  std::vector<Change> changes{Change::enter, Change::exit};
};

std::vector<Visit> visits() {
  const Vec2d start{0.5, 0.625};
  const Vec2d right{6, 0};
  return {{"neither squares nor level", sensor(polygon({{4, 0.1}, {5.3, 0}, {4.6, 1.7}})), start, right},
          {"half a square", sensor(box(4, 0, 4.5, 3)), start, right},
          {"between two pixels", sensor(box(4.001, -0.5, 4.011, 3)), start, right},
          {"a line", sensor(chain({{4.2, -1}, {4.7, 3}})), start, right},
          {"a floor that is none", sensor(box(-3, 2, 3, 3)), start + Vec2d(0, 6), {0, 0}, {0, -10}},
          {"in the solid as well", sensor(box(2, -1, 3, 3)), start, right},
          {"around the start", sensor(box(-1, -2, 3, 3)), start, right, {0, 0}, {Change::exit}},
          {"too far for any picture", sensor(box(1e6, 0, 1e6 + 1, 3)), start, right, {0, 0}, {}},
          {"on the move", sensor(polygon({{6, 0.1}, {7.3, 0}, {6.6, 1.7}}), 0), start, right}};
}

TEST(SensorsOfAController, change_no_bit_of_the_motion_by_any_technique) {
  for (const std::string_view kind : technique_names())
    for (const Visit& visit : visits()) {
      SCOPED_TRACE(std::string(kind) + ", " + visit.what);
      const std::vector<ColliderDef> solids{box(-4, -2, 16, -1), box(12, -1, 13, 6)};
      std::vector<ColliderDef> watched{visit.sensor};
      watched.insert(watched.end(), solids.begin(), solids.end());
      Stepper with(watched, {}, kind);
      Stepper without(solids, {}, kind);
      for (Stepper* each : {&with, &without}) {
        each->at(visit.from.x(), visit.from.y()).with_velocity(visit.velocity.x(), visit.velocity.y());
        each->gravity = visit.gravity;
        each->dt = 1.0 / 64;
      }
      std::vector<Change> changes;
      int contacts = 0;
      for (int step = 0; step < 160; ++step) {
        with.step_with_mover_by(-0.01, 0);
        without.step();
        ASSERT_TRUE(same_bits(with.state, without.state)) << "step " << step;
        ASSERT_EQ(with.report.status, without.report.status) << "step " << step;
        ASSERT_EQ(with.report.move.contacts.size(), without.report.move.contacts.size()) << "step " << step;
        for (const Contact& contact : with.report.move.contacts) contacts += contact.collider != 0 ? 1 : 0;
        for (const SensorEvent& event : with.report.sensors) changes.push_back(static_cast<Change>(event.change));
      }
      EXPECT_EQ(changes, visit.changes);
      EXPECT_GT(contacts, 0) << "nothing solid was met";
    }
}

TEST(SensorsOfAController, a_step_that_is_refused_reports_nothing) {
  Stepper stepper({sensor(box(1, -1, 2, 1))});
  stepper.at(0, 0).fly(4, 0);
  EXPECT_EQ(stepper.report.sensors.size(), 2U);
  stepper.at(0, 0).fly(5e6, 0);
  EXPECT_EQ(stepper.report.status, StepStatus::out_of_range);
  EXPECT_TRUE(stepper.report.sensors.empty());
  stepper.fly(nan, 0);
  EXPECT_EQ(stepper.report.status, StepStatus::invalid_input);
  EXPECT_TRUE(stepper.report.sensors.empty());
}

}  // namespace
}  // namespace paperproof::stepping
