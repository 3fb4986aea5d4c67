#include "compare/judge_steps.hpp"
#include "oracle/contacts.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace paperproof::compare {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

constexpr double gap = 0x1p-21;  // 4.8e-7 m
constexpr double fall = 0.0078125;
/// A platform to the right whose corner touches the lower right chamfer in its middle, `gap` away. Its normal is
/// (-2, 1) / √5, and 63.4° steep.
ColliderDef ledge() {
  const double away = gap / std::sqrt(5.0);
  return box(0.234375 + 2 * away, -4, 8, -0.46875 - away);
}

/// A step that was wanted to go `unsteered` and `steered` sideways, and went `made`.
TraceStep wanting(const Vec2d& unsteered, double steered = 0, const Vec2d& made = Vec2d::Zero()) {
  TraceStep wanting = step({{0, 0}, made});
  wanting.path.front().fraction = 0;
  wanting.path.back().fraction = 1;
  wanting.requested = unsteered + Vec2d(steered, 0);
  wanting.steered = steered;
  return wanting;
}

bool hangs(const TraceHeader& header, const TraceStep& step) { return Judge(header).judge(step).hangs; }

TEST(JudgeHanging, whoever_stays_in_free_air_hangs) {
  EXPECT_TRUE(hangs(header({}), wanting({0, -fall})));
  EXPECT_TRUE(hangs(header({}), wanting({0, -fall}, 0, {0.5, -0.49 * fall})));
  EXPECT_FALSE(hangs(header({}), wanting({0, -fall}, 0, {0, -0.51 * fall})));
  EXPECT_FALSE(hangs(header({}), wanting({1, fall}))) << "a rise";
  EXPECT_FALSE(hangs(header({}), wanting({1, -0.5e-9}))) << "less than 1e-9 m";
  EXPECT_TRUE(hangs(header({}), wanting({1, -2e-9})));
}

TEST(JudgeHanging, a_key_held_into_the_corner_of_a_platform_holds_nobody) {
  EXPECT_TRUE(hangs(header({ledge()}), wanting({0, -fall}, 0.1)));
  EXPECT_TRUE(hangs(header({ledge()}), wanting({0, -fall})));
  // What is left along the chamfer, (-1, -2) / √5, falls 4/5 of it.
  EXPECT_FALSE(hangs(header({ledge()}), wanting({0, -fall}, 0.1, {-0.21 * fall, -0.42 * fall})));
  EXPECT_TRUE(hangs(header({ledge()}), wanting({0, -fall}, 0.1, {-0.19 * fall, -0.38 * fall})));
}

TEST(JudgeHanging, momentum_that_climbs_a_steep_face_is_no_fall) {
  EXPECT_FALSE(hangs(header({ledge()}), wanting({0.1, -fall})));
}

TEST(JudgeHanging, ground_is_what_the_character_walks_on_and_nothing_steeper) {
  const double s = std::sqrt(0.5);
  // A slope of 45° that touches the lower left corner of the feet.
  const Vec2d foot(0.15625 + s * gap, -0.625 - s * gap);
  const ColliderDef slope = polygon({foot + Vec2d(-4, -4), foot + Vec2d(4, -4), foot + Vec2d(4, 4)});
  for (const auto& [limit, stands] : {std::pair{50.0, true}, {45.0, true}, {44.99, false}, {0.0, false}}) {
    TraceHeader on_slope = header({slope});
    on_slope.character.max_climb_degrees = limit;
    EXPECT_EQ(!hangs(on_slope, wanting({0, -fall})), stands) << limit;
  }
  EXPECT_FALSE(hangs(header({box(-4, -2, 4, -0.625 - gap)}), wanting({0.1, -fall})));
  EXPECT_TRUE(hangs(header({box(-4, -2, 4, -0.625 - 3e-6)}), wanting({0.1, -fall}))) << "3 micrometres above it";
}

TEST(JudgeHanging, a_wall_holds_nobody_and_two_steep_faces_do) {
  const ColliderDef right = box(0.3125 + gap, -4, 1, 4);
  const ColliderDef left = box(-1, -4, -0.3125 - gap, 4);
  EXPECT_TRUE(hangs(header({right}), wanting({0.5, -fall}, 0.1)));
  EXPECT_TRUE(hangs(header({right, left}), wanting({0.5, -fall}, 0.1)));
  ColliderDef other = ledge();
  for (Vec2d& point : other.points) point.x() = -point.x();
  EXPECT_FALSE(hangs(header({ledge(), other}), wanting({0.5, -fall}, 0.1))) << "a funnel";
}

TEST(JudgeHanging, an_opening_below_200_nanometres_is_closed) {
  for (const auto& [clearance, open] : {std::pair{1.9e-7, false}, {2.1e-7, true}}) {
    const ColliderDef right = box(0.3125 + clearance / 2, -4, 1, 4);
    const ColliderDef left = box(-1, -4, -0.3125 - clearance / 2, 4);
    EXPECT_EQ(hangs(header({right, left}), wanting({0, -fall})), open) << clearance;
  }
}

TEST(JudgeHanging, a_ledge_holds_nobody_who_is_beside_it) {
  // The feet are flat, and the ledge's corner lies below them and to the left of the flank.
  for (const auto& [beside, holds] : {std::pair{gap, false}, {1.9e-7, true}, {-1e-3, true}}) {
    TraceHeader boxed = header({box(-4, -4, -0.3125 - beside, -0.625 - gap)});
    boxed.points = {{-0.3125, -0.625}, {0.3125, -0.625}, {0.3125, 0.625}, {-0.3125, 0.625}};
    TraceStep pressed = wanting({0, -fall}, -0.1);
    EXPECT_EQ(hangs(boxed, pressed), !holds) << beside;
    pressed.grounded = true;
    EXPECT_FALSE(hangs(boxed, pressed)) << "says that it stands: whether there is ground is another clause";
  }
}

TEST(JudgeHanging, a_seam_of_a_steep_face_holds_nobody) {
  // A steep face below the chamfer in two pieces, cut straight down where the chamfer's middle is.
  const Vec2d touched = ledge().points[3];
  const Vec2d along(1, 2);
  const std::vector<ColliderDef> pieces{
      polygon({touched - along, touched + Vec2d(0, -8), touched}),
      polygon({touched + Vec2d(0, -8), touched + along + Vec2d(0, -8), touched + along, touched})};
  EXPECT_TRUE(hangs(header(pieces), wanting({0, -fall}, 0.1)));
}

TEST(JudgeHanging, in_company_of_movers_the_fall_is_the_one_beside_them) {
  ColliderDef moving = ledge();
  moving.mover = 0;
  const auto among = [&](const Vec2d& by) {
    TraceStep held = wanting({0, -fall}, 0.1);
    held.movers = {{Vec2d::Zero(), by}};
    return hangs(header({moving}), held);
  };
  EXPECT_TRUE(among({0, 0}));
  EXPECT_TRUE(among({0, -0.5 * fall}));
  EXPECT_TRUE(among({1, 0})) << "it goes away";
  EXPECT_FALSE(among({0, 4 * fall})) << "it lifts";
}

TEST(JudgeHanging, whoever_a_mover_runs_into_may_give_way_instead) {
  ColliderDef press = box(-1, -2, 1, -1);
  press.mover = 0;
  const auto among = [&](const Vec2d& by) {
    TraceStep aside = wanting({0, -fall}, 0, {0.5, 0});
    aside.movers = {{Vec2d::Zero(), by}};
    return hangs(header({press}), aside);
  };
  EXPECT_FALSE(among({0, 1}));
  EXPECT_TRUE(among({0, 0.3})) << "it does not reach the feet";
  EXPECT_TRUE(among({12, 1})) << "it goes past";
  EXPECT_TRUE(among({0, 0}));
  EXPECT_TRUE(among({0, -1}));
}

TEST(JudgeHanging, what_moves_holds_for_as_long_as_it_touches) {
  // A steep lift takes the character up for half of the step, and is gone.
  ColliderDef moving = ledge();
  moving.mover = 0;
  const auto goes = [&](double after) {
    TraceStep lifted = wanting({0, -fall});
    lifted.movers = {{Vec2d::Zero(), {8, 16 * fall}}};
    lifted.path = {{{0, 0}, 0}, {{0, 0}, 0.5}, {{0, after}, 1}};
    return hangs(header({moving}), lifted);
  };
  EXPECT_TRUE(goes(0));
  EXPECT_FALSE(goes(-0.6 * fall));
}

TEST(JudgeHanging, a_one_way_chain_holds_from_above_alone) {
  const auto with = [](double height) { return header({chain({{-4, height}, {4, height}}, Vec2d(0, 1))}); };
  EXPECT_FALSE(hangs(with(-0.625 - gap), wanting({0, -fall})));
  EXPECT_TRUE(hangs(with(-0.5), wanting({0, -fall}))) << "partly below it";
  EXPECT_TRUE(hangs(with(0.625 + gap), wanting({0, -fall}))) << "wholly below it";
  TraceStep dropping = wanting({0, -fall});
  dropping.dropped_through = {0};
  EXPECT_TRUE(hangs(with(-0.625 - gap), dropping));
}

TEST(JudgeHanging, the_skin_of_box2d_is_its_own_reach_and_counted) {
  const auto above_ground = [](double distance, bool path_exact) {
    return Judge(header({box(-4, -2, 4, -0.625 - distance)}, path_exact)).judge(wanting({0, -fall}));
  };
  EXPECT_FALSE(above_ground(0.015, false).hangs);
  EXPECT_TRUE(above_ground(0.015, false).hovers);
  EXPECT_TRUE(above_ground(0.015, true).hangs);
  EXPECT_TRUE(above_ground(0.025, false).hangs);
  EXPECT_FALSE(above_ground(gap, true).hovers);
}

TEST(JudgeHanging, a_unit_of_search_is_the_reach_of_who_searches_by_units) {
  TraceHeader by_pixels = header({box(-4, -2, 4, -0.625 - 0.03)});
  EXPECT_TRUE(hangs(by_pixels, wanting({0, -fall})));
  by_pixels.tolerances = {{"unit", 1.0 / 32}};
  EXPECT_FALSE(hangs(by_pixels, wanting({0, -fall})));
}

TEST(JudgeHanging, what_a_grid_will_make_later_is_made) {
  Judge judge(header({}));
  TraceStep waiting = wanting({0, -fall});
  for (int i = 1; i < 4; ++i) {
    waiting.remainder = {0, -i * fall};
    EXPECT_FALSE(judge.judge(waiting).hangs);
  }
  EXPECT_TRUE(judge.judge(waiting).hangs) << "no more was taken up";
  EXPECT_TRUE(judge.judge(waiting).hangs);
}

TEST(JudgeHanging, who_is_inside_of_something_is_told_so_instead) {
  EXPECT_FALSE(hangs(header({box(-4, -4, 4, 4)}), wanting({0, -fall})));
}

/// Against directions that are tried one by one on the exact ways of the oracle.
TEST(JudgeHanging, it_is_right_beside_random_solids) {
  constexpr std::uint64_t seed = 41;
  constexpr int directions = 720;
  constexpr double probe = 1e-4;
  Random random(seed);
  int hanging = 0;
  int held = 0;
  constexpr int scenes = paperproof::test::sampled(4000);
  for (int scene = 0; scene < scenes; ++scene) {
    std::vector<ColliderDef> solids;
    for (int k = 1 + random.below(3); k > 0; --k) {
      ColliderDef solid = polygon(star(random, random.point(1), random.between(0.2, 0.6), 3 + random.below(4)));
      // Moved along the shortest way until it is `gap` away; what is concave may then be nearer elsewhere.
      const ExactScenery alone(scenery({solid}), octagon());
      const std::vector<NearPart> parts = alone.near_parts(Vec2d(0, 0), 2);
      if (parts.size() != 1) continue;
      const NearFace& face = parts.front().faces.front();
      for (Vec2d& point : solid.points) point += (face.separation - gap) * face.normal;
      solids.push_back(std::move(solid));
    }
    TraceHeader beside = header(solids);
    beside.character.max_climb_degrees = 1;
    const ExactScenery exact(beside.scenery, beside.points);
    const std::vector<NearPart> near = exact.near_parts(Vec2d(0, 0), 2 * probe);
    const bool ground = std::any_of(near.begin(), near.end(), [](const NearPart& part) {
      return std::any_of(part.faces.begin(), part.faces.end(), [](const auto& f) { return f.normal.y() > 0.99; });
    });
    if (near.empty() || ground || near.size() != exact.near_parts(Vec2d(0, 0), detail::contact_reach).size() ||
        !exact.overlapped(Vec2d(0, 0)).empty())
      continue;
    const Vec2d u = fall * Vec2d(random.between(-1.5, 1.5), -1);
    Vec2d best = Vec2d::Zero();
    double along = 0;
    for (int i = 0; i < directions; ++i) {
      const double angle = 2 * std::numbers::pi * (i + 0.5) / directions;
      const Vec2d d(std::cos(angle), std::sin(angle));
      if (u.dot(d) <= along || !exact.met(Vec2d(0, 0), Vec2d(probe * d)).empty()) continue;
      along = u.dot(d);
      best = along * d;
    }
    const bool says = hangs(beside, wanting(u));
    // Where the best direction is nearly level, half a degree decides.
    if (-best.y() > 0.03 * fall) {
      EXPECT_TRUE(says) << "seed " << seed << ", scene " << scene;
      ++hanging;
    } else if (!(best.y() < 0)) {
      EXPECT_FALSE(says) << "seed " << seed << ", scene " << scene;
      ++held;
    }
  }
  EXPECT_GT(hanging, scenes / 8) << "seed " << seed;
  EXPECT_GT(held, scenes / 40) << "seed " << seed;
}

}  // namespace
}  // namespace paperproof::compare
