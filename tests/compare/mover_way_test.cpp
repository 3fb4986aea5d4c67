/// Scripts of movers by exact arithmetic, and ways that hold to them or do not.
#include "oracle/mover_way.hpp"

#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Loop = MoverScript::Loop;
using Colliders = std::vector<ColliderIndex>;

const MoverWayJudge::Near none = [](double) { return Colliders{}; };
using Movers = std::vector<MoverIndex>;

/// Between two entries in rationals, of a path that is run through once.
Rational exact_value(const std::vector<MoverScript::Turn>& turns, const Rational& time) {
  if (time <= Rational(turns.front().time)) return Rational(turns.front().at);
  for (std::size_t i = 1; i < turns.size(); ++i) {
    const Rational begin(turns[i - 1].time);
    const Rational end(turns[i].time);
    if (time > end) continue;
    const Rational at(turns[i - 1].at);
    return at + (time - begin) / (end - begin) * (Rational(turns[i].at) - at);
  }
  return Rational(turns.back().at);
}

/// The script of a plank: a random path, and random turns.
MoverScript random_script(Random& random, Loop loop) {
  MoverScript script{.colliders = {0}, .path = {}, .loop = loop};
  const double first = random.below(2) == 0 ? 0 : random.between(0, 0.5);
  double time = first;
  for (int i = 0; i < 4; ++i, time += random.between(0.01, 1)) {
    script.path.push_back({time, random.point(3)});
    script.turns.push_back({time, random.between(-4, 4)});
  }
  return script;
}

TEST(MoverScript, is_linear_between_entries_to_a_few_roundings) {
  constexpr std::uint64_t seed = 280;
  Random random(seed);
  int between = 0;
  constexpr int rounds = 4000;
  for (int i = 0; i < rounds; ++i) {
    const auto loop = static_cast<Loop>(random.below(3));
    const MoverScript script = random_script(random, loop);
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
    EXPECT_NEAR(pose_at(script, time).angle, static_cast<double>(exact), 8 * 0x1p-53 * (6 * steepest + 100))
        << "seed " << seed << " round " << i;
    between += rest > 0 && rest < length;
  }
  EXPECT_GE(between, rounds * 3 / 10);
}

TEST(MoverScript, is_exactly_its_entries_at_their_times_in_every_run) {
  MoverScript script{.colliders = {0}, .path = {{0, {0, 0}}, {0.25, {0.1, 0.7}}, {0.75, {0, 0}}}, .loop = Loop::loop};
  script.turns = {{0, 0}, {0.25, 0.3}, {0.75, 0.5}};
  for (int run = 0; run < 100; ++run) {
    const MoverPose pose = pose_at(script, 0.75 * run + 0.25);
    EXPECT_EQ(pose.offset, Vec2d(0.1, 0.7));
    EXPECT_EQ(pose.angle, 0.3 + run * 0.5) << "angles go on";
  }
  script.loop = Loop::ping_pong;
  EXPECT_EQ(pose_at(script, 1.25).offset, Vec2d(0.1, 0.7)) << "on the way back";
  script.loop = Loop::once;
  EXPECT_EQ(pose_at(script, 9).angle, 0.5);
}

/// A plank that turns about a place 1 m beside a character, and goes along.
class Plank : public testing::Test {
 protected:
  static constexpr double turn_per_step = 0.1;
  static constexpr int needed = 4;  // 0.1 rad × 1.4 m / 0.05 m = 2.8, and the next power of 2

  Plank() {
    ColliderDef plank = box(-0.8, -0.1, 0.8, 0.1);
    plank.mover = 0;
    header_ = promising({plank});
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
  [[nodiscard]] std::vector<Vec2d> placed(const Vec2d& offset, double angle) const {
    std::vector<Vec2d> all;
    for (const Vec2d& v : header_.scenery.colliders[0].points)
      all.emplace_back(offset + Vec2d(std::cos(angle) * v.x() - std::sin(angle) * v.y(),
                                      std::sin(angle) * v.x() + std::cos(angle) * v.y()));
    return all;
  }
  /// In parts, each with a turn at once about a corner of the octagon, and straight on.
  [[nodiscard]] TraceStep in_parts(int number, int parts, const Vec2d& from_corner = Vec2d::Zero()) const {
    TraceStep made = step({beside_, beside_});
    made.step = number;
    const MoverPose from = pose(number, 0);
    const MoverPose to = pose(number, 1);
    made.movers = {{from.offset, to.offset}};
    VertexWay way{.collider = 0, .instants = {0}, .vertices = {placed(from.offset, from.angle)}};
    for (int i = 0; i < parts; ++i) {
      const MoverPose begin = pose(number, static_cast<double>(i) / parts);
      const MoverPose end = pose(number, static_cast<double>(i + 1) / parts);
      const double angle = end.angle - begin.angle;
      const Vec2d arm = beside_ + Vec2d(-0.3125, -0.3125) + from_corner - begin.offset;
      const Vec2d turned(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                         std::sin(angle) * arm.x() + std::cos(angle) * arm.y());
      way.instants.push_back((i + 0x1p-20) / parts);
      way.vertices.push_back(placed(begin.offset + arm - turned, end.angle));
      way.instants.push_back(static_cast<double>(i + 1) / parts);
      way.vertices.push_back(placed(end.offset, end.angle));
    }
    made.vertex_ways = {way};
    return made;
  }
  [[nodiscard]] MoverWayJudgement judged(const std::vector<TraceStep>& steps, bool near = true) const {
    MoverWayJudge judge(header_, {script_});
    MoverWayJudgement last;
    for (const TraceStep& one : steps) last = judge.judge(one, is_near(near));
    return last;
  }

  [[nodiscard]] MoverWayJudge::Near is_near(bool near) const {
    return [this, near](double within) { return near || within > near_what_turns ? near_ : Colliders{}; };
  }

  TraceHeader header_;
  MoverScript script_;
  Vec2d beside_{1.2, 0.3};
  const Colliders near_{0};
};

TEST_F(Plank, that_turns_at_once_in_enough_parts_holds_to_its_script) {
  MoverWayJudge judge(header_, {script_});
  for (int k = 0; k < 40; ++k) {
    const TraceStep step = in_parts(k, needed);
    const MoverWayJudgement one = judge.judge(step, is_near(true));
    EXPECT_FALSE(one.broken()) << k;
    EXPECT_EQ(parts_of(step.vertex_ways), needed);
    EXPECT_GT(one.arc_error, 0) << "it turns at once";
    EXPECT_LE(one.arc_share, 1);
  }
}

TEST_F(Plank, that_crushes_in_the_first_part_goes_on_evenly_and_the_step_was_divided_as_before) {
  TraceStep step = in_parts(0, needed);
  for (VertexWay& way : step.vertex_ways) {
    // Turned at once and gone on in the first part; then 32 chords, as where a character that is crushed stays.
    way.instants.resize(3);
    way.vertices.resize(3);
    const double begin = way.instants.back();
    for (int k = 1; k <= 32; ++k) {
      way.instants.push_back(begin + (1 - begin) * k / 32);
      way.vertices.push_back(way.vertices.back());
    }
  }
  EXPECT_EQ(parts_of(step.vertex_ways), needed);
}

TEST_F(Plank, is_off_its_arc_by_the_chord_of_the_first_turn) {
  // The vertex farthest from the corner that it turns about, in the first part of the first step.
  const Vec2d corner = beside_ + Vec2d(-0.3125, -0.3125);
  double farthest = 0;
  for (const Vec2d& v : placed(pose(0, 0).offset, pose(0, 0).angle)) farthest = std::max(farthest, (v - corner).norm());
  const double chord = 2 * std::sin(turn_per_step / needed / 2) * farthest;
  EXPECT_NEAR(judged({in_parts(0, needed)}).arc_error, chord, 0.03 * chord) << "it goes on meanwhile";
}

TEST_F(Plank, that_turns_at_once_in_fewer_parts_is_coarse_near_the_character_only) {
  EXPECT_EQ(judged({in_parts(0, needed / 2)}).coarse, Colliders{0});
  EXPECT_FALSE(judged({in_parts(0, needed / 2)}, false).broken());
  EXPECT_FALSE(judged({in_parts(0, 2 * needed)}).broken()) << "more are no fault";
}

TEST_F(Plank, divides_a_step_only_where_it_is_near_and_into_no_more_parts_than_it_needs) {
  const auto is_fine = [&](int parts, double distance) {
    const auto near = [&](double within) { return distance <= within ? near_ : Colliders{}; };
    return MoverWayJudge(header_, {script_}).judge(in_parts(0, parts), near).is_fine;
  };
  EXPECT_FALSE(is_fine(1, 1000));
  EXPECT_FALSE(is_fine(needed, 3));
  EXPECT_TRUE(is_fine(needed, 1000)) << "it is far";
  EXPECT_TRUE(is_fine(4 * needed, 3));
  EXPECT_FALSE(is_fine(4 * needed, 0.05)) << "it may be met: a finer division may free the character";
}

TEST_F(Plank, of_which_only_a_circle_is_near_may_turn_in_fewer_parts) {
  ColliderDef ball{.shape = ColliderDef::Shape::circle, .points = {{0, 0}}, .mover = 0};
  ball.radius = 0.1;
  header_.scenery.colliders.push_back(ball);
  const auto of_near = [&](const Colliders& near) {
    return MoverWayJudge(header_, {script_}).judge(in_parts(0, needed / 2), [&](double) { return near; }).coarse;
  };
  EXPECT_EQ(of_near({1}), Colliders{});
  EXPECT_EQ(of_near({0, 1}), Colliders{0});
}

TEST_F(Plank, that_turns_about_a_far_point_leaves_its_arc) {
  // The bound is A (2 D + 4 R) and D about 2 m, R 0.64 m: 6.6 m for a point that is 20 m away.
  EXPECT_EQ(judged({in_parts(0, needed, {20, 0})}).off_arc, Colliders{0});
}

TEST_F(Plank, that_ends_or_begins_a_millimetre_or_a_picometre_off_leaves_its_script) {
  for (const double off : {1e-3, 1e-12}) {
    TraceStep ends = in_parts(0, needed);
    ends.vertex_ways[0].vertices.back()[2].x() += off;
    EXPECT_EQ(judged({ends}).off_script, Movers{0}) << off;
    TraceStep begins = in_parts(0, needed);
    begins.vertex_ways[0].vertices.front()[1].y() -= off;
    EXPECT_EQ(judged({begins}).off_script, Movers{0}) << off;
  }
}

TEST_F(Plank, whose_offset_is_an_ulp_off_leaves_its_script) {
  TraceStep off = in_parts(3, needed);
  off.movers[0].to.x() = one_ulp_up(off.movers[0].to.x());
  EXPECT_EQ(judged({off}).off_script, Movers{0});
}

TEST_F(Plank, that_begins_an_ulp_from_where_it_ended_leaves_its_script) {
  TraceStep next = in_parts(1, needed);
  next.vertex_ways[0].vertices.front()[0].x() = one_ulp_up(next.vertex_ways[0].vertices.front()[0].x());
  EXPECT_EQ(judged({in_parts(0, needed), next}).off_script, Movers{0});
  next.step = 2;  // the step between is not known, and the pose is another one
  EXPECT_EQ(judged({in_parts(0, needed), next}).off_script, Movers{0});
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
  ColliderDef lift = box(-1, -1, 1, 0);
  lift.mover = 0;
  const MoverScript script{.colliders = {0}, .path = {{0, {0, 0}}, {0.3, {0.7, 1.1}}}, .loop = Loop::ping_pong};
  for (const char* scalar : {"double", "float"}) {
    TraceHeader header = promising({lift});
    header.scalar = scalar;
    MoverWayJudge judge(header, {script});
    const auto offset = [&](int k) {
      const Vec2d at = pose_at(script, k * dt).offset;
      return scalar[0] == 'f' ? Vec2d(at.cast<float>().cast<double>()) : at;
    };
    for (int k = 0; k < 100; ++k) {
      TraceStep one = step({{5, 5}, {5, 5}});
      one.step = k;
      one.movers = {{offset(k), offset(k + 1)}};
      EXPECT_FALSE(judge.judge(one, none).broken()) << scalar << " " << k;
    }
    TraceStep off = step({{5, 5}, {5, 5}});
    off.step = 100;
    off.movers = {{offset(100), offset(101) + Vec2d(1e-3, 0)}};
    EXPECT_EQ(judge.judge(off, none).off_script, Movers{0}) << scalar;
  }
}

}  // namespace
}  // namespace paperproof::compare
