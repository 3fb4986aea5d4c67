#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

/// Which contacts the judge demands, which it confirms, and which it does not: cases that random runs came to.
namespace paperproof::compare::test {
namespace {

/// The normal of the octagon's lower left side, as an obstacle has it.
Vec2d lower_left() { return Vec2d(2, 1) / std::sqrt(5.0); }

/// Two walls that end at height 0, so far beside the octagon at x = 0.
std::vector<ColliderDef> shaft(double left, double right) {
  return {box(-2, -8, -half_width - left, 0), box(half_width + right, -8, 2, 0)};
}

/// A walker along a floor begins above the line of a ledge, which falls towards it, and runs into its tip, beside which
/// it is above no more.
TEST(JudgeOfContacts, a_ledge_is_met_at_its_tip_by_a_leg_that_began_above_it) {
  const TraceHeader scene = promising({box(-8, -1, 9, 0), one_way(chain({{-4, 0.75}, {-1, 0.5}}))});
  for (const auto& [from, above] : {std::pair{7.0, true}, {4.0, false}}) {
    ASSERT_EQ(0.5 - (from - 0.15625 + 1) * 0.25 / 3 < 0, above) << "the line under the foot's left end";
    const Vec2d tip(-1 + half_width + gap, standing);
    const TraceStep walk = step({{from, tip.y()}, tip, tip}, Vec2d(2 * (tip.x() - from), -1.0 / 128),
                                {contact(0, {0, 1}), contact(1, {1, 0}, 0.5)});
    EXPECT_EQ(judged(scene, walk).deflected, above ? (Touches{{1, Side::left}}) : Touches{}) << from;
  }
}

TEST(JudgeOfContacts, what_another_contact_keeps_the_motion_from_is_not_demanded) {
  // Beside a wall, and over the corner of a tile: the wall is met first, and what it leaves falls beside the tile.
  const ColliderDef tile = box(0.15625 + 1.5 * gap, -1, 4, 0);
  const Vec2d beside(0, half_height + 1.2e-7);
  const TraceStep held = step({beside, beside}, Vec2d(0.64, -0.04));
  EXPECT_EQ(demanded(judged(header({tile, box(half_width + gap, 0.4, 4, 2)}), held)), (Touches{{1, Side::right}}));
  EXPECT_EQ(demanded(judged(header({tile}), held)), (Touches{{0, Side::bottom}})) << "nothing keeps it";
  // A corner of the ceiling stops a step of 11 m, which would have come down by half a micrometre onto the next tile.
  const Vec2d rim = Vec2d(-0.234375, standing + 0.46875) - gap * Vec2d(2, -1) / std::sqrt(5.0);
  std::vector<ColliderDef> floor{box(-0.25, -1, 4, 0), box(-4, -1, -0.25, 0)};
  const TraceStep stopped = step({{0, standing}, {0, standing}}, Vec2d(-11, -5e-6));
  EXPECT_EQ(demanded(judged(promising(floor), stopped)), (Touches{{1, Side::bottom}})) << "nothing stops it";
  floor.push_back(box(-4, rim.y(), rim.x(), 3));
  EXPECT_EQ(demanded(judged(promising(floor), stopped)), (Touches{{2, Side::left}}));
}

/// In a valley that is one collider, at rest within its skin of both sides: the motion meets the nearer side alone.
TEST(JudgeOfContacts, within_a_skin_both_sides_of_a_valley_are_held) {
  ColliderDef valley;
  valley.points = {{-4, 8}, {-4, -1}, {4, -1}, {4, 8}, {0, 0}};
  const Vec2d right_side(-lower_left().x(), lower_left().y());
  const Vec2d rest(1e-3, 0.9375 + 5e-3 * std::sqrt(5.0));
  for (const bool path_exact : {true, false}) {
    TraceHeader scene = header({valley}, path_exact);
    scene.tolerances = {{"touch", 0.01}};
    TraceStep held = step({rest, rest}, Vec2d(0, -1.0 / 32), {contact(0, lower_left()), contact(0, right_side)});
    const StepJudgement both = judged(scene, held);
    EXPECT_EQ(demanded(both), (Touches{{0, Side::right}}));
    EXPECT_EQ(both.dont_care, Colliders{0});
    EXPECT_TRUE(both.ghosts.empty());
    held.contacts = {contact(0, {0, 1})};
    const StepJudgement none = judged(scene, held);
    EXPECT_TRUE(none.dont_care.empty() || none.ghosts == (Touches{{0, Side::bottom}})) << "no face is level";
  }
}

/// At the mouth of a shaft the exact octagon would fall past both rims, and meet the right wall far below.
TEST(JudgeOfContacts, no_contact_is_demanded_behind_an_opening_that_counts_as_closed) {
  for (const auto& [aside, open] : {std::pair{2e-9, false}, {8e-7, true}}) {
    const double above = 0.3125 + (gap - aside * lower_left().x()) / lower_left().y();
    TraceStep mouth = step({{0, above}, {0, above}}, Vec2d(0.02, -560));
    mouth.up = Vec2d(-5, 7).normalized();  // for which the rim and the wall are on different sides
    const std::vector<ExactContact> all = judged(promising(shaft(aside, aside)), mouth).contacts;
    EXPECT_EQ(std::any_of(all.begin(), all.end(),
                          [](const ExactContact& one) { return one.collider == 1 && one.normal == Vec2d(-1, 0); }),
              open);
  }
}

TEST(JudgeOfContacts, what_a_rim_turns_aside_meets_the_other_wall_of_a_shaft) {
  // An octagon that falls exactly along a wall, as far as its rim is concerned, comes within the hit distance of that
  // rim: it may be turned aside by it, and meet the other wall.
  constexpr double aside = 1.5e-5;
  const double rim = 0.3125 + gap * std::sqrt(5.0);
  const Touches right{{1, Side::right}};
  TraceStep fall = step({{0, rim + 1}, {0, rim}, {aside, rim - 2 * aside}, {aside, rim - 0.5}}, Vec2d(0, -1.5),
                        {contact(0, lower_left(), 0.4), contact(1, {-1, 0}, 0.5)});
  EXPECT_EQ(judged(promising(shaft(0, aside + gap)), fall).contact_band, Touches({{0, Side::left}}));
  EXPECT_EQ(judged(promising(shaft(0, aside + gap)), fall).deflected, right);
  fall.contacts.erase(fall.contacts.begin());
  EXPECT_TRUE(judged(promising(shaft(0, aside + gap)), fall).deflected.empty()) << "nothing turned it";
  // Sliding along the left rim the octagon meets the side of the right wall, although beside the corner of the way its
  // slanted side is nearer to that wall's rim.
  const Vec2d end(gap, 0.3125 + 1.5e-7);
  for (const Vec2d& normal : {Vec2d(-1, 0), Vec2d(0, 1)}) {
    const TraceStep slides = step({{0, 1.3125}, {0, end.y() + 2 * gap}, end, {gap, -20}}, Vec2d(0, -30),
                                  {contact(0, lower_left(), 0.3), contact(1, normal, 0.6)});
    EXPECT_EQ(judged(promising(shaft(0, 2 * gap)), slides).deflected, normal.y() > 0 ? Touches{} : right);
  }
}

TEST(JudgeOfContacts, a_start_without_a_gap_is_moved_away_before_it_meets_anything) {
  const TraceHeader wall = promising({box(half_width, -4, 2, 4)});
  for (const auto& [request, at_once, meets] :
       {std::tuple{5e-16, false, true}, {5e-16, true, false}, {1e-6, true, true}}) {
    TraceStep away = step({{0, 0}, {-gap, 0}, {-gap, 7}}, Vec2d(request, 7));
    if (at_once) away.path[1].fraction = 0;
    EXPECT_EQ(demanded(judged(wall, away)), meets ? (Touches{{0, Side::right}}) : Touches{}) << request << at_once;
  }
}

/// A launch along a wall comes within the hit distance of it before it is past the wall's end: that takes its speed.
TEST(JudgeOfContacts, what_comes_within_the_hit_distance_takes_speed) {
  const TraceHeader wall = promising({box(half_width + gap, 0.1875, 2, 1.1875)});
  const Vec2d requested(1.0 / 64, 6e4);
  TraceStep launch = step({{0, 0}, {0, 6e4}}, requested);
  // Half a micrometre takes 3.2e-5 of the step, and in that time it rises past the wall; not in four fifths of it.
  ASSERT_GT(gap / requested.x() * 6e4, 1.1875 + half_width);
  ASSERT_LT((gap - 1e-7) / requested.x() * 6e4 - half_width, 1.1875 + 0.1);
  EXPECT_GT(judged(wall, launch).motion_lost, 0.01);
  launch.contacts = {contact(0, {-1, 0}, (gap - 1e-7) / requested.x())};
  EXPECT_EQ(judged(wall, launch).motion_lost, 0);
}

/// A rest in a corner of a level floor and a wall, with a slanted up: that the motion straight down goes across up by
/// nothing is known to rounding only, and the wall is held.
TEST(JudgeOfContacts, a_wall_that_is_held_is_met_or_not_by_the_rounding_of_a_slanted_up) {
  for (const bool slanted : {true, false}) {
    const Vec2d up = Vec2d(slanted ? 4 : 0, 9).normalized();
    TraceHeader corner = promising({box(-4, -1, 4, 0), box(half_width + gap, 0, 2, 2)});
    corner.gravity = -32 * up;
    corner.up = up;
    TraceStep rest =
        step({{0, standing}, {0, standing}}, -up / 128, {contact(0, {0, 1}, 6e-5), contact(1, {-1, 0}, 1)});
    rest.up = up;
    EXPECT_EQ(judged(corner, rest).contact_band, slanted ? Touches({{1, Side::right}}) : Touches{});
  }
}

/// The end of a ledge that rises to the right: the octagon is above its line, a larger one is not.
TEST(JudgeOfContacts, who_is_above_a_ledge_does_not_fall_freely_past_it) {
  const double slope = 1.0 / 16;
  TraceHeader header = promising({one_way(chain({{-1, -slope}, {0, 0}}))});
  header.gravity = {0, -32};
  const Vec2d requested(0.05, -1.0 / 128);
  // The right end of the foot is a centimetre beyond the tip.
  const Vec2d begin(0.01 - 0.15625, half_height + 0.01 * slope + 1e-7);
  TraceStep land =
      step({begin, {0.02 - 0.15625, standing}, {0.06 - 0.15625, standing}}, requested, {contact(0, {0, 1}, 0.2)});
  land.velocity = {0.05 / dt, 0};
  EXPECT_EQ(judged(header, land, wanting(requested)).speed_lost, 0);
  land.path = {{begin, 0}, {begin + Vec2d(0.05, 1), 1}};
  EXPECT_GT(judged(header, land, wanting(requested)).way_gained, 0) << "nothing gives it a rise";
}

/// On a slope of 45 degrees a walk climbs as fast as it goes across; a wall gives no rise, and where nothing is near
/// nothing rises.
TEST(JudgeOfContacts, who_rises_has_ground_to_climb) {
  const double height = -0.78125 - gap * std::sqrt(2);  // at x = 0
  const ColliderDef slope = polygon({{-4, height - 4}, {4, height - 4}, {4, height + 4}});
  for (const auto& [near, rise, gained] : {std::tuple{slope, 0.0625, false},
                                           {slope, 0.0626, true},
                                           {box(half_width + gap, -4, 4, 4), 0.01, true},
                                           {box(-4, -9, 4, -8), 0.01, true}}) {
    const Vec2d requested(0.0625, -0.0078125);
    TraceStep climb = step({{0, 0}, {0.0625, 0.0625}}, requested);
    climb.velocity = Vec2d(0.0625, rise) / dt;
    Wanted wanted = wanting(requested);
    wanted.from_ground = true;
    EXPECT_EQ(judged(promising({near}), climb, wanted).speed_gained > 0, gained) << rise;
  }
}

/// A wall that is touched at 1e6 m/s leaves all of the speed, or nothing: what is the least has no share in what is the
/// rounding of the most, 1e-9 of it.
TEST(JudgeOfContacts, a_speed_is_known_to_a_share_of_the_largest_that_the_law_allows) {
  const double fast = 0x1p20;
  const TraceHeader wall = promising({box(fast * dt + half_width + gap, -4, fast * dt + 4, 4)});
  for (const auto& [beyond, gained] : {std::pair{0.0, false}, {0x1p-11, false}, {0x1p-9, true}}) {
    TraceStep flight = step({{0, 0}, {fast * dt, 0}}, {}, {contact(0, {-1, 0}, 1)});
    flight.velocity.x() = fast + beyond;
    EXPECT_EQ(judged(wall, flight, wanting({fast * dt, 0})).speed_gained > 0, gained) << beyond;
  }
}

/// Between the tip of a one-way ledge and a steep slope: the last leg that moved began above the ledge.
TEST(JudgeOfContacts, a_wedge_with_the_tip_of_a_ledge_holds_who_has_waited_in_it) {
  const double slope = 2;  // of the ground to the right, 63 degrees
  const Vec2d touch = Vec2d(0.3125, -0.3125) - gap * lower_right();
  ASSERT_LT((Vec2d(0.15625, -0.625) - touch).dot(lower_right()), gap + 1e-9);
  TraceHeader header = promising(
      {one_way(chain({{-3, 0.5}, {-half_width - gap, 0}})),
       polygon({touch - Vec2d(1, slope), Vec2d(4, touch.y() - slope), touch + (4 - touch.x()) * Vec2d(1, slope)})});
  header.gravity = {0, -32};
  // Or it waited all along, and never was above.
  for (const Vec2d& from : {Vec2d(1, 2.5), Vec2d(0, 0)}) {
    TraceStep wedged =
        step({from, {0, 0}, {0, 0}}, Vec2d(-4, -10), {contact(0, {1, 0}, 0.25), contact(1, lower_right(), 0.25)});
    wedged.path[1].fraction = 0.25;
    wedged.velocity = {0, 0};
    wedged.grounded = true;
    EXPECT_EQ(judged(header, wedged, wanting({-4, -10})).ground_refuted, from.y() == 0);
  }
}

}  // namespace
}  // namespace paperproof::compare::test
