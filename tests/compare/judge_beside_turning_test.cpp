/// Progress beside what turns: hanging, ground, ways out, speed and motion that is lost.
#include "compare/turning_planks.hpp"
#include "oracle/intent.hpp"
#include "oracle/later_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

constexpr double gap = 0x1p-21;  // 4.8e-7 m
constexpr double half_height = 0.625;
constexpr double half_width = 0.3125;
constexpr double gravity = 32;                          // [m/s²]
constexpr double fall = gravity * test::dt * test::dt;  // from rest, in a step [m]

/// A step from rest that wants to fall and stays where it is.
Beside staying(const std::vector<Vec2d>& plank, const Vec2d& position, double from, double turn, const Vec2d& at,
               const Vec2d& moved = Vec2d::Zero()) {
  Beside made = beside(plank, position, from, turn, at, moved);
  made.header.gravity = {0, -gravity};
  made.step.requested = {0, -fall};
  made.step.velocity.setZero();
  return made;
}

StepJudgement judged(const Beside& made) { return Judge(made.header).judge(made.step); }

/// What it wanted, if it was at rest.
Wanted from_rest(const Vec2d& carried = Vec2d::Zero()) {
  return {.displacement = carried + Vec2d(0, -fall), .velocity = (carried + Vec2d(0, -fall)) / test::dt};
}

TEST(BesideTurning, a_wall_that_turns_away_holds_nobody) {
  // It touches the right arm, and turns about its lower end.
  const std::vector<Vec2d> wall{{0, -1}, {4, -1}, {4, 0}, {0, 0}};
  const auto beside_it = [&](double turn) {
    return staying(wall, {0, 0}, std::numbers::pi / 2, turn, {half_width + gap, -2});
  };
  for (const double turn : {-1e-2, -1e-4, 0.0}) EXPECT_TRUE(judged(beside_it(turn)).hangs) << turn;
  Beside falls = beside_it(-1e-4);
  falls.step.path.back().position.y() = -0.51 * fall;
  EXPECT_FALSE(judged(falls).hangs);
}

TEST(BesideTurning, ground_that_turns_holds_and_a_steep_face_that_turns_does_not) {
  const std::vector<Vec2d> top{{-1, -0.5}, {1, -0.5}, {1, 0}, {-1, 0}};
  const auto stands_on = [&](double degrees) {
    const double slope = degrees * std::numbers::pi / 180;
    // The right foot touches it, and it turns about that place.
    const Vec2d foot(0.15625, -half_height);
    return staying(top, {0, 0}, slope, 1e-5, foot - gap * turned({0, 1}, slope));
  };
  EXPECT_FALSE(judged(stands_on(30)).hangs);
  EXPECT_FALSE(judged(stands_on(49)).hangs);
  EXPECT_TRUE(judged(stands_on(51)).hangs);
  EXPECT_TRUE(judged(stands_on(60)).hangs);
}

TEST(BesideTurning, who_hangs_unless_another_point_than_the_nearest_holds_it_is_unsure) {
  constexpr double slope = 57 * std::numbers::pi / 180;
  const Vec2d foot(0.15625, -half_height);
  // The octagon's largest extent, from one foot to the opposite shoulder.
  const double extent = Vec2d(2 * 0.15625, 2 * half_height).norm();
  int sure = 0;
  int unsure = 0;
  for (const double turn : {1e-4, 1e-3, 5e-3, 7e-3, 9e-3, 2e-2, 5e-2}) {
    const StepJudgement one = judged(
        staying({{-1, -0.5}, {1, -0.5}, {1, 0}, {-1, 0}}, {0, 0}, slope, turn, foot - gap * turned({0, 1}, slope)));
    // Along the face it falls by fall sin²; a face that comes by b along its normal lifts it by b cos.
    const double comes = turn * (extent + fall);
    const bool falls = fall * std::pow(std::sin(slope), 2) > comes * std::cos(slope);
    EXPECT_EQ(one.hangs, falls) << turn;
    EXPECT_EQ(one.unsure, !falls) << turn;
    sure += falls;
    unsure += !falls;
  }
  EXPECT_GT(sure, 1);
  EXPECT_GT(unsure, 1);
}

TEST(BesideTurning, what_will_run_into_it_may_be_given_way_to) {
  // A plank below that comes up to the feet, or not quite.
  EXPECT_FALSE(judged(staying(plank(2, 0.5), {0, half_height}, 0, 1e-3, {0, -0.52}, {0, 0.1})).hangs);
  EXPECT_TRUE(judged(staying(plank(2, 0.5), {0, half_height}, 0, 1e-3, {0, -0.62}, {0, 0.1})).hangs);
}

/// A plank that turns at once and then rises by 0.01 to the feet, as what is near a character does.
Beside lifted(double apart) {
  Beside made = staying(plank(2, 0.5), {0, half_height + apart}, -0.01, 0.01, {0, -0.51}, {0, 0.01});
  VertexWay& way = made.step.vertex_ways[0];
  way.instants = {0, 0x1p-20, 1};
  std::vector<Vec2d> turned = way.vertices.back();
  for (Vec2d& v : turned) v.y() -= 0.01;
  way.vertices = {way.vertices.front(), turned, way.vertices.back()};
  return made;
}

TEST(BesideTurning, who_says_that_it_stands_on_it_does_so_within_touch) {
  for (const auto& [apart, stands] : {std::pair{gap, true}, {6.9e-7, true}, {9e-7, false}, {3e-6, false}}) {
    Beside made = lifted(apart);
    made.step.grounded = true;
    const Wanted wanted = from_rest();
    const StepJudgement one = Judge(made.header).judge(made.step, {}, &wanted);
    EXPECT_EQ(one.ground_refuted, !stands) << apart;
    EXPECT_FALSE(one.hovers);
  }
}

TEST(BesideTurning, who_stands_on_it_and_says_it_does_not_is_told_so) {
  const Vec2d carried(0, 0.01);
  const auto missed = [&](double speed, const Wanted& wanted, double apart = gap) {
    Beside made = lifted(apart);
    made.step.velocity = {0, speed};
    return Judge(made.header).judge(made.step, {}, &wanted).ground_missed;
  };
  const double with_it = carried.y() / test::dt;
  EXPECT_TRUE(missed(with_it, from_rest(carried)));
  EXPECT_FALSE(missed(with_it + 1, from_rest(carried))) << "it leaves the ground";
  EXPECT_FALSE(missed(with_it, from_rest(carried), 2e-6)) << "it does not touch it";
  Wanted jump = from_rest(carried);
  jump.jumped = true;
  EXPECT_FALSE(missed(with_it, jump));
}

TEST(BesideTurning, what_is_lost_on_it_is_lost_to_nothing) {
  Beside made = staying(plank(2, 0.5), {0, half_height + gap}, 0, -1e-6, {0, -0.5});  // a little downhill
  made.step.requested = {0.05, 0};
  made.step.velocity = {0, 0};
  const StepJudgement one = judged(made);
  EXPECT_NEAR(one.motion_lost, 0.05, 1e-9);
  made.step.contacts = {{.collider = 0, .point = {0, 0}, .normal = {0, 1}, .fraction = 0, .side = Side::bottom}};
  EXPECT_NEAR(judged(made).ghost_speed_loss, 1, 1e-9);
}

TEST(BesideTurning, a_wall_that_turns_opposes_who_runs_into_it) {
  // So far away that it is met, or is not, or may be by another point than the nearest.
  const auto lost = [](double apart, double turn) {
    Beside made = staying(plank(2, 0.5), {0, 0}, std::numbers::pi / 2, turn, {half_width + apart + 0.5, 0});
    made.header.gravity.setZero();
    made.step.requested = {0.1, 0};
    return judged(made);
  };
  EXPECT_EQ(lost(0.05, 1e-6).motion_lost, 0);
  EXPECT_FALSE(lost(0.05, 1e-6).unsure);
  EXPECT_NEAR(lost(0.15, 1e-6).motion_lost, 0.1, 1e-9);
  // Its face comes 0.01 times 0.3125 closer at the height of the arm, and 0.01 times the octagon's extent at most.
  EXPECT_TRUE(lost(0.11, 1e-2).unsure);
  EXPECT_EQ(lost(0.11, 1e-2).motion_lost, 0);
  EXPECT_EQ(lost(0.102, 1e-2).motion_lost, 0);
  EXPECT_FALSE(lost(0.102, 1e-2).unsure);
}

/// A free fall in parts, a tenth of a metre beside a plank that turns.
TEST(BesideTurning, a_fall_in_parts_is_that_of_all_parts) {
  const Vec2d before(1, -2);
  for (const int parts : {1, 2, 8, 32}) {
    Beside made = staying(plank(2, 0.5), {0, 0}, std::numbers::pi / 2, 1e-3, {half_width + 0.6, 0});
    Wanted wanted;
    wanted.parts = parts;
    wanted.velocity = before - Vec2d(0, gravity * test::dt / parts);
    wanted.displacement = wanted.velocity * test::dt;
    made.step.requested = wanted.displacement;
    made.step.velocity = before - Vec2d(0, gravity * test::dt);
    const Vec2d way = before * test::dt - Vec2d(0, fall * (parts + 1) / (2 * parts));
    const auto judge = [&](const Vec2d& made_way) {
      made.step.path.back().position = made_way;
      return Judge(made.header).judge(made.step, {}, &wanted);
    };
    const StepJudgement good = judge(way);
    EXPECT_EQ(good.speed_lost, 0) << parts;
    EXPECT_EQ(good.speed_gained, 0) << parts;
    EXPECT_EQ(good.motion_lost, 0) << parts;
    EXPECT_FALSE(good.hangs) << parts;
    EXPECT_GT(judge(way + Vec2d(0, 1e-6)).speed_lost, 0) << parts;
    EXPECT_GT(judge(way - Vec2d(1e-6, 0)).motion_lost, 0) << parts;
    EXPECT_TRUE(judge(Vec2d::Zero()).hangs) << parts;
    EXPECT_FALSE(judge({0, way.y() * 0.51}).hangs) << parts;
    EXPECT_TRUE(judge({0, way.y() * 0.49}).hangs) << parts;
    made.step.velocity.y() += 1e-6;
    EXPECT_GT(judge(way).speed_lost, 0) << parts;
  }
}

/// Presses the button in the air, and ends a step in four parts as told, on its second corner `way_up` above the first.
/// @return whether the press is still there to jump from ground in the next step.
bool is_press_left(const Contact<double>& contact, double rise, bool grounded, bool jumping, double way_up = -0.1) {
  TraceHeader header = promising({});
  header.gravity = {0, -10};
  header.starts = {{.position = {0, 0}, .velocity = {0, -9}}};
  Intent intent(header);
  TraceStep first = test::step({{0, 0}, {0, -0.1}});
  first.input.jump = true;
  EXPECT_TRUE(intent.begin(first, 4, {}).pending);
  first.contacts = {contact};
  first.path = {{{0, 0}, 0}, {{0, way_up}, 0.5}, {{0, -0.1}, 1}};
  first.velocity = {0, rise};
  first.grounded = grounded;
  first.jumping = jumping;
  intent.end(first);
  if (!grounded) {  // it lands in the next step
    TraceStep landing = test::step({{0, -0.1}, {0, -0.2}});
    landing.input.jump = true;
    static_cast<void>(intent.begin(landing, 1, {}));
    landing.grounded = true;
    intent.end(landing);
  }
  TraceStep after = test::step({{0, -0.2}, {0, -0.2}});
  after.input.jump = true;
  return intent.begin(after, 1, {}).jumped;
}

TEST(PressOfTheButton, is_used_up_by_who_lands_in_a_part_before_the_last_one) {
  const auto ground = [](double fraction) {
    return Contact<double>{.normal = {0, 1}, .fraction = fraction, .side = Side::bottom};
  };
  const Contact<double> steep{.normal = {0.8, 0.6}, .fraction = 0.3, .side = Side::bottom};
  EXPECT_FALSE(is_press_left(ground(0.3), 10, false, true)) << "it rises";
  EXPECT_FALSE(is_press_left(ground(0.3), 0, true, false, 0.05)) << "a ceiling ended the jump, and it landed again";
  EXPECT_TRUE(is_press_left(ground(0.3), 0, true, false)) << "it landed, left the ground and landed again";
  EXPECT_TRUE(is_press_left(ground(0.9), 0, true, false)) << "it landed in the last part";
  EXPECT_TRUE(is_press_left(steep, -2, false, false)) << "it slides";
}

/// Against the law of motion, gone through part by part.
TEST(LaterParts, are_what_the_law_makes_part_by_part) {
  constexpr std::uint64_t seed = 284;
  Random random(seed);
  int limited = 0;
  int steered = 0;
  constexpr int rounds = 2000;
  for (int i = 0; i < rounds; ++i) {
    TraceHeader header = promising({});
    header.gravity = {0, -random.between(1, 40)};
    header.character.acceleration = random.between(10, 100);
    const bool has_limit = random.below(3) == 0;
    if (has_limit) header.character.max_fall_speed = random.between(1, 5);
    TraceStep step = test::step({{0, 0}, {0, 0}});
    const double target = header.character.walk_speed * random.between(-1, 1);
    step.input.move = target / header.character.walk_speed;
    const int parts = 1 << (1 + random.below(5));
    const double part = test::dt / parts;
    Vec2d v(random.between(-6, 6), random.between(-5, 5));
    if (has_limit) v.y() = std::max(v.y(), -*header.character.max_fall_speed);
    if (random.below(3) == 0) v.x() = target;
    Wanted first;
    first.parts = parts;
    Vec2d way = Vec2d::Zero();
    for (int k = 0; k < parts; ++k) {
      const double most = header.character.acceleration * part;
      const double change = std::clamp(target - v.x(), -most, most);
      v += Vec2d(change, header.gravity.y() * part);
      if (has_limit) v.y() = std::max(v.y(), -*header.character.max_fall_speed);
      way += v * part;
      if (k > 0) continue;
      first.velocity = v;
      first.displacement = v * test::dt;
      first.steered = change * test::dt;
      first.walk = v.x();
    }
    const detail::LaterParts later = detail::later_parts(header, step, first);
    const Wanted whole = later.whole(first);
    EXPECT_NEAR(whole.velocity.y(), v.y(), 1e-12) << "seed " << seed << " round " << i;
    EXPECT_NEAR(whole.displacement.y(), way.y(), 1e-12) << "seed " << seed << " round " << i;
    const double faster = v.x() - whole.velocity.x();
    const double farther = way.x() - whole.displacement.x();
    EXPECT_GE(faster, later.slower - 1e-12) << "seed " << seed << " round " << i;
    EXPECT_LE(faster, later.faster + 1e-12) << "seed " << seed << " round " << i;
    EXPECT_GE(farther, -later.steered_way(-later.slower) - 1e-12) << "seed " << seed << " round " << i;
    EXPECT_LE(farther, later.steered_way(later.faster) + 1e-12) << "seed " << seed << " round " << i;
    if (!has_limit) {
      EXPECT_NEAR(whole.displacement.y(),
                  (first.velocity.y() - header.gravity.y() * part) * test::dt +
                      header.gravity.y() * test::dt * test::dt * (parts + 1) / (2 * parts),
                  1e-12);
    }
    limited += has_limit && v.y() == -*header.character.max_fall_speed;
    steered += std::abs(faster) > 1e-3;
  }
  EXPECT_GT(limited, rounds / 20);
  EXPECT_GT(steered, rounds / 20);
  EXPECT_LT(steered, rounds * 19 / 20);
}

TEST(BesideTurning, who_is_stuck_in_what_came_into_it_has_a_way_out_where_there_is_room) {
  Beside made = staying(plank(2, 0.5), {0, half_height}, 0, 1e-3, {0, -0.52}, {0, 0.1});
  made.step.stuck = true;
  EXPECT_TRUE(judged(made).stuck_refuted) << "8 cm up it is free";
  // A ceiling over its head, and a wall on each side, each 10 nm away.
  const double e = 1e-8;
  for (const ColliderDef& wall :
       {box(-3, 2 * half_height + e, 3, 5), box(-3, 0.1, -half_width - e, 5), box(half_width + e, 0.1, 3, 5)}) {
    made.header.scenery.colliders.push_back(wall);
    made.header.ids.push_back(std::to_string(made.header.ids.size()));
  }
  EXPECT_FALSE(judged(made).stuck_refuted);
}

TEST(BesideTurning, a_reported_normal_is_that_of_a_face_that_is_touched) {
  Beside made = lifted(gap);
  made.step.grounded = true;
  const auto error = [&](const Vec2d& normal, Side side) {
    made.step.contacts = {{.collider = 0, .point = {0, 0}, .normal = normal, .fraction = 1, .side = side}};
    const StepJudgement one = judged(made);
    EXPECT_EQ(one.contacts.size(), 1U);
    return one.normal_error.value_or(-1);
  };
  EXPECT_NEAR(error({0, 1}, Side::bottom), 0, 1e-6);
  EXPECT_NEAR(error(turned({0, 1}, 0.1), Side::bottom), 0.1 * 180 / std::numbers::pi, 1e-6);
  EXPECT_NEAR(error({0, -1}, Side::top), 180, 1e-6);
}

/// Beside a wall that turns, 5 cm above a floor, which is collider 1.
Beside above_floor(double wall_apart, const Vec2d& moved) {
  Beside made = staying(plank(2, 0.5), {0, half_height + 0.05}, std::numbers::pi / 2, 1e-6,
                        {half_width + wall_apart + 0.5, 1}, moved);
  made.header.scenery.colliders.push_back(box(-5, -1, 5, 0));
  made.header.ids.push_back("floor");
  made.step.requested = {0, -0.1};
  return made;
}

bool has_contact(const StepJudgement& judged, ColliderIndex collider) {
  return std::any_of(judged.contacts.begin(), judged.contacts.end(),
                     [&](const ExactContact& contact) { return contact.collider == collider; });
}

TEST(BesideTurning, what_is_requested_meets_nothing_after_what_turns) {
  EXPECT_TRUE(has_contact(judged(above_floor(1, {-0.1, 0})), 1)) << "the wall does not come so far";
  // It comes to the arm after 0.2 of the step; the floor would be met after half of it.
  Beside met = above_floor(0.02, {-0.1, 0});
  met.step.path.back().position = {-0.08 - gap, half_height + 0.05};
  const StepJudgement one = judged(met);
  EXPECT_FALSE(has_contact(one, 1));
  EXPECT_TRUE(has_contact(one, 0)) << "which is not reported";
  EXPECT_NEAR(one.first_impact.value_or(0), 0.2, 1e-3);
  EXPECT_FALSE(one.in_parts);
}

TEST(BesideTurning, what_the_first_part_would_meet_in_a_later_one_is_not_asked_for) {
  const auto judge_parts = [](int parts, double requested) {
    Beside made = above_floor(0.3, Vec2d::Zero());
    made.step.requested = {0, -requested};
    Wanted wanted{.displacement = made.step.requested, .velocity = made.step.requested / test::dt};
    wanted.parts = parts;
    return Judge(made.header).judge(made.step, {}, &wanted);
  };
  EXPECT_TRUE(has_contact(judge_parts(1, 0.1), 1)) << "after half of the step";
  EXPECT_FALSE(has_contact(judge_parts(4, 0.1), 1));
  EXPECT_TRUE(judge_parts(4, 0.1).in_parts);
  EXPECT_TRUE(has_contact(judge_parts(4, 0.25), 1)) << "in the first fifth";
  EXPECT_FALSE(judge_parts(4, 0.25).in_parts);
}

TEST(BesideTurning, who_is_pressed_against_the_floor_touches_it) {
  // It wants to jump; a press that turns touches its head, or is far above.
  const auto deflected = [](double above) {
    Beside made = staying(plank(2, 0.5), {0, half_height + gap}, 0, 1e-9, {0, 2 * half_height + gap + above + 0.5});
    made.header.scenery.colliders.push_back(box(-5, -1, 5, 0));
    made.header.ids.push_back("floor");
    made.step.requested = {0, 0.1};
    made.step.contacts = {{.collider = 1, .point = {0, 0}, .normal = {0, 1}, .fraction = 0, .side = Side::bottom}};
    return judged(made).deflected;
  };
  const std::vector<std::pair<ColliderIndex, Side>> pressed{{1, Side::bottom}};
  EXPECT_EQ(deflected(gap), pressed);
  EXPECT_TRUE(deflected(1).empty());
}

TEST(BesideTurning, a_sensor_that_turns_is_counted_where_it_is_overlapped) {
  const auto overlaps = [](double x) {
    Beside made = staying(plank(2, 0.5), {x, 0}, 0, 0.01, {0, 0});
    made.header.scenery.colliders[0].sensor = true;
    return judged(made).turning_sensor;
  };
  EXPECT_TRUE(overlaps(0));
  EXPECT_FALSE(overlaps(5));
}

}  // namespace
}  // namespace paperproof::compare
