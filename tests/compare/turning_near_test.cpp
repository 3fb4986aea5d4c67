/// What is near of what turns, against many small steps.
#include "oracle/turning.hpp"

#include "compare/turning_planks.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::detail {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Opposition = TurningJudge::Opposition;

Beside random_plank(Random& random) {
  const double turn = random.between(-0.08, 0.08);
  Beside made = beside(plank(random.between(0.2, 1.5), random.between(0.01, 0.3)), random.point(0.9),
                       random.between(-4, 4), turn, random.point(1), random.point(0.1));
  made.step.requested = random.point(0.1);
  return made;
}

std::vector<NearPart> near_of(const Beside& made, double within) {
  return TurningJudge(made.header).near(made.step, made.start(), within);
}

TEST(NearWhatTurns, a_level_plank_under_the_feet_is_ground_that_rises_as_its_point_does) {
  // The top is at height 0 under feet at x = 0.5; it turns by 0.01 about the origin and goes up by 0.02.
  Beside made = beside(plank(2, 0.5), {0.5, half_height}, 0, 0.01, {0, -0.5}, {0, 0.02});
  const std::vector<NearPart> near = near_of(made, 1e-6);
  ASSERT_EQ(near.size(), 1U);
  ASSERT_FALSE(near[0].faces.empty());
  EXPECT_EQ(near[0].faces.front().normal, Vec2d(0, 1));
  EXPECT_NEAR(near[0].faces.front().separation, 0, 1e-12);
  // The left foot is nearest as well as the right one: x = 0.5 -+ 0.15625.
  const auto rise = [](double x) { return 0.02 + x * std::sin(0.01) - 0.5 * (1 - std::cos(0.01)); };
  EXPECT_GE(near[0].moved.y(), rise(0.5 - 0.15625) - 1e-9);
  EXPECT_LE(near[0].moved.y(), rise(0.5 + 0.15625) + 1e-9);
  EXPECT_GE(near[0].moved.y() + near[0].unsure, rise(0.5 + 0.15625)) << "either foot may be lifted by so much";
  made.step.path.front().position.y() += 1e-3;
  EXPECT_TRUE(near_of(made, 1e-4).empty()) << "a millimetre above";
}

TEST(NearWhatTurns, what_only_goes_along_moves_by_its_offset_and_is_sure) {
  const std::vector<NearPart> near =
      near_of(beside(plank(1, 0.5), {0, half_height}, 0, 0, {0, -0.5}, {0.03, 0.02}), 1e-6);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_NEAR((near[0].moved - Vec2d(0.03, 0.02)).norm(), 0, 1e-12);
  EXPECT_NEAR(near[0].unsure, 0, 1e-12);
}

TEST(NearWhatTurns, no_point_in_reach_comes_farther_along_a_face_than_the_safe_bound) {
  Random random(281);
  constexpr int rounds = 3000;
  int near_ones = 0;
  int beyond_nominal = 0;
  for (int i = 0; i < rounds; ++i) {
    const Beside made = random_plank(random);
    const std::vector<NearPart> near = near_of(made, 0.3);
    if (near.empty()) continue;
    ++near_ones;
    bool is_beyond = false;
    for (int sample = 0; sample < 20; ++sample) {
      // A point of the plank that the octagon can touch.
      const double u = random.unit();
      const double v = random.unit();
      const auto point = [&](const std::vector<Vec2d>& at) -> Vec2d {
        return (1 - u) * ((1 - v) * at[0] + v * at[3]) + u * ((1 - v) * at[1] + v * at[2]);
      };
      const Vec2d first = point(made.way().vertices.front());
      if ((first - made.start().position).norm() > half_height) continue;
      const Vec2d went = point(made.way().vertices.back()) - first;
      for (const NearFace& face : near[0].faces) {
        const double beyond = face.normal.dot(went - near[0].moved);
        EXPECT_LE(beyond, near[0].unsure + 1e-12) << "round " << i;
        is_beyond = is_beyond || beyond > 1e-12;
      }
    }
    beyond_nominal += is_beyond;
  }
  EXPECT_NEAR(near_ones, 0.55 * rounds, 0.25 * rounds);
  EXPECT_GE(beyond_nominal, near_ones * 3 / 10) << "the nominal bound is not safe";
}

TEST(NearWhatTurns, no_point_of_a_touched_face_goes_farther_along_it_than_the_bound) {
  Random random(283);
  const int rounds = paperproof::test::sampled(1000);
  int asked = 0;
  int beyond_nominal = 0;
  double share = 0;
  while (asked < rounds) {
    const Beside made = random_plank(random);
    const std::vector<NearPart> near = near_of(made, 0.05);
    if (near.empty() || near[0].faces.front().separation < 0) continue;
    const std::vector<Vec2d>& first = made.way().vertices.front();
    for (const NearFace& face : near[0].faces)
      for (std::size_t k = 0; k < first.size(); ++k) {
        const std::size_t next = (k + 1) % first.size();
        // The edge that is the face: along it, and nothing beyond.
        const bool is_beyond = std::any_of(first.begin(), first.end(), [&](const Vec2d& vertex) {
          return (vertex - first[k]).dot(face.normal) > 1e-9;
        });
        if (is_beyond || std::abs((first[next] - first[k]).normalized().dot(face.normal)) > 1e-6) continue;
        const double u = random.unit();
        const auto point = [&](const std::vector<Vec2d>& at) { return Vec2d((1 - u) * at[k] + u * at[next]); };
        if ((point(first) - made.start().position).norm() > half_height) continue;
        const Vec2d off = point(made.way().vertices.back()) - point(first) - near[0].moved;
        const double along = std::abs(off.x() * face.normal.y() - off.y() * face.normal.x());
        EXPECT_LE(along, near[0].unsure_along + 1e-12) << asked << " asked";
        share += near[0].unsure_along / near[0].unsure;
        beyond_nominal += along > 1e-9;
        ++asked;
      }
  }
  EXPECT_GE(beyond_nominal, rounds / 2);
  EXPECT_LE(share, 0.5 * asked) << "much less than across";
}

/// Where a motion enters the plank in small straight steps, and whether a face along which they were apart just before
/// looks against the motion's horizontal part.
struct SlowWay {
  double closest = std::numeric_limits<double>::infinity();  ///< [m]
  bool enters = false;
  bool only_against = true;
};

SlowWay slow_way(const Beside& made, const Vec2d& motion) {
  constexpr int small_steps = 256;
  const TurningJudge judge(made.header);
  SlowWay found;
  for (int k = 0; k <= small_steps && !found.enters; ++k) {
    const double share = static_cast<double>(k) / small_steps;
    const std::vector<NearPart> near = judge.near(made.step, {made.start().position + share * motion, share}, 1);
    if (near.empty()) continue;
    found.closest = std::min(found.closest, near[0].faces.front().separation);
    found.enters = near[0].faces.front().separation < 0;
    if (found.enters) continue;
    found.only_against = std::all_of(near[0].faces.begin(), near[0].faces.end(),
                                     [&](const NearFace& face) { return face.normal.x() * motion.x() < 0; });
  }
  return found;
}

TEST(NearWhatTurns, opposes_what_is_run_into_against_the_motion_and_nothing_that_stays_away) {
  Random random(283);
  const int rounds = paperproof::test::sampled(1500);
  int asked = 0;
  int met = 0;
  int unsure = 0;
  int entered = 0;
  while (asked < rounds) {
    const Beside made = random_plank(random);
    const TurningJudge judge(made.header);
    if (judge.near_at_begin(made.step, 0.3).empty() || !judge.near_at_begin(made.step, 0).empty()) continue;
    SCOPED_TRACE(std::to_string(++asked) + " asked");
    const Vec2d motion(random.between(-0.8, 0.8), random.between(-0.1, 0.1));
    const Opposition opposition = judge.opposes(made.step, made.start(), motion);
    const SlowWay slow = slow_way(made, motion);
    met += opposition == Opposition::met;
    unsure += opposition == Opposition::unsure;
    entered += slow.enters;
    EXPECT_FALSE(slow.enters && slow.only_against && opposition == Opposition::none);
    // A small step is no longer than 4 mm, and a side of the plank comes at most as much closer.
    EXPECT_FALSE(opposition == Opposition::met && slow.closest > 8e-3);
  }
  EXPECT_NEAR(entered, 0.5 * rounds, 0.2 * rounds);
  EXPECT_NEAR(met, 0.45 * rounds, 0.25 * rounds);
  EXPECT_GT(unsure, 0);
}

TEST(NearWhatTurns, is_run_into_where_it_comes_to_the_character_and_not_where_it_is_outrun) {
  const Beside made = beside(plank(1, 0.5), {0, half_height + 0.01}, 0, 0.01, {0, -0.5}, {0, 0.1});
  const TurningJudge judge(made.header);
  EXPECT_TRUE(judge.runs_into(made.step, made.start(), Vec2d(0, 0), 1e-6)) << "it rises by 0.1 m";
  EXPECT_FALSE(judge.runs_into(made.step, made.start(), Vec2d(0, 0), 0.02)) << "it is no farther away";
  EXPECT_FALSE(judge.runs_into(made.step, made.start(), Vec2d(0, 0.2), 1e-6)) << "the octagon rises faster";
}

}  // namespace
}  // namespace paperproof::compare::detail
