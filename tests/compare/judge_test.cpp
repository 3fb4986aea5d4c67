#include "compare/judge_steps.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

constexpr double fall = 1.0 / 128;  // in a step [m]

ColliderDef floor_at(double height) { return box(-4, height - 1, 4, height); }

/// One after the other.
struct Moment {
  std::vector<Vec2d> path;
  const char* told = "";
  bool respawn = false;
  Colliders dropped_through{};
};
struct Story {
  const char* what;
  std::vector<ColliderDef> solids;
  std::vector<Moment> moments;
};

TEST(Judge, follows_a_stay_inside_of_solids_over_steps) {
  const ColliderDef slab = box(-4, 0, 4, 0.5);
  const ColliderDef line = one_way(chain({{-4, 0}, {4, 0}}));
  const ColliderDef lower = one_way(chain({{-4, -1}, {4, -1}}));
  const std::vector<Story> stories{
      {"going around is free", {slab}, {{{{0, 1.2}, {5, 1.2}, {5, -1}, {0, -1}}}}},
      {"leaving on another side steps later is tunnelling, once",
       {slab},
       {{{{0, 2}, {0, 1}}, "inside 0, entered 0"},
        {{{0, 1}, {0, 0}}, "inside 0"},
        {{{0, 0}, {0, -2}}, "tunnelled 0"},
        {{{0, -2}, {0, -3}}}}},
      {"leaving on the side it was entered is none",
       {slab},
       {{{{0, 2}, {0, 1}}, "inside 0, entered 0"}, {{{0, 1}, {1, 0.75}}, "inside 0"}, {{{1, 0.75}, {2, 2}}}}},
      {"nor is leaving what the run began in", {slab}, {{{{0, 0.9}, {0, 0.5}}, "inside 0"}, {{{0, 0.5}, {0, -2}}}}},
      {"a respawn ends a stay, also at the same place",
       {slab},
       {{{{0, 2}, {0, 0.5}}, "inside 0, entered 0"},
        {{{0, -5}, {0, -6}}, "", true},
        {{{0, 2}, {0, 0.5}}, "inside 0, entered 0"},
        {{{0, 0.5}, {0, -6}}, "", true}}},
      {"what is dropped through is excused, and no solid that is said to be",
       {line, lower, box(-4, -3, 4, -2.9)},
       {{{{0, 1}, {0, -4}}, "tunnelled 2, one-way broken 1", false, {0, 2}},
        {{{0, 1}, {0, -4}}, "tunnelled 2", false, {0, 1}}}},
  };
  for (const Story& story : stories) {
    SCOPED_TRACE(story.what);
    Judge judge(header(story.solids));
    for (const Moment& moment : story.moments) {
      TraceStep one = step(moment.path);
      one.respawn = moment.respawn;
      one.dropped_through = moment.dropped_through;
      EXPECT_EQ(told(judge.judge(one)), moment.told);
    }
  }
  EXPECT_EQ(judged(header({slab}), step({{0, 2}, {0, 1}})).max_penetration, 0.5 - (1 - half_height));
}

TEST(Judge, a_one_way_hill_is_broken_on_its_peak_and_its_sides_and_not_beside_it) {
  const TraceHeader hill = header({one_way(chain({{-4, 0}, {0, 1}, {4, 0}}))});
  // On the peak no octagon is above the straight line of either side.
  for (const double x : {-5.0, -4.0, -2.0, -0.1, 0.0, 0.1, 2.0, 4.0, 5.0})
    EXPECT_EQ(told(judged(hill, step({{x, 1.7}, {x, -2}}))), std::abs(x) < 5 ? "one-way broken 0" : "") << x;
}

TEST(Judge, a_passing_is_told_with_speed_thickness_and_angle_to_the_face) {
  constexpr double thickness = 1.0 / 128;
  const ColliderDef paper = box(-4, 0, 4, thickness);
  const ColliderDef moving = box(-4, 0, 4, thickness, 0);
  const Motions up{{{0, -3}, {0, 5}}};
  for (const auto& [there, one, speed, angle] : {std::tuple{paper, step({{0, 1}, {0, -1}}), 2 / dt, 90.0},
                                                 {paper, step({{-1, 1}, {1, -1}}), 2 * std::hypot(1, 1) / dt, 45.0},
                                                 {moving, among(step({{0, 0}, {0, 0}}), up), 8 / dt, 90.0}}) {
    const double rounding = there.mover == no_mover ? 0x1p-57 : 1e-15;  // four ulps, or that of a way of metres
    const StepJudgement passed = judged(header({there}), one);
    EXPECT_EQ(told(passed), "tunnelled 0");
    ASSERT_EQ(passed.passings.size(), 1U);
    EXPECT_DOUBLE_EQ(passed.passings[0].speed, speed);
    EXPECT_NEAR(passed.passings[0].thickness, thickness, rounding);
    EXPECT_NEAR(passed.passings[0].angle, angle, 1e-9);
  }
}

TEST(Judge, a_paper_of_any_thickness_is_never_clipped_nor_by_who_is_smaller_than_the_rim) {
  for (const double thickness : {1e-3, 1e-6, 1e-12, 0.0})
    for (const double size : {1.0, 0x1p-10})
      for (const bool path_exact : {true, false}) {
        TraceHeader paper = header({thickness > 0 ? box(-4, 0, 4, thickness) : chain({{-4, 0}, {4, 0}})}, path_exact);
        for (Vec2d& point : paper.points) point *= size;
        EXPECT_EQ(told(judged(paper, step({{0, 1}, {0, -1}}))), "tunnelled 0") << thickness << " " << size;
        // Nearly through where a step ends, it was half its height deep on the way there.
        const Vec2d below{0, -0.99 * half_height * size};
        Judge judge(paper);
        EXPECT_EQ(told(judge.judge(step({{0, 1}, below}))), "inside 0, entered 0");
        EXPECT_EQ(told(judge.judge(step({below, {0, -1}}))), "tunnelled 0") << thickness << " " << size;
      }
}

TEST(Judge, whoever_passes_with_a_rim_clips_by_one_rule_for_all_who_promise_nothing) {
  const std::vector<ColliderDef> tile{box(0, -0.125, 1, 0.125)};
  using Row = std::pair<TraceHeader, double>;
  const auto by_units_of = [&](double unit, const char* name) {
    TraceHeader head = header(tile);
    head.tolerances = {{.name = name, .metres = unit}};
    return head;
  };
  for (const auto& [head, rim] :
       {Row{header(tile), 0.020}, Row{header(tile, false), 0.020}, Row{by_units_of(1.0 / 32, "pixel"), 1.0 / 32},
        Row{by_units_of(1.0 / 32, "unit"), 1.0 / 32}, Row{by_units_of(1e-3, "unit"), 0.020},
        Row{by_units_of(1, "unit"), half_width / 4}, Row{promising(tile), 0}})
    for (const double depth : {1e-9, rim - 0.001, rim + 0.001}) {
      if (depth < 0) continue;
      // The left arm passes the box's right face, `depth` beyond it.
      const double x = 1 + half_width - depth;
      const StepJudgement passed = judged(head, step({{x, 2}, {x, -2}}));
      EXPECT_EQ(told(passed), depth < rim ? "clipped 0" : "tunnelled 0") << depth;
      EXPECT_NEAR(passed.clipped_depth, depth < rim ? depth : 0, 1e-12);
    }
}

TEST(Judge, an_overlap_of_an_ulp_is_rounding_unless_it_is_promised_away) {
  const std::vector<ColliderDef> wall{box(0, -1, 4, 1)};
  const auto ends = [](double ulps) { return step({{6, 0}, {4 + half_width - ulps * 0x1p-50, 0}}); };  // of 4.3 m
  EXPECT_EQ(told(judged(header(wall), ends(1))), "inside 0, rounded 0");
  EXPECT_EQ(judged(header(wall), ends(1)).max_penetration, 0);
  EXPECT_EQ(told(judged(header(wall), ends(3))), "inside 0, entered 0");
  EXPECT_GT(judged(header(wall), ends(3)).max_penetration, 0);
  EXPECT_EQ(told(judged(promising(wall), ends(1))), "inside 0, entered 0");
  Judge judge(header(wall));
  EXPECT_EQ(told(judge.judge(ends(1))), "inside 0, rounded 0");
  EXPECT_EQ(told(judge.judge(step({ends(1).path.back().position, {4, 0}}))), "inside 0, entered 0") << "deeper after";
}

TEST(Judge, who_draws_pixels_may_be_as_deep_in_them_as_one) {
  TraceHeader drawing = header({floor_at(0)});
  drawing.tolerances = {{"unit", 0.03}};
  const auto deep = [&](double depth) { return judged(drawing, step({{0, half_height}, {0, half_height - depth}})); };
  EXPECT_EQ(told(deep(0.02)), "inside 0, entered 0") << "no level of pixels";
  drawing.tolerances.push_back({"pixel", 0.03});
  EXPECT_EQ(told(deep(0.029)), "inside 0, drawn 0");
  EXPECT_NEAR(deep(0.029).max_penetration, 0.029, 1e-12) << "how deep stays visible";
  EXPECT_EQ(told(deep(0.031)), "inside 0, entered 0");
}

TEST(Judge, stuck_is_refuted_where_a_straight_way_out_is_free) {
  const ColliderDef block = box(-0.5, -2, 2, 2);
  // Around it, nearer than the octagon is wide; the last one is a lid that moves.
  const std::vector<ColliderDef> closed{block, box(-2, -4, -0.75, 4), box(2.25, -4, 4, 4), box(-2, -4, 4, -2.25),
                                        box(-2, 2.25, 4, 4, 0)};
  // Walls that leave no way from a box that moves.
  const std::vector<ColliderDef> goes_away{box(-0.25, -0.5, 0.25, 0.5, 0), box(-2, -4, -0.375, 4), box(0.375, -4, 4, 4),
                                           box(-2, -4, 4, -0.75), box(-2, 0.75, 4, 4)};
  const Vec2d here(0, 0);
  const Vec2d away(0, 4);
  using Row = std::tuple<const char*, std::vector<ColliderDef>, bool, MoverMotion, bool>;
  for (const auto& [what, colliders, inside, motion, refuted] :
       {Row{"in the open", {block}, true, {}, true}, Row{"closed in", closed, true, {}, false},
        Row{"it is inside of nothing", {box(4, 4, 5, 5)}, false, {}, true},
        Row{"the lid opens too late", closed, true, {here, away}, false},
        Row{"the lid was open", closed, true, {away, here}, true},
        Row{"what it is in goes away", goes_away, true, {here, {0, 20}}, false}}) {
    TraceStep stuck = among(step({{0, 0}, {0, 0}}), {motion});
    stuck.stuck = true;
    if (inside) stuck.start_overlap = {0};
    EXPECT_EQ(judged(promising(colliders), stuck).stuck_refuted, refuted) << what;
  }
}

TEST(Judge, ground_is_refuted_where_nothing_is_under_it) {
  const std::vector<ColliderDef> floor{floor_at(0)};
  const TraceHeader exact = header(floor);
  const TraceHeader skin = header(floor, false);
  TraceHeader by_units = exact;
  by_units.tolerances = {{"unit", 0.03}};
  // The height of the feet before, and where it says that it is grounded.
  using Row = std::tuple<const char*, TraceHeader, double, double, bool>;
  for (const auto& [what, there, from, to, refuted] : {
           Row{"within reach", promising(floor), 0, 0.9e-6, false},
           Row{"out of reach", promising(floor), 0, 1.1e-6, true},
           Row{"what it touches is above it", promising({box(-4, 2 * half_height, 4, 4)}), 0, 0, true},
           Row{"what it touches is beside it", promising({box(half_width, -4, 4, 4)}), 0, 0, true},
           Row{"inside of it: another answer says so", promising(floor), 0, -0.1, false},
           Row{"it was there before", promising(floor), 0, 0.1, true},
           Row{"of who promises nothing it is excused if it was", exact, 0, 0.1, false},
           Row{"with sampled paths as well", skin, 0, 0.1, false},
           Row{"and not if it was not", exact, 0.1, 0.1, true},
           Row{"nor with sampled paths", skin, 0.1, 0.1, true},
           Row{"Box2D's skin", skin, 0.0199, 0.0199, false},
           Row{"beyond that", skin, 0.0201, 0.0201, true},
           Row{"a unit of search", by_units, 0.029, 0.029, false},
           Row{"more than it", by_units, 0.031, 0.031, true},
       }) {
    TraceStep stands = step({{0, half_height + from}, {0, half_height + to}});
    EXPECT_FALSE(judged(there, stands).ground_refuted) << "it says nothing";
    stands.grounded = true;
    EXPECT_EQ(judged(there, stands).ground_refuted, refuted) << what;
    EXPECT_EQ(judged(there, stands).ground_late, !refuted && to - from > 1e-6) << what;
  }
}

TEST(Judge, motion_and_speed_that_are_missing_were_lost_unless_something_is_in_their_way) {
  const TraceHeader floor = header({box(-4, -1, 0, 0), box(0, -1, 4, 0), box(2, 0, 3, 2)});
  const double wall = 2 - half_width - gap;
  // The way; what of the wanted motion is lost; the share of the speed that is left, and that is lost to nothing.
  using Row = std::tuple<const char*, double, double, double, double, double, double>;
  for (const auto& [what, from, to, wanted, lost, left, ghost] :
       {Row{"all of it", -0.5, -0.5, 0.5, 0.5, 0.25, 0.75}, Row{"half of it", -0.5, -0.25, 0.5, 0.25, 0, 1},
        Row{"backwards is no more than all of it", -0.5, -0.625, 0.5, 0.5, -1, 1},
        Row{"nothing", -0.5, 0, 0.5, 0, 1, 0}, Row{"to the wall", 1.5, wall, 0.5, 0, 0, 0},
        Row{"away from it", wall, wall, -0.5, 0.5, 0, 1}}) {
    TraceStep goes = step({{from, standing}, {to, standing}}, Vec2d(wanted, -fall));
    goes.velocity = {left * wanted / dt, 0};
    const StepJudgement went = judged(floor, goes);
    EXPECT_EQ(went.motion_wanted, std::abs(wanted)) << what;
    EXPECT_EQ(went.motion_lost, lost) << what;
    EXPECT_EQ(went.ghost_speed_loss, ghost) << what;
  }
}

TEST(Judge, a_step_at_rest_is_judged_as_the_one_before) {
  Judge judge(header({floor_at(0)}));
  const TraceStep rest = step({{0, standing}}, Vec2d(0, -fall));
  EXPECT_EQ(judge.judge(rest).contacts.size(), 1U);
  EXPECT_EQ(judge.judge(rest).contacts.size(), 1U);
  EXPECT_TRUE(judge.judge(step({{0, standing}}, Vec2d(0, 1))).contacts.empty());
  EXPECT_TRUE(judge.judge(step({{0, standing + 1}}, Vec2d(0, -fall))).contacts.empty());
  EXPECT_EQ(judge.judge(rest).max_contact_gap, 0);
  EXPECT_GT(judge.judge(step({{0, standing}}, Vec2d(0, -fall), {contact(0, {0, 1})})).max_contact_gap, 0);
}

TEST(Judge, a_landing_is_an_exact_contact_at_its_fraction) {
  const TraceHeader floor = header({floor_at(0)});
  TraceStep landing = step({{0, 1}, {0, standing}}, Vec2d(0, -1));
  const StepJudgement landed = judged(floor, landing);
  EXPECT_EQ(demanded(landed), (Touches{{0, Side::bottom}}));
  EXPECT_EQ(landed.contacts.at(0).fraction, 0.375);
  EXPECT_EQ(landed.first_impact, 0.375);
  EXPECT_TRUE(landed.first_impact_comparable);
  landing.stuck = true;
  EXPECT_FALSE(judged(floor, landing).first_impact_comparable) << "it does not go as requested";
  const TraceStep aside = step({{0, 1}, {0, 0.75}, {2, 0.75}}, Vec2d(2, -1), {contact(0, {0, 1}, 0.375)});
  EXPECT_EQ(judged(floor, aside).max_contact_gap, 0.125) << "the separation where it stopped";
}

TEST(Judge, resting_nearness_is_a_contact_with_motion_into_it_and_none_without) {
  for (const double gravity : {fall, 0.0}) {
    const StepJudgement rests =
        judged(header({floor_at(0), box(half_width + gap, 0, 1, 4)}), step({{0, standing}}, Vec2d(0, -gravity)));
    EXPECT_EQ(demanded(rests), gravity > 0 ? (Touches{{0, Side::bottom}}) : Touches{});
    EXPECT_FALSE(rests.first_impact_comparable) << "a resting gap is no time of impact";
  }
}

TEST(Judge, a_concave_outline_is_touched_on_both_sides_of_a_wedge) {
  // The arms' corners (0.3125, -0.3125) meet the walls |x| = y / 4 where the octagon's centre is this high.
  const double touching = 4 * 0.3125 + 0.3125;
  for (const ColliderDef& def :
       {polygon({{0, 0}, {1, 4}, {2, 4}, {2, -1}, {-2, -1}, {-2, 4}, {-1, 4}}), chain({{-1, 4}, {0, 0}, {1, 4}})}) {
    const StepJudgement rests = judged(header({def}), step({{0, touching + 1e-6}}, Vec2d(0, -fall)));
    EXPECT_EQ(demanded(rests), (Touches{{0, Side::left}, {0, Side::right}}));
    for (const ExactContact& one : rests.contacts) EXPECT_NEAR(std::abs(one.normal.x()), 4 / std::sqrt(17.0), 1e-15);
  }
}

TEST(Judge, a_contact_within_reach_of_the_contender_is_neither_right_nor_wrong) {
  TraceHeader held = promising({floor_at(0)});
  held.tolerances = {{"touch", 7e-7}};
  using Row = std::tuple<const char*, TraceHeader, double, double, bool, bool>;
  for (const auto& [what, there, above, request, reported, dont_care] : {
           Row{"in the skin of Box2D", header({floor_at(0)}, false), 0.015, fall, false, true},
           Row{"beyond it", header({floor_at(0)}, false), 0.025, fall, false, false},
           Row{"not Box2D", header({floor_at(0)}), 0.015, fall, false, false},
           Row{"held within the gap that the contender names", held, 5e-7, 3e-7, true, true},
           Row{"beyond that gap", held, 9e-7, 3e-7, true, false},
           Row{"met but for the hit distance", held, 9e-7, 8.5e-7, true, true},
           Row{"it leaves", held, 5e-7, -3e-7, true, false},
       }) {
    TraceStep rest = step({{0, half_height + above}}, Vec2d(0, -request));
    if (reported) rest.contacts = {contact(0, {0, 1})};
    const StepJudgement one = judged(there, rest);
    EXPECT_TRUE(one.contacts.empty()) << what;
    EXPECT_EQ(one.dont_care, dont_care ? Colliders{0} : Colliders{}) << what;
    EXPECT_EQ(one.contact_band, reported && dont_care ? Touches({{0, Side::bottom}}) : Touches{}) << what;
    EXPECT_TRUE(one.ghosts.empty()) << what;
  }
  // The foot's corner passes the tile's corner halfway, a twentieth of a micrometre above it, and ends far away.
  for (const auto& [above, near] : {std::pair{5e-8, true}, {5e-7, false}}) {
    const TraceStep pass = step({{-1, 1.625 + above}, {1, -0.375 + above}}, {}, {contact(0, {0, 1}, 0.5)});
    EXPECT_EQ(judged(header({box(-1, -1, -0.15625, 0)}), pass).dont_care, near ? Colliders{0} : Colliders{}) << above;
  }
}

TEST(Judge, a_contact_in_the_skin_or_behind_a_seam_is_a_ghost_where_no_face_stands_out) {
  const Touches wall{{1, Side::right}};
  // The foot's corner stands over the seam, just before the second tile, in Box2D's rest gap.
  const StepJudgement skin = judged(header({box(-4, -1, 0, 0), box(0, -1, 4, 0)}, false),
                                    step({{-0.15625 - 1e-9, half_height + 0.015}}, Vec2d(1.0 / 64, -fall),
                                         {contact(1, {0, 1}), contact(1, lower_right())}));
  EXPECT_TRUE(skin.contacts.empty());
  EXPECT_EQ(skin.dont_care, (Colliders{0, 1}));
  EXPECT_EQ(skin.ghosts, wall);
  // The foot's corner falls within rounding of the seam: the second tile is met at its vertex, which is no corner of
  // the floor.
  for (const Vec2d& normal : {Vec2d(0, 1), Vec2d(-1, 0)}) {
    const StepJudgement seam = judged(header({box(-4, -1, 4, 0), box(4, -1, 8, 0)}),
                                      step({{std::nextafter(4 - 0.15625, 0.0), standing}}, Vec2d(0, -fall),
                                           {contact(0, {0, 1}), contact(1, normal)}));
    EXPECT_EQ(demanded(seam), (Touches{{0, Side::bottom}}));
    EXPECT_EQ(seam.dont_care, Colliders{1});
    EXPECT_EQ(seam.ghosts, normal.x() < 0 ? wall : Touches{});
  }
}

/// In a valley of one polygon, 30 and 60 degrees, the steep side is met first, and what is left leads into the other.
TEST(Judge, one_collider_deflects_the_motion_into_another_side_of_itself) {
  const double steep = std::sqrt(27.0);
  const Vec2d flat(-0.5, std::sqrt(0.75));
  const Vec2d wall(-std::sqrt(0.75), 0.5);
  const Vec2d at = Vec2d(-0.15625, half_height) + gap / (1 + flat.dot(wall)) * (flat + wall);
  const auto deflected = [&](const Vec2d& normal, double away) {
    TraceHeader valley = promising({polygon({{-8, -8 / std::sqrt(3.0)}, {-8, -9}, {3, -9}, {3, steep}, {0, 0}})});
    valley.tolerances = {{"touch", 7e-7}};
    const Vec2d held = at + away * flat;
    return judged(valley, step({held, held}, Vec2d(1.0 / 64, -fall), {contact(0, wall), contact(0, normal)})).deflected;
  };
  EXPECT_EQ(deflected(flat, 0), (Touches{{0, Side::bottom}}));
  EXPECT_TRUE(deflected({0.5, std::sqrt(0.75)}, 0).empty()) << "no face has that normal";
  EXPECT_TRUE(deflected(flat, 2e-6).empty()) << "it is not touched";
}

}  // namespace
}  // namespace paperproof::compare::test
