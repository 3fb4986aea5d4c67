/// What other controllers have, and what their users complain of, where no other test shows it. `coming_from.md` lists
/// all of it, with the tests.
#include "controller/stepping.hpp"

#include <paperproof/report.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>
#include <vector>

namespace paperproof::stepping {
namespace {

constexpr double stop = Tolerances{}.stop;
constexpr double touch = 1e-6;  ///< Largest gap of what was stopped [m].

CharacterDef box_character() {
  return of_shape(CharacterShape(rectangle(-half_width, -half_height, half_width, half_height).points));
}

// ------------------------------------------------------------------------------------------------------- features

/// How high a character jumps beside the corner of a ceiling that catches so much of its width [m].
double jumps_up_beside_a_corner(const CharacterDef& character, double caught) {
  Stepper jumper({rectangle(-9, -1, 9, 0), rectangle(-3, 2, 0, 3)}, character);
  jumper.gravity = {0, -30};
  jumper.at(half_width - caught, half_height + stop).steps(2);
  double highest = 0;
  for (int n = 0; n < 60; ++n) {
    jumper.step({.move = 0, .jump = true});
    highest = std::max(highest, jumper.state.position.y());
  }
  return highest;
}

TEST(Contacts, of_one_collider_are_one_change_and_removed_ones_come_last) {
  const auto with = [](ColliderIndex collider, double fraction) {
    return Contact{.collider = collider, .fraction = fraction};
  };
  const std::vector<Contact> before{with(7, 0.1), with(3, 0.2), with(7, 0.3)};
  const std::vector<Contact> now{with(5, 0.4), with(3, 0.5), with(5, 0.6)};
  std::vector<std::tuple<ContactChange, ColliderIndex, double>> changes;
  for_each_change(before, now, [&](ContactChange change, const Contact& contact) {
    changes.emplace_back(change, contact.collider, contact.fraction);
  });
  using enum ContactChange;
  EXPECT_EQ(changes, (decltype(changes){{added, 5, 0.4}, {persisted, 3, 0.5}, {removed, 7, 0.1}}));
}

TEST(PeersFeature, corner_correction_by_a_slanted_head) {
  // Celeste puts a jumper whose head meets a corner aside, by up to 4 px. Here a slanted head slides past the corner.
  const double slant = 5 * px;
  const double below_the_ceiling = 2 - half_height;
  for (const double caught : {0.2 * slant, 0.9 * slant})
    EXPECT_GT(jumps_up_beside_a_corner({}, caught), below_the_ceiling + 0.5) << "caught by " << caught;
  EXPECT_LT(jumps_up_beside_a_corner({}, 1.1 * slant), below_the_ceiling);
  EXPECT_LT(jumps_up_beside_a_corner(box_character(), 0.2 * slant), below_the_ceiling);
}

// ----------------------------------------------------------------------------------------------------- complaints

TEST(PeersComplaint, falls_through_a_vertical_platform) {  // rapier #488
  for (const double speed : {-60.0, -12.0, -1.0, 1.0, 12.0, 60.0, 400.0}) {
    for (const double rate : {30.0, 60.0, 240.0}) {
      Stepper faller({compare::box(-3, -0.01, 3, 0, 0)});
      faller.dt = 1 / rate;
      faller.gravity = {0, -30};
      faller.at(0, 3).with_velocity(0, -20);
      for (int n = 0; n < 3 * static_cast<int>(rate); ++n) {
        faller.step_with_mover_by(0, speed / rate);
        ASSERT_GT(faller.state.position.y() - half_height, faller.movers[0].to.y()) << speed << " m/s, step " << n;
      }
      EXPECT_TRUE(faller.state.grounded) << speed;
    }
  }
}

TEST(PeersComplaint, snags_on_the_seams_of_walls_and_ceilings) {  // godot #87477, #92621; box2d #935
  std::vector<ColliderDef> tiles;
  for (int i = -20; i < 20; ++i) {
    tiles.push_back(rectangle(1, i, 2, i + 1));
    tiles.push_back(rectangle(-9, i, -8, i + 1));
  }
  for (int i = -8; i < 1; ++i) tiles.push_back(rectangle(i, 10, i + 1, 11));
  Stepper faller(tiles);
  faller.at(0, 8).with_velocity(6, 0);
  for (int n = 1; n <= 120; ++n) {
    faller.step({.move = 1});
    ASSERT_NEAR(faller.state.velocity.y(), -10.0 * n / 60, 1e-12) << "at the wall, step " << n;
  }
  // Along the ceiling, pressed against it in each step.
  faller.at(-6, 10 - half_height - 0.01).with_velocity(6, 0);
  for (int n = 0; n < 60; ++n) {
    faller.state.velocity.y() = 5;
    faller.step({.move = 1});
    const auto is_on_top = [](const Contact& contact) { return contact.side == Side::top; };
    ASSERT_TRUE(std::ranges::any_of(faller.report.move.contacts, is_on_top)) << n;
    ASSERT_EQ(faller.state.velocity, Vec2d(6, 0)) << "at the ceiling, step " << n;
  }
}

TEST(PeersComplaint, one_way_platforms_pop_or_eat_jumps) {  // godot #9399, #42914; prime31 #46, #82
  // Ledges, 0.3 m apart: the character spans several.
  std::vector<ColliderDef> ledges{rectangle(-9, -1, 9, 0)};
  for (int i = 1; i <= 20; ++i) ledges.push_back(chain({{-9, 0.3 * i}, {9, 0.3 * i}}, Vec2d{0, 1}));
  Stepper jumper(ledges);
  jumper.gravity = {0, -30};
  jumper.at(0, half_height + stop).steps(2);
  int jumps = 0;
  for (int n = 0; n < 240; ++n) {
    const CharacterState before = jumper.state;
    jumper.step({.move = 0.2, .jump = before.grounded});
    const double speed = jumper.report.requested.y() / jumper.dt;
    const double rise = jumper.state.position.y() - before.position.y();
    ASSERT_LE(rise, std::max(speed, 0.0) * jumper.dt + touch) << "it popped up, step " << n;
    if (!before.grounded) continue;
    ASSERT_EQ(jumper.state.velocity.y(), 12 - 0.5) << "the jump was eaten, step " << n;
    ++jumps;
  }
  EXPECT_GE(jumps, 3);
}

TEST(PeersComplaint, lift_reversal_eats_jumps) {  // JoltPhysics #530
  // A lift that goes 4 m/s up, then 4 m/s down, at once. The jump is pressed at any time around that.
  for (const double first : {4.0, -4.0}) {
    for (int pressed = 0; pressed < 20; ++pressed) {
      Stepper rider({compare::box(-3, -1, 3, 0, 0)}, {.snap = 0.2});
      rider.gravity = {0, -30};
      rider.at(0, half_height + stop).step();
      double speed = 0;
      for (int n = 0; n <= pressed; ++n) {
        speed = n < 10 ? first : -first;
        rider.step_with_mover_by(0, speed / 60, {.move = 0, .jump = n == pressed});
        ASSERT_EQ(rider.state.grounded, n < pressed) << "pressed in step " << pressed << ", step " << n;
      }
      EXPECT_NEAR(rider.state.velocity.y(), speed + 12 - 0.5, 1e-12) << "pressed in step " << pressed;
      rider.step_with_mover_by(0, speed / 60, {.move = 0});
      EXPECT_FALSE(rider.state.grounded);
    }
  }
}

TEST(PeersComplaint, climbs_corners) {  // box2d #1032: a capsule does, users want a box
  Stepper walker({rectangle(-9, -1, 9, 0), rectangle(1, 0, 9, 0.002)}, box_character());
  walker.at(0, half_height + stop).steps(60, {.move = 1});
  EXPECT_NEAR(walker.state.position.x(), 1 - half_width, touch) << "a kerb of 2 mm is a wall";
  EXPECT_NEAR(walker.state.position.y(), half_height, touch);
  Stepper on_the_brink({rectangle(-9, -1, 0, 0)}, box_character());
  const Vec2d brink{half_width - 0.001, half_height + stop};
  on_the_brink.at(brink.x(), brink.y()).steps(600, {.move = 0});
  EXPECT_EQ(on_the_brink.state.position, brink) << "it stands on a millimetre";
}

// ----------------------------------------------------------------------------------------------------- situations

TEST(PeersSituation, a_wall_is_still_found_without_a_key) {
  Stepper idle({rectangle(-9, -1, 9, 0), rectangle(1, 0, 2, 4)});
  idle.at(0, half_height + stop).steps(60, {.move = 1});
  ASSERT_TRUE(idle.state.wall_right);
  idle.steps(60, {.move = 0});
  EXPECT_FALSE(idle.state.wall_right) << "nothing was wanted to the right";
  std::array<Contact, 4> found;
  const std::size_t count = idle.sweep().contacts_at(idle.state.position, touch, {.dt = idle.dt}, idle.scratch, found);
  EXPECT_GT(std::ranges::count(std::span(found).first(count), Side::right, &Contact::side), 0);
}

}  // namespace
}  // namespace paperproof::stepping
