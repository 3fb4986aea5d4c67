/// Ground that is straight but for the rounding of its vertices: a walk does not leave it (the law is at
/// `leaves` of step_ground.hpp). The rest of such walks the campaign judges: lines/ramp.
#include "controller/stepping.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace paperproof::test {
namespace {

constexpr double touch = Tolerances{}.touch;

/// A ramp of straight pieces, from left to right. Its line rises at one angle; its vertices are off it.
std::vector<Vec2d> random_ramp(Random& random) {
  const Vec2d along = compare::towards(random.chance(0.3) ? 0 : random.between(-47, 47) * compare::degree);
  const bool is_float = random.chance(0.5);
  const bool is_even = random.chance(0.5);
  const double off = random.chance(0.2) ? 0 : random.log_between(1e-13, 1e-6);
  const double piece = random.log_between(0.2, 2);
  const Vec2d origin = random.point(60);
  std::vector<Vec2d> line;
  for (double at = 0; at < 36; at += is_even ? piece : piece * random.between(0.5, 1.5)) {
    const double height = is_even ? off * (line.size() % 2 == 0 ? 0 : 1) : off * random.between(-1, 1);
    Vec2d point = origin + along * at + Vec2d{0, height};
    if (is_float) point = point.cast<float>().cast<double>();
    line.emplace_back(point - origin);
  }
  return line;
}

std::vector<ColliderDef> made_of(const std::vector<Vec2d>& line, Random& random) {
  if (random.chance(0.3)) return {compare::chain(line)};
  const Vec2d down{0, -30};
  std::vector<ColliderDef> boxes;
  for (std::size_t i = 0; i + 1 < line.size(); ++i)
    boxes.push_back(compare::polygon({line[i], line[i] + down, line[i + 1] + down, line[i + 1]}));
  return boxes;
}

double slope(const std::vector<Vec2d>& line, std::size_t edge) {
  const Vec2d along = line[edge + 1] - line[edge];
  return std::atan2(along.y(), along.x());
}

/// How much the ground bends between two places, however often up and down [rad].
double bend(const std::vector<Vec2d>& line, double left, double right) {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    if (line[i].x() >= left && line[i].x() <= right) sum += std::abs(slope(line, i) - slope(line, i - 1));
  return sum;
}

TEST(RoundedGround, is_not_left_by_a_walk_and_every_press_jumps) {
  const int wanted = 10 * steps_per_family();
  int steps = 0;     // on the ground before, without a jump,
  int straight = 0;  // and on ground that bends too little for a motion to leave it,
  int nearly = 0;    // and hardly less than enough
  int presses = 0;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    const std::vector<Vec2d> line = random_ramp(random);
    CharacterDef character;
    const double gravity = random.between(10, 40);
    character.acceleration = 0.9 * gravity;  // downhill it would run off steep ground with more
    character.walk_speed = random.log_between(0.5, std::min(12.0, std::sqrt(8 * character.acceleration)));
    const double dt = 1 / random.between(30, 240);
    double steepest = 0;  // rise over run
    for (std::size_t i = 0; i + 1 < line.size(); ++i) steepest = std::max(steepest, std::abs(std::tan(slope(line, i))));
    const double climb = character.walk_speed * steepest;
    character.jump_speed = climb + gravity * dt + random.log_between(1e-6, 12);  // it may hardly leave
    stepping::Stepper walker(made_of(line, random), character);
    walker.gravity = {0, -gravity};
    walker.dt = dt;
    const Box2& shape = character.shape.box();
    CharacterState& state = walker.state;
    state.position = (line.front() + line.back()) / 2 + Vec2d{0, 1.2};
    double move = random.chance(0.5) ? 1 : -1;
    int same = 0;  // steps of one wish
    for (int step = 0; step < 600; ++step) {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", step " + std::to_string(step));
      const double left = state.position.x() - line.front().x();
      const double right = line.back().x() - state.position.x();
      const double wish = left < 6 ? 1 : right < 6 ? -1 : random.chance(0.01) ? -move : move;
      same = wish == move ? same + 1 : 0;
      move = wish;
      const CharacterState before = state;
      const bool presses_key = state.grounded && random.chance(0.02);
      ASSERT_EQ(walker.step({.move = move, .jump = presses_key}), StepStatus::moved);
      if (presses_key && !before.jump_held) {
        ++presses;
        ASSERT_TRUE(state.jumping && !state.grounded);
        ASSERT_NEAR(walker.report.requested.y(), (character.jump_speed - gravity * dt) * dt, 1e-15);
        same = 0;
        continue;
      }
      if (!before.grounded) continue;
      ++steps;
      const double length = std::max(state.velocity.norm(), before.velocity.norm()) * dt;
      const auto [low, high] = std::minmax(before.position.x(), state.position.x());
      const double parts = length * bend(line, low + shape.lower.x(), high + shape.upper.x());
      if (parts > touch) continue;
      ++straight;
      nearly += parts > touch / 4;
      ASSERT_TRUE(state.grounded) << "parts it by " << parts << " m";
      const double starts = 2 * character.walk_speed / (character.acceleration * dt) + 2;
      if (same > starts) {
        ASSERT_NEAR(state.velocity.x(), move * character.walk_speed, 1e-9);
      }
    }
  }
  if (sanitized) return;
  EXPECT_GT(presses, steps / 100);
  EXPECT_GT(straight, steps / 2);
  EXPECT_GT(nearly, steps / 100);
}

}  // namespace
}  // namespace paperproof::test
