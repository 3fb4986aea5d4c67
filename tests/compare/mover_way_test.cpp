/// Scripts of movers by exact arithmetic, and ways that hold to them or do not.
#include "oracle/mover_way.hpp"

#include "compare/turning_planks.hpp"
#include "scenes/mover.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

using Loop = MoverScript::Loop;
using Movers = std::vector<MoverIndex>;

/// Between two entries in rationals, of a path that is run through once.
Rational exact_value(const std::vector<MoverScript::Turn>& turns, const Rational& time) {
  std::size_t i = 1;
  while (i + 1 < turns.size() && time > Rational(turns[i].time)) ++i;
  const Rational begin(turns[i - 1].time);
  const Rational end(turns[i].time);
  const Rational at(turns[i - 1].at);
  return at + std::clamp<Rational>((time - begin) / (end - begin), 0, 1) * (Rational(turns[i].at) - at);
}

/// What contenders are given of it comes to the same bits by arithmetic of its own.
MoverPose pose_of(const MoverScript& script, double time) {
  const MoverDef given{.id = "given", .path = script.path, .loop = script.loop, .turns = script.turns};
  MoverPose pose = pose_at(script, time);
  EXPECT_EQ(offset_at(given, time), pose.offset) << time;
  EXPECT_EQ(angle_at(given, time), pose.angle) << time;
  return pose;
}

TEST(MoverScript, is_linear_between_entries_to_a_few_roundings) {
  Random random(280);
  int between = 0;
  constexpr int rounds = 4000;
  for (int i = 0; i < rounds; ++i) {
    const auto loop = static_cast<Loop>(random.below(3));
    MoverScript script{.colliders = {0}, .path = {}, .loop = loop};
    double begin = random.below(2) == 0 ? 0 : random.between(0, 0.5);
    for (int k = 0; k < 4; ++k, begin += random.between(0.01, 1)) {
      script.path.push_back({begin, random.point(3)});
      script.turns.push_back({begin, random.between(-4, 4)});
    }
    const Rational first(script.turns.front().time);
    const Rational length = Rational(script.turns.back().time) - first;
    const double time = random.below(8) == 0 ? script.turns[2].time : random.between(-0.5, 6);
    // What is behind in whole runs, and where in a run that is.
    Rational rest = Rational(time) - first;
    Rational runs = 0;
    if (rest > 0 && loop != Loop::once) {
      const Rational period = loop == Loop::loop ? length : Rational(2 * length);
      const Rational share = rest / period;
      runs = Rational(numerator(share) / denominator(share));  // the integer below
      rest -= runs * period;
      if (loop == Loop::ping_pong) runs = 0;
      if (loop == Loop::ping_pong && rest > length) rest = 2 * length - rest;
    }
    const Rational whole = Rational(script.turns.back().at) - Rational(script.turns.front().at);
    const Rational exact = exact_value(script.turns, first + rest) + runs * whole;
    // Times of 6 s have 2^-51 in their last place, angles change by 8 rad in 0.01 s at most.
    const double steepest = 8 / 0.01;
    EXPECT_NEAR(pose_of(script, time).angle, static_cast<double>(exact), 8 * 0x1p-53 * (6 * steepest + 100))
        << "round " << i;
    between += rest > 0 && rest < length;
  }
  EXPECT_GE(between, rounds * 3 / 10);
}

TEST(MoverScript, is_exactly_its_entries_at_their_times_in_every_run) {
  MoverScript script{.colliders = {0}, .path = {{0, {0, 0}}, {0.25, {0.1, 0.7}}, {0.75, {0, 0}}}, .loop = Loop::loop};
  script.turns = {{0, 0}, {0.25, 0.3}, {0.75, 0.5}};
  for (const int run : {0, 1, 2, 3, 100, 1'000'000}) {
    const MoverPose pose = pose_of(script, 0.75 * run + 0.25);
    EXPECT_EQ(pose.offset, Vec2d(0.1, 0.7));
    EXPECT_EQ(pose.angle, 0.3 + run * 0.5) << "angles go on";
  }
  script.loop = Loop::ping_pong;
  EXPECT_EQ(pose_of(script, 1.25).offset, Vec2d(0.1, 0.7)) << "on the way back";
  script.loop = Loop::once;
  EXPECT_EQ(pose_of(script, 9).angle, 0.5);
  script = {.colliders = {0}, .path = {{1, {4, 5}}}, .loop = Loop::loop};
  EXPECT_EQ(pose_of(script, 7.25).offset, Vec2d(4, 5)) << "parked";
}

/// A plank that turns about a place 1 m beside a character, and goes along.
class Plank : public testing::Test {
 protected:
  static constexpr double turn_per_step = 0.1;
  static constexpr int needed = 4;  // 0.1 rad × 1.4 m / 0.05 m = 2.8, and the next power of 2

  Plank() {
    header_.turning = {true};
    script_ = {
        .colliders = {0}, .path = {{0, {0, 0}}, {1, {0.5, 1}}}, .turns = {{0, 0.2}, {1, 0.2 + 64 * turn_per_step}}};
  }

  [[nodiscard]] MoverPose pose(int step, double fraction) const {
    const MoverPose from = pose_at(script_, step * dt);
    const MoverPose to = pose_at(script_, (step + 1) * dt);
    if (fraction == 0) return from;
    if (fraction == 1) return to;
    return {from.offset + fraction * (to.offset - from.offset), from.angle + fraction * (to.angle - from.angle)};
  }
  [[nodiscard]] std::vector<Vec2d> points(const Vec2d& offset, double angle) const {
    return placed(header_.scenery.colliders[0].points, offset, angle);
  }
  /// In parts, each with a turn at once about a corner of the octagon, and straight on.
  [[nodiscard]] TraceStep in_parts(int number, int parts, const Vec2d& from_corner = Vec2d::Zero()) const {
    TraceStep made = step({beside_, beside_});
    made.step = number;
    const MoverPose from = pose(number, 0);
    made.movers = {{from.offset, pose(number, 1).offset}};
    VertexWay way{.collider = 0, .instants = {0}, .vertices = {points(from.offset, from.angle)}};
    for (int i = 0; i < parts; ++i) {
      const MoverPose begin = pose(number, static_cast<double>(i) / parts);
      const MoverPose end = pose(number, static_cast<double>(i + 1) / parts);
      const Vec2d arm = beside_ + Vec2d(-0.3125, -0.3125) + from_corner - begin.offset;
      way.instants.push_back((i + 0x1p-20) / parts);
      way.vertices.push_back(points(begin.offset + arm - turned(arm, end.angle - begin.angle), end.angle));
      way.instants.push_back(static_cast<double>(i + 1) / parts);
      way.vertices.push_back(points(end.offset, end.angle));
    }
    made.vertex_ways = {way};
    return made;
  }
  [[nodiscard]] MoverWayJudgement judged(const std::vector<TraceStep>& steps, double distance = 0,
                                         const Colliders& near = {0}) const {
    MoverWayJudge judge(header_, {script_});
    MoverWayJudgement last;
    for (const TraceStep& one : steps)
      last = judge.judge(one, [&](double within) { return distance <= within ? near : Colliders{}; });
    return last;
  }

  TraceHeader header_ = promising({box(-0.8, -0.1, 0.8, 0.1, 0)});
  MoverScript script_;
  Vec2d beside_{1.2, 0.3};
};

TEST_F(Plank, that_turns_at_once_in_enough_parts_holds_to_its_script) {
  std::vector<TraceStep> steps;
  for (int k = 0; k < 40; ++k) {
    steps.push_back(in_parts(k, needed));
    EXPECT_EQ(parts_of(steps.back().vertex_ways), needed);
    const MoverWayJudgement one = judged(steps);
    EXPECT_FALSE(one.broken()) << k;
    EXPECT_GT(one.arc_error, 0) << "it turns at once";
    EXPECT_LE(one.arc_share, 1);
  }
  // The chord of the vertex farthest from the corner that it turns about, in the first part of the first step.
  const Vec2d corner = beside_ + Vec2d(-0.3125, -0.3125);
  double farthest = 0;
  for (const Vec2d& v : points(pose(0, 0).offset, pose(0, 0).angle)) farthest = std::max(farthest, (v - corner).norm());
  const double chord = 2 * std::sin(turn_per_step / needed / 2) * farthest;
  EXPECT_NEAR(judged({steps[0]}).arc_error, chord, 0.03 * chord) << "it goes on meanwhile";
}

TEST_F(Plank, that_crushes_in_the_first_part_goes_on_evenly_and_the_step_was_divided_as_before) {
  TraceStep step = in_parts(0, needed);
  VertexWay& way = step.vertex_ways[0];
  // Turned at once and gone on in the first part; then 32 chords, as where a character that is crushed stays.
  way.instants.resize(3);
  way.vertices.resize(3);
  const double begin = way.instants.back();
  for (int k = 1; k <= 32; ++k) {
    way.instants.push_back(begin + (1 - begin) * k / 32);
    way.vertices.push_back(way.vertices.back());
  }
  EXPECT_EQ(parts_of(step.vertex_ways), needed);
}

TEST_F(Plank, is_coarse_or_fine_near_the_character_only) {
  EXPECT_EQ(judged({in_parts(0, needed / 2)}).coarse, Colliders{0});
  EXPECT_FALSE(judged({in_parts(0, needed / 2)}, std::nextafter(near_what_turns, 9)).broken());
  EXPECT_FALSE(judged({in_parts(0, 2 * needed)}).broken()) << "more are no fault";
  using Row = std::tuple<const char*, int, double, bool>;
  for (const auto& [what, parts, distance, is_fine] :
       {Row{"whole", 1, 1000, false}, Row{"as needed", needed, 3, false}, Row{"far", needed, 1000, true},
        Row{"more than needed", 4 * needed, 3, true},
        Row{"it may be met: more may free the character", 4 * needed, 0.05, false}})
    EXPECT_EQ(judged({in_parts(0, parts)}, distance).is_fine, is_fine) << what;
  // What only a circle is near of may turn in fewer parts.
  header_.scenery.colliders.push_back(circle({0, 0}, 0.1, 0));
  EXPECT_EQ(judged({in_parts(0, needed / 2)}, 0, {1}).coarse, Colliders{});
  EXPECT_EQ(judged({in_parts(0, needed / 2)}, 0, {0, 1}).coarse, Colliders{0});
}

TEST_F(Plank, that_turns_about_a_far_point_leaves_its_arc) {
  // The bound is A (2 D + 4 R) and D about 2 m, R 0.64 m: 6.6 m for a point that is 20 m away.
  EXPECT_EQ(judged({in_parts(0, needed, {20, 0})}).off_arc, Colliders{0});
}

TEST_F(Plank, that_begins_or_ends_off_leaves_its_script) {
  const TraceStep good = in_parts(0, needed);
  for (const double off : {1e-3, 1e-12}) {
    TraceStep ends = good;
    ends.vertex_ways[0].vertices.back()[2].x() += off;
    EXPECT_EQ(judged({ends}).off_script, Movers{0}) << off;
    TraceStep begins = good;
    begins.vertex_ways[0].vertices.front()[1].y() -= off;
    EXPECT_EQ(judged({begins}).off_script, Movers{0}) << off;
  }
  TraceStep offset = in_parts(3, needed);
  offset.movers[0].to.x() = one_ulp_up(offset.movers[0].to.x());
  EXPECT_EQ(judged({offset}).off_script, Movers{0}) << "an ulp";
  TraceStep next = in_parts(1, needed);
  next.vertex_ways[0].vertices.front()[0].x() = one_ulp_up(next.vertex_ways[0].vertices.front()[0].x());
  EXPECT_EQ(judged({good, next}).off_script, Movers{0}) << "an ulp from where it ended";
  next.step = 2;
  EXPECT_EQ(judged({good, next}).off_script, Movers{0}) << "the step between is not known, and the pose is another one";
}

TEST_F(Plank, that_is_a_millimetre_off_within_a_step_is_out_of_its_way) {
  for (std::size_t instant = 1; instant < 2 * needed; ++instant) {
    TraceStep bent = in_parts(0, needed);
    bent.vertex_ways[0].vertices[instant][3].x() += 1e-3;
    EXPECT_EQ(judged({bent}).out_of_way, Colliders{0}) << instant;
  }
  TraceStep aside = in_parts(0, needed);  // where a part ends it is on its arc
  for (Vec2d& v : aside.vertex_ways[0].vertices[2]) v.y() += 1e-3;
  EXPECT_EQ(judged({aside}).out_of_way, Colliders{0});
}

TEST_F(Plank, whose_steps_have_lengths_of_their_own_goes_by_their_sum) {
  // A step of dt in the time of two: at its end the script has it where the second step begins.
  TraceStep first = in_parts(0, needed);
  TraceStep second = in_parts(1, needed);
  first.dt = second.dt = dt;
  EXPECT_FALSE(judged({first, second}).broken());
  first.dt = 2 * dt;
  EXPECT_EQ(judged({first}).off_script, Movers{0});
}

TEST(MoverWay, of_what_goes_straight_is_its_script_in_each_scalar) {
  const MoverScript script{.colliders = {0}, .path = {{0, {0, 0}}, {0.3, {0.7, 1.1}}}, .loop = Loop::ping_pong};
  for (const bool in_float : {false, true}) {
    TraceHeader header = promising({box(-1, -1, 1, 0, 0)});
    if (in_float) header.scalar = "float";
    MoverWayJudge judge(header, {script});
    const auto offset = [&](int k) -> Vec2d {
      const Vec2d at = pose_at(script, k * dt).offset;
      return in_float ? Vec2d(at.cast<float>().cast<double>()) : at;
    };
    for (int k = 0; k <= 100; ++k) {
      const Vec2d off(k < 100 ? 0 : 1e-3, 0);
      TraceStep one = among(step({{5, 5}, {5, 5}}), {{offset(k), offset(k + 1) + off}});
      one.step = k;
      const MoverWayJudgement judged = judge.judge(one, [](double) { return Colliders{}; });
      EXPECT_EQ(judged.off_script, k < 100 ? Movers{} : Movers{0}) << header.scalar << " " << k;
      EXPECT_EQ(judged.broken(), k == 100);
    }
  }
}

}  // namespace
}  // namespace paperproof::compare::test
