/// When a character enters sensors and leaves them, against formulas.
#include "sensors.hpp"

#include "controller/stepping.hpp"
#include "support/allocations.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::stepping {
namespace {

using Change = SensorEvent<double>::Change;

ColliderDef sensor(ColliderDef def, MoverIndex mover = no_mover) {
  def.sensor = true;
  def.mover = mover;
  return def;
}

/// Sensors alone, watching a path that the test makes up.
struct Watch {
  Scenery<double> scenery;
  Sensors<double> sensors;
  Candidates<double> candidates;
  Sensors<double>::Events events;

  explicit Watch(std::vector<ColliderDef> colliders)
      : scenery(SceneryDef{std::move(colliders)}),
        sensors(scenery, CharacterShape::article()),
        candidates(sensors.make_candidates()) {}

  void observe(const std::vector<PathPoint<double>>& path, const std::vector<MoverMotion<double>>& movers = {}) {
    events.clear();
    sensors.observe(path, movers, candidates, events);
  }
  void fly(const Vec2d& from, const Vec2d& to, const std::vector<MoverMotion<double>>& movers = {}) {
    observe({{from, 0}, {to, 1}}, movers);
  }
  void expect(std::size_t i, ColliderIndex collider, Change change, double fraction, double tolerance = 1e-12) const {
    ASSERT_LT(i, events.size());
    EXPECT_EQ(events[i].sensor, collider) << "event " << i;
    EXPECT_EQ(events[i].change, change) << "event " << i;
    EXPECT_NEAR(events[i].fraction, fraction, tolerance) << "event " << i;
  }
};

TEST(ThinSensor, passed_at_speed_is_entered_once_and_left_once_at_exact_times) {
  for (const double speed : {1.0, 100.0, 1e4, 1e6}) {
    Watch watch({sensor(rectangle(0.5, -1, 0.501, 1))});
    watch.fly({-0.25, 0}, {-0.25 + speed, 0});
    ASSERT_EQ(watch.events.size(), speed < 1.5 ? 1U : 2U) << speed;
    // The right side meets the left face, and the left side leaves the right face.
    watch.expect(0, 0, Change::enter, (0.5 - half_width + 0.25) / speed);
    if (speed > 1.5) watch.expect(1, 0, Change::exit, (0.501 + half_width + 0.25) / speed);
  }
}

TEST(ThinSensor, a_chain_without_thickness_is_passed_in_the_time_of_the_characters_own_width) {
  Watch watch({sensor(chain({{0.5, -1}, {0.5, 1}}))});
  watch.fly({-3, 0}, {5, 0});
  ASSERT_EQ(watch.events.size(), 2U);
  watch.expect(0, 0, Change::enter, (0.5 - half_width + 3) / 8);
  watch.expect(1, 0, Change::exit, (0.5 + half_width + 3) / 8);
}

TEST(ThinSensor, a_slanted_side_of_the_octagon_is_what_meets_a_corner) {
  // The lowest corner of the sensor is at height 0.5 above the centre, where the side from (10, 10) px to (5, 20) px is
  // at x = 10 - (16 - 10) / 2 = 7 px: it falls by 2 for 1.
  Watch watch({sensor(rectangle(1, 0.5, 1.25, 3))});
  watch.fly({0, 0}, {4, 0});
  ASSERT_EQ(watch.events.size(), 2U);
  watch.expect(0, 0, Change::enter, (1 - 7 * px) / 4);
  watch.expect(1, 0, Change::exit, (1.25 + 7 * px) / 4);
}

TEST(SensorBorder, touching_is_not_inside_and_the_next_step_enters_at_once) {
  Watch watch({sensor(rectangle(1, -1, 2, 1))});
  watch.fly({0, 0}, {1 - half_width, 0});
  EXPECT_TRUE(watch.events.empty());
  watch.fly({1 - half_width, 0}, {1, 0});
  ASSERT_EQ(watch.events.size(), 1U);
  watch.expect(0, 0, Change::enter, 0, 0);
  watch.fly({1, 0}, {2 + half_width, 0});
  ASSERT_EQ(watch.events.size(), 1U);
  watch.expect(0, 0, Change::exit, 1, 0);
  watch.fly({2 + half_width, 0}, {9, 0});
  EXPECT_TRUE(watch.events.empty());
}

TEST(SensorBorder, gliding_along_it_is_not_inside) {
  Watch watch({sensor(rectangle(-9, -1, 9, 0))});
  watch.fly({-5, half_height}, {5, half_height});
  EXPECT_TRUE(watch.events.empty());
}

TEST(SensorStart, inside_there_is_no_entry_and_one_exit) {
  Watch watch({sensor(rectangle(-1, -1, 1, 1))});
  watch.fly({0, 0}, {0, 0});
  EXPECT_TRUE(watch.events.empty()) << "standing in it is no event";
  watch.fly({0, 0}, {4, 0});
  ASSERT_EQ(watch.events.size(), 1U);
  watch.expect(0, 0, Change::exit, (1 + half_width) / 4);
}

TEST(ConcaveSensor, is_one_region_without_inner_borders) {
  // An arch: its legs and its top are several convex pieces. Along its top there is one entry and one exit.
  const ColliderDef arch = polygon({{0, 0}, {1, 0}, {1, 3}, {5, 3}, {5, 0}, {6, 0}, {6, 4}, {0, 4}});
  Watch watch({sensor(arch)});
  ASSERT_GT(watch.scenery.sensor_pieces().size(), 1U);
  watch.fly({-2, 3.5}, {8, 3.5});
  ASSERT_EQ(watch.events.size(), 2U);
  watch.expect(0, 0, Change::enter, (2 - half_width) / 10);
  watch.expect(1, 0, Change::exit, (8 + half_width) / 10);
  // Under the arch the way is clear of it between the legs.
  watch.fly({-2, 1}, {8, 1});
  ASSERT_EQ(watch.events.size(), 4U);
  watch.expect(0, 0, Change::enter, (2 - half_width) / 10);
  watch.expect(1, 0, Change::exit, (3 + half_width) / 10);
  watch.expect(2, 0, Change::enter, (7 - half_width) / 10);
  watch.expect(3, 0, Change::exit, (8 + half_width) / 10);
}

TEST(ConcaveSensor, a_chain_of_many_segments_is_one_sensor) {
  std::vector<Vec2d> points;
  for (int i = 0; i <= 64; ++i) points.push_back({0.125 * i, (i % 2) * 0.125});
  Watch watch({sensor(chain(points))});
  watch.fly({-2, 0}, {12, 0});
  ASSERT_EQ(watch.events.size(), 2U);
  watch.expect(0, 0, Change::enter, (2 - half_width) / 14);
  watch.expect(1, 0, Change::exit, (10 + half_width) / 14);
}

TEST(MovingSensor, sweeps_over_a_character_that_rests) {
  Watch watch({sensor(rectangle(-0.05, -1, 0.05, 1), 0)});
  watch.fly({0, 0}, {0, 0}, {{{-4, 0}, {4, 0}}});
  ASSERT_EQ(watch.events.size(), 2U);
  watch.expect(0, 0, Change::enter, (4 - 0.05 - half_width) / 8);
  watch.expect(1, 0, Change::exit, (4 + 0.05 + half_width) / 8);
}

TEST(MovingSensor, head_on_the_speeds_add_up) {
  Watch watch({sensor(rectangle(10, -1, 10.5, 1), 0)});
  watch.fly({0, 0}, {6, 0}, {{{0, 0}, {-14, 0}}});
  ASSERT_EQ(watch.events.size(), 2U);
  watch.expect(0, 0, Change::enter, (10 - half_width) / 20);
  watch.expect(1, 0, Change::exit, (10.5 + half_width) / 20);
}

TEST(MovingSensor, that_goes_along_with_the_character_gives_no_event) {
  Watch watch({sensor(rectangle(-1, -1, 1, 1), 0)});
  watch.fly({0, 0}, {6, 2}, {{{0, 0}, {6, 2}}});
  EXPECT_TRUE(watch.events.empty());
}

TEST(SensorPath, a_visit_over_a_corner_of_the_path_is_one) {
  Watch watch({sensor(rectangle(1, -1, 3, 1))});
  // Two metres to the right in the first quarter, then straight up.
  watch.observe({{{0, 0}, 0}, {{2, 0}, 0.25}, {{2, 9}, 1}});
  ASSERT_EQ(watch.events.size(), 2U);
  watch.expect(0, 0, Change::enter, 0.25 * (1 - half_width) / 2);
  watch.expect(1, 0, Change::exit, 0.25 + 0.75 * (1 + half_height) / 9);
}

TEST(SensorPath, a_mover_goes_on_evenly_while_the_path_has_corners) {
  // Rests for half of the step, then flies right; the sensor comes from the right all the time, to x = 10 - 16 t.
  Watch watch({sensor(rectangle(10, -1, 11, 1), 0)});
  watch.observe({{{0, 0}, 0}, {{0, 0}, 0.5}, {{8, 0}, 1}}, {{{0, 0}, {-16, 0}}});
  ASSERT_EQ(watch.events.size(), 2U);
  // At half time it is at 2, a gap of 2 - half_width closes at 16 + 16 m per step.
  watch.expect(0, 0, Change::enter, 0.5 + (2 - half_width) / 32);
  watch.expect(1, 0, Change::exit, 0.5 + (3 + half_width) / 32);
}

TEST(SensorOrder, events_of_several_sensors_are_in_order_of_time) {
  Watch watch({sensor(rectangle(6, -1, 7, 1)), sensor(rectangle(2, -1, 6.5, 1)), sensor(rectangle(2, -1, 9, 1))});
  watch.fly({0, 0}, {20, 0});
  ASSERT_EQ(watch.events.size(), 6U);
  watch.expect(0, 1, Change::enter, (2 - half_width) / 20);
  watch.expect(1, 2, Change::enter, (2 - half_width) / 20);
  watch.expect(2, 0, Change::enter, (6 - half_width) / 20);
  watch.expect(3, 1, Change::exit, (6.5 + half_width) / 20);
  watch.expect(4, 0, Change::exit, (7 + half_width) / 20);
  watch.expect(5, 2, Change::exit, (9 + half_width) / 20);
}

TEST(SensorOrder, more_events_than_fit_keep_the_earliest_and_say_so) {
  std::vector<ColliderDef> row;
  for (int i = 19; i >= 0; --i) row.push_back(sensor(rectangle(2 * i + 1, -1, 2 * i + 1.5, 1)));
  Watch watch(row);
  watch.fly({0, 0}, {100, 0});
  EXPECT_TRUE(watch.events.overflowed());
  ASSERT_EQ(watch.events.size(), Sensors<double>::Events::capacity());
  for (std::size_t i = 0; i < watch.events.size(); ++i) {
    const double left = 2.0 * static_cast<double>(i / 2) + 1;
    const bool enters = i % 2 == 0;
    watch.expect(i, static_cast<ColliderIndex>(19 - i / 2), enters ? Change::enter : Change::exit,
                 (enters ? left - half_width : left + 0.5 + half_width) / 100);
  }
}

TEST(SensorsOfAController, block_nothing_and_report_each_step) {
  // 100 m/s, 60 steps per second: the sensor of a millimetre is passed within one step.
  const std::vector<ColliderDef> colliders{rectangle(-50, -3, 50, -2), sensor(rectangle(0.5, -1, 0.501, 1))};
  for (const std::string_view kind : technique_names()) {
    if (kind == "grid") continue;  // goes by whole squares, not to 1.25 m
    Stepper<double> runner(colliders, {}, kind);
    const MoveResult<double>& move = runner.at(-0.5, 0).fly(1.75, 0);
    EXPECT_EQ(move.position, Vec2d(1.25, 0)) << kind;
    EXPECT_TRUE(move.contacts.empty()) << kind;
    ASSERT_EQ(runner.report.sensors.size(), 2U) << kind;
    EXPECT_EQ(runner.report.sensors[0].sensor, 1U);
    EXPECT_NEAR(runner.report.sensors[0].fraction, (1 - half_width) / 1.75, 1e-12) << kind;
    EXPECT_NEAR(runner.report.sensors[1].fraction, (1.001 + half_width) / 1.75, 1e-12) << kind;
    runner.fly(1, 0);
    EXPECT_TRUE(runner.report.sensors.empty()) << "the report is of one step: " << kind;
  }
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
  const Vec2d above{0.5, 6.625};
  const ColliderDef far_away = rectangle(1e6, 0, 1e6 + 1, 3);
  return {{"neither squares nor level", sensor(polygon({{4, 0.1}, {5.3, 0}, {4.6, 1.7}})), start, right},
          {"half a square", sensor(rectangle(4, 0, 4.5, 3)), start, right},
          {"between two pixels", sensor(rectangle(4.001, -0.5, 4.011, 3)), start, right},
          {"a line", sensor(chain({{4.2, -1}, {4.7, 3}})), start, right},
          {"a floor that is none", sensor(rectangle(-3, 2, 3, 3)), above, {0, 0}, {0, -10}},
          {"in the solid as well", sensor(rectangle(2, -1, 3, 3)), start, right},
          {"around the start", sensor(rectangle(-1, -2, 3, 3)), start, right, {0, 0}, {Change::exit}},
          {"too far for any picture", sensor(far_away), start, right, {0, 0}, {}},
          {"on the move", sensor(polygon({{6, 0.1}, {7.3, 0}, {6.6, 1.7}}), 0), start, right}};
}

template <class Scalar>
void expect_visit(const Visit& visit, std::string_view kind) {
  SCOPED_TRACE(std::string(kind) + ", " + visit.what);
  const std::vector<ColliderDef> solids{rectangle(-4, -2, 16, -1), rectangle(12, -1, 13, 6)};
  std::vector<ColliderDef> watched{visit.sensor};
  watched.insert(watched.end(), solids.begin(), solids.end());
  Stepper<Scalar> with(watched, {}, kind);
  Stepper<Scalar> without(solids, {}, kind);
  for (Stepper<Scalar>* each : {&with, &without}) {
    each->at(visit.from.x(), visit.from.y()).with_velocity(visit.velocity.x(), visit.velocity.y());
    each->gravity = visit.gravity.cast<Scalar>();
    each->dt = Scalar(1) / 64;
  }
  std::vector<Change> changes;
  int contacts = 0;
  for (int step = 0; step < 160; ++step) {
    with.step_with_mover_by(-0.01, 0);
    without.step();
    ASSERT_TRUE(same_bits(with.state, without.state)) << "step " << step;
    ASSERT_EQ(with.report.status, without.report.status) << "step " << step;
    ASSERT_EQ(with.report.move.contacts.size(), without.report.move.contacts.size()) << "step " << step;
    for (const Contact<Scalar>& contact : with.report.move.contacts) contacts += contact.collider != 0 ? 1 : 0;
    for (const SensorEvent<Scalar>& event : with.report.sensors) changes.push_back(static_cast<Change>(event.change));
  }
  EXPECT_EQ(changes, visit.changes);
  EXPECT_GT(contacts, 0) << "nothing solid was met";
}

TEST(SensorsOfAController, change_no_bit_of_the_motion_by_any_technique) {
  for (const std::string_view kind : technique_names()) {
    for (const Visit& visit : visits()) {
      expect_visit<double>(visit, kind);
      expect_visit<float>(visit, kind);
    }
  }
}

TEST(SensorsOfAController, a_teleport_into_a_sensor_is_no_entry) {
  Stepper<double> stepper({sensor(rectangle(9, -1, 11, 1))});
  stepper.at(0, 0).fly(1, 0);
  EXPECT_TRUE(stepper.report.sensors.empty());
  stepper.at(10, 0).fly(0.125, 0);
  EXPECT_TRUE(stepper.report.sensors.empty());
  stepper.fly(4, 0);
  ASSERT_EQ(stepper.report.sensors.size(), 1U);
  EXPECT_EQ(stepper.report.sensors[0].change, Change::exit);
}

TEST(SensorsOfAController, a_step_that_is_refused_reports_nothing) {
  Stepper<double> stepper({sensor(rectangle(1, -1, 2, 1))});
  stepper.at(0, 0).fly(4, 0);
  EXPECT_EQ(stepper.report.sensors.size(), 2U);
  stepper.at(0, 0).fly(5e6, 0);
  EXPECT_EQ(stepper.report.status, StepStatus::out_of_range);
  EXPECT_TRUE(stepper.report.sensors.empty());
  stepper.fly(std::nan(""), 0);
  EXPECT_EQ(stepper.report.status, StepStatus::invalid_input);
  EXPECT_TRUE(stepper.report.sensors.empty());
}

TEST(SensorsOfAController, watching_takes_no_memory) {
  std::vector<ColliderDef> colliders{rectangle(-50, -3, 50, -2)};
  for (int i = 0; i < 10; ++i) colliders.push_back(sensor(rectangle(i, -1, i + 0.5, 1)));
  Stepper<double> stepper(colliders);
  const std::size_t before = tests::allocations();
  std::size_t events = 0;
  for (int step = 0; step < 1000; ++step) {
    stepper.at(-1, 0).fly(0.01 * step, 0);
    events += stepper.report.sensors.size();
  }
  EXPECT_EQ(tests::allocations(), before);
  EXPECT_GT(events, 1000U);
}

}  // namespace
}  // namespace paperproof::stepping
