#include "compare/judge_steps.hpp"
#include "oracle/contacts.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::test {
namespace {

constexpr double gap = 0x1p-21;  // 4.8e-7 m
constexpr double fall = 0.0078125;

/// A platform to the right whose corner touches the lower right chamfer in its middle, `gap` away.
ColliderDef ledge(MoverIndex mover = no_mover) {
  const Vec2d corner = lower_right_middle() - gap * lower_right();
  return box(corner.x(), -4, 8, corner.y(), mover);
}
ColliderDef mirrored(ColliderDef def) {
  for (Vec2d& point : def.points) point.x() = -point.x();
  return def;
}
ColliderDef ground(double below) { return box(-4, -2, 4, -half_height - below); }
ColliderDef wall(double aside) { return box(half_width + aside, -4, 1, 4); }

/// A step that was wanted to go `unsteered` and `steered` sideways, and went `made`.
TraceStep falling(const Vec2d& unsteered = {0, -fall}, double steered = 0, const Vec2d& made = {0, 0}) {
  TraceStep one = step({{0, 0}, made}, unsteered + Vec2d(steered, 0));
  one.steered = steered;
  return one;
}

bool hangs(const std::vector<ColliderDef>& near, const TraceStep& step) { return judged(header(near), step).hangs; }

TEST(JudgeHanging, is_whoever_could_have_fallen_and_did_not) {
  using Row = std::tuple<const char*, std::vector<ColliderDef>, TraceStep, bool>;
  const TraceStep into_it = falling({0, -fall}, 0.1);
  const Vec2d along = fall * Vec2d(-0.5, -1);
  const ColliderDef below = one_way(chain({{-4, -half_height - gap}, {4, -half_height - gap}}));
  const TraceStep runs = falling({0.5, -fall}, 0.1);
  TraceStep dropping = falling();
  dropping.dropped_through = {0};
  // A steep face below the chamfer in two pieces, cut straight down where the chamfer's middle is.
  const Vec2d cut = ledge().points[3];
  const Vec2d low = cut - Vec2d(0, 8);
  const std::vector<ColliderDef> pieces{polygon({cut - Vec2d(1, 2), low, cut}),
                                        polygon({low, low + Vec2d(1, 2), cut + Vec2d(1, 2), cut})};
  for (const auto& [what, near, step, expected] : {
           Row{"stays in free air", {}, falling(), true},
           Row{"falls by less than half", {}, falling({0, -fall}, 0, {0.5, -0.49 * fall}), true},
           Row{"falls by more than half", {}, falling({0, -fall}, 0, {0, -0.51 * fall}), false},
           Row{"wants to rise", {}, falling({1, fall}), false},
           Row{"wants to fall by less than 1e-9 m", {}, falling({1, -0.5e-9}), false},
           Row{"wants to fall by more", {}, falling({1, -2e-9}), true},
           Row{"a key into the corner of a platform", {ledge()}, into_it, true},
           // What is left along the chamfer, (-1, -2) / √5, falls 4/5 of it.
           Row{"slides by more than half of that", {ledge()}, falling({0, -fall}, 0.1, 0.42 * along), false},
           Row{"slides by less", {ledge()}, falling({0, -fall}, 0.1, 0.38 * along), true},
           Row{"momentum that climbs a steep face is no fall", {ledge()}, falling({0.1, -fall}), false},
           Row{"stands", {ground(gap)}, falling({0.1, -fall}), false},
           Row{"stays 3 micrometres above ground", {ground(3e-6)}, falling({0.1, -fall}), true},
           Row{"a wall holds nobody", {wall(gap)}, runs, true},
           Row{"nor do two", {wall(gap), mirrored(wall(gap))}, runs, true},
           Row{"a funnel does", {ledge(), mirrored(ledge())}, runs, false},
           Row{"an opening below 200 nm is closed", {wall(0.95e-7), mirrored(wall(0.95e-7))}, falling(), false},
           Row{"one above is open", {wall(1.05e-7), mirrored(wall(1.05e-7))}, falling(), true},
           Row{"a seam of a steep face holds nobody", pieces, into_it, true},
           Row{"inside of something it is told so instead", {box(-4, -4, 4, 4)}, falling(), false},
           Row{"a one-way chain below it", {below}, falling(), false},
           Row{"it drops through that", {below}, dropping, true},
           Row{"partly above it", {one_way(chain({{-4, -0.5}, {4, -0.5}}))}, falling(), true},
           Row{"above it", {one_way(chain({{-4, half_height + gap}, {4, half_height + gap}}))}, falling(), true},
       })
    EXPECT_EQ(hangs(near, step), expected) << what;
}

TEST(JudgeHanging, ground_is_what_the_character_walks_on_and_nothing_steeper) {
  // A slope of 45° that touches the lower left corner of the feet.
  const Vec2d foot = Vec2d(0.15625, -0.625) + std::sqrt(0.5) * gap * Vec2d(1, -1);
  TraceHeader on_slope = header({polygon({foot + Vec2d(-4, -4), foot + Vec2d(4, -4), foot + Vec2d(4, 4)})});
  for (const auto& [limit, stands] : {std::pair{50.0, true}, {45.0, true}, {44.99, false}, {0.0, false}}) {
    on_slope.character.max_climb_degrees = limit;
    EXPECT_EQ(!judged(on_slope, falling()).hangs, stands) << limit;
  }
}

TEST(JudgeHanging, a_ledge_holds_nobody_who_is_beside_it) {
  // The feet are flat, and the ledge's corner lies below them and to the left of the flank.
  for (const auto& [beside, holds] : {std::pair{gap, false}, {1.9e-7, true}, {-1e-3, true}}) {
    TraceHeader boxed = header({box(-4, -4, -half_width - beside, -half_height - gap)});
    boxed.points = box(-half_width, -half_height, half_width, half_height).points;
    TraceStep pressed = falling({0, -fall}, -0.1);
    EXPECT_EQ(judged(boxed, pressed).hangs, !holds) << beside;
    pressed.grounded = true;
    EXPECT_FALSE(judged(boxed, pressed).hangs) << "says that it stands: whether there is ground is another clause";
  }
}

TEST(JudgeHanging, beside_movers_the_fall_is_the_one_that_they_leave_while_they_touch) {
  const TraceStep into_it = falling({0, -fall}, 0.1);
  const TraceStep aside = falling({0, -fall}, 0, {0.5, 0});
  const auto gone_after_half = [](double after) {
    TraceStep lifted = falling();
    lifted.path = {{{0, 0}, 0}, {{0, 0}, 0.5}, {{0, after}, 1}};
    return lifted;
  };
  const ColliderDef press = box(-1, -2, 1, -1, 0);
  for (const auto& [what, near, step, by, expected] :
       {std::tuple{"a ledge at rest", ledge(0), into_it, Vec2d(0, 0), true},
        {"it sinks", ledge(0), into_it, Vec2d(0, -0.5 * fall), true},
        {"it goes away", ledge(0), into_it, Vec2d(1, 0), true},
        {"it lifts", ledge(0), into_it, Vec2d(0, 4 * fall), false},
        {"whom it runs into may give way", press, aside, Vec2d(0, 1), false},
        {"it does not reach the feet", press, aside, Vec2d(0, 0.3), true},
        {"it goes past", press, aside, Vec2d(12, 1), true},
        {"it rests", press, aside, Vec2d(0, 0), true},
        {"it goes down", press, aside, Vec2d(0, -1), true},
        // A steep lift takes the character up for half of the step, and is gone.
        {"stays where the lift was", ledge(0), gone_after_half(0), Vec2d(8, 16 * fall), true},
        {"falls from there", ledge(0), gone_after_half(-0.6 * fall), Vec2d(8, 16 * fall), false}})
    EXPECT_EQ(hangs({near}, among(step, {{{0, 0}, by}})), expected) << what;
}

TEST(JudgeHanging, the_reach_of_the_contender_is_its_own_and_counted) {
  TraceHeader by_pixels = header({ground(0.03)});
  EXPECT_TRUE(judged(by_pixels, falling()).hangs);
  by_pixels.tolerances = {{"unit", 1.0 / 32}};
  EXPECT_FALSE(judged(by_pixels, falling()).hangs);
  for (const auto& [distance, path_exact, hangs, hovers] : {std::tuple{0.015, false, false, true},
                                                            {0.015, true, true, false},
                                                            {0.025, false, true, false},
                                                            {gap, true, false, false}}) {
    const StepJudgement one = judged(header({ground(distance)}, path_exact), falling());
    EXPECT_EQ(one.hangs, hangs) << distance << " " << path_exact;
    EXPECT_EQ(one.hovers, hovers) << distance << " " << path_exact;
  }
}

TEST(JudgeHanging, what_a_grid_will_make_later_is_made) {
  Judge judge(header({}));
  TraceStep waiting = falling();
  for (int i = 1; i < 4; ++i) {
    waiting.remainder = {0, -i * fall};
    EXPECT_FALSE(judge.judge(waiting).hangs);
  }
  EXPECT_TRUE(judge.judge(waiting).hangs) << "no more was taken up";
  EXPECT_TRUE(judge.judge(waiting).hangs);
}

/// Against directions that are tried one by one on the exact ways of the oracle.
TEST(JudgeHanging, it_is_right_beside_random_solids) {
  constexpr int directions = 720;
  constexpr double probe = 1e-4;
  const Vec2d origin(0, 0);
  Random random(41);
  int hanging = 0;
  int held = 0;
  constexpr int scenes = 4000;
  for (int scene = 0; scene < scenes; ++scene) {
    std::vector<ColliderDef> solids;
    for (int k = 1 + random.below(3); k > 0; --k) {
      ColliderDef solid = polygon(star(random, random.point(1), random.between(0.2, 0.6), 3 + random.below(4)));
      // Moved along the shortest way until it is `gap` away; what is concave may then be nearer elsewhere.
      const std::vector<NearPart> parts = world({solid}).near_parts(origin, 2);
      if (parts.size() != 1) continue;
      const NearFace& face = parts.front().faces.front();
      for (Vec2d& point : solid.points) point += (face.separation - gap) * face.normal;
      solids.push_back(std::move(solid));
    }
    TraceHeader beside = header(solids);
    beside.character.max_climb_degrees = 1;
    const ExactScenery exact(beside.scenery, beside.points);
    const std::vector<NearPart> near = exact.near_parts(origin, 2 * probe);
    const bool ground = std::any_of(near.begin(), near.end(), [](const NearPart& part) {
      return std::any_of(part.faces.begin(), part.faces.end(), [](const auto& f) { return f.normal.y() > 0.99; });
    });
    if (near.empty() || ground || near.size() != exact.near_parts(origin, detail::contact_reach).size() ||
        !exact.overlapped(origin).empty())
      continue;
    const Vec2d u = fall * Vec2d(random.between(-1.5, 1.5), -1);
    Vec2d best = Vec2d::Zero();
    double along = 0;
    for (int i = 0; i < directions; ++i) {
      const Vec2d d = towards(2 * std::numbers::pi * (i + 0.5) / directions);
      if (u.dot(d) <= along || !exact.met(origin, Vec2d(probe * d)).empty()) continue;
      along = u.dot(d);
      best = along * d;
    }
    const bool says = judged(beside, falling(u)).hangs;
    // Where the best direction is nearly level, half a degree decides.
    if (-best.y() > 0.03 * fall) {
      EXPECT_TRUE(says) << "scene " << scene;
      ++hanging;
    } else if (!(best.y() < 0)) {
      EXPECT_FALSE(says) << "scene " << scene;
      ++held;
    }
  }
  EXPECT_GT(hanging, scenes / 8);
  EXPECT_GT(held, scenes / 40);
}

}  // namespace
}  // namespace paperproof::compare::test
