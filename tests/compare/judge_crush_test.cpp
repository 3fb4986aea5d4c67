#include "compare/judge_steps.hpp"
#include "oracle/company.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Colliders = std::vector<ColliderIndex>;

constexpr double gap = 5e-7;

ColliderDef moving(ColliderDef def, MoverIndex mover = 0) {
  def.mover = mover;
  return def;
}

/// It stays where it is and says that `crushed` crushes it.
TraceStep staying(const Vec2d& at, MoverMotion<double> motion, Colliders crushed) {
  TraceStep staying = step({at, at});
  staying.movers = {motion};
  staying.crushed = std::move(crushed);
  return staying;
}

/// A floor, and a ceiling that comes down onto the octagon that stands on it.
std::vector<ColliderDef> press() { return {box(-4, -1, 4, 0), moving(box(-4, 1.5, 4, 2))}; }

const Vec2d standing(0, 0.625 + gap);

TEST(JudgeCrush, without_room_it_is_verified_and_excused) {
  Judge judge(promising(press()));
  const StepJudgement judged = judge.judge(staying(standing, {{0, 0}, {0, -0.5}}, {1}));
  EXPECT_EQ(judged.crushed, Colliders{1});
  EXPECT_TRUE(judged.crushed_with_room.empty());
  EXPECT_EQ(judged.end_overlap, Colliders{1});
  EXPECT_EQ(judged.pressed, Colliders{1});
  EXPECT_TRUE(judged.entered.empty());
  EXPECT_EQ(judged.max_penetration, 0);
}

TEST(JudgeCrush, unsaid_it_is_a_solid_entered) {
  Judge judge(promising(press()));
  const StepJudgement judged = judge.judge(staying(standing, {{0, 0}, {0, -0.5}}, {}));
  EXPECT_TRUE(judged.crushed.empty());
  EXPECT_EQ(judged.entered, Colliders{1});
  EXPECT_NEAR(judged.max_penetration, 0.25 + gap, 1e-15);
}

TEST(JudgeCrush, with_room_below_it_is_none) {
  Judge judge(promising({box(-4, -3, 4, -2), moving(box(-4, 1.5, 4, 2))}));
  const StepJudgement judged = judge.judge(staying(standing, {{0, 0}, {0, -0.5}}, {1}));
  EXPECT_TRUE(judged.crushed.empty());
  EXPECT_EQ(judged.crushed_with_room, Colliders{1});
  EXPECT_EQ(judged.entered, Colliders{1});
}

/// A mover that comes down on the octagon with room below, and a wall that stands: who promises `crush` breaks that
/// alone.
TEST(JudgeCrush, with_room_it_is_one_breach_of_who_promises_it_by_what_goes) {
  TraceHeader header = promising({box(-4, -3, 4, -2), moving(box(-4, 1.5, 4, 2)), box(0.25, 0, 1, 1)});
  for (const bool promised : {false, true}) {
    if (promised) header.guarantees = {Clause::crush};
    Judge judge(header);
    const StepJudgement judged = judge.judge(staying({-0.5, standing.y()}, {{0, 0}, {0, -0.5}}, {1}));
    EXPECT_EQ(judged.crushed_with_room, Colliders{1});
    EXPECT_EQ(judged.entered, promised ? Colliders{} : Colliders{1});
    EXPECT_EQ(judged.pressed, promised ? Colliders{1} : Colliders{});
    // It stays as the press goes up again, and comes out below: the press came over it and left.
    const StepJudgement left = judge.judge(staying({-0.5, standing.y()}, {{0, -0.5}, {0, 0}}, {}));
    EXPECT_TRUE(left.entered.empty());
    EXPECT_TRUE(left.tunnelled.empty());
    Judge again(header);
    TraceStep into_wall = step({{-0.5, standing.y()}, {0, standing.y()}});
    into_wall.movers = {{{0, 0}, {0, 0}}};
    into_wall.crushed = {2};
    EXPECT_EQ(again.judge(into_wall).entered, Colliders{2});
  }
}

/// What comes over the octagon with room and leaves it on the other side is not passed by the octagon, if the crush is
/// said as such.
TEST(JudgeCrush, what_passes_over_it_with_room_is_no_passage_of_who_promises_it) {
  TraceHeader header = promising({moving(box(-4, 1.5, 4, 2))});
  for (const bool promised : {false, true}) {
    if (promised) header.guarantees = {Clause::crush};
    Judge judge(header);
    const StepJudgement judged = judge.judge(staying(standing, {{0, 0}, {0, -3}}, {0}));
    EXPECT_EQ(judged.crushed_with_room, Colliders{0});
    EXPECT_EQ(judged.tunnelled, promised ? Colliders{} : Colliders{0});
  }
}

TEST(JudgeCrush, room_is_no_farther_than_what_crushes_goes_and_a_quarter_of_a_metre) {
  // The press comes down by 0.5 m, and touches the octagon after half of the step. By then it has to be beside the
  // press, whose edge is at x = `edge`: its top is 0.3125 m wide. So it goes aside by 2 (edge + 0.15625) in the step.
  constexpr double motion = 0.5;
  constexpr double half_top = 0.15625;
  for (const double more : {-0.3, -1e-3, 1e-3, 0.3}) {
    const double edge = (motion + detail::push_beyond_motion) / 2 - half_top + more;
    Judge judge(promising({box(-4, -1, 4, 0), moving(box(-4, 1.5, edge, 2))}));
    const StepJudgement judged = judge.judge(staying(standing, {{0, 0}, {0, -motion}}, {1}));
    EXPECT_EQ(judged.room.has_value(), more < 0) << more;
    EXPECT_EQ(judged.crushed, more < 0 ? Colliders{} : Colliders{1}) << more;
  }
}

TEST(JudgeCrush, room_is_not_where_it_did_not_go_by_itself) {
  // It goes 3 m to the right in half of the step, onto a shelf below a ceiling, and is pressed there from below: that
  // it could have stayed where it was does not count.
  Judge judge(promising({box(1.5, 0.625 + gap, 6, 2), moving(box(1.5, -0.825, 9, -0.725))}));
  TraceStep held = step({{0, 0}, {3, 0}, {3, 0}});
  held.movers = {{{0, 0}, {0, 0.2}}};
  held.crushed = {1};
  EXPECT_EQ(judge.judge(held).crushed, Colliders{1});
}

TEST(JudgeCrush, an_opening_counts_from_two_tenths_of_a_micrometre_on) {
  // Pushed to the right by a face that comes from -0.5 to -0.1; the wall leaves an opening of the octagon's width and
  // `more`.
  for (const double more : {-1e-3, 0.0, 1.9e-7, 2.1e-7, 1e-5, 0.1}) {
    const double wall = -0.1 + 0.625 + more;
    Judge judge(promising({box(wall, -4, 9, 4), moving(box(-2, -4, -0.5, 4))}));
    const StepJudgement judged = judge.judge(staying({0, 0}, {{0, 0}, {0.4, 0}}, {1}));
    EXPECT_EQ(judged.crushed.empty(), more > 2e-7) << more;
    EXPECT_EQ(judged.crushed_with_room.empty(), !(more > 2e-7)) << more;
  }
}

TEST(JudgeCrush, room_beyond_a_thin_wall_is_none) {
  for (const bool walled : {false, true}) {
    std::vector<ColliderDef> colliders{moving(box(-2, -4, -0.5, 4))};
    if (walled) colliders.push_back(chain({{0.4, -4}, {0.4, 4}}));
    Judge judge(promising(colliders));
    const StepJudgement judged = judge.judge(staying({0, 0}, {{0, 0}, {1.0, 0}}, {0}));
    EXPECT_EQ(judged.crushed, walled ? Colliders{0} : Colliders{}) << walled;
  }
}

TEST(JudgeCrush, room_that_only_a_way_from_after_it_reaches_is_none) {
  // A face presses the octagon against a block, and something lifts it meanwhile above the block: beside where it comes
  // to, over the block, there is room when the step ends. A straight way there from where the step began meets the
  // block; a way that begins later, or in no time from the end, begins inside the face.
  const double half = 0.3125;
  for (const bool blocked : {true, false}) {
    std::vector<ColliderDef> colliders{moving(box(half, 0, 1, 3))};
    if (blocked) colliders.push_back(box(-3, 0, -half, 1));
    Judge judge(promising(colliders));
    TraceStep lifted = step({{0, 0.625}, {0, 1.7}});
    lifted.movers = {{{0, 0}, {-0.8, 0}}};
    lifted.crushed = {0};
    const StepJudgement judged = judge.judge(lifted);
    EXPECT_EQ(judged.crushed, blocked ? Colliders{0} : Colliders{}) << blocked;
    EXPECT_EQ(judged.room.has_value(), !blocked);
  }
}

TEST(JudgeCrush, room_on_the_far_side_of_the_mover_is_none) {
  // A paper that passes the octagon within the step: where the octagon stays is free in the end.
  for (const bool walled : {false, true}) {
    std::vector<ColliderDef> colliders{moving(chain({{-0.5, -4}, {-0.5, 4}}))};
    if (walled) colliders.push_back(box(0.3125 + gap, -4, 1, 4));
    Judge judge(promising(colliders));
    const StepJudgement judged = judge.judge(staying({0, 0}, {{0, 0}, {1.1, 0}}, {0}));
    EXPECT_EQ(judged.crushed, walled ? Colliders{0} : Colliders{}) << walled;
    EXPECT_EQ(judged.tunnelled, walled ? Colliders{} : Colliders{0}) << walled;
    EXPECT_TRUE(judged.end_overlap.empty());
  }
}

TEST(JudgeCrush, what_was_pressed_in_stays_excused_until_it_is_free) {
  Judge judge(promising(press()));
  (void)judge.judge(staying(standing, {{0, 0}, {0, -0.5}}, {1}));
  const StepJudgement deeper = judge.judge(staying(standing, {{0, -0.5}, {0, -0.75}}, {}));
  EXPECT_EQ(deeper.pressed, Colliders{1});
  EXPECT_TRUE(deeper.entered.empty());
  const StepJudgement free = judge.judge(staying(standing, {{0, -0.75}, {0, 0}}, {}));
  EXPECT_TRUE(free.pressed.empty());
  EXPECT_TRUE(free.tunnelled.empty());
  const StepJudgement again = judge.judge(staying(standing, {{0, 0}, {0, -0.5}}, {}));
  EXPECT_EQ(again.entered, Colliders{1}) << "the excuse has ended";
}

/// A slab 0.1 m thick that rises under an octagon below a ceiling: after 0.2 m it is 0.1 m deep in the octagon.
struct Risen {
  Judge judge{promising({box(-4, 0.625 + gap, 4, 2), moving(box(-4, -0.825, 4, -0.725))})};

  Risen() {
    const StepJudgement judged = judge.judge(staying({0, 0}, {{0, 0}, {0, 0.2}}, {1}));
    EXPECT_EQ(judged.crushed, Colliders{1});
    EXPECT_EQ(judged.pressed, Colliders{1});
  }
  /// The octagon goes straight there while the slab goes on, up to an offset.
  StepJudgement next(const Vec2d& from, const Vec2d& to, double slab_from, double slab_to) {
    TraceStep gone = step({from, to});
    gone.movers = {{{0, slab_from}, {0, slab_to}}};
    return judge.judge(gone);
  }
};

TEST(JudgeCrush, whoever_comes_out_on_the_far_side_by_its_own_motion_has_passed_what_crushed_it) {
  Risen risen;
  const StepJudgement half_way = risen.next({0, 0}, {0, -0.3}, 0.2, 0.2);
  EXPECT_TRUE(half_way.tunnelled.empty()) << "it may still go back";
  const StepJudgement out = risen.next({0, -0.3}, {0, -1.4}, 0.2, 0.2);
  EXPECT_EQ(out.tunnelled, Colliders{1});
  ASSERT_EQ(out.passings.size(), 1U);
  EXPECT_NEAR(out.passings[0].thickness, 0.1, 1e-12);
}

TEST(JudgeCrush, whoever_stays_and_is_left_behind_by_what_crushed_it_has_passed_nothing) {
  Risen risen;
  EXPECT_TRUE(risen.next({0, 0}, {0, 0}, 0.2, 1.9).tunnelled.empty()) << "the slab is above the octagon";
  const StepJudgement fallen = risen.next({0, 0}, {0, -0.5}, 1.9, 1.9);
  EXPECT_FALSE(fallen.broke()) << "it falls away from there";
}

TEST(JudgeCrush, whoever_moves_back_where_it_came_from_has_passed_nothing) {
  Risen risen;
  const StepJudgement free = risen.next({0, 0}, {0.5, -0.1}, 0.2, -0.2);
  EXPECT_FALSE(free.broke());
  EXPECT_TRUE(free.end_overlap.empty());
}

TEST(JudgeCrush, left_behind_in_the_step_of_the_crush_it_must_have_stayed_there_too) {
  // The slab goes up through the octagon and beyond it; the octagon then is below it, or went there itself.
  for (const bool goes : {false, true}) {
    Judge judge(promising({moving(box(-4, -0.825, 4, -0.725)), box(-4, 0.625 + gap, 4, 0.7)}));
    TraceStep passed = step({{0, 0}, {0, 0}, {0, goes ? -2.0 : 0.0}});
    passed.path[1].fraction = 0.05;
    passed.movers = {{{0, 0}, {0, goes ? 0.2 : 1.6}}};
    passed.crushed = {0};
    const StepJudgement judged = judge.judge(passed);
    EXPECT_EQ(judged.crushed, Colliders{0});
    EXPECT_EQ(judged.tunnelled, goes ? Colliders{0} : Colliders{}) << goes;
  }
}

TEST(JudgeCrush, a_static_solid_never_crushes_and_being_pressed_into_one_is_not_excused) {
  Judge judge(promising(press()));
  TraceStep sunk = staying(standing, {{0, 0}, {0, -0.5}}, {0, 1});
  sunk.path.back().position.y() -= 0.125;
  const StepJudgement judged = judge.judge(sunk);
  EXPECT_EQ(judged.crushed_with_room, Colliders{0});
  EXPECT_EQ(judged.crushed, Colliders{1});
  EXPECT_EQ(judged.entered, Colliders{0});
}

TEST(JudgeCrush, a_ceiling_that_stops_short_by_less_than_an_opening_may_be_called_a_crush) {
  Judge judge(promising(press()));
  const double down = 1.5 - 1.25 - gap - 1e-8;  // what is left is 1e-8 more than touching
  const StepJudgement judged = judge.judge(staying({0, 0.625 + 1e-7}, {{0, 0}, {0, -down - gap}}, {1}));
  EXPECT_EQ(judged.crushed, Colliders{1});
}

TEST(FreeSpace, a_place_that_is_found_keeps_the_clearance_and_none_is_missed) {
  constexpr std::uint64_t seed = 71;
  Random random(seed);
  constexpr double clearance = 0.02;
  constexpr double reach = 0.75;
  int with_room = 0;
  Colliders all(14);
  std::iota(all.begin(), all.end(), ColliderIndex{0});
  constexpr int rounds = paperproof::test::sampled(300);
  for (int i = 0; i < rounds; ++i) {
    std::vector<ColliderDef> colliders;
    for (int k = 0; k < 14; ++k) {
      const Vec2d centre = random.point(1.8);
      colliders.push_back(polygon(star(random, centre, 0.9, 3 + random.below(4))));
    }
    colliders[0].mover = 0;
    const ExactScenery world(scenery(colliders), octagon());
    const std::vector<MoverMotion<double>> movers{{random.point(1), random.point(1)}};
    const Place at(random.point(0.5), movers, 0.5);
    const auto clear_by = [&](const Vec2d& position) {
      double least = std::numeric_limits<double>::infinity();
      for (ColliderIndex c = 0; c < colliders.size(); ++c) {
        least = std::min(least, world.separation(Place(position, movers, 0.5), c));
      }
      return least;
    };
    const WayQuestion anywhere{.from = at, .end = at, .may_pass = all};
    const auto found = world.find_free(anywhere, reach, clearance, [](const Vec2d&) { return true; });
    if (found) {
      ++with_room;
      EXPECT_GE(clear_by(*found), clearance) << "seed " << seed << " round " << i;
      EXPECT_LE((*found - at.position).norm(), reach * (1 + 1e-12));
    }
    for (int k = 0; k < 300; ++k) {
      const Vec2d off = random.point(reach);
      if (off.norm() > reach || clear_by(at.position + off) < 1.01 * clearance) continue;
      ASSERT_TRUE(found) << "seed " << seed << " round " << i;
      EXPECT_LE((*found - at.position).norm(), off.norm()) << "the nearest comes first";
    }
  }
  EXPECT_GT(with_room, rounds * 3 / 10);
  EXPECT_LT(with_room, rounds * 8 / 10);
}

/// Pressed to the right by a face that goes from -0.5 to -0.1, with another character at some place all the time.
StepJudgement pressed_beside(const Vec2d& other, bool promises = true) {
  const std::vector<ColliderDef> face{moving(box(-2, -4, -0.5, 4))};
  const TraceHeader two = promises ? promising(face) : header(face);
  std::vector<TraceStep> steps{staying({0, 0}, {{0, 0}, {0.4, 0}}, {0}), staying(other, {{0, 0}, {0.4, 0}}, {})};
  steps[1].character = 1;
  return Judge(two).judge(steps[0], CompanyJudge(two).others_of(0, steps));
}

TEST(JudgeCrush, where_another_character_is_there_is_no_room) {
  constexpr double half_width = 0.3125;
  for (const double more : {-0.1, -1e-3, 0.0, 1.9e-7, 2.1e-7, 1e-3, 0.1}) {
    const double between = -0.1 + 2 * half_width + more;
    const StepJudgement judged = pressed_beside({between + half_width, 0});
    EXPECT_EQ(judged.crushed.empty(), more > 2e-7) << more;
    EXPECT_EQ(judged.crushed_with_room.empty(), !(more > 2e-7)) << more;
  }
}

TEST(JudgeCrush, who_touched_another_is_excused_with_room_unless_it_promises) {
  const StepJudgement touched = pressed_beside({0, 1.25 + gap}, false);
  EXPECT_EQ(touched.crushed, Colliders{0});
  EXPECT_TRUE(touched.excused_crush);
  EXPECT_TRUE(touched.room);
  const StepJudgement alone = pressed_beside({0, 1.25 + 0.01}, false);
  EXPECT_EQ(alone.crushed_with_room, Colliders{0});
  EXPECT_FALSE(alone.excused_crush);
  EXPECT_EQ(pressed_beside({0, 1.25 + gap}).crushed_with_room, Colliders{0});
}

TEST(JudgeCrush, by_what_rests_or_goes_away_is_refuted) {
  for (const double lift : {0.0, 0.25}) {
    Judge judge(promising({box(-4, -1, 4, 0), moving(box(-4, 1.25 + 2 * gap, 4, 2))}));
    const StepJudgement judged = judge.judge(staying(standing, {{0, 0}, {0, lift}}, {1}));
    EXPECT_TRUE(judged.crushed.empty()) << lift;
    EXPECT_EQ(judged.crushed_with_room, Colliders{1}) << lift;
  }
}

TEST(JudgeCrush, by_what_comes_closer_only_to_where_it_is_held_is_verified) {
  // It goes to the right, under a ceiling, and is met from below there. From where it began the mover goes away.
  Judge judge(promising({box(-4, 0.625 + gap, 6, 2), moving(box(2.1, -1.1, 2.9, -0.9))}));
  TraceStep held = step({{0, 0}, {2.5, 0}, {2.5, 0}});
  held.movers = {{{0, 0}, {0.1, 0.5}}};
  held.crushed = {1};
  EXPECT_EQ(judge.judge(held).crushed, Colliders{1});
}

TEST(JudgeCrush, who_has_no_word_for_it_is_asked_for_room_all_the_same) {
  for (const bool path_exact : {true, false}) {
    Judge judge(header(press(), path_exact));
    TraceStep sunk = staying(standing, {{0, 0}, {0, -0.5}}, {});
    sunk.path.back().position.y() -= 0.125;
    const StepJudgement judged = judge.judge(sunk);
    EXPECT_EQ(judged.pressed, (Colliders{0, 1})) << "the press, and the floor into which it presses";
    EXPECT_FALSE(judged.broke());
    EXPECT_FALSE(judge.judge(staying(sunk.path.back().position, {{0, -0.5}, {0, -0.5}}, {})).broke());
  }
  Judge judge(header({box(-4, -3, 4, -2), moving(box(-4, 1.5, 4, 2))}));
  const StepJudgement with_room = judge.judge(staying(standing, {{0, 0}, {0, -0.5}}, {}));
  EXPECT_EQ(with_room.entered, Colliders{1});
  EXPECT_TRUE(with_room.crushed_with_room.empty()) << "nobody said so";
}

}  // namespace
}  // namespace paperproof::compare
