/// The ledger of disagreement on made-up traces: each cause, and a neighbour that is just outside of it.
#include "metrics/ledger.hpp"
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

TraceHeader header(bool box2d) {
  // Two tiles beside each other, a wall, a slope of 45 degrees, and a floor far down the line.
  TraceHeader made = test::header({box(-4, -1, 0, 0), box(0, -1, 4, 0), box(3, 0, 4, 8),
                                   polygon({{10, 0}, {18, 0}, {18, 8}}), box(-200, -1, -100, 0)},
                                  !box2d);
  made.contender = box2d ? "box2d" : "octagon_sweep";
  made.scalar = box2d ? "float" : "double";
  made.tolerances = {{"hit", 1e-7}, {"stop", 5e-7}, {"touch", 7e-7}};
  return made;
}

/// A step by `way` of which `made` is made.
TraceStep step(const Vec2d& from, const Vec2d& way, const Vec2d& made, std::vector<Contact> contacts = {}) {
  TraceStep one = test::step({from, from + made}, way, std::move(contacts));
  one.velocity = made / dt;
  return one;
}

Contact touch(ColliderIndex collider, const Vec2d& normal, const Vec2d& point, double fraction = 0) {
  const Side side = side_of_normal(normal.x(), normal.y());
  return {.collider = collider, .point = point, .normal = normal, .fraction = fraction, .side = side};
}
Contact floor_below(double x, double fraction = 0) { return touch(x < 0 ? 0 : 1, {0, 1}, {x, 0}, fraction); }

/// Steps of the two sides, both judged by exact arithmetic, and the ledger of what they disagree about.
class Ledgers {
 public:
  explicit Ledgers(bool lockstep)
      : ledger_({&mine_header_, &mine_judge_.scenery()}, {&reference_header_, &reference_judge_.scenery()}, lockstep) {}

  void add(TraceStep mine, TraceStep reference) {
    mine.step = reference.step = number_++;
    mine.start_overlap = mine_judge_.scenery().overlapped(Place(mine.path.front().position));
    reference.start_overlap = reference_judge_.scenery().overlapped(Place(reference.path.front().position));
    ledger_.add(mine, mine_judge_.judge(mine), reference, reference_judge_.judge(reference));
  }

  /// Nothing is added any more.
  const Ledger& finished() {
    ledger_.finish();
    return ledger_;
  }

 private:
  const TraceHeader mine_header_ = header(false);
  const TraceHeader reference_header_ = header(true);
  Judge mine_judge_{mine_header_};
  Judge reference_judge_{reference_header_};
  Ledger ledger_;
  int number_ = 0;
};

/// What stands in a ledger, as `cause.kind` in order; a space between.
std::string found_in(const Ledger& ledger) {
  std::string text;
  for (const auto& [key, sum] : ledger.sums())
    text +=
        (text.empty() ? "" : " ") + std::string(name_of(sum.first.cause)) + "." + std::string(name_of(sum.first.kind));
  return text;
}

const Vec2d still(0, 0);
const Vec2d down(0, -0.01);
const Vec2d right(0.1, 0);
const Vec2d sky(-2, 2);
const Vec2d beside_wall(2, 4);

const Contact ground = floor_below(-2);
const Contact landing = floor_below(-2, 1);

/// So far above the first tile.
Vec2d above(double height) { return {-2, half_height + height}; }
TraceStep falls(double height, std::vector<Contact> contacts = {}) {
  return step(above(height), down, down, std::move(contacts));
}
TraceStep held(double height, std::vector<Contact> contacts = {}) {
  return step(above(height), down, still, std::move(contacts));
}
/// 5 mm down to the floor, of which 0.5 µm are left.
TraceStep lands(double height, std::vector<Contact> contacts = {}) {
  return step(above(height), {0, -0.005}, {0, -0.0049995}, std::move(contacts));
}
TraceStep capped(double height) {
  TraceStep one = step(above(height), {0, -3}, {0, 0.5 - height});
  one.capped = true;
  return one;
}
TraceStep met(TraceStep one, const Vec2d& normal, double fraction, Side side) {
  one.met.push_back({.other = 1, .normal = normal, .fraction = fraction, .side = side});
  return one;
}
Contact at_wall(double fraction) { return touch(2, {-1, 0}, {3, 4}, fraction); }
TraceStep stopped(TraceStep one) {
  one.velocity.setZero();
  return one;
}
/// At the wall, or 15 mm before it.
const TraceStep stops = stopped(step(beside_wall, {1, 0}, {0.6874995, 0}, {at_wall(0.6874995)}));
TraceStep stops_early(double fraction) {
  TraceStep early = stopped(step(beside_wall, {1, 0}, {0.6725, 0}, {at_wall(fraction)}));
  early.path.insert(early.path.begin() + 1, {beside_wall + Vec2d(0.6725, 0), 0.6725});
  return early;
}

/// On the slope at 45 degrees with the right foot's corner: ours keeps (1, 1) of (1, 0), Box2D (1/2, 1/2). The flank's
/// facet is steeper than the slope, so its lower end touches first: (5/32, -5/8).
TraceStep on_slope(double share) {
  const double half = std::sqrt(0.5);
  const Vec2d from = Vec2d(14, 4) - Vec2d(0.15625, -0.625) + Vec2d(-half, half) * 5e-7;
  return step(from, {0.01, 0}, 0.01 * Vec2d(share, share), {touch(3, {-half, half}, {14, 4})});
}
TraceStep under_another(TraceStep one) { return met(std::move(one), {0, -1}, 1, Side::top); }

const Vec2d over_seam(-0.15625, half_height + 0.015);
const Vec2d skin_from_wall(3 - 0.3125 - 0.015, 4);
/// At 131,072 m a float has steps of 1/64 m.
TraceStep far_out(double made) { return step({131072, 2}, {0.25, 0}, {made, 0}); }

struct Story {
  const char* name;
  std::vector<std::pair<TraceStep, TraceStep>> steps;  ///< Ours, and Box2D's.
  const char* found;
};

const std::vector<Story> stories{
    {"a_report_from_within_the_skin", {{falls(0.0199), held(0.0199, {ground})}}, "skin.contact skin.stop"},
    {"a_report_from_beyond_the_skin", {{falls(0.0301), falls(0.0301, {ground})}}, "error_of_box2d.contact"},
    {"a_report_that_is_not_exact", {{falls(0.0199, {ground}), falls(0.0199)}}, "error_of_ours.contact"},
    {"an_exact_contact_that_is_missed", {{held(5e-7), held(5e-7, {ground})}}, "error_of_ours.contact"},
    {"our_motion_lost_to_nothing", {{step(sky, right, right / 2), step(sky, right, right)}}, "error_of_ours.stop"},
    {"box2d_stops_in_the_air", {{step(sky, right, right), step(sky, right, right / 2)}}, "unexplained.stop"},
    {"a_report_one_step_late",
     {{lands(0.005, {landing}), lands(0.005)}, {held(5e-7, {ground}), held(5e-7, {ground})}},
     "event_latency.contact"},
    {"a_report_that_never_comes",
     {{lands(0.005, {landing}), lands(0.005)}, {step(sky, down, down), step(sky, down, down)}},
     "skin.contact"},
    {"a_way_beyond_two_metres",
     {{step(above(2.5), {0, -3}, {0, -2.5 + 5e-7}, {floor_below(-2, 2.5 / 3)}), capped(2.5)}},
     "travel_cap.contact travel_cap.stop"},
    {"a_contact_within_two_metres_of_a_capped_step",
     {{step(above(1.5), {0, -3}, {0, -1.5 + 5e-7}, {floor_below(-2, 0.5)}), capped(1.5)}},
     "travel_cap.stop unexplained.contact"},
    {"velocities_of_both_laws", {{on_slope(1), on_slope(0.5)}}, "response_law.stop"},
    {"a_velocity_of_no_law", {{on_slope(1), on_slope(0.501)}}, "unexplained.stop"},
    {"a_velocity_of_ours_that_is_not_our_law", {{on_slope(0.999), on_slope(0.5)}}, "error_of_ours.stop"},
    {"a_circumstance_of_a_velocity_of_no_law", {{on_slope(1), under_another(on_slope(0.501))}}, "company.stop"},
    {"who_meets_another_character",
     {{step(sky, right, right), met(step(sky, right, right / 2), {-1, 0}, 0, Side::right)}},
     "company.stop"},
    {"a_normal_of_no_face",
     {{step(over_seam, {0.01, 0}, {0.01, 0}), step(over_seam, {0.01, 0}, still, {touch(1, {-1, 0}, {0, 0})})}},
     "ghost_collision.contact ghost_collision.stop"},
    {"a_normal_of_a_face",
     {{step(skin_from_wall, {0.01, 0}, {0.01, 0}), step(skin_from_wall, {0.01, 0}, still, {at_wall(0)})}},
     "skin.contact skin.stop"},
    {"a_difference_of_four_ulps", {{far_out(0.25), far_out(0.1875)}}, "float.stop"},
    {"a_difference_of_eight_ulps", {{far_out(0.25), far_out(0.125)}}, "unexplained.stop"},
    {"what_begins_inside",
     {{step(above(-0.25), still, {0, 0.2500005}), step(above(-0.25), still, {0, 0.05})}},
     "start_inside.stop"},
    // Ours comes to the floor; Box2D stays 30 mm above it.
    {"both_right_beyond_the_skin", {{lands(0.005, {landing}), lands(0.035)}}, "remaining_lockstep.contact"},
    {"who_passes_a_wall",
     {{step(beside_wall, {3, 0}, {0.6874995, 0}, {at_wall(0.2291665)}), step(beside_wall, {3, 0}, {3, 0})}},
     "error_of_box2d.contact error_of_box2d.crossing unexplained.stop"},
    {"our_own_crossing",
     {{step(beside_wall, {3, 0}, {3, 0}), step(beside_wall, {3, 0}, {0.67, 0}, {at_wall(0.22)})}},
     "error_of_ours.crossing unexplained.contact unexplained.stop"},
    {"an_impact_that_is_early_by_the_skin", {{stops, stops_early(0.6725)}}, "skin.time skin.stop"},
    {"an_impact_that_is_earlier_than_the_skin", {{stops, stops_early(0.6625)}}, "skin.stop sampled_time.time"}};

TEST(Ledger, has_each_cause_and_no_other) {
  for (const Story& story : stories) {
    Ledgers ledgers(true);
    for (const auto& [mine, reference] : story.steps) ledgers.add(mine, reference);
    EXPECT_EQ(found_in(ledgers.finished()), story.found) << story.name;
  }
}

TEST(Ledger, names_the_side_that_trembles_at_rest_with_its_reason) {
  Ledgers ledgers(true);
  for (int k = 0; k < 40; ++k) {
    TraceStep mine = step(above(5e-7), {0, -0.001}, still, {ground});
    TraceStep reference = step(above(0.015), {0, -0.001}, still, {ground});
    mine.grounded = reference.grounded = true;
    if (k == 36) reference.contacts.push_back(touch(0, {1, 0}, {0, 0}));
    ledgers.add(mine, reference);
  }
  const Ledger& ledger = ledgers.finished();
  EXPECT_TRUE(found_in(ledger).find("ghost_collision.contact") != std::string::npos) << found_in(ledger);
  EXPECT_EQ(ledger.sums().at({Cause::skin, EventKind::toggle_box2d}).count, 2);
}

TEST(Ledger, counts_apart_what_both_are_right_about_once_they_are_apart) {
  // Step 0: a ghost stops Box2D. Step 1: ours comes to the wall, Box2D is a metre behind.
  Ledgers ledgers(false);
  const Vec2d way(0.2, 0);
  ledgers.add(step(over_seam, {2.75, 0}, {2.75, 0}), step(over_seam, {2.75, 0}, still, {touch(1, {-1, 0}, {0, 0})}));
  ledgers.add(
      stopped(step(over_seam + Vec2d(2.75, 0), way, {0.0937495, 0}, {touch(2, {-1, 0}, {3, half_height}, 0.46875)})),
      step(over_seam, way, way));
  const Ledger& ledger = ledgers.finished();
  EXPECT_EQ(found_in(ledger),
            "ghost_collision.contact ghost_collision.stop after_divergence.contact after_divergence.stop");
  const LedgerEntry& first = ledger.sums().at({Cause::after_divergence, EventKind::contact}).first;
  EXPECT_EQ(first.step, 1);
  EXPECT_NE(first.words.find("apart since step 0 (ghost_collision)"), std::string::npos) << first.words;
}

TEST(Ledger, has_nothing_after_divergence_while_both_are_together) {
  Ledgers ledgers(false);
  const Vec2d from(2.5875, half_height + 0.015);
  const Vec2d way(0.2, 0);
  ledgers.add(stopped(step(from, way, {0.0999995, 0}, {touch(2, {-1, 0}, {3, half_height}, 0.5)})),
              step(from, way, {0.05, 0}));
  EXPECT_EQ(found_in(ledgers.finished()).find("after_divergence"), std::string::npos);
}

}  // namespace
}  // namespace paperproof::compare::test
