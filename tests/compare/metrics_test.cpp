#include "metrics/metrics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::compare {
namespace {

TraceHeader header(bool one_way = false) {
  TraceHeader header;
  header.contender = "mine";
  header.dt = 0.5;
  header.ids = {"floor", "paper"};
  header.scenery.colliders.resize(2);
  if (one_way) header.scenery.colliders[1].one_way = Vec2d(0, 1);
  return header;
}

Contact<double> contact(ColliderIndex collider, Side side, double fraction = 0) {
  return {.collider = collider, .fraction = fraction, .side = side};
}
ExactContact exact(ColliderIndex collider, Side side) { return {.collider = collider, .side = side}; }

/// A synthetic run: what was reported and what was so.
struct Moment {
  TraceStep step;
  StepJudgement judged;
};

Moment moment(int number, std::vector<Contact<double>> contacts = {}, std::vector<ExactContact> truth = {}) {
  Moment moment;
  moment.step.step = number;
  moment.step.path = {{Vec2d(0, 0), 0}, {Vec2d(0, 0), 1}};
  moment.step.contacts = std::move(contacts);
  moment.judged.contacts = std::move(truth);
  return moment;
}

Row row_of(const std::vector<Moment>& run, const TraceHeader& head = header()) {
  Metrics metrics(head);
  for (const Moment& moment : run) metrics.add(moment.step, moment.judged);
  Row row;
  metrics.write(row);
  return row;
}

TEST(Metrics, counts_what_the_judge_found) {
  std::vector<Moment> run;
  for (int i = 0; i < 10; ++i) run.push_back(moment(i));
  run[2].judged.tunnelled = {1};
  run[2].judged.passings = {{.collider = 1, .speed = 40, .thickness = 0.01, .angle = 90}};
  run[5].judged.tunnelled = {0, 1};
  run[5].judged.passings = {{.collider = 0}, {.collider = 1}};
  run[3].judged.corner_cut = {1};
  run[6].judged.end_overlap = run[7].judged.end_overlap = run[8].judged.end_overlap = {0};
  run[7].judged.max_penetration = 0.25;
  run[8].judged.max_penetration = 0.125;
  run[4].step.respawn = true;
  run[9].step.dropped = true;
  const Row row = row_of(run);
  EXPECT_EQ(row.tunnels, 2);
  EXPECT_EQ(row.corner_cuts, 1);
  EXPECT_EQ(row.steps_ending_inside, 3);
  EXPECT_EQ(row.max_penetration_m, 0.25);
  EXPECT_EQ(row.respawns, 1);
  EXPECT_EQ(row.dropped_steps, 1);
  ASSERT_EQ(row.findings.size(), 1U);
  EXPECT_EQ(row.findings[0], "step 2: passed `paper` at 40.0 m/s, 0.01 m thick at the crossing, 90° to its face");
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

TraceHeader header_of_two() {
  TraceHeader head = header();
  head.characters = 2;
  return head;
}

TEST(Metrics, of_two_characters_every_step_of_each_counts_and_what_they_do_to_each_other_once) {
  std::vector<Moment> run = two(4);
  run[2].judged.company.passed = {1};
  run[4].judged.company.overlap = run[4].judged.company.entered = {1};
  run[5].judged.end_overlap = {0};
  run[6].judged.company.corner_cut = {1};
  const Row row = row_of(run, header_of_two());
  EXPECT_EQ(row.characters, 2);
  EXPECT_EQ(row.tunnels, 1);
  EXPECT_EQ(row.steps_ending_inside, 2);
  EXPECT_EQ(row.corner_cuts, 1);
  ASSERT_FALSE(row.findings.empty());
  EXPECT_EQ(row.findings[0], "step 1: character 0 and character 1 passed through each other");
  EXPECT_FALSE(row_of({moment(0)}).characters);
}

TEST(Metrics, a_contact_with_another_character_is_one_and_may_be_the_first) {
  std::vector<Moment> run = two(2);
  run[2].step.contacts = {contact(0, Side::bottom, 0.75)};
  run[2].judged.contacts = {exact(0, Side::bottom)};
  run[3].step.met = {{.other = 0, .fraction = 0.5, .side = Side::left}};
  run[3].judged.first_met = CharacterIndex{0};
  run[3].judged.first_impact = 0.5 + 0x1p-20;
  run[3].judged.first_impact_comparable = true;
  const Row row = row_of(run, header_of_two());
  EXPECT_EQ(row.contact_steps, 2);
  EXPECT_EQ(row.first_contact_step, 1);
  EXPECT_EQ(row.first_contact_fraction, 0.5);
  EXPECT_EQ(row.toi_error_max, 0x1p-20);
  EXPECT_EQ(row.contact_precision, 1);
  run[3].judged.first_met = CharacterIndex{1};
  EXPECT_FALSE(row_of(run, header_of_two()).toi_error_max) << "with somebody else";
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
  run[10].step.contacts = {contact(0, Side::bottom)};
  run[11].judged.contacts = {exact(0, Side::bottom)};
  const Row row = row_of(run, header_of_two());
  EXPECT_EQ(row.rest_peak_to_peak_m, 0x1p-6);
  EXPECT_EQ(row.contact_precision, 0) << "the other one's contact is no excuse";
  EXPECT_EQ(row.contact_recall, 0);
}

TEST(Metrics, one_way_violations_are_absent_without_one_way_chains) {
  EXPECT_FALSE(row_of({moment(0)}).one_way_violations);
  std::vector<Moment> run{moment(0), moment(1)};
  run[1].judged.one_way_broken = {1};
  EXPECT_EQ(row_of(run, header(true)).one_way_violations, 1);
}

TEST(Metrics, what_does_not_apply_is_absent) {
  const Row row = row_of({moment(0), moment(1)});
  EXPECT_FALSE(row.contact_precision);
  EXPECT_FALSE(row.contact_recall);
  EXPECT_FALSE(row.max_contact_gap_m);
  EXPECT_FALSE(row.first_contact_step);
  EXPECT_FALSE(row.toi_error_max);
  EXPECT_FALSE(row.rest_peak_to_peak_m);
  EXPECT_FALSE(row.contact_toggles);
  EXPECT_FALSE(row.ghost_speed_loss);
  EXPECT_FALSE(row.contact_agreement_box2d);
  EXPECT_EQ(row.tunnels, 0);
}

TEST(Metrics, a_contact_matches_within_one_step_with_its_collider_and_side) {
  const auto bottom = contact(0, Side::bottom);
  const auto floor = exact(0, Side::bottom);
  for (int late = -3; late <= 3; ++late) {
    std::vector<Moment> run;
    for (int i = 0; i < 9; ++i) run.push_back(moment(i));
    run[4].judged.contacts = {floor};
    run[static_cast<std::size_t>(4 + late)].step.contacts = {bottom};
    const Row row = row_of(run);
    const double expected = std::abs(late) <= 1 ? 1 : 0;
    EXPECT_EQ(row.contact_precision, expected) << late;
    EXPECT_EQ(row.contact_recall, expected) << late;
  }
  EXPECT_EQ(row_of({moment(0, {contact(0, Side::left)}, {floor})}).contact_precision, 0);
  EXPECT_EQ(row_of({moment(0, {contact(1, Side::bottom)}, {floor})}).contact_precision, 0);
}

TEST(Metrics, the_first_and_the_last_step_are_matched_too) {
  const auto bottom = contact(0, Side::bottom);
  const auto floor = exact(0, Side::bottom);
  for (int steps = 1; steps <= 5; ++steps) {
    std::vector<Moment> run;
    for (int i = 0; i < steps; ++i) run.push_back(moment(i, {bottom}, {floor}));
    run.back().step.contacts.push_back(contact(1, Side::left));
    const Row row = row_of(run);
    EXPECT_DOUBLE_EQ(*row.contact_precision, steps / (steps + 1.0));
    EXPECT_EQ(row.contact_recall, 1);
    EXPECT_EQ(row.contact_steps, steps);
    EXPECT_EQ(row.colliders_touched, 2);
  }
}

TEST(Metrics, a_floor_of_two_tiles_is_one_contact_for_recall_and_two_for_precision) {
  const Row row = row_of({moment(0, {contact(0, Side::bottom)}, {exact(0, Side::bottom), exact(1, Side::bottom)})});
  EXPECT_EQ(row.contact_recall, 1);
  EXPECT_EQ(row.contact_precision, 1);
  const Row missed =
      row_of({moment(0, {}, {exact(0, Side::bottom), exact(0, Side::left)}), moment(5, {contact(0, Side::left)}, {})});
  EXPECT_EQ(missed.contact_recall, 0.5);
}

TEST(Metrics, contacts_within_the_skin_count_neither_way) {
  std::vector<Moment> run{moment(0, {contact(0, Side::bottom)}), moment(1, {contact(1, Side::left)})};
  run[0].judged.dont_care = {0};
  const Row row = row_of(run);
  EXPECT_EQ(row.contact_precision, 0) << "only the left one counts, and it is wrong";
  run[1].judged.dont_care = {1};
  EXPECT_FALSE(row_of(run).contact_precision);
  run[0].judged.ghosts = {{0, Side::bottom}};
  EXPECT_EQ(row_of(run).contact_precision, 0) << "a ghost is wrong within the skin too";
}

TEST(Metrics, the_first_contact_is_the_earliest_of_the_first_step_that_has_one) {
  const Row row = row_of({moment(3), moment(4, {contact(0, Side::left, 0.75), contact(1, Side::bottom, 0.25)}),
                          moment(5, {contact(0, Side::left, 0.125)})});
  EXPECT_EQ(row.first_contact_step, 4);
  EXPECT_EQ(row.first_contact_fraction, 0.25);
}

TEST(Metrics, the_error_of_impact_times_is_measured_where_they_are_comparable) {
  std::vector<Moment> run{moment(0, {contact(0, Side::bottom, 0.5)}, {exact(0, Side::bottom)}),
                          moment(1, {contact(0, Side::bottom, 0.5)}, {exact(0, Side::bottom)}),
                          moment(2, {contact(1, Side::bottom, 0.5)}, {exact(0, Side::bottom)})};
  run[0].judged.first_impact = 0.625;
  run[1].judged.first_impact = 1;
  run[2].judged.first_impact = 1;
  run[0].judged.first_impact_comparable = run[2].judged.first_impact_comparable = true;
  EXPECT_EQ(row_of(run).toi_error_max, 0.125) << "the second is not comparable, the third met something else";
}

TEST(Metrics, rest_jitter_of_an_oscillation_is_its_closed_form) {
  // After settling the character hops between -a and +a: the range is 2a, the root mean square a.
  constexpr double a = 1.0 / 1024;
  std::vector<Moment> run;
  for (int i = 0; i < 130; ++i) {
    Moment one = moment(i, {contact(0, Side::bottom)});
    if (i % 10 == 9) one.step.contacts.clear();
    one.step.grounded = true;
    one.step.path.back().position = i < 30 ? Vec2d(5, 100 - i) : Vec2d(5, i % 2 == 0 ? a : -a);
    run.push_back(one);
  }
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
  std::vector<Moment> run;
  for (int i = 0; i < 100; ++i) {
    Moment one = moment(i, {contact(1, Side::bottom)});
    one.step.grounded = true;
    one.step.movers = {{at(i), at(i + 1)}};
    one.step.requested = {0.25, -1};  // the ride, and gravity
    one.step.path.back().position = at(i + 1) + Vec2d(0, i % 2 == 0 ? 0.125 : 0);
    run.push_back(one);
  }
  EXPECT_EQ(row_of(run, head).rest_peak_to_peak_m, 0.125);
  for (Moment& one : run) one.step.requested.x() = 0.5;
  EXPECT_FALSE(row_of(run, head).rest_peak_to_peak_m) << "it walks on what moves";
}

TEST(Metrics, crushes_are_counted_apart_and_so_is_what_they_press_into) {
  std::vector<Moment> run;
  for (int i = 0; i < 6; ++i) {
    run.push_back(moment(i));
    run.back().step.movers = {{}};
  }
  run[2].judged.crushed = {1};
  run[2].judged.end_overlap = run[2].judged.pressed = {1};
  run[3].judged.crushed_with_room = {1};
  run[3].judged.end_overlap = {0, 1};
  run[3].judged.pressed = {1};
  const Row row = row_of(run);
  EXPECT_EQ(row.crushes, 1);
  EXPECT_EQ(row.crushes_with_room, 1);
  EXPECT_EQ(row.steps_ending_inside, 1) << "in the floor, which pressed nobody";
  for (Moment& one : run) one.step.movers.clear();
  EXPECT_FALSE(row_of(run).crushes) << "nothing moves";
}

TEST(Metrics, sensor_events_and_what_was_made_of_them_are_counted) {
  TraceHeader head = header();
  std::vector<Moment> run{moment(0), moment(1), moment(2)};
  run[0].judged.sensor_events.resize(3);
  run[0].judged.sensor_events_missing = 1;
  run[0].judged.max_sensor_error = 0.25;
  run[1].judged.sensor_events_extra = 2;
  run[2].judged.sensor_events.resize(1);
  run[2].judged.max_sensor_error = 0.125;
  EXPECT_FALSE(row_of(run, head).sensor_events) << "there are no sensors";
  head.scenery.colliders[1].sensor = true;
  const Row row = row_of(run, head);
  EXPECT_EQ(row.sensor_events, 4);
  EXPECT_EQ(row.sensor_errors, 1 + 2);
  EXPECT_EQ(row.max_sensor_error, 0.25);
}

TEST(Metrics, a_rest_needs_sixty_steps_and_the_last_one_counts) {
  const auto rest = [](std::vector<Moment>& run, int steps, double height, double hop) {
    for (int i = 0; i < steps; ++i) {
      Moment one = moment(static_cast<int>(run.size()));
      one.step.grounded = true;
      one.step.path.back().position = {0, height + (i % 2 == 0 ? hop : 0)};
      run.push_back(one);
    }
    run.push_back(moment(static_cast<int>(run.size())));  // in the air
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

TEST(Metrics, ghost_speed_loss_is_the_largest_share_where_motion_was_wanted) {
  std::vector<Moment> run{moment(0), moment(1), moment(2)};
  run[0].judged.ghost_speed_loss = 0.25;
  run[1].judged.ghost_speed_loss = 0.5;
  EXPECT_FALSE(row_of(run).ghost_speed_loss);
  for (Moment& one : run) one.step.requested = {1, 0};
  EXPECT_EQ(row_of(run).ghost_speed_loss, 0.5);
}

class AgreementTest : public testing::Test {
 protected:
  AgreementTest() { reference_header_.contender = "box2d"; }

  Row compare(const std::vector<std::pair<Moment, Moment>>& run) {
    agreement_.emplace(header(), reference_header_, 2);
    for (const auto& [mine, reference] : run) agreement_->add(mine.step, mine.judged, reference.step, reference.judged);
    Row row;
    agreement_->write(row);
    return row;
  }

  TraceHeader reference_header_ = header();
  std::optional<Agreement> agreement_;
};

TEST_F(AgreementTest, is_the_share_of_steps_with_the_same_sides) {
  const auto floor = contact(0, Side::bottom);
  const auto wall = contact(1, Side::left);
  const Row row = compare({{moment(0), moment(0)},
                           {moment(1, {floor}), moment(1, {floor})},
                           {moment(2, {floor, wall}), moment(2, {wall, contact(1, Side::bottom)})},
                           {moment(3, {floor}), moment(3, {floor, wall})},
                           {moment(4), moment(4)}});
  EXPECT_EQ(row.contact_agreement_box2d, 0.8);
  EXPECT_EQ(row.contact_recall_box2d, 1) << "the wall of step 3 was reported one step before";
  EXPECT_EQ(agreement_->disagreements().size(), 1U);
}

TEST_F(AgreementTest, contacts_in_the_references_skin_are_excused) {
  std::vector<std::pair<Moment, Moment>> run{{moment(0), moment(0, {contact(0, Side::bottom)})},
                                             {moment(9, {contact(1, Side::left)}), moment(9)}};
  EXPECT_EQ(compare(run).contact_agreement_box2d, 0);
  run[0].second.judged.dont_care = {0};
  EXPECT_EQ(compare(run).contact_agreement_box2d, 0.5);
  run[0].second.judged.ghosts = {{0, Side::bottom}};
  EXPECT_EQ(compare(run).contact_agreement_box2d, 0) << "a ghost is a difference";
  run[0].second.judged.ghosts.clear();
  run[1].second.judged.dont_care = {1};
  EXPECT_EQ(compare(run).contact_agreement_box2d, 1);
  EXPECT_FALSE(compare(run).contact_precision_box2d) << "nothing is left to be counted";
}

TEST_F(AgreementTest, precision_and_recall_count_sides_within_one_step) {
  const auto floor = contact(0, Side::bottom);
  std::vector<std::pair<Moment, Moment>> run;
  for (int i = 0; i < 8; ++i) run.emplace_back(moment(i), moment(i));
  run[1].first.step.contacts = {floor};   // matched one step later
  run[2].second.step.contacts = {floor};  // matched one step before
  run[5].first.step.contacts = {floor};   // two steps apart: not matched
  run[7].second.step.contacts = {floor};
  const Row row = compare(run);
  EXPECT_EQ(row.contact_precision_box2d, 0.5);
  EXPECT_EQ(row.contact_recall_box2d, 0.5);
}

TEST_F(AgreementTest, exact_arithmetic_says_who_is_right) {
  using Right = SideDisagreement::Right;
  const auto floor = contact(0, Side::bottom);
  const auto truth = exact(0, Side::bottom);
  const auto one = [&](const Moment& mine, const Moment& reference) {
    compare({{mine, reference}});
    return agreement_->disagreements().at(0).right;
  };
  EXPECT_EQ(one(moment(0, {floor}, {truth}), moment(0, {}, {truth})), Right::mine);
  EXPECT_EQ(one(moment(0, {floor}), moment(0)), Right::reference);
  EXPECT_EQ(one(moment(0, {floor}, {truth}), moment(0)), Right::both);
  EXPECT_EQ(one(moment(0, {}, {truth}), moment(0, {contact(0, Side::top)}, {truth})), Right::neither);
  EXPECT_EQ(agreement_->count(Right::neither), 1);
  EXPECT_EQ(agreement_->disagreements()[0].who_is_right,
            "mine reports no contact where exact arithmetic has bottom, box2d reports top where exact arithmetic has "
            "bottom: neither is right");
}

TEST_F(AgreementTest, a_report_one_step_early_is_right_once_the_next_step_is_known) {
  using Right = SideDisagreement::Right;
  const auto floor = contact(0, Side::bottom);
  const auto truth = exact(0, Side::bottom);
  compare({{moment(0, {floor}), moment(0)}});
  EXPECT_EQ(agreement_->disagreements()[0].right, Right::reference);
  compare({{moment(0, {floor}), moment(0)}, {moment(1, {floor}, {truth}), moment(1, {floor}, {truth})}});
  EXPECT_EQ(agreement_->disagreements()[0].right, Right::both);
  EXPECT_EQ(agreement_->count(Right::both), 1);
  EXPECT_EQ(agreement_->count(Right::reference), 0);
}

TEST_F(AgreementTest, keeps_the_first_disagreements_and_counts_all) {
  std::vector<std::pair<Moment, Moment>> run;
  for (int i = 0; i < 6; ++i) run.emplace_back(moment(i, {contact(0, Side::bottom)}), moment(i));
  compare(run);
  ASSERT_EQ(agreement_->disagreements().size(), 2U);
  EXPECT_EQ(agreement_->disagreements()[1].step, 1);
  EXPECT_EQ(agreement_->count(SideDisagreement::Right::reference), 6);
}

TEST_F(AgreementTest, the_first_difference_is_named_with_who_is_right) {
  const auto floor = contact(0, Side::bottom);
  const auto truth = exact(0, Side::bottom);
  Row row = compare({{moment(0), moment(0)}, {moment(1, {floor}, {truth}), moment(1, {}, {truth})}});
  EXPECT_EQ(row.first_difference_box2d_step, 1);
  EXPECT_NE(row.first_difference_box2d.find("mine is right"), std::string::npos) << row.first_difference_box2d;
  row = compare({{moment(0), moment(0)}, {moment(1), moment(1)}});
  EXPECT_FALSE(row.first_difference_box2d_step);
  EXPECT_EQ(row.first_difference_box2d, "");
}

TEST_F(AgreementTest, a_first_difference_on_which_both_are_right_is_followed_by_the_first_on_which_one_is_not) {
  const auto floor = contact(0, Side::bottom);
  const auto truth = exact(0, Side::bottom);
  std::vector<std::pair<Moment, Moment>> run{
      {moment(0, {floor}, {truth}), moment(0)}, {moment(1), moment(1)}, {moment(2), moment(2)}, {moment(3), moment(3)}};
  run[3].first.step.contacts = {floor};
  const Row row = compare(run);
  EXPECT_EQ(row.first_difference_box2d_step, 0);
  EXPECT_NE(row.first_difference_box2d.find("; step 3 is the first on which one is not"), std::string::npos)
      << row.first_difference_box2d;
}

TEST_F(AgreementTest, positions_apart_by_more_than_the_skin_are_a_difference) {
  std::vector<std::pair<Moment, Moment>> run;
  for (int i = 0; i < 5; ++i) run.emplace_back(moment(i), moment(i));
  run[2].second.step.path.back().position = {0.0209, 0};
  EXPECT_FALSE(compare(run).first_difference_box2d_step);
  run[3].second.step.path.back().position = {0.0211, 0};
  EXPECT_EQ(compare(run).first_difference_box2d_step, 3);
  EXPECT_NE(compare(run).first_difference_box2d.find("they respond differently"), std::string::npos);
  run[1].second.judged.tunnelled = {1};
  EXPECT_NE(compare(run).first_difference_box2d.find("mine is right, as box2d passed or entered a solid on step 1"),
            std::string::npos)
      << compare(run).first_difference_box2d;
  run[2].first.judged.end_overlap = run[2].first.judged.entered = {0};
  EXPECT_NE(compare(run).first_difference_box2d.find("neither is right"), std::string::npos);
}

TEST_F(AgreementTest, the_position_difference_is_the_largest_distance_of_the_ends) {
  std::vector<std::pair<Moment, Moment>> run{{moment(0), moment(0)}, {moment(1), moment(1)}};
  run[0].second.step.path.back().position = {3, 4};
  run[1].first.step.path.back().position = {1, 0};
  EXPECT_EQ(compare(run).max_position_difference_box2d_m, 5);
}

}  // namespace
}  // namespace paperproof::compare
