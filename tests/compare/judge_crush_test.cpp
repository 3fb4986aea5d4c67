#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace paperproof::compare::test {
namespace {

const ColliderDef ground = box(-4, -1, 4, 0);
const ColliderDef deep_ground = box(-4, -3, 4, -2);
/// A ceiling that comes down onto the octagon that stands on the ground.
ColliderDef press(double right = 4) { return box(-4, 1.5, right, 2, 0); }
/// A face that comes from the left.
ColliderDef face() { return box(-2, -4, -0.5, 4, 0); }
/// 0.1 m thick. It rises under an octagon below a ceiling: after 0.2 m it is 0.1 m deep in the octagon.
ColliderDef slab() { return box(-4, -0.825, 4, -0.725, 0); }

const Vec2d here(0, 0);
const Vec2d on_ground(0, standing);

TraceHeader promising_crush(const std::vector<ColliderDef>& colliders) {
  TraceHeader made = promising(colliders);
  made.guarantees = {Clause::crush};
  return made;
}

/// A step in which the mover goes from one offset to another, and those are said to crush.
struct Go {
  std::vector<Vec2d> path;
  MoverMotion mover;
  Colliders crushed;
  const char* told = "";
};
struct Story {
  const char* what;
  TraceHeader header;
  std::vector<Go> steps;
};

TraceStep step_of(const Go& go) {
  TraceStep made = among(step(go.path), {go.mover});
  made.crushed = go.crushed;
  return made;
}

constexpr const char* excused = "inside 1, pressed 1, crushed 1";
constexpr const char* excused_0 = "inside 0, pressed 0, crushed 0";
constexpr const char* refuted = "inside 1, entered 1, crushed with room 1";
constexpr const char* refuted_0 = "inside 0, entered 0, crushed with room 0";
constexpr const char* by_the_static_one = "inside 0 1, pressed 1, entered 0, crushed 1, crushed with room 0";
constexpr const char* said_once = "inside 1, pressed 1, crushed with room 1";

/// The press comes down by 0.5 m, and touches the octagon after half of the step. By then it has to be beside the
/// press, whose edge it is told of: its top is 0.3125 m wide. So it goes aside by 2 (edge + 0.15625) in the step.
constexpr double farthest_edge = (0.5 + detail::push_beyond_motion) / 2 - 0.15625;

/// Pushed to the right by a face that comes from -0.5 to -0.1; the wall leaves an opening of the octagon's width and
/// `more`.
std::vector<ColliderDef> opening(double more) { return {box(-0.1 + 2 * half_width + more, -4, 9, 4), face()}; }

TEST(JudgeCrush, is_excused_only_without_room) {
  const std::vector<Vec2d> stands{on_ground, on_ground};
  const std::vector<Vec2d> stays{here, here};
  const std::vector<Vec2d> sinks{on_ground, on_ground - Vec2d(0, 0.125)};
  const std::vector<Vec2d> just_below{{0, 0.625 + 1e-7}, {0, 0.625 + 1e-7}};
  const Vec2d down(0, -0.5);
  const std::vector<ColliderDef> at_rest{ground, box(-4, 1.25 + 2 * gap, 4, 2, 0)};
  // A paper that passes the octagon within the step: where the octagon stays is free in the end.
  const ColliderDef paper = chain({{-0.5, -4}, {-0.5, 4}}, 0);
  // It goes 3 m to the right in half of the step, onto a shelf below a ceiling, and is pressed there from below.
  const std::vector<ColliderDef> shelf{box(1.5, 0.625 + gap, 6, 2), box(1.5, -0.825, 9, -0.725, 0)};
  // It goes under a ceiling and is met from below there. From where it began the mover goes away.
  const std::vector<ColliderDef> there_only{box(-4, 0.625 + gap, 6, 2), box(2.1, -1.1, 2.9, -0.9, 0)};
  // A face presses the octagon against a block, and something lifts it meanwhile above the block: beside where it
  // comes to, over the block, there is room when the step ends. A straight way there from where the step began
  // meets the block; a way that begins later, or in no time from the end, begins inside the face.
  const ColliderDef pusher = box(half_width, 0, 1, 3, 0);
  const ColliderDef block = box(-3, 0, -half_width, 1);
  const std::vector<Vec2d> lifted{{0, 0.625}, {0, 1.7}};
  using Row = std::tuple<const char*, std::vector<ColliderDef>, std::vector<Vec2d>, Vec2d, Colliders, const char*>;
  const std::vector<Row> rows{
      {"between press and ground", {ground, press()}, stands, down, {1}, excused},
      {"unsaid it is a solid entered", {ground, press()}, stands, down, {}, "inside 1, entered 1"},
      {"with room below", {deep_ground, press()}, stands, down, {1}, refuted},
      {"room nearly too far", {ground, press(farthest_edge - 1e-3)}, stands, down, {1}, refuted},
      {"room too far", {ground, press(farthest_edge + 1e-3)}, stands, down, {1}, excused},
      {"an opening of its width", opening(0), stays, {0.4, 0}, {1}, excused},
      {"less than 0.2 micrometres more", opening(1.9e-7), stays, {0.4, 0}, {1}, excused},
      {"more than that", opening(2.1e-7), stays, {0.4, 0}, {1}, refuted},
      {"swept over, in the open", {face()}, stays, {1, 0}, {0}, refuted_0},
      {"room is beyond a thin wall", {face(), chain({{0.4, -4}, {0.4, 4}})}, stays, {1, 0}, {0}, excused_0},
      {"passed by a paper", {paper}, stays, {1.1, 0}, {0}, "tunnelled 0, crushed with room 0"},
      {"room is beyond it", {paper, box(half_width + gap, -4, 1, 4)}, stays, {1.1, 0}, {0}, "crushed 0"},
      {"that it could have stayed does not count", shelf, {here, {3, 0}, {3, 0}}, {0, 0.2}, {1}, excused},
      {"by what comes closer there only", there_only, {here, {2.5, 0}, {2.5, 0}}, {0.1, 0.5}, {1}, excused},
      {"only a way from after it reaches the room", {pusher, block}, lifted, {-0.8, 0}, {0}, excused_0},
      {"a way from its beginning does", {pusher}, lifted, {-0.8, 0}, {0}, refuted_0},
      {"by a static solid, and pressed into one", {ground, press()}, sinks, down, {0, 1}, by_the_static_one},
      {"1e-8 more than touching is left", {ground, press()}, just_below, {0, -0.25 + 1e-8}, {1}, excused},
      {"it rests", at_rest, stands, here, {1}, "crushed with room 1"},
      {"it goes away", at_rest, stands, {0, 0.25}, {1}, "crushed with room 1"},
  };
  for (const auto& [what, solids, path, motion, said, expected] : rows)
    EXPECT_EQ(told(judged(promising(solids), step_of({path, {here, motion}, said}))), expected) << what;
  for (const Colliders& said : {Colliders{}, Colliders{1}})
    EXPECT_NEAR(judged(promising({ground, press()}), step_of({stands, {here, down}, said})).max_penetration,
                said.empty() ? 0.25 + gap : 0, 1e-15);
}

void expect(const std::vector<Story>& stories) {
  for (const Story& story : stories) {
    SCOPED_TRACE(story.what);
    Judge judge(story.header);
    for (const Go& go : story.steps) EXPECT_EQ(told(judge.judge(step_of(go))), go.told);
  }
}

/// Who promises `crush` breaks that alone, by what goes; who has no word for it is asked for room all the same.
TEST(JudgeCrush, with_room_is_one_breach_of_who_promises_it) {
  const std::vector<ColliderDef> beside_wall{deep_ground, press(), box(0.25, 0, 1, 1)};
  const Vec2d left(-0.5, on_ground.y());
  const Vec2d sunk = on_ground - Vec2d(0, 0.125);
  const MoverMotion down{here, {0, -0.5}};
  // It stays as the press goes up again, and comes out below: the press came over it and left.
  const Go up{{left, left}, {{0, -0.5}, here}, {}};
  const Go into_wall{{left, on_ground}, {}, {2}, "inside 2, entered 2, crushed with room 2"};
  const Go passes{{on_ground, on_ground}, {here, {0, -3}}, {0}, "tunnelled 0, crushed with room 0"};
  const std::vector<Go> sinks{{{on_ground, sunk}, down, {}, "inside 0 1, pressed 0 1, crushed 1 0"},
                              {{sunk, sunk}, {{0, -0.5}, {0, -0.5}}, {}, "inside 0 1, pressed 0 1"}};
  expect({
      {"unpromised", promising(beside_wall), {{{left, left}, down, {1}, refuted}, up}},
      {"promised", promising_crush(beside_wall), {{{left, left}, down, {1}, said_once}, up}},
      {"by what stands, unpromised", promising(beside_wall), {into_wall}},
      {"by what stands, promised", promising_crush(beside_wall), {into_wall}},
      {"passes over it, unpromised", promising({press()}), {passes}},
      {"passes over it, promised",
       promising_crush({press()}),
       {{passes.path, passes.mover, {0}, "crushed with room 0"}}},
      {"no word for it: the press, and the floor into which it presses", header({ground, press()}), sinks},
      {"the same with sampled paths", header({ground, press()}, false), sinks},
      {"no word for it, and room",
       header({deep_ground, press()}),
       {{{on_ground, on_ground}, down, {}, "inside 1, entered 1"}}},
  });
}

/// Who says so while nothing moves breaks `crush`, and one breach is said once.
TEST(JudgeCrush, of_who_stays_in_the_air_is_no_hanging) {
  for (const bool comes : {false, true})
    for (const bool says : {false, true}) {
      TraceStep stays = step_of({{here, here}, {here, {comes ? 0.4 : 0.0, 0}}, says ? Colliders{1} : Colliders{}});
      stays.requested = {0, -0.01};
      EXPECT_EQ(judged(promising_crush(opening(0)), stays).hangs, !comes && !says) << comes << says;
    }
}

TEST(JudgeCrush, excuses_until_it_is_free_and_no_passing_by_its_own_motion) {
  const std::vector<Vec2d> stands{on_ground, on_ground};
  const TraceHeader below_ceiling = promising({box(-4, 0.625 + gap, 4, 2), slab()});
  const Go rises{{here, here}, {here, {0, 0.2}}, {1}, excused};
  const MoverMotion rests{{0, 0.2}, {0, 0.2}};
  const std::vector<Go> comes_out{
      rises, {{here, {0, -0.3}}, rests, {}, "inside 1, pressed 1"}, {{{0, -0.3}, {0, -1.4}}, rests, {}, "tunnelled 1"}};
  expect({
      {"what was pressed in stays excused until it is free",
       promising({ground, press()}),
       {{stands, {here, {0, -0.5}}, {1}, excused},
        {stands, {{0, -0.5}, {0, -0.75}}, {}, "inside 1, pressed 1"},
        {stands, {{0, -0.75}, here}, {}},
        {stands, {here, {0, -0.5}}, {}, "inside 1, entered 1"}}},
      {"whoever comes out on the far side by its own motion has passed it", below_ceiling, comes_out},
      {"whoever stays and is left behind has passed nothing, nor falls from there",
       below_ceiling,
       {rises, {{here, here}, {{0, 0.2}, {0, 1.9}}, {}}, {{here, {0, -0.5}}, {{0, 1.9}, {0, 1.9}}, {}}}},
      {"whoever moves back where it came from has passed nothing",
       below_ceiling,
       {rises, {{here, {0.5, -0.1}}, {{0, 0.2}, {0, -0.2}}, {}}}},
  });
  Judge judge(below_ceiling);
  StepJudgement out;
  for (const Go& go : comes_out) out = judge.judge(step_of(go));
  ASSERT_EQ(out.passings.size(), 1U);
  EXPECT_NEAR(out.passings[0].thickness, 0.1, 1e-12);
  // In one step the slab goes up through the octagon and beyond it; the octagon then is below it, or went there itself.
  for (const bool goes : {false, true}) {
    TraceStep passed = step_of({{here, here, {0, goes ? -2.0 : 0.0}}, {here, {0, goes ? 0.2 : 1.6}}, {0}});
    passed.path[1].fraction = 0.05;
    EXPECT_EQ(told(judged(promising({slab(), box(-4, 0.625 + gap, 4, 0.7)}), passed)),
              goes ? "tunnelled 0, crushed 0" : "crushed 0");
  }
}

TEST(FreeSpace, a_place_that_is_found_keeps_the_clearance_and_none_is_missed) {
  Random random(71);
  constexpr double clearance = 0.02;
  constexpr double reach = 0.75;
  int with_room = 0;
  Colliders all(14);
  std::iota(all.begin(), all.end(), ColliderIndex{0});
  constexpr int rounds = 300;
  for (int i = 0; i < rounds; ++i) {
    SCOPED_TRACE("round " + std::to_string(i));
    std::vector<ColliderDef> colliders;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const Vec2d centre = random.point(1.8);
      colliders.push_back(polygon(star(random, centre, 0.9, 3 + random.below(4)), k == 0 ? 0 : no_mover));
    }
    const ExactScenery there = world(colliders);
    const Motions movers{{random.point(1), random.point(1)}};
    const Place at(random.point(0.5), movers, 0.5);
    const auto clear_by = [&](const Vec2d& position) {
      double least = std::numeric_limits<double>::infinity();
      for (const ColliderIndex c : all) least = std::min(least, there.separation(Place(position, movers, 0.5), c));
      return least;
    };
    const WayQuestion anywhere{.from = at, .end = at, .may_pass = all};
    const auto found = there.find_free(anywhere, reach, clearance, [](const Vec2d&) { return true; });
    if (found) {
      ++with_room;
      EXPECT_GE(clear_by(*found), clearance);
      EXPECT_LE((*found - at.position).norm(), reach * (1 + 1e-12));
    }
    for (int k = 0; k < 300; ++k) {
      const Vec2d off = random.point(reach);
      if (off.norm() > reach || clear_by(at.position + off) < 1.01 * clearance) continue;
      ASSERT_TRUE(found);
      EXPECT_LE((*found - at.position).norm(), off.norm()) << "the nearest comes first";
    }
  }
  EXPECT_NEAR(with_room, 0.55 * rounds, 0.25 * rounds);
}

TEST(JudgeCrush, who_is_beside_another_is_excused_with_room) {
  for (const bool beside : {false, true}) {
    const StepJudgement one =
        Judge(header({face()})).judge(step_of({{here, here}, {here, {0.4, 0}}, {0}}), nullptr, beside);
    EXPECT_EQ(told(one), beside ? excused_0 : refuted_0);
    EXPECT_EQ(one.excused_crush, beside);
    EXPECT_TRUE(one.room);
  }
}

}  // namespace
}  // namespace paperproof::compare::test
