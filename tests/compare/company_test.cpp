/// Several characters, judged from records that are made here.
#include "oracle/company.hpp"
#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

using Way = std::vector<PathPoint>;

constexpr double width = 2 * half_width;
const ExactPair& pair() {
  static const ExactPair octagons(octagon());
  return octagons;
}

TEST(ExactPair, touching_is_no_overlap_and_an_ulp_more_is_one) {
  EXPECT_FALSE(pair().overlap({0, 0}, {width, 0}));
  EXPECT_TRUE(pair().overlap({0x1p-52, 0}, {width, 0}));
  EXPECT_TRUE(pair().overlap({3, 3}, {3, 3}));
  EXPECT_EQ(pair().separation({0, 0}, {2, 0}), 2 - width);
  EXPECT_EQ(pair().separation({2, 0}, {2.25, 0}), 0.25 - width);
  // A way that slides along the other, and one that does not and ends free as well.
  EXPECT_FALSE(pair().meet_between({0, -5}, {width, 0}, {0, 5}, {width, 0}));
  EXPECT_TRUE(pair().meet_between({0x1p-50, -5}, {width, 0}, {0x1p-50, 5}, {width, 0}));
}

TEST(ExactPair, ways_that_cross_meet_only_at_the_same_time) {
  const Way right{{{-2, 0}, 0}, {{2, 0}, 1}};
  // It takes no time at the half of the step: it is looked at from where the other is then.
  const Way leap{{{-3, 0}, 0}, {{-3, 0}, 0.5}, {{3, 0}, 0.5}, {{3, 0}, 1}};
  using Row = std::tuple<const char*, Way, Way, bool>;
  for (const auto& [what, one, other, meet] :
       {Row{"at one time", right, {{{0, -4}, 0}, {{0, 4}, 1}}, true},
        Row{"it was there before", right, {{{0, -4}, 0}, {{0, 4}, 0.125}, {{0, 4}, 1}}, false},
        // At 0.3125 its right side is at -0.4375, and at 0.5 beyond the other's left side at -0.3125.
        Row{"gone", right, {{{0, 0}, 0}, {{0, 0}, 0.25}, {{0, 9}, 0.3125}, {{0, 9}, 1}}, false},
        Row{"not gone", right, {{{0, 0}, 0}, {{0, 0}, 0.5}, {{0, 9}, 0.5625}, {{0, 9}, 1}}, true},
        Row{"a leap over it", leap, {{{0, 0}, 0}, {{0, 0}, 1}}, true},
        Row{"it is at -4 by then", leap, {{{0, 4}, 0}, {{0, -12}, 1}}, false},
        Row{"it is at 0 by then", {{{0, 4}, 0}, {{0, -4}, 1}}, leap, true}})
    EXPECT_EQ(pair().meet(one, other), meet) << what;
}

TEST(ExactPair, the_first_impact_is_distance_over_both_speeds) {
  const auto impact = pair().first_impact({0, 0}, {0.5, 0}, {width + 0.25, 0}, {-0.25, 0}).value();
  EXPECT_EQ(impact.fraction, Rational(1, 3));
  EXPECT_EQ(impact.normal, Vec2d(-1, 0)) << "from the other towards the one";
  EXPECT_FALSE(pair().first_impact({0, 0}, {0.125, 0}, {width + 0.25, 0}, {-0.125, 0})) << "they come to touch";
  EXPECT_FALSE(pair().first_impact({0, 0}, {1, 0}, {0.5, 0}, {0, 0})) << "they overlap already";
}

TEST(ExactPair, the_deepest_place_of_a_passing_is_found_between_the_corners) {
  // Half a width off each other's middle, the shortest way out is the other half.
  for (const auto& [above, depth] : {std::pair{1.25 - 0.1, 0.1}, {3.0, 0.0}})
    EXPECT_NEAR(pair().deepest(Way{{{-3, 0}, 0}, {{3, 0}, 1}}, Way{{{0, above}, 0}, {{0, above}, 1}}), depth, 1e-12);
}

TraceStep resting(const Vec2d& at, const std::optional<Vec2d>& requested = {}) { return step({at, at}, requested); }

/// What two characters do in one step, and what is said of the first one.
class Two {
 public:
  /// @param touch as the contender states it among its tolerances [m]; 0: it states none.
  explicit Two(bool path_exact = true, double touch = 0) : judge_(with_two(path_exact, touch)) {}

  StepJudgement operator()(TraceStep one, TraceStep other, StepJudgement alone = {}) {
    other.character = 1;
    const std::array<TraceStep, 2> steps{std::move(one), std::move(other)};
    judged_ = {std::move(alone), StepJudgement{}};
    judge_.judge(steps, judged_);
    return judged_[0];
  }
  [[nodiscard]] const StepJudgement& other() const { return judged_[1]; }

 private:
  static TraceHeader with_two(bool path_exact, double touch) {
    TraceHeader made = test::header({}, path_exact);
    made.characters = 2;
    if (touch > 0) made.tolerances = {{"touch", touch}};
    return made;
  }
  CompanyJudge judge_;
  std::array<StepJudgement, 2> judged_{};
};

/// What became of another: "inside, entered".
std::string told_of_other(const StepJudgement& judged) {
  const StepJudgement::Company& company = judged.company;
  std::string all;
  for (const auto& [what, characters] : {std::pair{"inside ", &company.overlap},
                                         {"entered ", &company.entered},
                                         {"passed ", &company.passed},
                                         {"corner cut ", &company.corner_cut}}) {
    if (*characters == std::vector<CharacterIndex>{1}) all += what;
  }
  EXPECT_EQ(judged.broke(), company.broke());
  EXPECT_EQ(company.broke(), !company.entered.empty() || !company.passed.empty());
  return all;
}

TEST(CompanyJudge, follows_a_stay_inside_of_another_over_steps) {
  TraceStep put = step({{1, 0}, {2, 0}});
  put.respawn = true;
  const TraceStep enters = step({{-1, 0}, {-0.5, 0}});
  const TraceStep there_and_back = step({{-1, 0}, {-0.5, 0}, {-1, 0}});
  struct Row {
    const char* what;
    std::vector<TraceStep> steps;
    std::vector<const char*> told;
    double above = 0;  ///< Of the other, which rests [m].
    bool path_exact = true;
  };
  const std::vector<Row> rows{
      {"a rim cut by less than the slop", {step({{-2, 0}, {2, 0}})}, {"corner cut "}, 1.246},
      {"by more", {step({{-2, 0}, {2, 0}})}, {"passed "}, 1.244},
      {"an overlap is new once, and its end on the same side no passing",
       {enters, resting({-0.5, 0}), step({{-0.5, 0}, {-1, 0}})},
       {"inside entered ", "inside ", ""}},
      {"its end on another side is one", {enters, step({{-0.5, 0}, {1, 0}})}, {"inside entered ", "passed "}},
      {"who begins inside may leave on any side", {step({{-0.25, 0}, {-1, 0}})}, {""}},
      {"on the other, too", {step({{-0.25, 0}, {1, 0}})}, {""}},
      {"who is put elsewhere passes nobody", {enters, put}, {"inside entered ", ""}},
      {"within a step it passes", {there_and_back}, {"passed "}},
      {"of a sampled path only both ends count", {there_and_back}, {""}, 0, false},
      {"of a sampled path the straight way", {step({{-1, 0}, {1, 0}})}, {"passed "}, 0, false},
  };
  for (const Row& row : rows) {
    Two two(row.path_exact);
    for (std::size_t i = 0; i < row.steps.size(); ++i)
      EXPECT_EQ(told_of_other(two(row.steps[i], resting({0, row.above}))), row.told[i]) << row.what;
  }
  EXPECT_EQ(Two()(enters, resting({0, 0})).max_penetration, 0.125);
  Two two;
  EXPECT_EQ(told_of_other(two(step({{-1, 0}, {1, 0}}), step({{1, 0}, {-1, 0}}))), "passed ");
  EXPECT_FALSE(two.other().broke()) << "it is told once, with the lower of the two";
}

TEST(CompanyJudge, the_first_impact_of_both_is_theirs_unless_scenery_comes_first_or_one_is_stuck) {
  // 0.375 m are between them, and 0.75 m would be gone.
  TraceStep one = step({{0, 0}, {0.0625, 0}}, Vec2d(0.5, 0));
  const TraceStep other = step({{1, 0}, {0.75, 0}}, Vec2d(-0.25, 0));
  Two two;
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
  one.stuck = true;
  EXPECT_FALSE(Two()(one, other).first_impact_comparable) << "it does not go as requested";
  EXPECT_FALSE(Two()(other, one).first_impact_comparable) << "nor that of who comes to it";
}

TEST(CompanyJudge, speed_that_another_takes_is_not_lost_to_nothing) {
  StepJudgement alone;
  alone.ghost_speed_loss = 1;
  for (const auto& [what, at, lost] : {std::tuple{"before it", Vec2d(width + 0.05, 0), 0},
                                       {"too far away", Vec2d(width + 0.15, 0), 1},
                                       {"behind it", Vec2d(-width, 0), 1},
                                       {"below it", Vec2d(0, -1.25), 1}})
    EXPECT_EQ(Two()(resting({0, 0}, Vec2d(0.1, 0)), resting(at), alone).ghost_speed_loss, lost) << what;
}

TEST(CompanyJudge, beside_another_what_scenery_was_met_is_not_told_from_what_was_requested) {
  StepJudgement alone;
  alone.contacts = {{.collider = 0, .side = Side::right}};
  TraceStep one = resting({0, 0});
  one.contacts = {contact(1, {0, 1})};
  // In float it stops farther away.
  for (const auto& [apart, touch, touches] :
       {std::tuple{gap, 0.0, true}, {2e-6, 0.0, false}, {5e-4, 0.0, false}, {5e-4, 7e-4, true}}) {
    const StepJudgement beside = Two(true, touch)(one, resting({width + apart, 0}), alone);
    EXPECT_EQ(beside.contacts.empty(), touches) << apart;
    EXPECT_EQ(beside.dont_care, touches ? Colliders{1} : Colliders{}) << apart;
  }
}

TraceHeader company_of(std::size_t characters, const std::vector<ColliderDef>& solids = {}) {
  TraceHeader made = promising(solids);
  made.characters = characters;
  return made;
}

TEST(CompanyJudge, a_contact_is_none_where_another_turns_the_motion_aside_before) {
  const ExactContact wall{
      .collider = 0, .side = Side::right, .normal = {-1, 0}, .fraction = 0.34, .touched = 0.34, .foreseen = true};
  // Both are touched: the other first, and what it leaves goes straight down.
  const ExactContact near{.collider = 0, .side = Side::right, .normal = {-1, 0}, .fraction = 0, .touched = 1e-6};
  ExactContact into_it = near;
  into_it.normal = {-std::sqrt(0.2), std::sqrt(0.8)};
  ExactContact before = near;
  before.touched = 1e-8;
  const Vec2d beside(width + gap, 0);
  for (const auto& [what, at, contact, asked] : {std::tuple{"it is between", beside, wall, false},
                                                 {"it is behind", -beside, wall, true},
                                                 {"it is above", Vec2d(width + gap, 1.5), wall, true},
                                                 {"it is met first", beside, near, false},
                                                 {"what it leaves leads into it", beside, into_it, true},
                                                 {"it is met before", beside, before, true}}) {
    TraceStep other = resting(at);
    other.character = 1;
    std::array<StepJudgement, 2> judged{};
    judged[0].contacts = {contact};
    CompanyJudge(company_of(2, {box(1, -1, 2, 1)})).judge(std::array{resting({0, 0}, Vec2d(2, -0.5)), other}, judged);
    EXPECT_EQ(!judged[0].contacts.empty(), asked) << what;
  }
}

TEST(CompanyJudge, the_time_of_a_meeting_is_told_from_a_moment_at_which_they_are_near) {
  const CompanyJudge judge(company_of(2));
  const auto off = [&](const TraceStep& one, TraceStep other, const Vec2d& normal, double fraction) {
    other.character = 1;
    return judge.off_at(one, other, {.other = 1, .normal = normal, .fraction = fraction}, std::array{one, other});
  };
  const TraceStep turned_aside = step({{0, 0}, {0, 3}}, Vec2d(0.5, 3));  // at once
  EXPECT_LE(off(turned_aside, resting({width + gap, 0}), {-1, 0}, 1e-6), 5.1e-7) << "it would have touched then";
  EXPECT_NEAR(off(turned_aside, resting({width + gap, 0}), {-1, 0}, 0.5), 0.25, 1e-6);
  TraceStep lands;  // down at once at the end
  lands.path = {{{0, 2}, 0}, {{0, 2}, 1}, {{0, 1.25 + gap}, 1}};
  EXPECT_EQ(off(lands, resting({0, 0}), {0, 1}, 1), 0);
  EXPECT_GT(off(lands, resting({0, 0}), {0, 1}, 0.5), 0.7);
}

TEST(CompanyJudge, two_that_hold_hold_for_as_long_as_they_touch) {
  const TraceHeader three = company_of(3);
  const Vec2d fall(0, -0.1);
  // The one stands with its chamfers on theirs until they go down.
  for (const auto& [gone, falls, hangs] : {std::tuple{0.75, 0.25, false}, {0.0, 0.25, true}, {0.0, 0.75, false}}) {
    std::array<TraceStep, 3> steps;
    steps[0].path = {{{0, 0}, 0}, {{0, 0}, 0.75}, {falls * fall, 1}};
    steps[0].requested = fall;
    steps[0].velocity = fall / dt;
    for (const auto& [who, side] : {std::pair{1U, -1.0}, {2U, 1.0}}) {
      const Vec2d at = side * Vec2d(0.46875 + 1e-7, 0) - Vec2d(0, 0.9375 + 1e-7);
      steps[who].path = {{at, 0}, {at, gone}, {at - Vec2d(0, 2), 1}};
      steps[who].character = who;
    }
    const CompanyJudge company(three);
    const Wanted wanted = wanting(fall);
    EXPECT_EQ(Judge(three).judge(steps[0], company.others_of(0, steps), &wanted).hangs, hangs) << gone << " " << falls;
  }
}

/// The one goes before the other, or after it.
std::array<TraceStep, 2> in_turns(TraceStep one, CharacterIndex turn, TraceStep other) {
  one.turn = turn;
  other.turn = 1 - turn;
  other.character = 1;
  return {std::move(one), std::move(other)};
}

TEST(CompanyJudge, in_turns_each_goes_while_the_other_stands) {
  const TraceStep comes = step({{-2, 0}, {0, 0}});
  const TraceStep through = step({{-2, 0}, {2, 0}});
  const TraceStep leaves = step({{0, 0}, {2, 0}});
  const TraceStep goes_up = step({{0, 0}, {0, 3}});
  const TraceStep falls = step({{0, 3}, {0, 0}});
  using Row = std::tuple<const char*, TraceStep, CharacterIndex, TraceStep, const char*>;
  for (const auto& [what, one, turn, other, told] :
       {Row{"to where the other was", comes, 1, leaves, ""}, Row{"where it still is", comes, 0, leaves, "passed "},
        Row{"through where it was", through, 1, goes_up, ""}, Row{"where it still is", through, 0, goes_up, "passed "},
        Row{"through where it is by then", through, 1, falls, "passed "},
        Row{"where it will be", through, 0, falls, ""}, Row{"to where it ended", comes, 1, falls, "inside entered "},
        Row{"the other goes through where it ended", falls, 0, through, "passed "},
        Row{"the other goes to where it was", leaves, 0, comes, ""},
        Row{"a rim cut by less than the slop", through, 1, resting({0, 1.246}), "corner cut "}}) {
    const auto steps = in_turns(one, turn, other);
    EXPECT_EQ(told_of_other(Two()(steps[0], steps[1])), told) << what;
  }
  EXPECT_EQ(told_of_other(Two()(comes, leaves)), "") << "at the same time";
}

TEST(CompanyJudge, in_turns_another_goes_evenly_where_it_carries_leaves_or_pushes_and_else_stands) {
  const CompanyJudge judge(company_of(2));
  const Vec2d beside(width + gap, 0);
  const Vec2d below(0, -2 * half_height - gap);
  const Vec2d right(0.125, 0);
  const Vec2d up(0, 0.125);
  for (const auto& [what, turn, from, to, begin, end] :
       {std::tuple{"its ground, which rises later", 0U, below, Vec2d(below + up), 0, 1},
        {"its ground, which goes aside later", 0U, below, Vec2d(below + right), 0, 1},
        {"its ground, which has sunk", 1U, below, Vec2d(below - up), 0, 1},
        {"has left", 1U, beside, Vec2d(beside + right), 0, 1},
        {"will leave", 0U, beside, Vec2d(beside + right), 0, 0},
        {"has come near", 1U, Vec2d(beside + right), beside, 1, 1},
        {"will come near", 0U, Vec2d(beside + right), beside, 0, 0},
        {"will come in", 0U, Vec2d(beside + right), Vec2d(beside - right), 0, 1},
        {"above it, and will rise", 0U, Vec2d(-below), Vec2d(up - below), 0, 0}}) {
    TraceStep other = step({from, from + Vec2d(0, -3), to}, Vec2d(9, 9), {contact(0, {0, 1})});
    other.met = {{.other = 0}};
    const auto steps = in_turns(resting({0, 0}), turn, other);
    const std::vector<TraceStep> acting = judge.acting_on(0, steps);
    const TraceStep& acts = acting.at(1);
    EXPECT_EQ(acts.path.front().position, begin == 0 ? from : to) << what;
    EXPECT_EQ(acts.path.back().position, end == 0 ? from : to) << what;
    EXPECT_EQ(acts.path.size(), 2U) << what;
    EXPECT_EQ(acts.requested, acts.path.back().position - acts.path.front().position) << what;
    EXPECT_TRUE(acts.contacts.empty() && acts.met.empty()) << what;
    EXPECT_EQ(acting[0].requested, steps[0].requested) << what;
  }
  EXPECT_TRUE(judge.acting_on(0, std::array{resting({0, 0}), resting(beside)}).empty()) << "at the same time";
}

/// What is said of the first of two that take turns, whose fall is wanted.
StepJudgement judged_in_turns(const std::array<TraceStep, 2>& steps) {
  const TraceHeader two = company_of(2);
  const CompanyJudge company(two);
  const std::vector<TraceStep> acting = company.acting_on(0, steps);
  const Wanted wanted = wanting(steps[0].requested);
  return Judge(two).judge(steps[0], company.others_of(0, steps, acting), &wanted);
}

TEST(CompanyJudge, in_turns_a_fall_ends_at_where_the_other_stands_then) {
  // Both fall, and 0.03 m are between them.
  const Vec2d fall(0, -0.1);
  TraceStep stops = step({{0, 2 * half_height + 0.03}, {0, 2 * half_height + gap}, {0, 2 * half_height + gap}}, fall);
  stops.velocity.setZero();
  const TraceStep below = step({{0, 0}, fall});
  EXPECT_FALSE(judged_in_turns(in_turns(stops, 0, below)).hangs) << "the other falls later";
  EXPECT_TRUE(judged_in_turns(in_turns(stops, 1, below)).hangs) << "it has fallen";
}

TEST(CompanyJudge, in_turns_only_a_head_that_is_stood_on_lifts_before_it_goes) {
  const Vec2d up(0, 0.1);
  const TraceStep head = step({{0, 0}, up});
  for (const auto& [above, lifts] : {std::pair{gap, true}, {0.05, false}}) {
    const Vec2d begin(0, 2 * half_height + above);
    TraceStep rides = step({begin, begin + up}, Vec2d(0, -0.01));
    rides.grounded = lifts;
    const StepJudgement judged = judged_in_turns(in_turns(rides, 0, head));
    EXPECT_EQ(judged.way_gained == 0 && judged.speed_gained == 0, lifts) << above;
    EXPECT_EQ(judged.hangs, !lifts) << above;
    EXPECT_FALSE(judged.ground_refuted) << above;
  }
}

TEST(CompanyJudge, in_turns_there_is_room_where_the_other_is_not_then_and_ground_where_all_have_ended) {
  const CompanyJudge judge(company_of(2));
  const Way there{{{-2, 0}, 0}, {{0, 0}, 1}};
  TraceStep stands = resting({0, 3 + 2 * half_height + gap}, Vec2d(0, -0.01));
  stands.grounded = true;
  for (const CharacterIndex turn : {0U, 1U}) {
    const auto leaves = in_turns(resting({-2, 0}), turn, step({{0, 0}, {0, 3}}));
    EXPECT_EQ(judge.others_of(0, leaves, judge.acting_on(0, leaves)).left_free(there), turn == 1);
    EXPECT_FALSE(judged_in_turns(in_turns(stands, turn, step({{0, 0}, {0, 3}}))).ground_refuted);
    EXPECT_TRUE(judged_in_turns(in_turns(stands, turn, step({{0, 3}, {0, 0}}))).ground_refuted);
  }
}

TEST(CompanyJudge, in_turns_who_is_pushed_need_not_say_so) {
  const CompanyJudge judge(company_of(2));
  const Vec2d left(-0.125, 0);
  for (const auto& [wanted, must] : {std::pair{Vec2d(0, -0.01), false}, {Vec2d(0.01, 0), true}}) {
    const Vec2d beside(width + gap, 0);
    const auto steps = in_turns(step({{0, 0}, left}, wanted), 0, step({beside, beside + left}));
    const std::vector<TraceStep> acting = judge.acting_on(0, steps);
    EXPECT_EQ(judge.must_meet(acting[0], acting[1]), must);
  }
}

}  // namespace
}  // namespace paperproof::compare::test
