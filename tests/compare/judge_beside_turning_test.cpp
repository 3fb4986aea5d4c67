/// Progress beside what turns: hanging, ground, ways out, speed and motion that is lost.
#include "compare/turning_planks.hpp"
#include "oracle/intent.hpp"
#include "oracle/later_parts.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

constexpr double gap = 0x1p-21;                         // 4.8e-7 m
constexpr double gravity = 32;                          // [m/s²]
constexpr double fall = gravity * test::dt * test::dt;  // from rest, in a step [m]
const Vec2d at_origin(0, 0);

/// A step from rest that wants to fall and stays where it is.
Beside staying(const std::vector<Vec2d>& plank, const Vec2d& position, double from, double turn, const Vec2d& at,
               const Vec2d& moved = {0, 0}) {
  Beside made = beside(plank, position, from, turn, at, moved);
  made.header.gravity = {0, -gravity};
  made.step.requested = {0, -fall};
  made.step.velocity.setZero();
  return made;
}

StepJudgement judged(const Beside& made) { return test::judged(made.header, made.step); }
StepJudgement judged(const Beside& made, const Wanted& wanted) { return test::judged(made.header, made.step, wanted); }

/// A plank whose top the right foot touches, about which place it turns.
Beside on_slope(double degrees, double turn) {
  const Vec2d foot(0.15625, -half_height);
  const double slope = degrees * degree;
  return staying(box(-1, -0.5, 1, 0).points, at_origin, slope, turn, foot - gap * turned({0, 1}, slope));
}

/// A plank below that rises by 0.1.
Beside rising(double from) { return staying(plank(2, 0.5), {0, half_height}, 0, 1e-3, {0, from}, {0, 0.1}); }

/// A wall to the right, so far from the arm.
Beside at_wall(double apart, double turn) {
  return staying(plank(2, 0.5), at_origin, 90 * degree, turn, {half_width + apart + 0.5, 0});
}

TEST(BesideTurning, what_turns_away_or_is_steep_or_stays_below_holds_nobody) {
  for (const auto& [degrees, hangs] : {std::pair{30.0, false}, {49.0, false}, {51.0, true}, {60.0, true}})
    EXPECT_EQ(judged(on_slope(degrees, 1e-5)).hangs, hangs) << degrees;
  // What will run into it may be given way to: a plank comes up to the feet, or not quite.
  EXPECT_FALSE(judged(rising(-0.52)).hangs);
  EXPECT_TRUE(judged(rising(-0.62)).hangs);
  // A wall touches the right arm, and turns about its lower end.
  for (const double turn : {-1e-2, -1e-4, 0.0}) {
    Beside wall = staying(box(0, -1, 4, 0).points, at_origin, 90 * degree, turn, {half_width + gap, -2});
    EXPECT_TRUE(judged(wall).hangs) << turn;
    wall.step.path.back().position.y() = -0.51 * fall;
    EXPECT_FALSE(judged(wall).hangs) << turn;
  }
}

TEST(BesideTurning, who_hangs_unless_another_point_than_the_nearest_holds_it_is_unsure) {
  // The octagon's largest extent, from one foot to the opposite shoulder.
  const double extent = Vec2d(2 * 0.15625, 2 * half_height).norm();
  int sure = 0;
  constexpr std::array turns{1e-4, 1e-3, 5e-3, 7e-3, 9e-3, 2e-2, 5e-2};
  for (const double turn : turns) {
    const StepJudgement one = judged(on_slope(57, turn));
    // Along the face it falls by fall sin²; a face that comes by b along its normal lifts it by b cos.
    const double comes = turn * (extent + fall);
    const bool falls = fall * std::pow(std::sin(57 * degree), 2) > comes * std::cos(57 * degree);
    EXPECT_EQ(one.hangs, falls) << turn;
    EXPECT_EQ(one.unsure, !falls) << turn;
    sure += falls;
  }
  EXPECT_GT(sure, 1);
  EXPECT_LT(sure, std::ssize(turns) - 1);
}

/// A plank that turns at once and then rises by 0.01 to the feet, as what is near a character does.
Beside lifted(double apart) {
  Beside made = staying(plank(2, 0.5), {0, half_height + apart}, -0.01, 0.01, {0, -0.51}, {0, 0.01});
  VertexWay& way = made.step.vertex_ways[0];
  way.instants = {0, 0x1p-20, 1};
  way.vertices = {way.vertices.front(), placed(way.vertices.back(), {0, -0.01}, 0), way.vertices.back()};
  return made;
}

TEST(BesideTurning, who_stands_on_it_says_so_and_nobody_else) {
  for (const auto& [apart, stands] : {std::pair{gap, true}, {6.9e-7, true}, {9e-7, false}, {3e-6, false}}) {
    Beside made = lifted(apart);
    made.step.grounded = true;
    EXPECT_EQ(judged(made, wanting({0, -fall})).ground_refuted, !stands) << apart;
    EXPECT_FALSE(judged(made, wanting({0, -fall})).hovers);
  }
  const double with_it = 0.01 / test::dt;
  for (const auto& [what, apart, speed, jumps, missed] : {std::tuple{"it stands", gap, with_it, false, true},
                                                          {"it leaves the ground", gap, with_it + 1, false, false},
                                                          {"it does not touch it", 2e-6, with_it, false, false},
                                                          {"it jumps", gap, with_it, true, false}}) {
    Beside made = lifted(apart);
    made.step.velocity = {0, speed};
    Wanted wanted = wanting({0, 0.01 - fall});
    wanted.jumped = jumps;
    EXPECT_EQ(judged(made, wanted).ground_missed, missed) << what;
  }
}

TEST(BesideTurning, a_reported_normal_is_that_of_a_face_that_is_touched) {
  Beside made = lifted(gap);
  made.step.grounded = true;
  for (const double off : {0.0, 0.1, 180 * degree}) {
    made.step.contacts = {contact(0, turned({0, 1}, off), 1)};
    EXPECT_EQ(judged(made).contacts.size(), 1U);
    EXPECT_NEAR(judged(made).normal_error.value_or(-1), off / degree, 1e-6);
  }
}

TEST(BesideTurning, what_is_lost_is_lost_to_nothing_unless_a_wall_opposes_it) {
  Beside made = staying(plank(2, 0.5), {0, half_height + gap}, 0, -1e-6, {0, -0.5});  // a little downhill
  made.step.requested = {0.05, 0};
  EXPECT_NEAR(judged(made).motion_lost, 0.05, 1e-9);
  made.step.contacts = {contact(0, {0, 1})};
  EXPECT_NEAR(judged(made).ghost_speed_loss, 1, 1e-9);
  // A wall is so far away that it is met, or is not, or may be by another point than the nearest: its face comes 0.01
  // times 0.3125 closer at the height of the arm, and 0.01 times the octagon's extent at most.
  for (const auto& [apart, turn, lost, unsure] : {std::tuple{0.05, 1e-6, 0.0, false},
                                                  {0.15, 1e-6, 0.1, false},
                                                  {0.11, 1e-2, 0.0, true},
                                                  {0.102, 1e-2, 0.0, false}}) {
    Beside runs = at_wall(apart, turn);
    runs.header.gravity.setZero();
    runs.step.requested = {0.1, 0};
    EXPECT_NEAR(judged(runs).motion_lost, lost, 1e-9) << apart;
    EXPECT_EQ(judged(runs).unsure, unsure) << apart;
  }
}

/// A free fall in parts, a tenth of a metre beside a plank that turns.
TEST(BesideTurning, a_fall_in_parts_is_that_of_all_parts) {
  const Vec2d before(1, -2);
  for (const int parts : {1, 2, 8, 32}) {
    SCOPED_TRACE(parts);
    Beside made = at_wall(0.1, 1e-3);
    Wanted wanted = wanting((before - Vec2d(0, gravity * test::dt / parts)) * test::dt);
    wanted.parts = parts;
    made.step.requested = wanted.displacement;
    made.step.velocity = before - Vec2d(0, gravity * test::dt);
    const Vec2d way = before * test::dt - Vec2d(0, fall * (parts + 1) / (2 * parts));
    const auto judge = [&](const Vec2d& made_way) {
      made.step.path.back().position = made_way;
      return judged(made, wanted);
    };
    const StepJudgement good = judge(way);
    EXPECT_EQ(good.speed_lost, 0);
    EXPECT_EQ(good.speed_gained, 0);
    EXPECT_EQ(good.motion_lost, 0);
    EXPECT_FALSE(good.hangs);
    EXPECT_GT(judge(way + Vec2d(0, 1e-6)).speed_lost, 0);
    EXPECT_GT(judge(way - Vec2d(1e-6, 0)).motion_lost, 0);
    for (const auto& [share, hangs] : {std::pair{0.0, true}, {0.49, true}, {0.51, false}})
      EXPECT_EQ(judge({0, way.y() * share}).hangs, hangs) << share;
    made.step.velocity.y() += 1e-6;
    EXPECT_GT(judge(way).speed_lost, 0);
  }
}

/// Presses the button in the air, and ends a step in four parts as told, on its second corner `way_up` above the first.
/// @return whether the press is still there to jump from ground in the next step.
bool is_press_left(const Contact& contact, double rise, bool grounded, bool jumping, double way_up = -0.1) {
  TraceHeader header = promising({});
  header.gravity = {0, -10};
  header.starts = {{.position = {0, 0}, .velocity = {0, -9}}};
  Intent intent(header);
  TraceStep first = test::step({{0, 0}, {0, way_up}, {0, -0.1}}, {}, {contact});
  first.input.jump = true;
  EXPECT_TRUE(intent.begin(first, 4, {}).pending);
  first.velocity = {0, rise};
  first.grounded = grounded;
  first.jumping = jumping;
  intent.end(first);
  TraceStep after = test::step({{0, -0.1}, {0, -0.2}});
  after.input.jump = true;
  if (!grounded) {  // it lands in the next step
    static_cast<void>(intent.begin(after, 1, {}));
    after.grounded = true;
    intent.end(after);
  }
  return intent.begin(after, 1, {}).jumped;
}

TEST(PressOfTheButton, is_used_up_by_who_lands_in_a_part_before_the_last_one) {
  const Contact ground = contact(0, {0, 1}, 0.3);
  Contact steep = contact(0, {0.8, 0.6}, 0.3);
  steep.side = Side::bottom;
  EXPECT_FALSE(is_press_left(ground, 10, false, true)) << "it rises";
  EXPECT_FALSE(is_press_left(ground, 0, true, false, 0.05)) << "a ceiling ended the jump, and it landed again";
  EXPECT_TRUE(is_press_left(ground, 0, true, false)) << "it landed, left the ground and landed again";
  EXPECT_TRUE(is_press_left(contact(0, {0, 1}, 0.9), 0, true, false)) << "it landed in the last part";
  EXPECT_TRUE(is_press_left(steep, -2, false, false)) << "it slides";
}

/// Against the law of motion, gone through part by part.
TEST(LaterParts, are_what_the_law_makes_part_by_part) {
  Random random(284);
  int limited = 0;
  int steered = 0;
  constexpr int rounds = 2000;
  for (int i = 0; i < rounds; ++i) {
    SCOPED_TRACE("round " + std::to_string(i));
    TraceHeader header = promising({});
    header.gravity = {0, -random.between(1, 40)};
    header.character.acceleration = random.between(10, 100);
    const double fastest = random.below(3) == 0 ? random.between(1, 5) : std::numeric_limits<double>::infinity();
    if (std::isfinite(fastest)) header.character.max_fall_speed = fastest;
    TraceStep step = test::step({{0, 0}, {0, 0}});
    const double target = header.character.walk_speed * random.between(-1, 1);
    step.input.move = target / header.character.walk_speed;
    const int parts = 1 << (1 + random.below(5));
    const double part = test::dt / parts;
    Vec2d v{random.between(-6, 6), std::max(random.between(-5, 5), -fastest)};
    if (random.below(3) == 0) v.x() = target;
    Wanted first;
    Vec2d way = Vec2d::Zero();
    for (int k = 0; k < parts; ++k) {
      const double most = header.character.acceleration * part;
      const double change = std::clamp(target - v.x(), -most, most);
      v += Vec2d(change, header.gravity.y() * part);
      v.y() = std::max(v.y(), -fastest);
      way += v * part;
      if (k > 0) continue;
      first = wanting(v * test::dt);
      first.parts = parts;
      first.steered = change * test::dt;
      first.walk = v.x();
    }
    const detail::LaterParts later = detail::later_parts(header, step, first);
    const Wanted whole = later.whole(first);
    EXPECT_NEAR(whole.velocity.y(), v.y(), 1e-12);
    EXPECT_NEAR(whole.displacement.y(), way.y(), 1e-12);
    const double faster = v.x() - whole.velocity.x();
    const double farther = way.x() - whole.displacement.x();
    EXPECT_GE(faster, later.slower - 1e-12);
    EXPECT_LE(faster, later.faster + 1e-12);
    EXPECT_GE(farther, -later.steered_way(-later.slower) - 1e-12);
    EXPECT_LE(farther, later.steered_way(later.faster) + 1e-12);
    limited += v.y() == -fastest;
    steered += std::abs(faster) > 1e-3;
  }
  EXPECT_GT(limited, rounds / 20);
  EXPECT_NEAR(steered, 0.5 * rounds, 0.45 * rounds);
}

TEST(BesideTurning, who_is_stuck_in_what_came_into_it_has_a_way_out_where_there_is_room) {
  Beside made = rising(-0.52);
  made.step.stuck = true;
  EXPECT_TRUE(judged(made).stuck_refuted) << "8 cm up it is free";
  // A ceiling over its head, and a wall on each side, each 10 nm away.
  const double e = 1e-8;
  add(made.header, box(-3, 2 * half_height + e, 3, 5));
  add(made.header, box(-3, 0.1, -half_width - e, 5));
  add(made.header, box(half_width + e, 0.1, 3, 5));
  EXPECT_FALSE(judged(made).stuck_refuted);
}

/// Beside a wall that turns, 5 cm above a floor, which is collider 1.
Beside above_floor(double wall_apart, const Vec2d& moved, double requested) {
  Beside made =
      staying(plank(2, 0.5), {0, half_height + 0.05}, 90 * degree, 1e-6, {half_width + wall_apart + 0.5, 1}, moved);
  add(made.header, box(-5, -1, 5, 0));
  made.step.requested = {0, -requested};
  return made;
}

bool has_contact(const StepJudgement& judged, ColliderIndex collider) {
  return std::ranges::count(judged.contacts, collider, &ExactContact::collider) > 0;
}

TEST(BesideTurning, what_is_requested_meets_nothing_after_what_turns_nor_in_a_later_part) {
  EXPECT_TRUE(has_contact(judged(above_floor(1, {-0.1, 0}, 0.1)), 1)) << "the wall does not come so far";
  // It comes to the arm after 0.2 of the step; the floor would be met after half of it.
  Beside met = above_floor(0.02, {-0.1, 0}, 0.1);
  met.step.path.back().position = {-0.08 - gap, half_height + 0.05};
  const StepJudgement one = judged(met);
  EXPECT_FALSE(has_contact(one, 1));
  EXPECT_TRUE(has_contact(one, 0)) << "which is not reported";
  EXPECT_NEAR(one.first_impact.value_or(0), 0.2, 1e-3);
  EXPECT_FALSE(one.in_parts);
  // The floor is met after half of the step, or in the first fifth.
  for (const auto& [parts, requested, later] : {std::tuple{1, 0.1, false}, {4, 0.1, true}, {4, 0.25, false}}) {
    const Beside made = above_floor(0.3, at_origin, requested);
    Wanted wanted = wanting(made.step.requested);
    wanted.parts = parts;
    EXPECT_EQ(has_contact(judged(made, wanted), 1), !later);
    EXPECT_EQ(judged(made, wanted).in_parts, later);
  }
}

TEST(BesideTurning, who_is_pressed_against_the_floor_touches_it) {
  // It wants to jump; a press that turns touches its head, or is far above.
  for (const double above : {gap, 1.0}) {
    Beside made = staying(plank(2, 0.5), {0, half_height + gap}, 0, 1e-9, {0, 2 * half_height + gap + above + 0.5});
    add(made.header, box(-5, -1, 5, 0));
    made.step.requested = {0, 0.1};
    made.step.contacts = {contact(1, {0, 1})};
    EXPECT_EQ(judged(made).deflected, above < 1 ? (Touches{{1, Side::bottom}}) : Touches{});
  }
}

TEST(BesideTurning, a_sensor_that_turns_is_counted_where_it_is_overlapped) {
  for (const double x : {0.0, 5.0}) {
    Beside made = staying(plank(2, 0.5), {x, 0}, 0, 0.01, at_origin);
    made.header.scenery.colliders[0].sensor = true;
    EXPECT_EQ(judged(made).turning_sensor, x < 1);
  }
}

}  // namespace
}  // namespace paperproof::compare::test
