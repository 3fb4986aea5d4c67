/// Heroes on ramps of boxes, whose corners Box2D rounds; and heroes whose shape lies away from their position.
#include "box2d_adapter/hero_world.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/tolerances.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace paperproof::box2d::hero_test {
namespace {

using test::Random;

b2Vec2 in_float(const Vec2d& v) { return {static_cast<float>(v.x()), static_cast<float>(v.y())}; }

/// Where the walk is asked to stay on the ground: its speed in a step times all that the ramp bends near it is less
/// than the touch distance.
TEST(HeroOnBoxes, stays_on_the_ground_and_every_press_jumps) {
  constexpr double touch = Tolerances<double>{}.touch;
  const int wanted = test::steps_per_family();
  int steps = 0;
  int straight = 0;
  int in_air = 0;
  int presses = 0;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    // On less than half a degree a corner under the flat foot may count together with the face beside it, as both are
    // within the touch distance: one step in 200,000 then leaves the ground along the foot.
    const double degrees = random.chance(0.2) ? 0 : random.between(0.5, 45) * (random.chance(0.5) ? 1 : -1);
    const double angle = degrees * std::numbers::pi / 180;
    const Vec2d along{std::cos(angle), std::sin(angle)};
    const double length = random.between(0.3, 2);
    Vec2d origin{random.between(-20, 20), 0};
    origin.y() = random.between(-20, 20);
    b2World world({0, -30});
    b2BodyDef def;
    b2Body* ground = world.CreateBody(&def);
    std::vector<Vec2d> line;
    for (int i = 0; length * i < 40; ++i) line.push_back(origin + along * (length * i));
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Vec2d down{0, -2};
      const std::array corners{in_float(line[i]), in_float(line[i] + down), in_float(line[i + 1] + down),
                               in_float(line[i + 1])};
      b2PolygonShape box;
      box.Set(corners.data(), 4);
      ground->CreateFixture(&box, 0);
    }
    for (Vec2d& vertex : line) vertex = Vec2d(in_float(vertex).x, in_float(vertex).y);
    const auto bend_near = [&](double x) {
      double sum = 0;
      for (std::size_t i = 1; i + 1 < line.size(); ++i) {
        if (std::abs(line[i].x() - x) > 1.2) continue;
        const Vec2d before = line[i] - line[i - 1];
        const Vec2d after = line[i + 1] - line[i];
        sum += std::abs(std::atan2(after.y(), after.x()) - std::atan2(before.y(), before.x()));
      }
      return sum;
    };
    HeroDef hero_def;
    hero_def.position = origin + along * 20 + Vec2d{0, 1.3};
    hero_def.character.acceleration = 27;
    hero_def.character.jump_speed = 12;
    Hero hero(world, hero_def);
    double move = 1;
    for (int step = 0; step < 200; ++step) {
      const double place = (hero.state().position - origin).dot(along);
      move = place > 30 ? -1 : place < 10 ? 1 : random.chance(0.01) ? -move : move;
      const bool stood = hero.state().grounded;
      const bool presses_now = stood && !hero.state().jump_held && random.chance(0.02);
      hero.step({.move = move, .jump = presses_now}, frame);
      world.Step(static_cast<float>(frame), 8, 3);
      if (presses_now) {
        ++presses;
        ASSERT_TRUE(hero.state().jumping) << "seed " << seed << ", step " << step;
        continue;
      }
      if (!stood) continue;
      ++steps;
      const double parts = hero.state().velocity.norm() * frame * bend_near(hero.state().position.x());
      in_air += !hero.state().grounded;
      if (parts > touch) continue;
      ++straight;
      ASSERT_TRUE(hero.state().grounded) << "seed " << seed << ", step " << step << " parts it by " << parts << " m";
    }
  }
  std::printf("%d steps, %d where boxes hardly bend, %d in the air elsewhere, %d presses\n", steps, straight, in_air,
              presses);
  if (wanted < test::few_steps) return;
  EXPECT_GT(straight, steps / 4);
  EXPECT_GT(presses, steps / 200);
}

/// The hero's own way is in doubles, whatever Box2D rounds. Nothing but boxes that stand is here: bodies would meet the
/// hero's body, which is in floats.
TEST(HeroOrigin, changes_no_step) {
  constexpr double equal = 1e-9;
  const int wanted = test::steps_per_family() / 4;
  int steps = 0;
  int contacts = 0;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    b2World world({0, -30});
    b2BodyDef def;
    b2Body* ground = world.CreateBody(&def);
    b2PolygonShape floor;
    floor.SetAsBox(40, 1, {0, -1}, 0);
    ground->CreateFixture(&floor, 0);
    for (int i = 0; i < 6; ++i) {
      const auto x = static_cast<float>(random.between(-8, 8));
      const auto y = static_cast<float>(random.between(0, 2));
      const auto half = static_cast<float>(random.between(0.1, 1));
      b2PolygonShape box;
      box.SetAsBox(half, half, {x, y}, static_cast<float>(random.between(0, 1)));
      ground->CreateFixture(&box, 0);
    }
    const double angle = random.angle();
    Vec2d offset = Vec2d{std::cos(angle), std::sin(angle)} * random.log_between(1e-2, 1000);
    for (double& component : offset) component = std::round(component * 0x1p10) / 0x1p10;
    const auto hero_def = [&](const Vec2d& by) {
      std::vector<Vec2d> points;
      const CharacterShape article = CharacterShape::article();
      for (const Vec2d& point : article.hull()) points.push_back(point + by);
      HeroDef hero;
      hero.character.shape = CharacterShape(points);
      hero.character.acceleration = random.between(30, 90);
      return hero;
    };
    HeroDef one_def = hero_def({0, 0});
    HeroDef other_def = hero_def(offset);
    other_def.character.acceleration = one_def.character.acceleration;
    one_def.position = {-30, 20};
    other_def.position = one_def.position - offset;
    one_def.filter.maskBits = other_def.filter.maskBits = 1;
    one_def.filter.categoryBits = other_def.filter.categoryBits = 2;
    Hero one(world, one_def);
    Hero other(world, other_def);
    Vec2d place{random.between(-8, 8), random.between(3, 6)};
    Vec2d velocity{random.either_sign_log_between(0.1, 20), 0};
    for (int step = 0; step < 40; ++step) {
      for (double& component : place) component = std::round(component * 0x1p40) / 0x1p40;
      one.place(place, velocity);
      other.place(place - offset, velocity);
      const Input input{.move = random.between(-1, 1), .jump = random.chance(0.3)};
      const Vec2d displacement{random.between(-3, 3), random.chance(0.7) ? -0.5 : 0.5};
      const bool by_move = random.chance(0.2);
      const auto go = [&](Hero& hero) { return by_move ? hero.move(displacement, frame) : hero.step(input, frame); };
      const StepStatus status = go(one);
      ASSERT_EQ(go(other), status) << "seed " << seed << ", step " << step;
      const Vec2d apart = one.state().position - other.state().position - offset;
      ASSERT_LE(apart.cwiseAbs().maxCoeff(), equal) << "seed " << seed << ", step " << step;
      ASSERT_EQ(one.state().grounded, other.state().grounded) << "seed " << seed << ", step " << step;
      ASSERT_EQ(one.report().move.contacts.size(), other.report().move.contacts.size())
          << "seed " << seed << ", step " << step;
      contacts += !one.report().move.contacts.empty();
      place = one.state().position;
      if (std::abs(place.x()) > 20) place.x() = 0;
      velocity = one.state().velocity;
      ++steps;
    }
  }
  std::printf("%d steps, %d with contacts\n", steps, contacts);
  if (wanted < test::few_steps) return;
  EXPECT_GT(contacts, steps / 10);
}

}  // namespace
}  // namespace paperproof::box2d::hero_test
