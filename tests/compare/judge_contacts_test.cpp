#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// Which contacts the judge demands, which it confirms, and which it does not: cases that random runs came to.
namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Touches = std::vector<std::pair<ColliderIndex, Side>>;

constexpr double gap = 5e-7;  ///< Where a motion is stopped [m].

Touches demanded(const StepJudgement& judged) {
  Touches all;
  for (const ExactContact& contact : judged.contacts) all.emplace_back(contact.collider, contact.side);
  std::sort(all.begin(), all.end());
  return all;
}

Contact<double> contact(ColliderIndex collider, const Vec2d& normal, double fraction, Side side) {
  return {.collider = collider, .normal = normal, .fraction = fraction, .side = side};
}

/// The normal of the octagon's lower left side, as an obstacle has it.
Vec2d lower_left() { return Vec2d(2, 1) / std::sqrt(5.0); }

/// A walker along a floor begins above the line of a ledge, which falls towards it, and runs into its tip, beside which
/// it is above no more.
TEST(JudgeOfContacts, a_ledge_is_met_at_its_tip_by_a_leg_that_began_above_it) {
  const std::vector<ColliderDef> scene{box(-8, -1, 9, 0), chain({{-4, 0.75}, {-1, 0.5}}, Vec2d(0, 1))};
  for (const auto& [from, above] : {std::pair{7.0, true}, {4.0, false}}) {
    const double foot = 0.5 - (from - 0.15625 + 1) * 0.25 / 3;  // the line under the foot's left end
    ASSERT_EQ(foot < 0, above);
    const Vec2d tip(-1 + 0.3125 + gap, 0.625 + gap);
    TraceStep walk = step({{from, tip.y()}, tip, tip});
    walk.requested = {2 * (tip.x() - from), -1.0 / 128};
    walk.contacts = {contact(0, {0, 1}, 0, Side::bottom), contact(1, {1, 0}, 0.5, Side::left)};
    EXPECT_EQ(Judge(promising(scene)).judge(walk).deflected, above ? (Touches{{1, Side::left}}) : Touches{}) << from;
  }
}

/// Beside a wall, and over the corner of a tile: the wall is met first, and what it leaves falls beside the tile.
TEST(JudgeOfContacts, what_another_contact_keeps_the_motion_from_is_not_demanded) {
  const ColliderDef tile = box(0.15625 + 1.5 * gap, -1, 4, 0);
  TraceStep held = step({{0, 0.625 + 1.2e-7}, {0, 0.625 + 1.2e-7}});
  held.requested = {0.64, -0.04};
  EXPECT_EQ(demanded(Judge(header({tile, box(0.3125 + gap, 0.4, 4, 2)})).judge(held)), (Touches{{1, Side::right}}));
  EXPECT_EQ(demanded(Judge(header({tile})).judge(held)), (Touches{{0, Side::bottom}})) << "nothing keeps it";
}

/// A corner of the ceiling stops a step of 11 m, which would have come down by half a micrometre onto the next tile.
TEST(JudgeOfContacts, what_is_near_only_along_the_normal_is_not_demanded) {
  const Vec2d rim = Vec2d(-0.234375, 0.625 + gap + 0.46875) - gap * Vec2d(2, -1) / std::sqrt(5.0);
  const std::vector<ColliderDef> floor{box(-0.25, -1, 4, 0), box(-4, -1, -0.25, 0)};
  std::vector<ColliderDef> below = floor;
  below.push_back(box(-4, rim.y(), rim.x(), 3));
  TraceStep stopped = step({{0, 0.625 + gap}, {0, 0.625 + gap}});
  stopped.requested = {-11, -5e-6};
  EXPECT_EQ(demanded(Judge(promising(below)).judge(stopped)), (Touches{{2, Side::left}}));
  EXPECT_EQ(demanded(Judge(promising(floor)).judge(stopped)), (Touches{{1, Side::bottom}})) << "nothing stops it";
}

/// At the mouth of a shaft the exact octagon would fall past both rims, and meet the right wall far below.
TEST(JudgeOfContacts, no_contact_is_demanded_behind_an_opening_that_counts_as_closed) {
  for (const auto& [aside, open] : {std::pair{2e-9, false}, {8e-7, true}}) {
    const std::vector<ColliderDef> shaft{box(-2, -8, -0.3125 - aside, 0), box(0.3125 + aside, -8, 2, 0)};
    const double above = 0.3125 + (gap - aside * lower_left().x()) / lower_left().y();
    TraceStep mouth = step({{0, above}, {0, above}});
    mouth.requested = {0.02, -560};
    mouth.up = Vec2d(-5, 7).normalized();  // for which the rim and the wall are on different sides
    const std::vector<ExactContact> contacts = Judge(promising(shaft)).judge(mouth).contacts;
    EXPECT_EQ(std::any_of(contacts.begin(), contacts.end(),
                          [](const ExactContact& one) { return one.collider == 1 && one.normal == Vec2d(-1, 0); }),
              open)
        << aside;
  }
}

/// An octagon that falls exactly along a wall, as far as its rim is concerned, comes within the hit distance of that
/// rim: it may be turned aside by it, and meet the other wall.
TEST(JudgeOfContacts, what_comes_within_the_hit_distance_turns_a_motion_aside) {
  constexpr double aside = 1.5e-5;
  const std::vector<ColliderDef> shaft{box(-2, -8, -0.3125, 0), box(0.3125 + aside + gap, -8, 2, 0)};
  const double rim = 0.3125 + gap * std::sqrt(5.0);
  TraceStep fall = step({{0, rim + 1}, {0, rim}, {aside, rim - 2 * aside}, {aside, rim - 0.5}});
  fall.requested = {0, -1.5};
  fall.contacts = {contact(0, lower_left(), 0.4, Side::left), contact(1, {-1, 0}, 0.5, Side::right)};
  const StepJudgement judged = Judge(promising(shaft)).judge(fall);
  EXPECT_EQ(judged.contact_band, std::vector<ColliderIndex>{0});
  EXPECT_EQ(judged.deflected, (Touches{{1, Side::right}}));
  fall.contacts.erase(fall.contacts.begin());
  EXPECT_TRUE(Judge(promising(shaft)).judge(fall).deflected.empty()) << "nothing turned it";
}

/// Sliding along the left rim the octagon meets the side of the right wall, although beside the corner of the way its
/// slanted side is nearer to that wall's rim.
TEST(JudgeOfContacts, a_face_is_there_where_a_leg_would_come_to) {
  const Vec2d end(gap, 0.3125 + 1.5e-7);
  const std::vector<ColliderDef> shaft{box(-2, -8, -0.3125, 0), box(0.3125 + 2 * gap, -8, 2, 0)};
  TraceStep fall = step({{0, 1.3125}, {0, end.y() + 2 * gap}, end, {gap, -20}});
  fall.requested = {0, -30};
  fall.contacts = {contact(0, lower_left(), 0.3, Side::left), contact(1, {-1, 0}, 0.6, Side::right)};
  EXPECT_EQ(Judge(promising(shaft)).judge(fall).deflected, (Touches{{1, Side::right}}));
  fall.contacts[1].normal = {0, 1};
  fall.contacts[1].side = Side::bottom;
  EXPECT_TRUE(Judge(promising(shaft)).judge(fall).deflected.empty()) << "there is no such face";
}

TEST(JudgeOfContacts, a_start_without_a_gap_is_moved_away_before_it_meets_anything) {
  const std::vector<ColliderDef> wall{box(0.3125, -4, 2, 4)};
  TraceStep away = step({{0, 0}, {-gap, 0}, {-gap, 7}});
  away.requested = {5e-16, 7};
  EXPECT_EQ(demanded(Judge(promising(wall)).judge(away)), (Touches{{0, Side::right}})) << "not at once";
  away.path[1].fraction = 0;
  EXPECT_TRUE(Judge(promising(wall)).judge(away).contacts.empty());
  away.requested = {1e-6, 7};
  EXPECT_EQ(demanded(Judge(promising(wall)).judge(away)), (Touches{{0, Side::right}})) << "it comes back";
}

/// A launch along a wall comes within the hit distance of it before it is past the wall's end: that takes its speed.
TEST(JudgeOfContacts, what_comes_within_the_hit_distance_takes_speed) {
  const std::vector<ColliderDef> wall{box(0.3125 + gap, 0.1875, 2, 1.1875)};
  TraceStep launch = step({{0, 0}, {0, 6e4}});
  launch.requested = {1.0 / 64, 6e4};
  launch.velocity = {0, 6e4 / dt};
  // Half a micrometre takes 3.2e-5 of the step, and in that time it rises past the wall; not in four fifths of it.
  const double meets = gap / launch.requested.x();
  ASSERT_GT(meets * 6e4, 1.1875 + 0.3125);
  ASSERT_LT((gap - 1e-7) / launch.requested.x() * 6e4 - 0.3125, 1.1875 + 0.1);
  launch.contacts = {contact(0, {-1, 0}, (gap - 1e-7) / launch.requested.x(), Side::right)};
  EXPECT_EQ(Judge(promising(wall)).judge(launch).motion_lost, 0);
  launch.contacts.clear();
  EXPECT_GT(Judge(promising(wall)).judge(launch).motion_lost, 0.01);
}

/// A rest in a corner of a level floor and a wall, with a slanted up: that the motion straight down goes across up by
/// nothing is known to rounding only, and the wall is held.
TEST(JudgeOfContacts, a_wall_that_is_held_is_met_or_not_by_the_rounding_of_a_slanted_up) {
  const std::vector<ColliderDef> corner{box(-4, -1, 4, 0), box(0.3125 + gap, 0, 2, 2)};
  const auto band = [&](const Vec2d& up) {
    TraceHeader header = promising(corner);
    header.gravity = -32 * up;
    header.up = up;
    const Vec2d at(0, 0.625 + gap);
    TraceStep rest = step({at, at});
    rest.up = up;
    rest.requested = -up / 128;
    rest.contacts = {contact(0, {0, 1}, 6e-5, Side::bottom), contact(1, {-1, 0}, 1, Side::right)};
    return Judge(header).judge(rest).contact_band;
  };
  EXPECT_EQ(band(Vec2d(4, 9).normalized()), std::vector<ColliderIndex>{1});
  EXPECT_TRUE(band({0, 1}).empty()) << "straight down is straight down";
}

TEST(JudgeOfContacts, the_rounding_of_a_fall_along_a_slanted_up_is_no_speed) {
  TraceHeader header = promising({box(-4, -9, 4, -8)});
  const Vec2d up = Vec2d(-5, 6).normalized();
  header.up = up;
  TraceStep fall = step({{0, 0}, -up / 64});
  fall.up = up;
  fall.velocity = fall.requested / dt + Vec2d(up.y(), -up.x()) * 1e-16;
  EXPECT_EQ(Judge(header).judge(fall).ghost_speed_loss, 0);
}

/// The end of a ledge that rises to the right: the octagon is above its line, a larger one is not.
TEST(JudgeOfContacts, who_is_above_a_ledge_does_not_fall_freely_past_it) {
  const double slope = 1.0 / 16;
  TraceHeader header = promising({chain({{-1, -slope}, {0, 0}}, Vec2d(0, 1))});
  header.gravity = {0, -32};
  const double foot = 0.01 * slope + 1e-7;  // where the right end of the foot is a centimetre beyond the tip
  TraceStep land = step({{0.01 - 0.15625, 0.625 + foot}, {0.02 - 0.15625, 0.625 + gap}, {0.06 - 0.15625, 0.625 + gap}});
  land.requested = {0.05, -1.0 / 128};
  land.velocity = {0.05 / dt, 0};
  land.contacts = {contact(0, {0, 1}, 0.2, Side::bottom)};
  Wanted wanted;
  wanted.displacement = land.requested;
  wanted.velocity = land.requested / dt;
  EXPECT_EQ(Judge(header).judge(land, {}, &wanted).speed_lost, 0);
  land.path = {{land.path[0].position, 0}, {land.path[0].position + Vec2d(0.05, 1), 1}};
  EXPECT_GT(Judge(header).judge(land, {}, &wanted).way_gained, 0) << "nothing gives it a rise";
}

/// On a slope of 45 degrees a walk climbs as fast as it goes across; a wall gives no rise, and where nothing is near
/// nothing rises.
TEST(JudgeOfContacts, who_rises_has_ground_to_climb) {
  const double height = -0.78125 - gap * std::sqrt(2);  // at x = 0
  const ColliderDef slope = polygon({{-4, height - 4}, {4, height - 4}, {4, height + 4}});
  const auto gained = [&](const ColliderDef& near, double rise) {
    TraceStep climb = step({{0, 0}, {0.0625, 0.0625}});
    climb.requested = {0.0625, -0.0078125};
    climb.velocity = Vec2d(0.0625, rise) / dt;
    Wanted wanted;
    wanted.displacement = climb.requested;
    wanted.velocity = climb.requested / dt;
    wanted.from_ground = true;
    return Judge(promising({near})).judge(climb, {}, &wanted).speed_gained > 0;
  };
  EXPECT_FALSE(gained(slope, 0.0625));
  EXPECT_TRUE(gained(slope, 0.0626));
  EXPECT_TRUE(gained(box(0.3125 + gap, -4, 4, 4), 0.01)) << "a wall";
  EXPECT_TRUE(gained(box(-4, -9, 4, -8), 0.01)) << "nothing near";
}

/// Between the tip of a one-way ledge and a steep slope: the last leg that moved began above the ledge.
TEST(JudgeOfContacts, a_wedge_with_the_tip_of_a_ledge_holds_who_has_waited_in_it) {
  const Vec2d at(0, 0);
  const double slope = 2;  // of the ground to the right, 63 degrees
  const Vec2d n = Vec2d(-slope, 1).normalized();
  const Vec2d foot = Vec2d(0.15625, -0.625);
  const Vec2d touch = Vec2d(0.3125, -0.3125) - gap * n;
  ASSERT_LT((foot - touch).dot(n), gap + 1e-9);
  const std::vector<ColliderDef> scene{chain({{-3, 0.5}, {-0.3125 - gap, 0}}, Vec2d(0, 1)),
                                       polygon({Vec2d(touch - Vec2d(1, slope)), Vec2d(4, touch.y() - slope),
                                                Vec2d(touch + (4 - touch.x()) * Vec2d(1, slope))})};
  TraceHeader header = promising(scene);
  header.gravity = {0, -32};
  TraceStep wedged = step({{1, 2.5}, at, at});
  wedged.path[1].fraction = 0.25;
  wedged.requested = {-4, -10};
  wedged.velocity = {0, 0};
  wedged.grounded = true;
  wedged.contacts = {contact(0, {1, 0}, 0.25, Side::left), contact(1, n, 0.25, Side::right)};
  Wanted wanted;
  wanted.displacement = wedged.requested;
  wanted.velocity = wedged.requested / dt;
  EXPECT_FALSE(Judge(header).judge(wedged, {}, &wanted).ground_refuted);
  wedged.path[0].position = at;  // it waited all along, and never was above
  EXPECT_TRUE(Judge(header).judge(wedged, {}, &wanted).ground_refuted);
}

}  // namespace
}  // namespace paperproof::compare
