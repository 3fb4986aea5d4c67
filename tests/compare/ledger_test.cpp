/// The ledger of disagreement on made-up traces: each cause, and a neighbour that is just outside of it.
#include "metrics/ledger.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace paperproof::compare {
namespace {

constexpr double dt = 1.0 / 64;
const double feet = 0.625;

SceneryDef scenery() {
  const auto polygon = [](std::vector<Vec2d> points) {
    return ColliderDef{.shape = ColliderDef::Shape::polygon, .points = std::move(points)};
  };
  SceneryDef def;
  def.colliders = {polygon({{-4, -1}, {0, -1}, {0, 0}, {-4, 0}}),             // tile
                   polygon({{0, -1}, {4, -1}, {4, 0}, {0, 0}}),               // next to it
                   polygon({{3, 0}, {4, 0}, {4, 8}, {3, 8}}),                 // wall
                   polygon({{10, 0}, {18, 0}, {18, 8}}),                      // slope of 45 degrees
                   polygon({{-200, -1}, {-100, -1}, {-100, 0}, {-200, 0}})};  // a floor far down the line
  return def;
}

TraceHeader header(bool box2d) {
  TraceHeader made;
  made.contender = box2d ? "box2d" : "octagon_sweep";
  made.scalar = box2d ? "float" : "double";
  made.dt = dt;
  made.path_exact = !box2d;
  made.character.max_climb_degrees = 50;
  made.points = {{-0.15625, -0.625}, {0.15625, -0.625}, {0.3125, -0.3125}, {0.3125, 0.3125},
                 {0.15625, 0.625},   {-0.15625, 0.625}, {-0.3125, 0.3125}, {-0.3125, -0.3125}};
  made.scenery = scenery();
  made.ids = {"tile", "next", "wall", "slope", "far"};
  made.tolerances = {{"hit", 1e-7}, {"stop", 5e-7}, {"touch", 7e-7}};
  return made;
}

/// A step by `way` of which `made` is made.
TraceStep step(const Vec2d& from, const Vec2d& way, const Vec2d& made, std::vector<Contact<double>> contacts = {}) {
  TraceStep one;
  one.path = {{from, 0}, {from + made, 1}};
  one.requested = way;
  one.velocity = made / dt;
  one.contacts = std::move(contacts);
  return one;
}

Contact<double> touch(ColliderIndex collider, const Vec2d& normal, const Vec2d& point, double fraction = 0) {
  return {.collider = collider,
          .point = point,
          .normal = normal,
          .fraction = fraction,
          .side = side_of_normal(normal.x(), normal.y())};
}
Contact<double> floor_below(double x, double fraction = 0) { return touch(x < 0 ? 0 : 1, {0, 1}, {x, 0}, fraction); }

class LedgerTest : public testing::Test {
 protected:
  explicit LedgerTest(bool lockstep = true) : lockstep_(lockstep) {}

  /// A pair of steps; both are judged by exact arithmetic.
  void add(TraceStep mine, TraceStep reference) {
    mine.step = reference.step = number_++;
    mine.start_overlap = mine_judge_.scenery().overlapped(Place(mine.path.front().position));
    reference.start_overlap = reference_judge_.scenery().overlapped(Place(reference.path.front().position));
    ledger_.add(mine, mine_judge_.judge(mine), reference, reference_judge_.judge(reference));
  }

  /// What stands in the ledger, as `cause.kind` in order; a space between.
  std::string found() {
    if (!finished_) ledger_.finish();
    finished_ = true;
    std::string text;
    for (const auto& [key, sum] : ledger_.sums()) {
      text += text.empty() ? "" : " ";
      text += std::string(name_of(sum.first.cause)) + "." + std::string(name_of(sum.first.kind));
    }
    return text;
  }

  const TraceHeader mine_header_ = header(false);
  const TraceHeader reference_header_ = header(true);
  Judge mine_judge_{mine_header_};
  Judge reference_judge_{reference_header_};
  bool lockstep_;
  Ledger ledger_{{&mine_header_, &mine_judge_.scenery()}, {&reference_header_, &reference_judge_.scenery()}, lockstep_};
  int number_ = 0;
  bool finished_ = false;
};

struct FreeLedgerTest : LedgerTest {
  FreeLedgerTest() : LedgerTest(false) {}
};

TEST_F(LedgerTest, equal_steps_are_no_disagreement) {
  const TraceStep falls = step({-2, 2}, {0.01, -0.01}, {0.01, -0.01});
  add(falls, falls);
  add(falls, falls);
  EXPECT_EQ(found(), "");
}

TEST_F(LedgerTest, a_report_from_within_the_skin_is_skin) {
  const Vec2d from(-2, feet + 0.0199);
  add(step(from, {0, -0.01}, {0, -0.01}), step(from, {0, -0.01}, {0, 0}, {floor_below(-2)}));
  EXPECT_EQ(found(), "skin.contact skin.stop");
}

TEST_F(LedgerTest, a_report_from_beyond_the_skin_is_an_error_of_box2d) {
  const Vec2d from(-2, feet + 0.0301);
  add(step(from, {0, -0.01}, {0, -0.01}), step(from, {0, -0.01}, {0, -0.01}, {floor_below(-2)}));
  EXPECT_EQ(found(), "error_of_box2d.contact");
}

TEST_F(LedgerTest, a_report_that_is_not_exact_is_an_error_of_ours) {
  const Vec2d from(-2, feet + 0.0199);
  add(step(from, {0, -0.01}, {0, -0.01}, {floor_below(-2)}), step(from, {0, -0.01}, {0, -0.01}));
  EXPECT_EQ(found(), "error_of_ours.contact");
}

TEST_F(LedgerTest, an_exact_contact_that_is_missed_is_an_error_of_ours) {
  const Vec2d from(-2, feet + 5e-7);
  add(step(from, {0, -0.01}, {0, 0}), step(from, {0, -0.01}, {0, 0}, {floor_below(-2)}));
  EXPECT_NE(found().find("error_of_ours.contact"), std::string::npos);
}

TEST_F(LedgerTest, motion_that_is_lost_to_nothing_is_an_error_of_ours) {
  add(step({-2, 2}, {0.1, 0}, {0.05, 0}), step({-2, 2}, {0.1, 0}, {0.1, 0}));
  EXPECT_EQ(found(), "error_of_ours.stop");
}

TEST_F(LedgerTest, a_report_one_step_late_is_latency) {
  const Vec2d from(-2, feet + 0.005);
  const Vec2d there = from - Vec2d(0, 0.0049995);
  add(step(from, {0, -0.005}, {0, -0.0049995}, {floor_below(-2, 1)}), step(from, {0, -0.005}, {0, -0.0049995}));
  add(step(there, {0, -0.01}, {0, 0}, {floor_below(-2)}), step(there, {0, -0.01}, {0, 0}, {floor_below(-2)}));
  EXPECT_EQ(found(), "event_latency.contact");
}

TEST_F(LedgerTest, a_report_that_never_comes_is_no_latency) {
  const Vec2d from(-2, feet + 0.005);
  add(step(from, {0, -0.005}, {0, -0.0049995}, {floor_below(-2, 1)}), step(from, {0, -0.005}, {0, -0.0049995}));
  add(step({-2, 2}, {0, -0.01}, {0, -0.01}), step({-2, 2}, {0, -0.01}, {0, -0.01}));
  EXPECT_EQ(found(), "skin.contact");
}

TEST_F(LedgerTest, a_way_beyond_two_metres_is_the_travel_cap) {
  const Vec2d from(-2, feet + 2.5);
  TraceStep capped = step(from, {0, -3}, {0, -2});
  capped.capped = true;
  add(step(from, {0, -3}, {0, -2.5 + 5e-7}, {floor_below(-2, 2.5 / 3)}), capped);
  EXPECT_EQ(found(), "travel_cap.contact travel_cap.stop");
}

TEST_F(LedgerTest, a_contact_within_two_metres_is_not_excused_by_the_cap) {
  const Vec2d from(-2, feet + 1.5);
  TraceStep capped = step(from, {0, -3}, {0, -1});
  capped.capped = true;
  add(step(from, {0, -3}, {0, -1.5 + 5e-7}, {floor_below(-2, 0.5)}), capped);
  EXPECT_NE(found().find("unexplained.contact"), std::string::npos);
}

/// On the slope at 45 degrees with the right foot's corner: ours keeps (1, 1) of (1, 0), Box2D (1/2, 1/2).
class OnASlope : public LedgerTest {
 protected:
  OnASlope() {
    const double half = std::sqrt(0.5);
    // The flank's facet is steeper than the slope, so its lower end touches first: (5/32, -5/8).
    const Vec2d corner(0.15625, -0.625);
    from_ = Vec2d(14, 4) - corner + Vec2d(-half, half) * 5e-7;
    contact_ = touch(3, {-half, half}, {14, 4});
    ours_ = step(from_, way_, {0.01, 0.01}, {contact_});
  }
  TraceStep box2d(double share) { return step(from_, way_, way_.x() * Vec2d(share, share), {contact_}); }

  const Vec2d way_{0.01, 0};
  Vec2d from_;
  Contact<double> contact_;
  TraceStep ours_;
};

TEST_F(OnASlope, velocities_of_both_laws_are_the_response_law) {
  add(ours_, box2d(0.5));
  EXPECT_EQ(found(), "response_law.stop");
}

TEST_F(OnASlope, a_velocity_of_no_law_is_unexplained) {
  add(ours_, box2d(0.501));
  EXPECT_EQ(found(), "unexplained.stop");
}

TEST_F(OnASlope, a_velocity_of_ours_that_is_not_our_law_is_unexplained) {
  ours_ = step(from_, way_, {0.00999, 0.00999}, {contact_});
  add(ours_, box2d(0.5));
  EXPECT_EQ(found().find("response_law"), std::string::npos);
}

TEST_F(LedgerTest, a_normal_of_no_face_is_a_ghost) {
  const Vec2d from(-0.15625, feet + 0.015);
  const TraceStep ours = step(from, {0.01, 0}, {0.01, 0});
  add(ours, step(from, {0.01, 0}, {0, 0}, {touch(1, {-1, 0}, {0, 0})}));
  EXPECT_EQ(found(), "ghost_collision.contact ghost_collision.stop");
}

TEST_F(LedgerTest, a_normal_of_a_face_is_no_ghost) {
  const Vec2d from(3 - 0.3125 - 0.015, 4);
  const TraceStep ours = step(from, {0.01, 0}, {0.01, 0});
  add(ours, step(from, {0.01, 0}, {0, 0}, {touch(2, {-1, 0}, {3, 4})}));
  EXPECT_EQ(found(), "skin.contact skin.stop");
}

/// At 131,072 m a float has steps of 1/64 m; four of them are 1/16 m.
TEST_F(LedgerTest, what_differs_by_some_ulps_is_float) {
  const Vec2d far(131072, 2);
  add(step(far, {0.25, 0}, {0.25, 0}), step(far, {0.25, 0}, {0.1875, 0}));
  EXPECT_EQ(found(), "float.stop");
}

TEST_F(LedgerTest, what_differs_by_more_ulps_is_not) {
  const Vec2d far(131072, 2);
  add(step(far, {0.25, 0}, {0.25, 0}), step(far, {0.25, 0}, {0.125, 0}));
  EXPECT_EQ(found(), "unexplained.stop");
}

TEST_F(LedgerTest, what_begins_inside_leaves_as_each_side_does) {
  const Vec2d inside(-2, feet - 0.25);
  add(step(inside, {0, 0}, {0, 0.2500005}), step(inside, {0, 0}, {0, 0.05}));
  EXPECT_EQ(found(), "start_inside.stop");
}

/// Ours comes to the floor from 5 mm above, Box2D from 35 mm and stays 30 mm away.
TEST_F(LedgerTest, what_both_are_right_about_beyond_the_skin_remains) {
  const Vec2d way(0, -0.005);
  const Vec2d made(0, -0.0049995);
  add(step({-2, feet + 0.005}, way, made, {floor_below(-2, 1)}), step({-2, feet + 0.035}, way, made));
  EXPECT_EQ(found(), "remaining_lockstep.contact");
}

TEST_F(LedgerTest, what_both_are_right_about_within_the_skin_is_skin) {
  const Vec2d way(0, -0.005);
  const Vec2d made(0, -0.0049995);
  add(step({-2, feet + 0.005}, way, made, {floor_below(-2, 1)}), step({-2, feet + 0.0249}, way, made));
  EXPECT_EQ(found(), "skin.contact");
}

/// A law that explains both velocities comes before what else is so in the step.
TEST_F(OnASlope, a_law_explains_the_step_of_a_character_that_meets_another) {
  TraceStep reference = box2d(0.5);
  reference.met.push_back({.other = 1, .normal = {0, -1}, .fraction = 1, .side = Side::top});
  add(ours_, reference);
  EXPECT_EQ(found(), "response_law.stop");
}

TEST_F(OnASlope, a_circumstance_explains_a_velocity_of_no_law) {
  TraceStep reference = box2d(0.501);
  reference.met.push_back({.other = 1, .normal = {0, -1}, .fraction = 1, .side = Side::top});
  add(ours_, reference);
  EXPECT_EQ(found(), "company.stop");
}

TEST_F(LedgerTest, who_meets_another_character_is_in_company) {
  TraceStep pushed = step({-2, 2}, {0.1, 0}, {0.05, 0});
  pushed.met.push_back({.other = 1, .normal = {-1, 0}, .fraction = 0, .side = Side::right});
  add(step({-2, 2}, {0.1, 0}, {0.1, 0}), pushed);
  EXPECT_EQ(found(), "company.stop");
}

TEST_F(LedgerTest, who_meets_nobody_and_stops_in_the_air_is_unexplained) {
  add(step({-2, 2}, {0.1, 0}, {0.1, 0}), step({-2, 2}, {0.1, 0}, {0.05, 0}));
  EXPECT_EQ(found(), "unexplained.stop");
}

TEST_F(LedgerTest, who_passes_a_wall_errs) {
  const Vec2d from(2, 4);
  const Vec2d through(3, 0);
  add(step(from, through, {0.6874995, 0}, {touch(2, {-1, 0}, {3, 4}, 0.2291665)}), step(from, through, through));
  EXPECT_NE(found().find("error_of_box2d.crossing"), std::string::npos);
  EXPECT_NE(found().find("error_of_box2d.contact"), std::string::npos);
}

TEST_F(LedgerTest, our_own_crossing_is_an_error_of_ours) {
  const Vec2d from(2, 4);
  add(step(from, {3, 0}, {3, 0}), step(from, {3, 0}, {0.67, 0}, {touch(2, {-1, 0}, {3, 4}, 0.22)}));
  EXPECT_NE(found().find("error_of_ours.crossing"), std::string::npos);
}

TEST_F(LedgerTest, an_impact_that_is_early_by_the_skin_is_skin) {
  const Vec2d from(2, 4);
  const Vec2d way(1, 0);
  const auto at_wall = [](double fraction) { return touch(2, {-1, 0}, {3, 4}, fraction); };
  TraceStep ours = step(from, way, {0.6874995, 0}, {at_wall(0.6874995)});
  ours.velocity.setZero();
  TraceStep early = step(from, way, {0.6725, 0}, {at_wall(0.6725)});
  early.path.insert(early.path.begin() + 1, {from + Vec2d(0.6725, 0), 0.6725});
  early.velocity.setZero();
  add(ours, early);
  EXPECT_EQ(found(), "skin.time skin.stop");
}

TEST_F(LedgerTest, an_impact_that_is_earlier_than_the_skin_is_a_sampled_time) {
  const Vec2d from(2, 4);
  const Vec2d way(1, 0);
  const auto at_wall = [](double fraction) { return touch(2, {-1, 0}, {3, 4}, fraction); };
  TraceStep ours = step(from, way, {0.6874995, 0}, {at_wall(0.6874995)});
  ours.velocity.setZero();
  TraceStep early = step(from, way, {0.6725, 0}, {at_wall(0.6625)});
  early.path.insert(early.path.begin() + 1, {from + Vec2d(0.6725, 0), 0.6725});
  early.velocity.setZero();
  add(ours, early);
  EXPECT_EQ(found(), "skin.stop sampled_time.time");
}

TEST_F(LedgerTest, the_side_that_trembles_at_rest_is_named_with_its_reason) {
  const Vec2d from(-2, feet + 0.015);
  const Vec2d ours(-2, feet + 5e-7);
  for (int k = 0; k < 40; ++k) {
    TraceStep mine = step(ours, {0, -0.001}, {0, 0}, {floor_below(-2)});
    TraceStep reference = step(from, {0, -0.001}, {0, 0}, {floor_below(-2)});
    mine.grounded = reference.grounded = true;
    if (k == 36) reference.contacts.push_back(touch(0, {1, 0}, {0, 0}));
    add(mine, reference);
  }
  EXPECT_NE(found().find("ghost_collision.contact"), std::string::npos);
  const auto& sums = ledger_.sums();
  EXPECT_EQ(sums.at({Cause::skin, EventKind::toggle_box2d}).count, 2);
}

TEST_F(FreeLedgerTest, what_both_are_right_about_once_they_are_apart_is_counted_apart) {
  // Step 0: a ghost stops Box2D. Step 1: ours comes to the wall, Box2D is a metre behind.
  const Vec2d from(-0.15625, feet + 0.015);
  TraceStep ours = step(from, {2.75, 0}, {2.75, 0});
  add(ours, step(from, {2.75, 0}, {0, 0}, {touch(1, {-1, 0}, {0, 0})}));
  const Vec2d there = from + Vec2d(2.75, 0);
  const Vec2d way(0.2, 0);
  TraceStep stops = step(there, way, {0.0937495, 0}, {touch(2, {-1, 0}, {3, feet}, 0.46875)});
  stops.velocity.setZero();
  add(stops, step(from, way, way));
  EXPECT_EQ(found(), "ghost_collision.contact ghost_collision.stop after_divergence.contact after_divergence.stop");
  const LedgerEntry& first = ledger_.sums().at({Cause::after_divergence, EventKind::contact}).first;
  EXPECT_EQ(first.step, 1);
  EXPECT_NE(first.words.find("apart since step 0 (ghost_collision)"), std::string::npos) << first.words;
}

TEST_F(FreeLedgerTest, nothing_is_after_divergence_while_both_are_together) {
  const Vec2d from(2.5875, feet + 0.015);
  const Vec2d way(0.2, 0);
  TraceStep stops = step(from, way, {0.0999995, 0}, {touch(2, {-1, 0}, {3, feet}, 0.5)});
  stops.velocity.setZero();
  add(stops, step(from, way, {0.05, 0}));
  EXPECT_EQ(found().find("after_divergence"), std::string::npos);
}

TEST_F(FreeLedgerTest, the_row_has_every_cause_with_its_first_step) {
  const Vec2d from(-2, feet + 0.0199);
  const TraceStep falls = step({-2, 2}, {0, -0.01}, {0, -0.01});
  add(falls, falls);
  for (int k = 0; k < 2; ++k)
    add(step(from, {0, -0.01}, {0, -0.01}), step(from, {0, -0.01}, {0, 0}, {floor_below(-2)}));
  ledger_.finish();
  Row row;
  ledger_.write(row);
  ASSERT_TRUE(row.disagreements.contains("skin.contact"));
  EXPECT_EQ(row.disagreements.at("skin.contact").count, 2);
  EXPECT_EQ(row.disagreements.at("skin.contact").first_step, 1);
}

}  // namespace
}  // namespace paperproof::compare
