/// Several characters, judged from records that are made here.
#include "oracle/company.hpp"
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

using Way = std::vector<PathPoint<double>>;

constexpr double width = 0.625;  // of the octagon
const std::vector<CharacterIndex> nobody{};
const std::vector<CharacterIndex> the_other{1};

ExactPair pair() { return ExactPair(octagon()); }

TEST(ExactPair, touching_is_no_overlap_and_an_ulp_more_is_one) {
  EXPECT_FALSE(pair().overlap({0, 0}, {width, 0}));
  EXPECT_TRUE(pair().overlap({0x1p-52, 0}, {width, 0}));
  EXPECT_TRUE(pair().overlap({3, 3}, {3, 3}));
  EXPECT_EQ(pair().separation({0, 0}, {2, 0}), 2 - width);
  EXPECT_EQ(pair().separation({2, 0}, {2.25, 0}), 0.25 - width);
}

TEST(ExactPair, a_way_that_only_slides_along_the_other_does_not_meet_it) {
  EXPECT_FALSE(pair().meet_between({0, -5}, {width, 0}, {0, 5}, {width, 0}));
  EXPECT_TRUE(pair().meet_between({0x1p-50, -5}, {width, 0}, {0x1p-50, 5}, {width, 0})) << "both ends are free";
}

TEST(ExactPair, ways_that_cross_meet_only_at_the_same_time) {
  const Way right{{{-2, 0}, 0}, {{2, 0}, 1}};
  EXPECT_TRUE(pair().meet(right, Way{{{0, -4}, 0}, {{0, 4}, 1}}));
  EXPECT_FALSE(pair().meet(right, Way{{{0, -4}, 0}, {{0, 4}, 0.125}, {{0, 4}, 1}})) << "it was there before";
  // At 0.3125 its right side is at -0.4375, and at 0.5 beyond the other's left side at -0.3125.
  EXPECT_FALSE(pair().meet(right, Way{{{0, 0}, 0}, {{0, 0}, 0.25}, {{0, 9}, 0.3125}, {{0, 9}, 1}}));
  EXPECT_TRUE(pair().meet(right, Way{{{0, 0}, 0}, {{0, 0}, 0.5}, {{0, 9}, 0.5625}, {{0, 9}, 1}}));
}

TEST(ExactPair, a_part_that_takes_no_time_is_looked_at_from_where_the_other_is_then) {
  const Way jump{{{-3, 0}, 0}, {{-3, 0}, 0.5}, {{3, 0}, 0.5}, {{3, 0}, 1}};
  EXPECT_TRUE(pair().meet(jump, Way{{{0, 0}, 0}, {{0, 0}, 1}}));
  EXPECT_FALSE(pair().meet(jump, Way{{{0, 4}, 0}, {{0, -12}, 1}})) << "it is at -4 by then";
  EXPECT_TRUE(pair().meet(Way{{{0, 4}, 0}, {{0, -4}, 1}}, jump)) << "it is at 0 by then";
}

TEST(ExactPair, the_first_impact_is_distance_over_both_speeds) {
  const auto impact = pair().first_impact({0, 0}, {0.5, 0}, {width + 0.25, 0}, {-0.25, 0});
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, Rational(1, 3));
  EXPECT_EQ(impact->normal, Vec2d(-1, 0)) << "from the other towards the one";
  EXPECT_FALSE(pair().first_impact({0, 0}, {0.125, 0}, {width + 0.25, 0}, {-0.125, 0})) << "they come to touch";
  EXPECT_FALSE(pair().first_impact({0, 0}, {1, 0}, {0.5, 0}, {0, 0})) << "they overlap already";
}

TEST(ExactPair, the_deepest_place_of_a_passing_is_found_between_the_corners) {
  // Through each other's middle: half a width off, so the shortest way out is the other half.
  EXPECT_NEAR(pair().deepest(Way{{{-3, 0}, 0}, {{3, 0}, 1}}, Way{{{0, 1.25 - 0.1}, 0}, {{0, 1.25 - 0.1}, 1}}), 0.1,
              1e-12);
  EXPECT_EQ(pair().deepest(Way{{{-3, 0}, 0}, {{3, 0}, 1}}, Way{{{0, 3}, 0}, {{0, 3}, 1}}), 0);
}

/// What two characters do in one step, and what is said of the first one.
class Two {
 public:
  /// @param touch as the contender states it among its tolerances [m]; 0: it states none.
  explicit Two(bool path_exact = true, double touch = 0) : header_(header({}, path_exact)), judge_(with_two(touch)) {}

  StepJudgement operator()(TraceStep one, TraceStep other, StepJudgement alone = {}) {
    other.character = 1;
    const std::array<TraceStep, 2> steps{std::move(one), std::move(other)};
    judged_ = {std::move(alone), StepJudgement{}};
    judge_.judge(steps, judged_);
    return judged_[0];
  }
  [[nodiscard]] const StepJudgement& other() const { return judged_[1]; }

 private:
  TraceHeader with_two(double touch) {
    header_.characters = 2;
    if (touch > 0) header_.tolerances = {{"touch", touch}};
    return header_;
  }
  TraceHeader header_;
  CompanyJudge judge_;
  std::array<StepJudgement, 2> judged_{};
};

TEST(CompanyJudge, tells_a_passing_once_with_the_lower_of_the_two) {
  Two two;
  const StepJudgement judged = two(step({{-1, 0}, {1, 0}}), step({{1, 0}, {-1, 0}}));
  EXPECT_EQ(judged.company.passed, the_other);
  EXPECT_TRUE(judged.broke());
  EXPECT_FALSE(two.other().broke());
  EXPECT_EQ(judged.company.overlap, nobody);
}

TEST(CompanyJudge, a_rim_that_is_cut_by_no_more_than_the_slop_is_a_corner_cut) {
  EXPECT_EQ(Two()(step({{-2, 0}, {2, 0}}), step({{0, 1.246}, {0, 1.246}})).company.corner_cut, the_other);
  EXPECT_EQ(Two()(step({{-2, 0}, {2, 0}}), step({{0, 1.244}, {0, 1.244}})).company.passed, the_other);
}

TEST(CompanyJudge, an_overlap_is_new_once_and_its_end_on_the_same_side_is_no_passing) {
  Two two;
  const TraceStep rest = step({{0, 0}, {0, 0}});
  StepJudgement judged = two(step({{-1, 0}, {-0.5, 0}}), rest);
  EXPECT_EQ(judged.company.overlap, the_other);
  EXPECT_EQ(judged.company.entered, the_other);
  EXPECT_EQ(judged.max_penetration, 0.125);
  judged = two(step({{-0.5, 0}, {-0.5, 0}}), rest);
  EXPECT_EQ(judged.company.overlap, the_other);
  EXPECT_EQ(judged.company.entered, nobody);
  EXPECT_FALSE(two(step({{-0.5, 0}, {-1, 0}}), rest).company.broke());
}

TEST(CompanyJudge, an_overlap_that_ends_on_another_side_was_a_passing) {
  Two two;
  const TraceStep rest = step({{0, 0}, {0, 0}});
  (void)two(step({{-1, 0}, {-0.25, 0}}), rest);
  EXPECT_EQ(two(step({{-0.25, 0}, {1, 0}}), rest).company.passed, the_other);
}

TEST(CompanyJudge, of_a_sampled_path_only_both_ends_of_the_step_count) {
  const TraceStep there_and_back = step({{-1, 0}, {-0.5, 0}, {-1, 0}});
  const TraceStep rest = step({{0, 0}, {0, 0}});
  EXPECT_EQ(Two()(there_and_back, rest).company.passed, the_other);
  EXPECT_FALSE(Two(false)(there_and_back, rest).broke());
  EXPECT_EQ(Two(false)(step({{-1, 0}, {1, 0}}), rest).company.passed, the_other);
}

TEST(CompanyJudge, who_begins_inside_another_may_leave_on_any_side) {
  for (const double x : {-1.0, 1.0}) {
    const StepJudgement judged = Two()(step({{-0.25, 0}, {x, 0}}), step({{0, 0}, {0, 0}}));
    EXPECT_FALSE(judged.broke()) << x;
  }
}

TEST(CompanyJudge, a_character_that_is_put_elsewhere_does_not_pass_who_is_between) {
  Two two;
  const TraceStep rest = step({{0, 0}, {0, 0}});
  (void)two(step({{-1, 0}, {-0.5, 0}}), rest);
  TraceStep put = step({{1, 0}, {2, 0}});
  put.respawn = true;
  EXPECT_FALSE(two(put, rest).broke());
}

TEST(CompanyJudge, the_first_impact_of_both_is_theirs_unless_scenery_comes_first) {
  Two two;
  TraceStep one = step({{0, 0}, {0.0625, 0}});
  one.requested = {0.5, 0};
  TraceStep other = step({{1, 0}, {0.75, 0}});
  other.requested = {-0.25, 0};
  // 0.375 m are between them, and 0.75 m would be gone.
  StepJudgement judged = two(one, other);
  EXPECT_EQ(judged.first_impact, 0.5);
  EXPECT_EQ(judged.first_met, CharacterIndex{1});
  EXPECT_TRUE(judged.first_impact_comparable);
  EXPECT_EQ(two.other().first_met, CharacterIndex{0});
  StepJudgement alone;
  alone.first_impact = 0.25;
  alone.first_impact_comparable = true;
  judged = Two()(one, other, alone);
  EXPECT_EQ(judged.first_impact, 0.25);
  EXPECT_FALSE(judged.first_met);
}

TEST(CompanyJudge, who_is_stuck_does_not_go_as_requested_so_that_no_first_impact_is_comparable) {
  TraceStep one = step({{0, 0}, {0, 0}});
  one.requested = {0.5, 0};
  one.stuck = true;
  TraceStep other = step({{1, 0}, {0.75, 0}});
  other.requested = {-0.5, 0};
  EXPECT_FALSE(Two()(one, other).first_impact_comparable);
  EXPECT_FALSE(Two()(other, one).first_impact_comparable) << "nor that of who comes to it";
  one.stuck = false;
  EXPECT_TRUE(Two()(one, other).first_impact_comparable);
}

TEST(CompanyJudge, speed_that_another_takes_is_not_lost_to_nothing) {
  StepJudgement alone;
  alone.ghost_speed_loss = 1;
  TraceStep one = step({{0, 0}, {0, 0}});
  one.requested = {0.1, 0};
  EXPECT_EQ(Two()(one, step({{width + 0.05, 0}, {width + 0.05, 0}}), alone).ghost_speed_loss, 0);
  EXPECT_EQ(Two()(one, step({{width + 0.15, 0}, {width + 0.15, 0}}), alone).ghost_speed_loss, 1) << "too far away";
  EXPECT_EQ(Two()(one, step({{-width, 0}, {-width, 0}}), alone).ghost_speed_loss, 1) << "behind it";
  EXPECT_EQ(Two()(one, step({{0, -1.25}, {0, -1.25}}), alone).ghost_speed_loss, 1) << "below it";
}

TEST(CompanyJudge, beside_another_what_scenery_was_met_is_not_told_from_what_was_requested) {
  StepJudgement alone;
  alone.contacts = {{.collider = 0, .side = Side::right}};
  TraceStep one = step({{0, 0}, {0, 0}});
  one.contacts = {{.collider = 1, .side = Side::bottom}};
  const StepJudgement beside = Two()(one, step({{width + 5e-7, 0}, {width + 5e-7, 0}}), alone);
  EXPECT_TRUE(beside.contacts.empty());
  EXPECT_EQ(beside.dont_care, std::vector<ColliderIndex>{1});
  const StepJudgement apart = Two()(one, step({{width + 2e-6, 0}, {width + 2e-6, 0}}), alone);
  EXPECT_EQ(apart.contacts.size(), 1U);
  EXPECT_TRUE(apart.dont_care.empty());
  const Vec2d in_float(width + 5e-4, 0);
  EXPECT_TRUE(Two(true, 7e-4)(one, step({in_float, in_float}), alone).contacts.empty()) << "it stops there";
}

TEST(CompanyJudge, a_contact_is_none_where_another_turns_the_motion_aside_before) {
  TraceHeader header = promising({box(1, -1, 2, 1)});
  header.characters = 2;
  TraceStep one = step({{0, 0}, {0, 0}});
  one.requested = {2, -0.5};
  const auto asked = [&](const Vec2d& at, const ExactContact& contact) {
    TraceStep other = step({at, at});
    other.character = 1;
    std::array<StepJudgement, 2> judged{};
    judged[0].contacts = {contact};
    CompanyJudge(header).judge(std::array{one, other}, judged);
    return !judged[0].contacts.empty();
  };
  const ExactContact wall{
      .collider = 0, .side = Side::right, .normal = {-1, 0}, .fraction = 0.34, .touched = 0.34, .foreseen = true};
  EXPECT_FALSE(asked({width + 5e-7, 0}, wall)) << "it is between";
  EXPECT_TRUE(asked({-width - 5e-7, 0}, wall)) << "it is behind";
  EXPECT_TRUE(asked({width + 5e-7, 1.5}, wall)) << "it is above";
  // Both are touched: the other first, and what it leaves goes straight down.
  ExactContact near{.collider = 0, .side = Side::right, .normal = {-1, 0}, .fraction = 0, .touched = 1e-6};
  EXPECT_FALSE(asked({width + 5e-7, 0}, near));
  near.normal = {-std::sqrt(0.2), std::sqrt(0.8)};
  EXPECT_TRUE(asked({width + 5e-7, 0}, near)) << "that leads into it";
  near.normal = {-1, 0};
  near.touched = 1e-8;
  EXPECT_TRUE(asked({width + 5e-7, 0}, near)) << "it is met before";
}

TEST(CompanyJudge, the_time_of_a_meeting_is_told_from_a_moment_at_which_they_are_near) {
  TraceHeader header = promising({});
  header.characters = 2;
  const CompanyJudge judge(header);
  TraceStep one = step({{0, 0}, {0, 3}});  // turned aside at once
  one.requested = {0.5, 3};
  TraceStep other = step({{width + 5e-7, 0}, {width + 5e-7, 0}});
  other.character = 1;
  const auto off = [&](double fraction) {
    return judge.off_at(one, other, {.other = 1, .normal = {-1, 0}, .fraction = fraction}, std::array{one, other});
  };
  EXPECT_LE(off(1e-6), 5.1e-7) << "it would have touched then";
  EXPECT_NEAR(off(0.5), 0.25, 1e-6);
  // Down at once at the end.
  TraceStep lands;
  lands.path = {{{0, 2}, 0}, {{0, 2}, 1}, {{0, 1.25 + 5e-7}, 1}};
  TraceStep stands = step({{0, 0}, {0, 0}});
  stands.character = 1;
  const std::array both{lands, stands};
  EXPECT_EQ(judge.off_at(lands, stands, {.other = 1, .normal = {0, 1}, .fraction = 1}, both), 0);
  EXPECT_GT(judge.off_at(lands, stands, {.other = 1, .normal = {0, 1}, .fraction = 0.5}, both), 0.7);
}

TEST(CompanyJudge, two_that_hold_hold_for_as_long_as_they_touch) {
  TraceHeader header = promising({});
  header.characters = 3;
  constexpr double fall = 0.1;
  // The one stands with its chamfers on theirs until they go down.
  const auto hangs = [&](double gone, double falls) {
    std::array<TraceStep, 3> steps;
    steps[0].path = {{{0, 0}, 0}, {{0, 0}, 0.75}, {{0, -falls}, 1}};
    steps[0].requested = {0, -fall};
    for (const auto& [who, side] : {std::pair{1U, -1.0}, {2U, 1.0}}) {
      const Vec2d at = side * Vec2d(0.46875 + 1e-7, 0) - Vec2d(0, 0.9375 + 1e-7);
      steps[who].path = {{at, 0}, {at, gone}, {at - Vec2d(0, 2), 1}};
      steps[who].character = who;
    }
    const CompanyJudge company(header);
    Wanted wanted;
    wanted.displacement = steps[0].requested;
    wanted.velocity = wanted.displacement / dt;
    steps[0].velocity = wanted.velocity;
    return Judge(header).judge(steps[0], company.others_of(0, steps), &wanted).hangs;
  };
  EXPECT_FALSE(hangs(0.75, 0.25 * fall));
  EXPECT_TRUE(hangs(0, 0.25 * fall)) << "they were gone";
  EXPECT_FALSE(hangs(0, 0.75 * fall));
}

}  // namespace
}  // namespace paperproof::compare::test
