/// Parts of the judge against slower ways to the same answer, at random; and what no row of a table says (../judge).
#include "compare/judge_steps.hpp"
#include "oracle/contacts.hpp"
#include "oracle/intent.hpp"
#include "oracle/later_parts.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace paperproof::compare::test {
namespace {

TEST(FreeSpace, a_place_that_is_found_keeps_the_clearance_and_none_is_missed) {
  Random random(71);
  constexpr double clearance = 0.02;
  constexpr double reach = 0.75;
  int with_room = 0;
  Colliders all(14);
  std::iota(all.begin(), all.end(), ColliderIndex{0});
  const int rounds = paperproof::test::sampled(300);
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

/// Against directions that are tried one by one on the exact ways of the oracle.
TEST(JudgeHanging, it_is_right_beside_random_solids) {
  constexpr int directions = 720;
  constexpr double probe = 1e-4;
  constexpr double fall = 0.0078125;
  const Vec2d origin(0, 0);
  Random random(41);
  int hanging = 0;
  int held = 0;
  const int scenes = paperproof::test::sampled(4000);
  for (int scene = 0; scene < scenes; ++scene) {
    std::vector<ColliderDef> solids;
    for (int k = 1 + random.below(3); k > 0; --k) {
      ColliderDef solid = polygon(star(random, random.point(1), random.between(0.2, 0.6), 3 + random.below(4)));
      // It moves along the shortest way until it is `gap` away. A concave solid may then be nearer elsewhere.
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
    const bool says = judged(beside, step({origin, origin}, u)).hangs;
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

/// Against the law of motion, gone through part by part.
TEST(LaterParts, are_what_the_law_makes_part_by_part) {
  Random random(284);
  int limited = 0;
  int steered = 0;
  constexpr int rounds = 2000;
  for (int i = 0; i < rounds; ++i) {
    SCOPED_TRACE("round " + std::to_string(i));
    TraceHeader header = promising({});
    header.gravity = {0, -random.between(1, 40)};
    header.character.acceleration = random.between(10, 100);
    const double fastest = random.below(3) == 0 ? random.between(1, 5) : std::numeric_limits<double>::infinity();
    if (std::isfinite(fastest)) header.character.max_fall_speed = fastest;
    TraceStep step = test::step({{0, 0}, {0, 0}});
    const double target = header.character.walk_speed * random.between(-1, 1);
    step.input.move = target / header.character.walk_speed;
    const int parts = 1 << (1 + random.below(5));
    const double part = test::dt / parts;
    Vec2d v{random.between(-6, 6), std::max(random.between(-5, 5), -fastest)};
    if (random.below(3) == 0) v.x() = target;
    Wanted first;
    Vec2d way = Vec2d::Zero();
    for (int k = 0; k < parts; ++k) {
      const double most = header.character.acceleration * part;
      const double change = std::clamp(target - v.x(), -most, most);
      v += Vec2d(change, header.gravity.y() * part);
      v.y() = std::max(v.y(), -fastest);
      way += v * part;
      if (k > 0) continue;
      first = wanting(v * test::dt);
      first.parts = parts;
      first.steered = change * test::dt;
      first.walk = v.x();
    }
    const detail::LaterParts later = detail::later_parts(header, step, first);
    const Wanted whole = later.whole(first);
    EXPECT_NEAR(whole.velocity.y(), v.y(), 1e-12);
    EXPECT_NEAR(whole.displacement.y(), way.y(), 1e-12);
    const double faster = v.x() - whole.velocity.x();
    const double farther = way.x() - whole.displacement.x();
    EXPECT_GE(faster, later.slower - 1e-12);
    EXPECT_LE(faster, later.faster + 1e-12);
    EXPECT_GE(farther, -later.steered_way(-later.slower) - 1e-12);
    EXPECT_LE(farther, later.steered_way(later.faster) + 1e-12);
    limited += v.y() == -fastest;
    steered += std::abs(faster) > 1e-3;
  }
  EXPECT_GT(limited, rounds / 20);
  EXPECT_NEAR(steered, 0.5 * rounds, 0.45 * rounds);
}

/// Presses the button in the air, and ends a step in four parts as told, on its second corner `way_up` above the first.
/// @return whether the press is still there to jump from ground in the next step.
bool is_press_left(const Contact& contact, double rise, bool grounded, bool jumping, double way_up = -0.1) {
  TraceHeader header = promising({});
  header.gravity = {0, -10};
  header.starts = {{.position = {0, 0}, .velocity = {0, -9}}};
  Intent intent(header);
  TraceStep first = test::step({{0, 0}, {0, way_up}, {0, -0.1}}, {}, {contact});
  first.input.jump = true;
  EXPECT_TRUE(intent.begin(first, 4, {}).pending);
  first.velocity = {0, rise};
  first.grounded = grounded;
  first.jumping = jumping;
  intent.end(first);
  TraceStep after = test::step({{0, -0.1}, {0, -0.2}});
  after.input.jump = true;
  if (!grounded) {  // it lands in the next step
    static_cast<void>(intent.begin(after, 1, {}));
    after.grounded = true;
    intent.end(after);
  }
  return intent.begin(after, 1, {}).jumped;
}

TEST(PressOfTheButton, is_used_up_by_who_lands_in_a_part_before_the_last_one) {
  const Contact ground = contact(0, {0, 1}, 0.3);
  Contact steep = contact(0, {0.8, 0.6}, 0.3);
  steep.side = Side::bottom;
  EXPECT_FALSE(is_press_left(ground, 10, false, true)) << "it rises";
  EXPECT_FALSE(is_press_left(ground, 0, true, false, 0.05)) << "a ceiling ended the jump, and it landed again";
  EXPECT_TRUE(is_press_left(ground, 0, true, false)) << "it landed, left the ground and landed again";
  EXPECT_TRUE(is_press_left(contact(0, {0, 1}, 0.9), 0, true, false)) << "it landed in the last part";
  EXPECT_TRUE(is_press_left(steep, -2, false, false)) << "it slides";
}

/// A trace has a motion of every mover, and a way of what turns: its reader sees to that.
TEST(Judge, refuses_a_step_without_the_motion_of_a_mover) {
  TraceHeader lift = header({box(0, 0, 1, 1, 1)});
  TraceStep one = among(step({{5, 0}, {5, 0}}), {{}});
  EXPECT_THROW((void)judged(lift, one), std::invalid_argument) << "too few";
  lift.scenery.colliders[0].mover = 0;
  lift.turning = {true};
  EXPECT_THROW((void)judged(lift, one), std::invalid_argument) << "it has no way";
}

}  // namespace
}  // namespace paperproof::compare::test
