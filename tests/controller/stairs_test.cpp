/// Kerbs, stairs and crests: `CharacterDef::step_height` and `snap`.
#include <paperproof/paperproof.hpp>

#include <gtest/gtest.h>

#include <cmath>

namespace paperproof::test {
namespace {

constexpr double half_height = 0.625;

ColliderDef box(double left, double bottom, double right, double top) {
  return {.points = {{left, bottom}, {right, bottom}, {right, top}, {left, top}}};
}

CharacterDef walker(double step_height, double snap = 0) {
  CharacterDef character;
  character.step_height = step_height;
  character.snap = snap;
  return character;
}

CharacterDef square_walker(double step_height, double snap = 0) {
  CharacterDef character = walker(step_height, snap);
  character.shape =
      CharacterShape(std::array{Vec2d(-0.3, -0.625), Vec2d(0.3, -0.625), Vec2d(0.3, 0.625), Vec2d(-0.3, 0.625)});
  return character;
}

/// A character that walks to the right.
struct Walk {
  Walk(SceneryDef def, const CharacterDef& of, double x, double ground = 0, double dt_of = 1.0 / 60)
      : scenery(def), character(of), controller(scenery, character), dt(dt_of) {
    state.position = {x, ground + half_height + 1e-6};
    state.velocity.x() = character.walk_speed;
    state.grounded = true;
  }
  StepStatus go(const Input& input = {.move = 1.0}) {
    return controller.step(state, input, {{0, -30}, dt}, scratch, report);
  }

  Scenery<double> scenery;
  CharacterDef character;
  Controller<double> controller;
  double dt;
  Scratch<double> scratch = controller.make_scratch();
  StepReport<double> report;
  CharacterState<double> state;
};

SceneryDef kerb(double height) { return {{box(-10, -1, 3, 0), box(3, -1, 20, height)}}; }

SceneryDef stairs(double rise, double tread, int count) {
  SceneryDef def{{box(-10, -1, 3, 0)}};
  for (int i = 0; i < count; ++i) {
    const double left = 3 + tread * i;
    def.colliders.push_back(box(left, -1, i + 1 == count ? 60 : left + tread, rise * (i + 1)));
  }
  return def;
}

TEST(StepHeight, a_kerb_of_5_mm_stops_no_walker_that_climbs) {
  for (const CharacterDef& character : {walker(0.05), square_walker(0.05)}) {
    for (const double dt : {1e-3, 1.0 / 240, 1.0 / 60, 1.0 / 30}) {
      Walk walk(kerb(0.005), character, 0.0137, 0, dt);
      while (walk.state.position.x() < 5) {
        const double before = walk.state.position.x();
        walk.go();
        ASSERT_TRUE(walk.state.grounded) << walk.state.position.x();
        ASSERT_NEAR(walk.state.position.x() - before, 6 * dt, 1e-6) << walk.state.position.x() << ", dt " << dt;
      }
      EXPECT_NEAR(walk.state.position.y(), 0.005 + half_height, 2e-6);
    }
  }
}

TEST(StepHeight, stairs_are_climbed_at_walking_speed) {
  for (const CharacterDef& character : {walker(0.25), square_walker(0.25)}) {
    for (const double dt : {1e-3, 1.0 / 240, 1.0 / 60, 1.0 / 30}) {
      for (const double speed : {0.3, 6.0}) {
        Walk walk(stairs(0.2, 0.3, 10), character, 0.0137, 0, dt);
        const Input input{.move = speed / 6};
        walk.state.velocity.x() = speed;
        while (walk.state.position.x() < 7) {
          const double before = walk.state.position.x();
          walk.go(input);
          ASSERT_GT(walk.state.position.x() - before, 0.99 * speed * dt) << before << " dt " << dt << " at " << speed;
          ASSERT_LT(walk.state.position.x() - before, 1.01 * speed * dt) << before << " dt " << dt << " at " << speed;
          ASSERT_LE(walk.state.velocity.y(), 1e-9);
        }
        EXPECT_NEAR(walk.state.position.y(), 2 + half_height, 2e-6);
      }
    }
  }
}

/// On most of these the foot is wider than a tread, or a flank meets the next corner before the foot is on the stair.
TEST(StepHeight, stairs_of_any_tread_are_climbed_and_descended) {
  for (const bool is_square : {false, true}) {
    for (const double rise : {0.05, 0.1, 0.15, 0.2, 0.25}) {
      for (const double tread : {0.15, 0.2, 0.25, 0.3, 0.4}) {
        for (const double speed : {1.0, 3.0, 6.0}) {
          for (const double dt : {1.0 / 240, 1.0 / 60}) {
            SCOPED_TRACE(testing::Message() << (is_square ? "square, " : "") << "rise " << rise << ", tread " << tread
                                            << ", " << speed << " m/s, dt " << dt);
            const CharacterDef character = is_square ? square_walker(0.4, 0.5) : walker(0.4, 0.5);
            Walk walk(stairs(rise, tread, 8), character, 0, 0, dt);
            const int most = static_cast<int>((8 * tread + 8) / speed / dt) + 60;
            int steps = 0;
            while (walk.state.position.x() < 4 + 8 * tread && ++steps < most) walk.go({.move = speed / 6});
            ASSERT_LT(steps, most) << "it stops at " << walk.state.position.transpose();
            int in_air = 0;
            for (steps = 0; walk.state.position.x() > 0 && ++steps < most;) {
              walk.go({.move = -speed / 6});
              in_air += !walk.state.grounded;
            }
            ASSERT_LT(steps, most) << "it stops at " << walk.state.position.transpose();
            if (rise / tread < 1.2) {
              ASSERT_EQ(in_air, 0);
            }
          }
        }
      }
    }
  }
}

TEST(StepHeight, a_kerb_that_leans_back_or_over_is_climbed) {
  for (const double lean : {-0.05, -0.01, 0.0, 0.01, 0.02, 0.05, 0.1}) {
    for (const double speed : {1.0, 3.0, 6.0}) {
      for (const double dt : {1.0 / 240, 1.0 / 60}) {
        SCOPED_TRACE(testing::Message() << "lean " << lean << ", " << speed << " m/s, dt " << dt);
        const ColliderDef top{.points = {{3, -1}, {20, -1}, {20, 0.2}, {3 + lean, 0.2}, {3, 0}}};
        Walk walk({{box(-10, -1, 3, 0), top}}, square_walker(0.5), 0, 0, dt);
        for (int i = 0; i < static_cast<int>(6 / speed / dt); ++i) walk.go({.move = speed / 6});
        EXPECT_GT(walk.state.position.x(), 4);
      }
    }
  }
}

TEST(StepHeight, a_higher_wall_stops) {
  for (const CharacterDef& character : {walker(0.25), square_walker(0.25)}) {
    Walk walk(kerb(0.26), character, 0);
    for (int i = 0; i < 240; ++i) walk.go();
    EXPECT_LT(walk.state.position.x(), 3);
    EXPECT_NEAR(walk.state.position.y(), half_height, 2e-6);
    EXPECT_TRUE(walk.state.grounded);
  }
}

TEST(StepHeight, a_ceiling_that_leaves_no_room_stops) {
  for (const bool has_room : {true, false}) {
    SceneryDef def = kerb(0.2);
    def.colliders.push_back(box(2, 1.2 + (has_room ? 0.26 : 0.24), 6, 3));
    Walk walk(def, walker(0.25), 0);
    for (int i = 0; i < 60; ++i) walk.go();
    EXPECT_EQ(walk.state.position.x() > 4, has_room);
  }
}

TEST(StepHeight, a_low_stair_under_a_lintel_is_climbed) {
  SceneryDef def = kerb(0.05);
  def.colliders.push_back(box(3, 1.35, 6, 3));
  Walk walk(def, walker(0.4), 0);
  for (int i = 0; i < 60; ++i) walk.go();
  EXPECT_GT(walk.state.position.x(), 4);
}

TEST(StepHeight, in_the_air_nothing_is_climbed) {
  Walk walk(kerb(0.2), walker(0.25), 1.5);
  walk.state.position.y() += 0.02;
  walk.state.grounded = false;
  walk.state.velocity = {6, 0.2};
  bool climbed = false;
  for (int i = 0; i < 4; ++i) {
    walk.go();
    climbed = climbed || walk.state.position.y() > half_height + 0.1;
  }
  EXPECT_FALSE(climbed);
}

TEST(StepHeight, without_a_key_nothing_is_climbed) {
  Walk walk(kerb(0.2), square_walker(0.25), 2.7 - 1e-6);
  walk.state.velocity.setZero();
  for (int i = 0; i < 60; ++i) walk.go({.move = 0.0});
  EXPECT_NEAR(walk.state.position.y(), half_height, 2e-6);
}

TEST(Snap, goes_down_stairs_on_the_ground) {
  for (const CharacterDef& character : {walker(0, 0.25), square_walker(0, 0.25)}) {
    SceneryDef def{{box(-10, -4, 3, 0)}};
    for (int i = 0; i < 10; ++i) def.colliders.push_back(box(3 + 0.3 * i, -4, 3.3 + 0.3 * i, -0.2 * (i + 1)));
    def.colliders.push_back(box(6, -4, 30, -2));
    Walk walk(def, character, 0);
    while (walk.state.position.x() < 8) {
      const double before = walk.state.position.x();
      walk.go();
      ASSERT_TRUE(walk.state.grounded) << walk.state.position.x();
      ASSERT_NEAR(walk.state.position.x() - before, 0.1, 1e-3);
      ASSERT_LE(std::abs(walk.state.velocity.y()), 1e-9) << "it gained speed";
    }
    EXPECT_NEAR(walk.state.position.y(), -2 + half_height, 2e-6);
  }
}

TEST(Snap, holds_over_a_crest_of_any_angle) {
  for (const double down : {20.0, 45.0, 49.0}) {
    const double drop = 10 * std::tan(down * std::numbers::pi / 180);
    Walk walk({{{.points = {{-10, -20}, {10, -20}, {10, -drop}, {0, 0}, {-10, -drop}}}}}, walker(0, 0.4), -0.2, -0.2);
    walk.state.position = {-5, -drop / 2 + half_height + 0.3};
    walk.state.grounded = false;
    for (int i = 0; i < 20; ++i) walk.go({.move = 0.0});
    ASSERT_TRUE(walk.state.grounded);
    while (walk.state.position.x() < 5) {
      walk.go();
      ASSERT_TRUE(walk.state.grounded) << down << " degrees, at " << walk.state.position.x();
    }
  }
}

TEST(Snap, a_cliff_deeper_than_it_is_left) {
  Walk walk({{box(-10, -1, 3, 0), box(3, -9, 30, -0.3)}}, walker(0, 0.25), 2);
  bool was_in_the_air = false;
  for (int i = 0; i < 30; ++i) {
    walk.go();
    was_in_the_air = was_in_the_air || !walk.state.grounded;
  }
  EXPECT_TRUE(was_in_the_air);
}

TEST(Snap, a_jump_overrides_it) {
  Walk walk({{box(-10, -1, 30, 0)}}, walker(0.3, 0.5), 0);
  walk.go();
  walk.go({.move = 1.0, .jump = true});
  EXPECT_FALSE(walk.state.grounded);
  EXPECT_NEAR(walk.state.velocity.y(), 12 - 30.0 / 60, 1e-9);
}

}  // namespace
}  // namespace paperproof::test
