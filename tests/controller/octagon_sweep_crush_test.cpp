/// octagon_sweep under movers that came over the character: which side it is on, and what else may move it.
#include "controller/stepping.hpp"

#include <gtest/gtest.h>

#include <array>

namespace paperproof::stepping {
namespace {

constexpr Tolerances<double> tolerances{};

ColliderDef moving(ColliderDef collider, MoverIndex mover) {
  collider.mover = mover;
  return collider;
}

/// A shaft 0.66 m wide under a ceiling. In it a platform 0.1 m thick that is below the character, and a press 0.2 m
/// thick that comes from above the ceiling. The character touches the ceiling.
struct Shaft {
  static constexpr double ceiling = 4;
  static constexpr double feet = ceiling - 2 * half_height - tolerances.stop;  // of the character
  static constexpr double platform_top = feet - 0.05;
  static constexpr double press_bottom = ceiling + 0.5;
  static constexpr ColliderIndex platform = 3;
  static constexpr ColliderIndex press = 4;
  Stepper<double> pressed{{rectangle(-5, ceiling, 5, 5), rectangle(-5, 0, -0.33, ceiling),
                           rectangle(0.33, 0, 5, ceiling),
                           moving(rectangle(-0.32, platform_top - 0.1, 0.32, platform_top), 0),
                           moving(rectangle(-0.32, press_bottom, 0.32, press_bottom + 0.2), 1)}};

  Shaft() {
    pressed.gravity = {0, 0};
    pressed.at(0, feet + half_height);
    pressed.step();
  }
  /// Each by so far, upwards.
  StepStatus step(double platform_by, double press_by) {
    pressed.movers[0] = {pressed.movers[0].to, pressed.movers[0].to + Vec2d{0, platform_by}};
    pressed.movers[1] = {pressed.movers[1].to, pressed.movers[1].to + Vec2d{0, press_by}};
    return pressed.step();
  }
  [[nodiscard]] std::vector<ColliderIndex> crushed() const {
    const auto& named = pressed.report.move.crushed;
    return {named.begin(), named.end()};
  }
  [[nodiscard]] std::vector<ColliderIndex> on_it() const {
    std::vector<ColliderIndex> colliders;
    for (const Crusher<double>& each : pressed.state.crushers) colliders.push_back(each.collider);
    return colliders;
  }
};

using Colliders = std::vector<ColliderIndex>;

TEST(Crushed, by_what_passes_in_one_step_although_something_else_comes_closer_by_next_to_nothing) {
  constexpr double top = 2 * half_height;
  constexpr double aside = half_width + tolerances.stop;
  Stepper<double> pressed{{rectangle(-5, -1, 5, -tolerances.stop), rectangle(aside, 0, 5, 3),
                           moving(rectangle(-5, 0, -aside, 3), 0), moving(rectangle(-0.2, top + 1, 0.2, top + 1.2), 1),
                           moving(rectangle(-50, 0.5, -49, 0.7), 2)}};
  pressed.gravity = {0, 0};
  pressed.at(0, half_height);
  pressed.movers[1].to = {0, -1.1};
  ASSERT_EQ(pressed.step(), StepStatus::crushed);
  pressed.movers = {{{0, 0}, {1e-17, 0}}, {{0, -1.1}, {0, -1.1}}, {{0, 0}, {1e5, 0}}};
  EXPECT_EQ(pressed.step(), StepStatus::crushed);
  ASSERT_EQ(pressed.report.move.crushed.size(), 1U);
  EXPECT_EQ(pressed.report.move.crushed[0], 4U);
}

TEST(CrushedTwice, from_below_and_then_from_above_it_stays_and_both_are_named) {
  Shaft shaft;
  const Vec2d stays = shaft.pressed.state.position;
  ASSERT_EQ(shaft.step(0.15, 0), StepStatus::crushed);
  EXPECT_EQ(shaft.crushed(), Colliders{Shaft::platform});
  EXPECT_EQ(shaft.step(0, 0), StepStatus::stuck);
  // The press is at the head after 0.5 m: in the sixth step. In the twentieth it has passed the feet, 1.75 m down.
  for (int step = 1; step <= 20; ++step) {
    const StepStatus status = shaft.step(0, -0.0999);
    EXPECT_EQ(status, step == 6 ? StepStatus::crushed : StepStatus::stuck) << step;
    EXPECT_EQ(shaft.crushed(), step == 6 ? Colliders{Shaft::press} : Colliders{}) << step;
    EXPECT_EQ(shaft.pressed.state.position, stays) << step;
    const bool under_press = step >= 6 && step * 0.0999 < 0.5 + 2 * half_height + 0.2;
    EXPECT_EQ(shaft.on_it().size(), under_press ? 2U : 1U) << step;
  }
  EXPECT_EQ(shaft.on_it(), Colliders{Shaft::platform}) << "the press is forgotten";
  EXPECT_EQ(shaft.step(-0.15, 0), StepStatus::moved) << "free again";
  EXPECT_TRUE(shaft.pressed.state.crushers.empty());
  EXPECT_EQ(shaft.pressed.state.position, stays);
}

TEST(CrushedTwice, in_one_step_each_it_does_not_come_out_below_the_first) {
  Shaft shaft;
  const Vec2d stays = shaft.pressed.state.position;
  ASSERT_EQ(shaft.step(0.15, 0), StepStatus::crushed);
  EXPECT_EQ(shaft.step(0, -2.5), StepStatus::crushed) << "the press goes from above the head to below the feet";
  EXPECT_EQ(shaft.crushed(), Colliders{Shaft::press});
  EXPECT_EQ(shaft.pressed.state.position, stays);
}

TEST(CrushedTwice, within_one_step_the_second_does_not_move_it_either) {
  Shaft shaft;
  const Vec2d stays = shaft.pressed.state.position;
  // The platform is at the feet after a third of the step, the press at the head after five sixths.
  EXPECT_EQ(shaft.step(0.15, -0.6), StepStatus::crushed);
  EXPECT_EQ(shaft.crushed(), (Colliders{Shaft::platform, Shaft::press}));
  EXPECT_EQ(shaft.pressed.state.position, stays);
  for (const Crusher<double>& each : shaft.pressed.state.crushers) {
    EXPECT_EQ(each.last_free, stays);
    EXPECT_NEAR(each.displacement.y(), each.collider == Shaft::platform ? 0.1 : -0.1, 1e-6)
        << "what was left after the impact";
  }
}

TEST(CrushedTwice, it_goes_where_there_is_room_once_the_first_has_gone) {
  // What lies on it goes away in the very step in which it is pushed down.
  Shaft shaft;
  ASSERT_EQ(shaft.step(0.15, -0.4), StepStatus::crushed);
  ASSERT_EQ(shaft.step(0, 0), StepStatus::stuck);
  EXPECT_EQ(shaft.step(-0.8, -0.4), StepStatus::moved);
  EXPECT_TRUE(shaft.crushed().empty());
  EXPECT_NEAR(shaft.pressed.state.position.y() + half_height, Shaft::press_bottom - 0.8, 3e-5);
}

TEST(CrushedAgain, each_mover_is_looked_at_from_where_it_came_over_the_character) {
  // Two lifts under a ceiling, a wide and a narrow one, and a board that is in the way to the left. The narrow lift
  // crushes the character and goes down again, while the wide one comes up and crushes it, too. In the last step the
  // wide one goes down by 0.86 m and the narrow one comes up again: there is room on the right, 0.2 m away and on top
  // of both, as far as each of them goes by where it was met itself, and not by where the character was free last.
  constexpr double unit = 1.0 / 1024;
  const std::array<std::array<Vec2d, 3>, 6> to{{{{{0, 4}, {0, 15}, {0, 17}}},
                                                {{{0, 625}, {-193, 2244}, {0, 2477}}},
                                                {{{0, 625}, {0, 2136}, {0, 2477}}},
                                                {{{0, 1331}, {0, 322}, {0, 373}}},
                                                {{{0, 1325}, {0, 337}, {0, 390}}},
                                                {{{0, 441}, {-562, 2130}, {0, 2103}}}}};
  Stepper<double> pressed({rectangle(-20, 3.4375, 20, 9.5), moving(rectangle(2.65625, 0.578125, 4.21875, 1), 0),
                           moving(rectangle(2.609375, 0.625, 2.875, 1), 1),
                           moving(chain({{2.375, 2}, {1.4375, 2.28125}}), 2)});
  pressed.gravity = {0, 0};
  pressed.at(2.828125, 1 + half_height + unit / 1024);
  std::vector<Colliders> crushed;
  for (const std::array<Vec2d, 3>& offsets : to) {
    for (std::size_t k = 0; k < offsets.size(); ++k) pressed.movers[k] = {pressed.movers[k].to, offsets[k] * unit};
    pressed.step();
    crushed.emplace_back(pressed.report.move.crushed.begin(), pressed.report.move.crushed.end());
  }
  EXPECT_EQ(crushed, (std::vector<Colliders>{{}, {2}, {}, {1}, {}, {}}));
  EXPECT_EQ(pressed.report.status, StepStatus::moved);
}

/// Two surfaces of nearly one direction squeezed the character out at up to 3,000 km/s.
TEST(Pressed, between_surfaces_that_are_hardly_apart_in_direction_it_is_flung_by_nothing) {
  int crushed = 0;
  int squeezed = 0;
  for (const double tilt : {0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 0.01, 0.05, 0.2, 0.5}) {
    for (const double speed : {0.5, 3.0}) {
      for (const double half : {1.0, 20.0}) {
        for (const bool is_lift : {false, true}) {
          SCOPED_TRACE(testing::Message() << (is_lift ? "lift, " : "press, ") << "tilt " << tilt << ", " << speed
                                          << " m/s, half width " << half);
          const double slope = tilt * half;
          const ColliderDef lift = polygon({{-half, -60}, {half, -60}, {half, slope}, {-half, -slope}});
          const ColliderDef press = polygon({{-half, 2 - slope}, {half, 2 + slope}, {half, 60}, {-half, 60}});
          Stepper<double> pressed(is_lift ? std::vector{moving(lift, 0), rectangle(-50, 2, 50, 3)}
                                          : std::vector{rectangle(-50, -1, 50, 0), moving(press, 0)});
          pressed.at(0, half_height + (is_lift ? tilt * half_width : 0.0) + 1e-3);
          bool is_crushed = false;
          const int steps = static_cast<int>(1.5 / speed / pressed.dt);
          for (int i = 0; i < steps && !is_crushed && std::abs(pressed.state.position.x()) < half; ++i) {
            const Vec2d by{0, (is_lift ? speed : -speed) * pressed.dt};
            pressed.movers[0] = {pressed.movers[0].to, pressed.movers[0].to + by};
            const Vec2d before = pressed.state.position;
            is_crushed = pressed.step({}) == StepStatus::crushed;
            ASSERT_LE((pressed.state.position - before).norm(), 33 * speed * pressed.dt + 0.05) << "step " << i;
            ASSERT_LE(pressed.state.velocity.norm(), 9 * speed + 0.5) << "step " << i;
          }
          EXPECT_TRUE(tilt > 0.02 || is_crushed);
          (is_crushed ? crushed : squeezed) += 1;
        }
      }
    }
  }
  EXPECT_GT(crushed, 0);
  EXPECT_GT(squeezed, 0);
}

}  // namespace
}  // namespace paperproof::stepping
