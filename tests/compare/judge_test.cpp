#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Colliders = std::vector<ColliderIndex>;

TEST(Judge, passing_a_paper_in_one_step_is_tunnelling_told_with_speed_thickness_and_angle) {
  constexpr double thickness = 1.0 / 128;
  Judge judge(header({box(-4, 0, 4, thickness)}));
  const StepJudgement judged = judge.judge(step({{0, 1}, {0, -1}}));
  EXPECT_EQ(judged.tunnelled, Colliders{0});
  EXPECT_TRUE(judged.corner_cut.empty());
  EXPECT_TRUE(judged.end_overlap.empty());
  ASSERT_EQ(judged.passings.size(), 1U);
  EXPECT_DOUBLE_EQ(judged.passings[0].speed, 2 / dt);
  EXPECT_DOUBLE_EQ(judged.passings[0].thickness, thickness);
  EXPECT_DOUBLE_EQ(judged.passings[0].angle, 90);
}

TEST(Judge, the_angle_is_that_of_the_way_to_the_face) {
  Judge judge(header({box(-4, 0, 4, 0.125)}));
  const StepJudgement judged = judge.judge(step({{-1, 1}, {1, -1}}));
  ASSERT_EQ(judged.passings.size(), 1U);
  EXPECT_NEAR(judged.passings[0].angle, 45, 1e-9);
}

TEST(Judge, a_paper_of_any_thickness_is_never_a_corner_cut) {
  for (const double thickness : {1e-3, 1e-6, 1e-12, 0.0}) {
    const ColliderDef paper = thickness > 0 ? box(-4, 0, 4, thickness) : chain({{-4, 0}, {4, 0}});
    for (const bool path_exact : {true, false}) {
      Judge judge(header({paper}, path_exact));
      EXPECT_EQ(judge.judge(step({{0, 1}, {0, -1}})).tunnelled, Colliders{0}) << thickness;
    }
  }
}

TEST(Judge, a_character_smaller_than_the_slop_still_tunnels) {
  TraceHeader small = header({box(-4, 0, 4, 1e-6)}, false);
  for (Vec2d& point : small.points) point *= 0x1p-10;
  Judge judge(small);
  EXPECT_EQ(judge.judge(step({{0, 1}, {0, -1}})).tunnelled, Colliders{0});
}

TEST(Judge, cutting_a_corner_shallower_than_the_slop_is_counted_apart) {
  // The left arm passes the box's right face, `depth` beyond it.
  for (const double depth : {0.004, 0.006, 0.019, 0.021}) {
    const double x = 1 + 0.3125 - depth;
    for (const bool path_exact : {true, false}) {
      Judge judge(header({box(0, -0.125, 1, 0.125)}, path_exact));
      const StepJudgement judged = judge.judge(step({{x, 2}, {x, -2}}));
      const bool cut = depth < (path_exact ? 0.005 : 0.020);
      EXPECT_EQ(judged.corner_cut, cut ? Colliders{0} : Colliders{}) << depth;
      EXPECT_EQ(judged.tunnelled, cut ? Colliders{} : Colliders{0}) << depth;
    }
  }
}

TEST(Judge, who_promises_is_excused_no_corner) {
  Judge judge(promising({box(0, -0.125, 1, 0.125)}));
  const double x = 1 + 0.3125 - 1e-9;
  const StepJudgement judged = judge.judge(step({{x, 2}, {x, -2}}));
  EXPECT_EQ(judged.tunnelled, Colliders{0});
  EXPECT_TRUE(judged.corner_cut.empty());
}

TEST(Judge, an_overlap_of_an_ulp_is_rounding_unless_it_is_promised_away) {
  const double half = 0.3125;
  for (const double ulps : {1.0, 3.0}) {
    const double x = 4 + half - ulps * 0x1p-50;  // 4.3 m and an ulp of it
    const auto judged = [&](TraceHeader head) { return Judge(std::move(head)).judge(step({{6, 0}, {x, 0}})); };
    const StepJudgement rounded = judged(header({box(0, -1, 4, 1)}));
    EXPECT_EQ(rounded.entered, ulps > 1 ? Colliders{0} : Colliders{}) << ulps;
    EXPECT_EQ(rounded.rounded, ulps > 1 ? Colliders{} : Colliders{0}) << ulps;
    EXPECT_EQ(rounded.max_penetration > 0, ulps > 1) << ulps;
    EXPECT_EQ(judged(promising({box(0, -1, 4, 1)})).entered, Colliders{0});
  }
  Judge judge(header({box(0, -1, 4, 1)}));
  EXPECT_TRUE(judge.judge(step({{6, 0}, {4 + half - 0x1p-50, 0}})).entered.empty());
  EXPECT_EQ(judge.judge(step({{4 + half - 0x1p-50, 0}, {4, 0}})).entered, Colliders{0}) << "deeper afterwards";
}

TEST(Judge, stuck_is_refuted_where_a_straight_way_out_is_free) {
  const auto says_stuck = [](std::vector<ColliderDef> colliders) {
    TraceStep stuck = step({{0, 0}, {0, 0}});
    stuck.stuck = true;
    stuck.start_overlap = {0};
    return Judge(promising(std::move(colliders))).judge(stuck).stuck_refuted;
  };
  const ColliderDef block = box(-0.5, -2, 2, 2);
  EXPECT_TRUE(says_stuck({block}));
  // Around it, nearer than the octagon is wide.
  std::vector<ColliderDef> closed{block, box(-2, -4, -0.75, 4), box(2.25, -4, 4, 4), box(-2, 2.25, 4, 4),
                                  box(-2, -4, 4, -2.25)};
  EXPECT_FALSE(says_stuck(closed));
  TraceStep free = step({{0, 0}, {0, 0}});
  free.stuck = true;
  EXPECT_TRUE(Judge(promising({box(4, 4, 5, 5)})).judge(free).stuck_refuted) << "it is inside of nothing";
}

TEST(Judge, stuck_is_refuted_by_a_way_out_that_is_free_where_the_step_begins) {
  // Closed in, but for where a lid is: away above at one end of the step, upon all else at the other.
  const auto says_stuck = [](const Vec2d& lid_from, const Vec2d& lid_to) {
    std::vector<ColliderDef> colliders{box(-0.5, -2, 2, 2), box(-2, -4, -0.75, 4), box(2.25, -4, 4, 4),
                                       box(-2, -4, 4, -2.25), box(-2, 2.25, 4, 4)};
    colliders.back().mover = 0;
    TraceStep stuck = step({{0, 0}, {0, 0}});
    stuck.stuck = true;
    stuck.start_overlap = {0};
    stuck.movers = {{lid_from, lid_to}};
    return Judge(promising(std::move(colliders))).judge(stuck).stuck_refuted;
  };
  const Vec2d away(0, 4);
  EXPECT_FALSE(says_stuck({0, 0}, {0, 0}));
  EXPECT_FALSE(says_stuck({0, 0}, away)) << "it opens too late";
  EXPECT_TRUE(says_stuck(away, {0, 0})) << "it was open";
}

TEST(Judge, who_is_freed_by_what_it_was_stuck_in_was_stuck) {
  // What it is inside of goes away during the step, from among walls that leave no way.
  std::vector<ColliderDef> colliders{box(-0.25, -0.5, 0.25, 0.5), box(-2, -4, -0.375, 4), box(0.375, -4, 4, 4),
                                     box(-2, -4, 4, -0.75), box(-2, 0.75, 4, 4)};
  colliders.front().mover = 0;
  TraceStep stuck = step({{0, 0}, {0, 0}});
  stuck.stuck = true;
  stuck.start_overlap = {0};
  stuck.movers = {{{0, 0}, {0, 20}}};
  const StepJudgement judged = Judge(promising(std::move(colliders))).judge(stuck);
  EXPECT_TRUE(judged.end_overlap.empty());
  EXPECT_FALSE(judged.stuck_refuted);
}

constexpr double half_height = 0.625;  // of the octagon

/// Of who stands at a height above a floor, and came from another.
StepJudgement says_grounded(const TraceHeader& header, double from, double to) {
  TraceStep stands = step({{0, half_height + from}, {0, half_height + to}});
  stands.grounded = true;
  return Judge(header).judge(stands);
}

TEST(Judge, ground_is_refuted_where_nothing_is_under_it) {
  const std::vector<ColliderDef> floor{box(-4, -1, 4, 0)};
  EXPECT_FALSE(says_grounded(promising(floor), 0, 0.9e-6).ground_refuted);
  EXPECT_TRUE(says_grounded(promising(floor), 0, 1.1e-6).ground_refuted);
  TraceStep silent = step({{0, 9}, {0, 9}});
  EXPECT_FALSE(Judge(promising(floor)).judge(silent).ground_refuted) << "it says nothing";
  const std::vector<ColliderDef> ceiling{box(-4, 2 * half_height, 4, 4)};
  EXPECT_TRUE(says_grounded(promising(ceiling), 0, 0).ground_refuted) << "what it touches is above it";
  const std::vector<ColliderDef> wall{box(0.3125, -4, 4, 4)};
  EXPECT_TRUE(says_grounded(promising(wall), 0, 0).ground_refuted) << "what it touches is beside it";
  EXPECT_FALSE(says_grounded(promising(floor), 0, -0.1).ground_refuted) << "inside of it: another answer says so";
}

TEST(Judge, ground_that_was_there_earlier_in_the_step_is_excused_only_who_promises_nothing) {
  const std::vector<ColliderDef> floor{box(-4, -1, 4, 0)};
  EXPECT_TRUE(says_grounded(promising(floor), 0, 0.1).ground_refuted);
  for (const bool exact : {true, false}) {
    const StepJudgement judged = says_grounded(header(floor, exact), 0, 0.1);
    EXPECT_FALSE(judged.ground_refuted);
    EXPECT_TRUE(judged.ground_late);
    EXPECT_TRUE(says_grounded(header(floor, exact), 0.1, 0.1).ground_refuted) << "nor was it";
  }
  EXPECT_FALSE(says_grounded(header(floor, false), 0.0199, 0.0199).ground_refuted) << "Box2D's skin";
  EXPECT_FALSE(says_grounded(header(floor, false), 0.0199, 0.0199).ground_late);
  EXPECT_TRUE(says_grounded(header(floor, false), 0.0201, 0.0201).ground_refuted);
  TraceHeader by_units = header(floor);
  by_units.tolerances = {{"unit", 0.03}};
  EXPECT_FALSE(says_grounded(by_units, 0.029, 0.029).ground_refuted);
  EXPECT_TRUE(says_grounded(by_units, 0.031, 0.031).ground_refuted);
}

TEST(Judge, who_draws_pixels_may_be_as_deep_in_them_as_one) {
  TraceHeader drawing = header({box(-4, -1, 4, 0)});
  drawing.tolerances = {{"unit", 0.03}};
  EXPECT_EQ(Judge(drawing).judge(step({{0, half_height}, {0, half_height - 0.02}})).entered, Colliders{0})
      << "no level of pixels";
  drawing.tolerances.push_back({"pixel", 0.03});
  const StepJudgement within = Judge(drawing).judge(step({{0, half_height}, {0, half_height - 0.029}}));
  EXPECT_EQ(within.drawn, Colliders{0});
  EXPECT_TRUE(within.entered.empty());
  EXPECT_NEAR(within.max_penetration, 0.029, 1e-12) << "how deep stays visible";
  const StepJudgement deeper = Judge(drawing).judge(step({{0, half_height}, {0, half_height - 0.031}}));
  EXPECT_EQ(deeper.entered, Colliders{0});
  EXPECT_TRUE(deeper.drawn.empty());
}

TEST(Judge, motion_that_is_missing_was_lost_unless_something_is_in_its_way) {
  const auto lost = [](double from, double to, double wanted) {
    TraceStep went = step({{from, 0.625 + 5e-7}, {to, 0.625 + 5e-7}});
    went.requested = {wanted, -1.0 / 128};
    const StepJudgement judged = Judge(header({box(-4, -1, 4, 0), box(2, 0, 3, 2)})).judge(went);
    EXPECT_EQ(judged.motion_wanted, std::abs(wanted));
    return judged.motion_lost;
  };
  EXPECT_EQ(lost(-0.5, -0.5, 0.5), 0.5) << "no contact on that side, no velocity: lost all the same";
  EXPECT_EQ(lost(-0.5, -0.25, 0.5), 0.25);
  EXPECT_EQ(lost(-0.5, -0.625, 0.5), 0.5) << "backwards is no more than all of it";
  EXPECT_EQ(lost(-0.5, 0, 0.5), 0);
  EXPECT_EQ(lost(1.5, 2 - 0.3125 - 5e-7, 0.5), 0) << "the wall";
  EXPECT_EQ(lost(2 - 0.3125 - 5e-7, 2 - 0.3125 - 5e-7, -0.5), 0.5) << "away from it";
}

TEST(Judge, the_normal_of_a_contact_is_held_against_the_exact_one_of_that_side) {
  const auto error = [](const Vec2d& normal) {
    TraceStep rest = step({{0, 0.625 + 5e-7}});
    rest.requested = {0, -1.0 / 128};
    rest.contacts = {{.collider = 0, .normal = normal, .side = Side::bottom}};
    return Judge(promising({box(-4, -1, 4, 0)})).judge(rest).normal_error;
  };
  EXPECT_EQ(error({0, 1}), 0);
  ASSERT_TRUE(error({0.6, 0.8}));
  EXPECT_NEAR(*error({0.6, 0.8}), std::atan2(0.6, 0.8) * 180 / 3.14159265358979323846, 1e-12);
}

TEST(Judge, going_around_is_free) {
  Judge judge(header({box(-4, 0, 4, 0.125)}));
  const StepJudgement judged = judge.judge(step({{0, 1}, {5, 1}, {5, -1}, {0, -1}}));
  EXPECT_TRUE(judged.tunnelled.empty());
  EXPECT_TRUE(judged.corner_cut.empty());
}

TEST(Judge, leaving_a_solid_on_another_side_steps_later_is_tunnelling_once) {
  Judge judge(header({box(-4, 0, 4, 0.5)}));
  const StepJudgement in = judge.judge(step({{0, 2}, {0, 1}}));
  EXPECT_EQ(in.end_overlap, Colliders{0});
  EXPECT_EQ(in.max_penetration, 0.5 - (1 - 0.625));
  EXPECT_TRUE(in.tunnelled.empty());
  EXPECT_TRUE(judge.judge(step({{0, 1}, {0, 0}})).tunnelled.empty());
  EXPECT_EQ(judge.judge(step({{0, 0}, {0, -2}})).tunnelled, Colliders{0});
  EXPECT_TRUE(judge.judge(step({{0, -2}, {0, -3}})).tunnelled.empty());
}

TEST(Judge, leaving_a_solid_on_the_side_it_was_entered_is_none) {
  Judge judge(header({box(-4, 0, 4, 0.5)}));
  EXPECT_EQ(judge.judge(step({{0, 2}, {0, 1}})).end_overlap, Colliders{0});
  EXPECT_EQ(judge.judge(step({{0, 1}, {1, 0.75}})).end_overlap, Colliders{0});
  const StepJudgement out = judge.judge(step({{1, 0.75}, {2, 2}}));
  EXPECT_TRUE(out.end_overlap.empty());
  EXPECT_TRUE(out.tunnelled.empty());
}

TEST(Judge, leaving_a_solid_in_which_the_run_began_is_none) {
  Judge judge(header({box(-4, 0, 4, 0.5)}));
  EXPECT_EQ(judge.judge(step({{0, 0.9}, {0, 0.5}})).end_overlap, Colliders{0});
  EXPECT_TRUE(judge.judge(step({{0, 0.5}, {0, -2}})).tunnelled.empty());
}

TEST(Judge, a_respawn_ends_every_episode) {
  Judge judge(header({box(-4, 0, 4, 0.5)}));
  EXPECT_EQ(judge.judge(step({{0, 2}, {0, 0.5}})).end_overlap, Colliders{0});
  TraceStep respawned = step({{0, -5}, {0, -6}});
  respawned.respawn = true;
  EXPECT_TRUE(judge.judge(respawned).tunnelled.empty());

  EXPECT_EQ(judge.judge(step({{0, 2}, {0, 0.5}})).end_overlap, Colliders{0});
  TraceStep at_the_same_place = step({{0, 0.5}, {0, -6}});
  at_the_same_place.respawn = true;
  EXPECT_TRUE(judge.judge(at_the_same_place).tunnelled.empty()) << "it was put inside";
}

TEST(Judge, a_step_at_rest_is_judged_as_the_one_before) {
  Judge judge(header({box(-4, -1, 4, 0)}));
  TraceStep rest = step({{0, 0.625 + 5e-7}});
  rest.requested = {0, -1.0 / 128};
  EXPECT_EQ(judge.judge(rest).contacts.size(), 1U);
  EXPECT_EQ(judge.judge(rest).contacts.size(), 1U);
  TraceStep other = rest;
  other.requested = {0, 1};
  EXPECT_TRUE(judge.judge(other).contacts.empty());
  other = rest;
  other.path[0].position.y() += 1;
  EXPECT_TRUE(judge.judge(other).contacts.empty());
  other = rest;
  other.contacts.push_back({.collider = 0, .normal = {0, 1}});
  EXPECT_EQ(judge.judge(rest).max_contact_gap, 0);
  EXPECT_GT(judge.judge(other).max_contact_gap, 0);
}

TEST(Judge, a_one_way_chain_is_broken_against_its_normal_only) {
  Judge judge(header({chain({{-4, 0}, {4, 0}}, Vec2d(0, 1))}));
  EXPECT_EQ(judge.judge(step({{0, 1}, {0, -1}})).one_way_broken, Colliders{0});
  const StepJudgement up = judge.judge(step({{0, -1}, {0, 1}}));
  EXPECT_TRUE(up.one_way_broken.empty());
  EXPECT_TRUE(up.tunnelled.empty());
  // A leg that begins half through passes freely, however it got there.
  EXPECT_TRUE(judge.judge(step({{0, 0.5}, {0, -1}})).one_way_broken.empty());
}

TEST(Judge, a_one_way_hill_is_broken_on_its_peak_and_its_sides_and_not_beside_it) {
  Judge judge(header({chain({{-4, 0}, {0, 1}, {4, 0}}, Vec2d(0, 1))}));
  // On the peak no octagon is above the straight line of either side.
  for (const double x : {-4.0, -2.0, -0.1, 0.0, 0.1, 2.0, 4.0})
    EXPECT_EQ(judge.judge(step({{x, 1.7}, {x, -2}})).one_way_broken, Colliders{0}) << x;
  for (const double x : {-5.0, 5.0}) EXPECT_TRUE(judge.judge(step({{x, 1.7}, {x, -2}})).one_way_broken.empty()) << x;
}

TEST(Judge, what_is_dropped_through_is_excused_and_nothing_else) {
  const auto ledge = [](double y) { return chain({{-4, y}, {4, y}}, Vec2d(0, 1)); };
  Judge judge(header({ledge(0), ledge(-1), box(-4, -3, 4, -2.9)}));
  TraceStep fall = step({{0, 1}, {0, -4}});
  fall.dropped_through = {0, 2};  // who says so of a solid is not believed
  const StepJudgement judged = judge.judge(fall);
  EXPECT_EQ(judged.one_way_broken, Colliders{1});
  EXPECT_EQ(judged.tunnelled, Colliders{2});
  fall.dropped_through = {0, 1};
  EXPECT_TRUE(judge.judge(fall).one_way_broken.empty());
}

TEST(Judge, a_landing_is_an_exact_contact_at_its_fraction) {
  Judge judge(header({box(-4, -1, 4, 0)}));
  TraceStep landing = step({{0, 1}, {0, 0.625 + 5e-7}});
  landing.requested = {0, -1};
  const StepJudgement judged = judge.judge(landing);
  ASSERT_EQ(judged.contacts.size(), 1U);
  EXPECT_EQ(judged.contacts[0].side, Side::bottom);
  EXPECT_EQ(judged.contacts[0].fraction, 0.375);
  ASSERT_TRUE(judged.first_impact);
  EXPECT_EQ(*judged.first_impact, 0.375);
  EXPECT_TRUE(judged.first_impact_comparable);
  landing.stuck = true;
  EXPECT_FALSE(Judge(header({box(-4, -1, 4, 0)})).judge(landing).first_impact_comparable)
      << "it does not go as requested";
}

TEST(Judge, resting_nearness_is_a_contact_with_motion_into_it_and_none_without) {
  for (const double gravity : {-1.0 / 128, 0.0}) {
    Judge judge(header({box(-4, -1, 4, 0), box(0.3125 + 5e-7, 0, 1, 4)}));
    TraceStep rest = step({{0, 0.625 + 5e-7}});
    rest.requested = {0, gravity};
    const StepJudgement judged = judge.judge(rest);
    EXPECT_EQ(judged.contacts.size(), gravity < 0 ? 1U : 0U);
    EXPECT_FALSE(judged.first_impact_comparable) << "a resting gap is no time of impact";
  }
}

TEST(Judge, walking_over_abutting_tiles_touches_only_the_floor) {
  std::vector<ColliderDef> tiles;
  for (int i = 0; i < 8; ++i) tiles.push_back(box(i, -1, i + 1, 0));
  Judge judge(header(tiles));
  int contacts = 0;
  Vec2d at(0.5, 0.625 + 5e-7);
  for (int i = 0; i < 448; ++i) {
    const Vec2d next = at + Vec2d(1.0 / 64, 0);
    TraceStep walk = step({at, next});
    walk.requested = {1.0 / 64, -1.0 / 128};
    for (const ExactContact& contact : judge.judge(walk).contacts) {
      EXPECT_EQ(contact.side, Side::bottom) << "at " << at.x();
      ++contacts;
    }
    at = next;
  }
  EXPECT_GE(contacts, 448);
}

TEST(Judge, walking_into_a_wall_on_the_floor_touches_both) {
  Judge judge(header({box(-4, -1, 4, 0), box(1, 0, 2, 2)}));
  const Vec2d wall(1 - 0.3125 - 5e-7, 0.625 + 5e-7);
  TraceStep walk = step({{0.5, 0.625 + 5e-7}, wall, wall});
  walk.requested = {0.5, -1.0 / 128};
  const StepJudgement judged = judge.judge(walk);
  ASSERT_EQ(judged.contacts.size(), 2U);
  const bool floor_first = judged.contacts[0].collider == 0;
  EXPECT_EQ(judged.contacts[floor_first ? 0 : 1].side, Side::bottom);
  EXPECT_EQ(judged.contacts[floor_first ? 1 : 0].side, Side::right);
}

TEST(Judge, a_concave_polygon_is_touched_on_both_sides_of_a_wedge) {
  const ColliderDef wedge{.points = {{0, 0}, {1, 4}, {2, 4}, {2, -1}, {-2, -1}, {-2, 4}, {-1, 4}}};
  const ColliderDef chain_wedge = chain({{-1, 4}, {0, 0}, {1, 4}});
  // The arms' corners (0.3125, -0.3125) meet the walls |x| = y / 4 where the octagon's centre is this high.
  const double touching = 4 * 0.3125 + 0.3125;
  for (const ColliderDef& def : {wedge, chain_wedge}) {
    Judge judge(header({def}));
    TraceStep rest = step({{0, touching + 1e-6}});
    rest.requested = {0, -1.0 / 128};
    const StepJudgement judged = judge.judge(rest);
    ASSERT_EQ(judged.contacts.size(), 2U);
    EXPECT_NE(judged.contacts[0].side, judged.contacts[1].side);
    for (const ExactContact& contact : judged.contacts) {
      EXPECT_TRUE(contact.side == Side::left || contact.side == Side::right);
      EXPECT_NEAR(std::abs(contact.normal.x()), 4 / std::sqrt(17.0), 1e-15);
    }
  }
}

TEST(Judge, walking_over_a_concave_outline_with_vertices_in_a_row_touches_only_the_floor) {
  ColliderDef map{.points = {{0, -1}, {9, -1}, {9, 3}, {8, 3}}};
  for (int i = 8; i >= 0; --i) map.points.emplace_back(i, 0);
  Judge judge(header({map}));
  for (int i = 0; i < 448; ++i) {  // up to 7.5 m: its side is then 0.2 m from the wall
    const Vec2d at(0.5 + i / 64.0, 0.625 + 5e-7);
    TraceStep walk = step({at, at + Vec2d(1.0 / 64, 0)});
    walk.requested = {1.0 / 64, -1.0 / 128};
    const StepJudgement judged = judge.judge(walk);
    ASSERT_FALSE(judged.contacts.empty());
    for (const ExactContact& contact : judged.contacts) ASSERT_EQ(contact.side, Side::bottom) << "at " << at.x();
  }
}

TEST(Judge, the_gap_of_a_contact_is_the_separation_where_it_stopped) {
  Judge judge(header({box(-4, -1, 4, 0)}));
  TraceStep landing = step({{0, 1}, {0, 0.75}, {2, 0.75}});
  landing.requested = {2, -1};
  landing.contacts.push_back({.collider = 0, .normal = {0, 1}, .fraction = 0.375, .side = Side::bottom});
  EXPECT_EQ(judge.judge(landing).max_contact_gap, 0.125);
}

TEST(Judge, box2d_may_touch_from_its_skin_without_being_right_or_wrong) {
  for (const double gap : {0.015, 0.025}) {
    for (const bool path_exact : {true, false}) {
      Judge judge(header({box(-4, -1, 4, 0)}, path_exact));
      TraceStep rest = step({{0, 0.625 + gap}});
      rest.requested = {0, -1.0 / 128};
      const StepJudgement judged = judge.judge(rest);
      EXPECT_TRUE(judged.contacts.empty());
      EXPECT_EQ(judged.dont_care, !path_exact && gap < 0.020 ? Colliders{0} : Colliders{});
    }
  }
}

TEST(Judge, a_contact_that_is_held_is_neither_right_nor_wrong_up_to_the_gap_that_the_contender_names) {
  TraceHeader head = promising({box(-4, -1, 4, 0)});
  head.tolerances = {{"touch", 7e-7}};
  for (const auto& [gap, request, held] : {std::tuple{5e-7, 3e-7, true}, {9e-7, 3e-7, false}, {9e-7, 8.5e-7, true}}) {
    Judge judge(head);
    TraceStep rest = step({{0, 0.625 + gap}});
    rest.requested = {0, -request};
    rest.contacts = {{.collider = 0, .normal = {0, 1}, .side = Side::bottom}};
    const StepJudgement judged = judge.judge(rest);
    EXPECT_TRUE(judged.contacts.empty()) << gap;
    EXPECT_EQ(judged.dont_care, held ? Colliders{0} : Colliders{}) << gap << " " << request;
    EXPECT_EQ(judged.contact_band, judged.dont_care) << gap << " " << request;
    EXPECT_TRUE(judged.ghosts.empty()) << gap;
    rest.requested = {0, request};
    EXPECT_TRUE(Judge(head).judge(rest).dont_care.empty()) << "it leaves: " << gap;
  }
}

TEST(Judge, a_corner_that_is_passed_within_the_hit_distance_is_neither_right_nor_wrong) {
  // The foot's corner passes the tile's corner halfway, a twentieth of a micrometre above it, and ends far away.
  for (const auto& [above, near] : {std::pair{5e-8, true}, {5e-7, false}}) {
    Judge judge(header({box(-1, -1, -0.15625, 0)}));
    TraceStep pass = step({{-1, 1.625 + above}, {1, -0.375 + above}});
    pass.contacts = {{.collider = 0, .normal = {0, 1}, .fraction = 0.5, .side = Side::bottom}};
    EXPECT_EQ(judge.judge(pass).dont_care, near ? Colliders{0} : Colliders{}) << above;
  }
}

TEST(Judge, a_contact_in_the_skin_is_a_ghost_where_no_face_stands_out) {
  // The foot's corner stands over the seam, just before the second tile, in Box2D's rest gap.
  Judge judge(header({box(-4, -1, 0, 0), box(0, -1, 4, 0)}, false));
  TraceStep rest = step({{-0.15625 - 1e-9, 0.625 + 0.015}});
  rest.requested = {1.0 / 64, -1.0 / 128};
  const double part = 1 / std::sqrt(5.0);
  rest.contacts = {{.collider = 1, .normal = {0, 1}, .side = Side::bottom},
                   {.collider = 1, .normal = {-2 * part, part}, .side = Side::right}};
  const StepJudgement judged = judge.judge(rest);
  EXPECT_TRUE(judged.contacts.empty());
  EXPECT_EQ(judged.dont_care, (Colliders{0, 1}));
  const std::vector<std::pair<ColliderIndex, Side>> ghosts{{1, Side::right}};
  EXPECT_EQ(judged.ghosts, ghosts);
}

TEST(Judge, a_collider_behind_a_seam_is_neither_right_nor_wrong) {
  // The foot's corner falls within rounding of the seam: the second tile is met at its vertex, which is no corner of
  // the floor.
  const double below_seam = std::nextafter(4 - 0.15625, 0.0);
  Judge judge(header({box(-4, -1, 4, 0), box(4, -1, 8, 0)}));
  TraceStep rest = step({{below_seam, 0.625 + 5e-7}});
  rest.requested = {0, -1.0 / 128};
  rest.contacts = {{.collider = 0, .normal = {0, 1}, .side = Side::bottom},
                   {.collider = 1, .normal = {0, 1}, .side = Side::bottom}};
  const StepJudgement judged = judge.judge(rest);
  ASSERT_EQ(judged.contacts.size(), 1U);
  EXPECT_EQ(judged.contacts[0].collider, 0U);
  EXPECT_EQ(judged.dont_care, Colliders{1});
  EXPECT_TRUE(judged.ghosts.empty());

  rest.contacts[1] = {.collider = 1, .normal = {-1, 0}, .side = Side::right};
  EXPECT_EQ(judge.judge(rest).ghosts.size(), 1U) << "a wall where no face stands out";
}

/// In a valley of one polygon, 30 and 60 degrees, the steep side is met first, and what is left leads into the other.
TEST(Judge, one_collider_deflects_the_motion_into_another_side_of_itself) {
  const double steep = std::sqrt(27.0);
  const Vec2d flat(-0.5, std::sqrt(0.75));
  const Vec2d wall(-std::sqrt(0.75), 0.5);
  const Vec2d at = Vec2d(-0.15625, 0.625) + 5e-7 / (1 + flat.dot(wall)) * (flat + wall);
  const auto judged_with = [&](const Vec2d& normal, double away) {
    TraceHeader valley = promising({polygon({{-8, -8 / std::sqrt(3.0)}, {-8, -9}, {3, -9}, {3, steep}, {0, 0}})});
    valley.tolerances = {{"touch", 7e-7}};
    Judge judge(valley);
    TraceStep held = step({at + away * flat, at + away * flat});
    held.requested = {1.0 / 64, -1.0 / 128};
    held.contacts = {{.normal = wall, .side = Side::right}, {.normal = normal, .side = Side::bottom}};
    return judge.judge(held).deflected;
  };
  const std::pair<ColliderIndex, Side> bottom{0, Side::bottom};
  EXPECT_EQ(judged_with(flat, 0), std::vector{bottom});
  EXPECT_TRUE(judged_with({0.5, std::sqrt(0.75)}, 0).empty()) << "no face has that normal";
  EXPECT_TRUE(judged_with(flat, 2e-6).empty()) << "it is not touched";
}

TEST(Judge, speed_lost_to_nothing_is_a_ghost_and_speed_lost_to_a_wall_is_none) {
  const std::vector<ColliderDef> floor{box(-4, -1, 0, 0), box(0, -1, 4, 0), box(2, 0, 3, 2)};
  TraceStep snag = step({{-0.5, 0.625 + 5e-7}, {-0.25, 0.625 + 5e-7}});
  snag.requested = {0.5, -1.0 / 128};
  snag.velocity = {0.25 * 0.5 / dt, 0};
  EXPECT_EQ(Judge(header(floor)).judge(snag).ghost_speed_loss, 0.75);

  TraceStep wall = step({{1.5, 0.625 + 5e-7}, {2 - 0.3125 - 5e-7, 0.625 + 5e-7}});
  wall.requested = {0.5, -1.0 / 128};
  wall.velocity = {0, 0};
  EXPECT_EQ(Judge(header(floor)).judge(wall).ghost_speed_loss, 0);

  TraceStep smooth = step({{-0.5, 0.625 + 5e-7}, {0, 0.625 + 5e-7}});
  smooth.requested = {0.5, -1.0 / 128};
  smooth.velocity = {0.5 / dt, 0};
  EXPECT_EQ(Judge(header(floor)).judge(smooth).ghost_speed_loss, 0);
}

TEST(Judge, a_run_far_from_everything_has_nothing_to_report) {
  Judge judge(header({box(-4, -1, 4, 0)}));
  const StepJudgement judged = judge.judge(step({{100, 100}, {101, 99}}));
  EXPECT_TRUE(judged.contacts.empty());
  EXPECT_FALSE(judged.first_impact);
  EXPECT_EQ(judge.scenery().rational_decisions(), 0U);
}

}  // namespace
}  // namespace paperproof::compare
