#include "metrics/metrics.hpp"

#include "compare/moments.hpp"
#include "records/metric.hpp"

#include <gtest/gtest.h>
#include <map>

#include <cmath>
#include <functional>

namespace paperproof::compare {
namespace {

Row row_of(const std::vector<Moment>& run, const TraceHeader& head = header()) {
  Metrics metrics(head);
  Breaches breaches;
  for (const Moment& moment : run) metrics.add(moment.step, moment.judged, breaches);
  Row row;
  metrics.write(row);
  return row;
}

std::vector<Moment> moments(int steps, const std::vector<Contact>& contacts = {}) {
  std::vector<Moment> run;
  for (int i = 0; i < steps; ++i) run.push_back(moment(i, contacts));
  return run;
}

/// Grounded at the end of every step, at a place that depends on its number.
std::vector<Moment> resting(int steps, const std::function<Vec2d(int)>& place) {
  std::vector<Moment> run = moments(steps, {contact(0, Side::bottom)});
  for (Moment& one : run) {
    one.step.grounded = true;
    one.step.path.back().position = place(one.step.step);
  }
  return run;
}

const Contact bottom = contact(0, Side::bottom);
const ExactContact floor_below = exact(0, Side::bottom);

const TraceHeader promising = header("octagon_sweep");
const TraceHeader of_two = header("mine", 2);

TEST(Metrics, a_step_that_passes_two_is_one_tunnel_and_the_first_is_told) {
  std::vector<Moment> run = moments(10);
  run[2].judged.tunnelled = {1};
  run[2].judged.passings = {{.collider = 1, .speed = 40, .thickness = 0.01, .angle = 90}};
  run[5].judged.tunnelled = {0, 1};
  run[5].judged.passings = {{.collider = 0}, {.collider = 1}};
  const Row row = row_of(run);
  EXPECT_EQ(row.tunnels, 2);
  ASSERT_TRUE(row.first_tunnel);
  EXPECT_EQ(row.first_tunnel->step, 2);
  EXPECT_EQ(row.first_tunnel->collider, "paper");
  EXPECT_EQ(row.first_tunnel->words,
            "step 2: passed `paper` at 40.0 m/s, 0.01 m thick at the crossing, 90° to its face");
}

TEST(Metrics, steps_that_are_said_to_be_stuck_are_counted_and_miss_no_contact) {
  std::vector<Moment> run = moments(6);
  for (Moment& one : run) one.judged.contacts = {floor_below};
  run[0].step.contacts = run[1].step.contacts = {bottom};
  EXPECT_EQ(row_of(run).stuck_steps, 0);
  EXPECT_EQ(row_of(run).contact_recall, 2.0 / 6);
  for (const std::size_t i : {2U, 3U, 4U, 5U}) run[i].step.stuck = true;
  EXPECT_EQ(row_of(run).stuck_steps, 4);
  EXPECT_EQ(row_of(run).contact_recall, 1.0);
  EXPECT_EQ(row_of(run).exempted.at("stuck"), 4);
  run[5].judged.stuck_refuted = run[5].judged.ground_refuted = true;
  const Row promises = row_of(run, promising);
  EXPECT_EQ(promises.stuck_refuted, 1);
  EXPECT_EQ(promises.ground_refuted, 1);
  EXPECT_EQ(promises.contact_recall, 2.0 / 3) << "three were right";
  EXPECT_EQ(promises.exempted, (std::map<std::string, int>{{"stuck", 3}})) << "and are counted";
}

TEST(Metrics, what_is_not_held_against_a_contender_is_counted_by_name) {
  std::vector<Moment> run = moments(5);
  run[0].judged.note_clipped(run[0].judged.clipped, ColliderIndex{1}, 0.01);
  run[1].judged.hovers = run[2].judged.hovers = true;
  run[3].judged.excused_crush = run[3].judged.ground_late = true;
  run[3].judged.end_overlap = run[3].judged.drawn = {1};
  run[4].step.contacts = {bottom};
  run[4].judged.beside_another = true;
  const std::map<std::string, int> expected{
      {"company", 2}, {"clipped", 1}, {"drawn", 1}, {"hover", 2}, {"late_ground", 1}};
  EXPECT_EQ(row_of(run).exempted, expected);
  EXPECT_EQ(row_of(run).clipped_depth_max_m, 0.01);
  EXPECT_EQ(row_of(run).steps_ending_inside, 0);
}

TEST(Metrics, distance_and_motion_lost_are_sums_over_the_run_and_the_loss_to_ghosts_is_the_largest) {
  std::vector<Moment> run = moments(2);
  run[0].step.path = {{Vec2d(0, 0), 0}, {Vec2d(3, 4), 0.5}, {Vec2d(3, 3), 1}};
  run[1].step.path = {{Vec2d(3, 3), 0}, {Vec2d(1, 3), 1}};
  run[0].judged.ghost_speed_loss = 0.25;
  run[1].judged.ghost_speed_loss = 0.125;
  EXPECT_FALSE(row_of(run).wanted_motion_lost || row_of(run).ghost_speed_loss) << "none was wanted";
  run[0].judged.motion_wanted = 3;
  run[1].judged.motion_wanted = 1;
  run[1].judged.motion_lost = 0.5;
  EXPECT_EQ(row_of(run).distance_m, 8);
  EXPECT_EQ(row_of(run).wanted_motion_lost, 0.125);
  EXPECT_EQ(row_of(run).ghost_speed_loss, 0.25);
}

/// Two characters, each step of each.
std::vector<Moment> two(int steps) {
  std::vector<Moment> run;
  for (int i = 0; i < 2 * steps; ++i) {
    run.push_back(moment(i / 2));
    run.back().step.character = static_cast<CharacterIndex>(i % 2);
  }
  return run;
}

TEST(Metrics, a_contact_with_another_character_is_one_and_may_be_the_first) {
  std::vector<Moment> run = two(2);
  run[2].step.contacts = {contact(0, Side::bottom, 0.75)};
  run[2].judged.contacts = {floor_below};
  run[3].step.met = {{.other = 0, .fraction = 0.5, .side = Side::left}};
  run[3].judged.beside_another = true;
  run[2].judged.first_impact = 0.75;
  run[2].judged.first_impact_comparable = true;
  const Row row = row_of(run, of_two);
  EXPECT_EQ(row.contact_steps, 2);
  EXPECT_EQ(row.first_contact_step, 1);
  EXPECT_EQ(row.first_contact_fraction, 0.5);
  EXPECT_EQ(row.toi_error_max, 0);
  EXPECT_EQ(row.contact_precision, 1);
  EXPECT_EQ(row.exact_first_impact_fraction, 0.75);
  run[1].judged.beside_another = true;
  EXPECT_FALSE(row_of(run, of_two).exact_first_impact_fraction) << "another may have been met before";
}

TEST(Metrics, two_characters_are_matched_and_rest_each_by_itself) {
  std::vector<Moment> run = two(80);
  for (std::size_t i = 0; i < run.size(); ++i) {
    run[i].step.grounded = true;
    if (i % 2 == 0) continue;
    // The second one moves by 1/64 m every other step.
    const Vec2d at(7 + (i % 4 == 1 ? 0x1p-6 : 0), 0);
    run[i].step.path = {{at, 0}, {at, 1}};
  }
  run[10].step.contacts = {bottom};
  run[11].judged.contacts = {floor_below};
  const Row row = row_of(run, of_two);
  EXPECT_EQ(row.rest_peak_to_peak_m, 0x1p-6);
  EXPECT_EQ(row.contact_precision, 0) << "the other one's contact is no excuse";
  EXPECT_EQ(row.contact_recall, 0);
}

TEST(Metrics, a_floor_of_two_tiles_is_one_contact_for_recall_and_two_for_precision) {
  const Row row = row_of({moment(0, {bottom}, {floor_below, exact(1, Side::bottom)})});
  EXPECT_EQ(row.contact_recall, 1);
  EXPECT_EQ(row.contact_precision, 1);
  const Row missed = row_of({moment(0, {contact(0, Side::left)}, {floor_below, exact(0, Side::left)})});
  EXPECT_EQ(missed.contact_recall, 0.5);
}

TEST(Metrics, contacts_within_the_skin_count_neither_way) {
  std::vector<Moment> run{moment(0, {bottom}), moment(1, {contact(1, Side::left)})};
  run[0].judged.dont_care = {0};
  const Row row = row_of(run);
  EXPECT_EQ(row.contact_precision, 0) << "only the left one counts, and it is wrong";
  EXPECT_EQ(row.exempted.at("reach"), 1);
  run[1].judged.dont_care = {1};
  EXPECT_FALSE(row_of(run).contact_precision);
  EXPECT_EQ(row_of(run, promising).contact_precision, 0) << "who promises has no reach";
  run[0].judged.contact_band = {{0, Side::bottom}};
  run[1].judged.deflected = {{1, Side::left}};
  EXPECT_EQ(row_of(run, promising).contact_precision, 1) << "one in the band, and one that is right";
  EXPECT_EQ(row_of(run, promising).contact_band, 1);
  run[0].judged.contact_band = {{0, Side::left}};
  EXPECT_EQ(row_of(run, promising).contact_precision, 0.5) << "the band of another side excuses nothing";
  run[1].judged.deflected.clear();
  run[0].judged.ghosts = {{0, Side::bottom}};
  EXPECT_EQ(row_of(run).contact_precision, 0) << "a ghost is wrong within the skin too";
}

TEST(Metrics, rest_jitter_of_an_oscillation_is_its_closed_form) {
  // After settling the character hops between -a and +a: the range is 2a, the root mean square a.
  constexpr double a = 1.0 / 1024;
  std::vector<Moment> run = resting(130, [](int i) { return Vec2d(5, i < 30 ? 100 - i : i % 2 == 0 ? a : -a); });
  for (std::size_t i = 9; i < run.size(); i += 10) run[i].step.contacts.clear();
  const Row row = row_of(run);
  EXPECT_EQ(row.rest_peak_to_peak_m, 2 * a);
  EXPECT_NEAR(*row.rest_rms_m, a, 1e-15);
  // The contact is lost on every tenth of 100 measured steps and comes back on the next; the last one does not.
  EXPECT_DOUBLE_EQ(*row.contact_toggles, 1000.0 * 19 / 100);
}

TEST(Metrics, who_stands_on_a_mover_rests_relative_to_it) {
  TraceHeader head = header();
  head.scenery.colliders[1].mover = 0;
  const auto at = [](int number) { return Vec2d(0.25 * number, 2 * number); };
  std::vector<Moment> run = resting(100, [&](int i) -> Vec2d { return at(i + 1) + Vec2d(0, i % 2 == 0 ? 0.125 : 0); });
  for (Moment& one : run) {
    one.step.contacts = {contact(1, Side::bottom)};
    one.step.movers = {{at(one.step.step), at(one.step.step + 1)}};
    one.step.requested = {0.25, -1};  // the ride, and gravity
  }
  EXPECT_EQ(row_of(run, head).rest_peak_to_peak_m, 0.125);
  for (Moment& one : run) one.step.requested.x() = 0.5;
  EXPECT_FALSE(row_of(run, head).rest_peak_to_peak_m) << "it walks on what moves";
}

TEST(Metrics, crushes_are_counted_apart_and_so_is_what_they_press_into) {
  std::vector<Moment> run = moments(6);
  for (Moment& one : run) one.step.movers = {{}};
  run[2].judged.crushed = {1};
  run[2].judged.end_overlap = run[2].judged.pressed = {1};
  run[3].judged.crushed_with_room = {1};
  run[3].judged.end_overlap = {0, 1};
  run[3].judged.pressed = {1};
  const Row row = row_of(run);
  EXPECT_EQ(row.crushes, 1);
  EXPECT_EQ(row.crushes_refuted, 1);
  EXPECT_EQ(row.steps_ending_inside, 1) << "in the floor, which pressed nobody";
  for (Moment& one : run) one.step.movers.clear();
  EXPECT_FALSE(row_of(run).crushes) << "nothing moves";
}

TEST(Metrics, a_rest_needs_sixty_steps_and_the_last_one_counts) {
  const auto rest = [](std::vector<Moment>& run, int steps, double height, double hop) {
    const auto more = resting(steps, [&](int i) { return Vec2d(0, height + (i % 2 == 0 ? hop : 0)); });
    run.insert(run.end(), more.begin(), more.end());
    run.push_back(moment(steps));  // in the air
  };
  std::vector<Moment> run;
  rest(run, 59, 0, 1);
  EXPECT_FALSE(row_of(run).rest_peak_to_peak_m);
  rest(run, 60, 0, 0.5);
  EXPECT_EQ(row_of(run).rest_peak_to_peak_m, 0.5);
  rest(run, 60, 7, 0.25);
  rest(run, 40, 0, 2);
  EXPECT_EQ(row_of(run).rest_peak_to_peak_m, 0.25);
  for (Moment& one : run) one.step.requested = {0.1, 0};
  EXPECT_FALSE(row_of(run).rest_peak_to_peak_m) << "walking is no rest";
}

TEST(Metrics, who_hops_on_its_floor_rests_and_who_jumps_does_not) {
  TraceHeader head = header();
  head.dt = 1.0 / 60;
  constexpr double hop = 1.0 / 32;
  // Grounded on the floor in every `period`-th step, a hop above it in the others.
  const auto hopping = [&](int period) {
    std::vector<Moment> run = resting(121, [&](int i) { return Vec2d(0, i % period == 0 ? 0 : hop); });
    for (Moment& one : run) {
      one.step.grounded = one.step.step % period == 0;
      if (!one.step.grounded) one.step.contacts.clear();
    }
    return run;
  };
  for (const int period : {2, 4, 7})
    EXPECT_EQ(row_of(hopping(period), head).rest_peak_to_peak_m, hop)
        << period << ": at most 6 steps of 1/60 s in the air";
  EXPECT_FALSE(row_of(hopping(8), head).rest_peak_to_peak_m) << "7 steps in the air are no rest";
  std::vector<Moment> jump = hopping(4);
  for (std::size_t i = 101; i < jump.size(); ++i) {
    jump[i].step.grounded = false;
    jump[i].step.path.back().position = {0, 1};
  }
  EXPECT_EQ(row_of(jump, head).rest_peak_to_peak_m, hop) << "what does not come back is not part of the rest";
}

}  // namespace
}  // namespace paperproof::compare
