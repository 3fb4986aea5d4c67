/// Ground that is straight but for the rounding of its vertices: a walk does not leave it (the law is at
/// `StepSolver::leaves`).
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>
#include <paperproof/tolerances.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

namespace paperproof {
namespace {

using test::Random;

constexpr double touch = Tolerances<double>{}.touch;
constexpr double rounding = 1e-8;  ///< Of a gap and of a motion [m].

enum class Made { of_boxes, as_chain, as_polygon };

/// A ramp of straight pieces. Its line rises at one angle; its vertices are off it.
struct Ramp {
  std::vector<Vec2d> line;  ///< From left to right.
  double least_off = std::numeric_limits<double>::infinity();

  explicit Ramp(Random& random) {
    const double degrees = random.chance(0.3) ? 0 : random.between(-47, 47);
    const double angle = degrees * std::numbers::pi / 180;
    const bool is_float = random.chance(0.5);
    const bool is_even = random.chance(0.5);
    const double off = random.chance(0.2) ? 0 : random.log_between(1e-13, 1e-6);
    const double piece = random.log_between(0.2, 2);
    Vec2d origin{random.between(-60, 60), 0};
    origin.y() = random.between(-60, 60);
    double along = 0;
    for (int i = 0; along < 36; ++i) {
      const double height = is_even ? off * (i % 2) : off * random.between(-1, 1);
      Vec2d at = origin + Vec2d{std::cos(angle), std::sin(angle)} * along + Vec2d{0, height};
      if (is_float) at = at.cast<float>().cast<double>();
      line.emplace_back(at - origin);
      along += is_even ? piece : piece * random.between(0.5, 1.5);
    }
  }

  [[nodiscard]] SceneryDef made(Made how) const {
    if (how == Made::as_chain) return {{{.shape = ColliderDef::Shape::chain, .points = line}}};
    const Vec2d down{0, -30};
    SceneryDef def;
    if (how == Made::as_polygon) {
      def.colliders.push_back({.points = line});
      def.colliders[0].points.emplace_back(line.back().x(), -60);
      def.colliders[0].points.emplace_back(line.front().x(), -60);
      return def;
    }
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      def.colliders.push_back({.points = {line[i], line[i] + down, line[i + 1] + down, line[i + 1]}});
    return def;
  }

  [[nodiscard]] double slope(std::size_t edge) const {
    const Vec2d along = line[edge + 1] - line[edge];
    return std::atan2(along.y(), along.x());
  }
  /// Rise over run.
  [[nodiscard]] double steepest() const {
    double steepest = 0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) steepest = std::max(steepest, std::abs(std::tan(slope(i))));
    return steepest;
  }
  /// How much the ground bends between two places, however often up and down [rad].
  [[nodiscard]] double bend(double left, double right) const {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < line.size(); ++i)
      if (line[i].x() >= left && line[i].x() <= right) sum += std::abs(slope(i) - slope(i - 1));
    return sum;
  }
  [[nodiscard]] int seams(double from, double to) const {
    return static_cast<int>(std::count_if(line.begin(), line.end(), [&](const Vec2d& v) {
      return v.x() > std::min(from, to) && v.x() <= std::max(from, to);
    }));
  }
};

/// Whether the law of the ground says that a character stands: a corner of it is over an edge, near enough, and its
/// motion hardly goes away from it.
bool must_stand(const Ramp& ramp, const CharacterDef& character, const CharacterState<double>& state, double dt) {
  for (std::size_t i = 0; i + 1 < ramp.line.size(); ++i) {
    const Vec2d edge = (ramp.line[i + 1] - ramp.line[i]).normalized();
    const Vec2d normal{-edge.y(), edge.x()};
    double gap = std::numeric_limits<double>::infinity();
    double place = 0;
    for (const Vec2d& corner : character.shape.hull()) {
      const Vec2d from = state.position + corner - ramp.line[i];
      if (from.dot(normal) < gap) place = from.dot(edge);
      gap = std::min(gap, from.dot(normal));
    }
    const bool is_over = place > rounding && place < (ramp.line[i + 1] - ramp.line[i]).norm() - rounding;
    if (is_over && gap >= 0 && gap <= touch - rounding && dt * state.velocity.dot(normal) <= touch - rounding)
      return true;
  }
  return false;
}

struct Walked {
  int steps = 0;     ///< On the ground before, without a jump,
  int straight = 0;  ///< and on ground that bends too little for a motion to leave it,
  int nearly = 0;    ///< and hardly less than enough.
  int in_air = 0;    ///< Where it bends more.
  int seams = 0;
  int presses = 0;
};

class RoundedGround : public testing::TestWithParam<Made> {};

constexpr std::array names{"of_boxes", "as_chain", "as_polygon"};
INSTANTIATE_TEST_SUITE_P(Made, RoundedGround, testing::Values(Made::of_boxes, Made::as_chain, Made::as_polygon),
                         [](const auto& made) { return std::string(names[static_cast<std::size_t>(made.param)]); });

TEST_P(RoundedGround, is_not_left_by_a_walk_and_every_press_jumps) {
  const int wanted = test::steps_per_family();
  Walked walked;
  for (std::uint64_t seed = 1; walked.steps < wanted; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Ramp ramp(random);
    CharacterDef character;
    const Vec2d gravity{0, random.between(-40, -10)};
    character.acceleration = -0.9 * gravity.y();  // downhill it would run off steep ground with more
    character.walk_speed = random.log_between(0.5, std::min(12.0, std::sqrt(8 * character.acceleration)));
    const double dt = 1 / random.between(30, 240);
    const double climb = character.walk_speed * ramp.steepest();
    character.jump_speed = climb - gravity.y() * dt + random.log_between(1e-6, 12);  // it may hardly leave
    const Scenery<double> scenery(ramp.made(GetParam()));
    const Controller<double> controller(scenery, character);
    Scratch<double> scratch = controller.make_scratch();
    const Box2<double>& shape = character.shape.box();
    CharacterState<double> state;
    state.position = (ramp.line.front() + ramp.line.back()) / 2 + Vec2d{0, 1.2};
    StepReport<double> report;
    double move = random.chance(0.5) ? 1 : -1;
    int same = 0;  // steps of one wish
    for (int step = 0; step < 600; ++step) {
      const double left = state.position.x() - ramp.line.front().x();
      const double right = ramp.line.back().x() - state.position.x();
      const double wish = left < 6 ? 1 : right < 6 ? -1 : random.chance(0.01) ? -move : move;
      same = wish == move ? same + 1 : 0;
      move = wish;
      const CharacterState<double> before = state;
      const bool presses = state.grounded && random.chance(0.02);
      ASSERT_EQ(controller.step(state, {.move = move, .jump = presses}, {gravity, dt}, scratch, report),
                StepStatus::moved);
      if (presses && !before.jump_held) {
        ++walked.presses;
        ASSERT_TRUE(state.jumping && !state.grounded) << "step " << step;
        ASSERT_NEAR(report.requested.y(), (character.jump_speed + gravity.y() * dt) * dt, 1e-15) << "step " << step;
        same = 0;
        continue;
      }
      if (must_stand(ramp, character, state, dt)) {
        ASSERT_TRUE(state.grounded) << "step " << step;
      }
      if (!before.grounded) continue;
      ++walked.steps;
      walked.seams += ramp.seams(before.position.x(), state.position.x());
      const double length = std::max(state.velocity.norm(), before.velocity.norm()) * dt;
      const double parts = length * ramp.bend(std::min(before.position.x(), state.position.x()) + shape.lower.x(),
                                              std::max(before.position.x(), state.position.x()) + shape.upper.x());
      if (parts > touch) {
        walked.in_air += !state.grounded;
        continue;
      }
      ++walked.straight;
      walked.nearly += parts > touch / 4;
      ASSERT_TRUE(state.grounded) << "step " << step << " parts it by " << parts << " m";
      const double start = 2 * character.walk_speed / (character.acceleration * dt) + 2;
      if (same > start) {
        ASSERT_NEAR(state.velocity.x(), move * character.walk_speed, 1e-9) << "step " << step;
      }
    }
  }
  RecordProperty("steps", walked.steps);
  RecordProperty("in_air_where_it_bends_more", walked.in_air);
  std::printf("%d steps: %d seams, %d presses, %d on straight ground (%d hardly), %d in the air elsewhere\n",
              walked.steps, walked.seams, walked.presses, walked.straight, walked.nearly, walked.in_air);
  if (test::sanitized || wanted < test::few_steps) return;
  EXPECT_GT(walked.seams, walked.steps / 40);
  EXPECT_GT(walked.presses, walked.steps / 100);
  EXPECT_GT(walked.straight, walked.steps / 2);
  EXPECT_GT(walked.nearly, walked.steps / 100);
}

}  // namespace
}  // namespace paperproof
