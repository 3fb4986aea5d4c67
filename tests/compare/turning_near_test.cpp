/// What is near of what turns, against many small steps.
#include "oracle/turning.hpp"

#include "compare/turning_planks.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare::detail {
namespace {

using namespace test;  // NOLINT(google-build-using-namespace): the shapes of this folder

using Opposition = TurningJudge::Opposition;

constexpr int small_steps = 256;
constexpr double half_height = 0.625;

Beside random_plank(Random& random) {
  const double turn = random.between(-0.08, 0.08);
  Beside made = beside(plank(random.between(0.2, 1.5), random.between(0.01, 0.3)), random.point(0.9),
                       random.between(-4, 4), turn, random.point(1), random.point(0.1));
  made.step.requested = random.point(0.1);
  return made;
}

/// Whether the octagon at a place overlaps the plank as it is at an instant; rounded.
bool overlaps(const Beside& made, const Vec2d& position, double fraction) {
  const ColliderDef def = polygon(vertices_at(made.way(), fraction));
  return ExactScenery(scenery({def}), made.header.points).overlaps(position, 0);
}

TEST(NearWhatTurns, a_level_plank_under_the_feet_is_ground_that_rises_as_its_point_does) {
  // The top is at height 0 under feet at x = 0.5; it turns by 0.01 about the origin and goes up by 0.02.
  Beside made = beside(plank(2, 0.5), {0.5, half_height}, 0, 0.01, {0, -0.5}, {0, 0.02});
  const TurningJudge judge(made.header);
  const std::vector<NearPart> near = judge.near(made.step, made.start(), 1e-6);
  ASSERT_EQ(near.size(), 1U);
  ASSERT_FALSE(near[0].faces.empty());
  EXPECT_EQ(near[0].faces.front().normal, Vec2d(0, 1));
  EXPECT_NEAR(near[0].faces.front().separation, 0, 1e-12);
  // The left foot is nearest as well as the right one: x = 0.5 -+ 0.15625.
  const double left = 0.02 + (0.5 - 0.15625) * std::sin(0.01) - 0.5 * (1 - std::cos(0.01));
  const double right = 0.02 + (0.5 + 0.15625) * std::sin(0.01) - 0.5 * (1 - std::cos(0.01));
  EXPECT_GE(near[0].moved.y(), left - 1e-9);
  EXPECT_LE(near[0].moved.y(), right + 1e-9);
  EXPECT_GE(near[0].moved.y() + near[0].unsure, right) << "either foot may be lifted by so much";
  EXPECT_TRUE(judge.near(made.step, {{0.5, half_height + 1e-3}, 0}, 1e-4).empty()) << "a millimetre above";
}

TEST(NearWhatTurns, what_only_goes_along_moves_by_its_offset_and_is_sure) {
  const Beside made = beside(plank(1, 0.5), {0, half_height}, 0, 0, {0, -0.5}, {0.03, 0.02});
  const std::vector<NearPart> near = TurningJudge(made.header).near(made.step, made.start(), 1e-6);
  ASSERT_EQ(near.size(), 1U);
  EXPECT_NEAR((near[0].moved - Vec2d(0.03, 0.02)).norm(), 0, 1e-12);
  EXPECT_NEAR(near[0].unsure, 0, 1e-12);
}

TEST(NearWhatTurns, no_point_in_reach_comes_farther_along_a_face_than_the_safe_bound) {
  constexpr std::uint64_t seed = 281;
  Random random(seed);
  constexpr int rounds = 3000;
  constexpr double within = 0.3;
  int near_ones = 0;
  int beyond_nominal = 0;
  for (int i = 0; i < rounds; ++i) {
    const Beside made = random_plank(random);
    const TurningJudge judge(made.header);
    const std::vector<NearPart> near = judge.near(made.step, made.start(), within);
    if (near.empty()) continue;
    ++near_ones;
    bool is_beyond = false;
    const std::vector<Vec2d>& first = made.way().vertices.front();
    for (int sample = 0; sample < 20; ++sample) {
      // A point of the plank that the octagon can touch; where it goes in small straight steps.
      const double u = random.between(0, 1);
      const double v = random.between(0, 1);
      const auto point = [&](const std::vector<Vec2d>& at) -> Vec2d {
        return (1 - u) * ((1 - v) * at[0] + v * at[3]) + u * ((1 - v) * at[1] + v * at[2]);
      };
      if ((point(first) - made.start().position).norm() > half_height) continue;
      Vec2d went = Vec2d::Zero();
      for (int k = 1; k <= small_steps; ++k)
        went += point(vertices_at(made.way(), static_cast<double>(k) / small_steps)) -
                point(vertices_at(made.way(), static_cast<double>(k - 1) / small_steps));
      for (const NearFace& face : near[0].faces) {
        EXPECT_LE(face.normal.dot(went), face.normal.dot(near[0].moved) + near[0].unsure + 1e-12)
            << "seed " << seed << " round " << i;
        is_beyond = is_beyond || face.normal.dot(went) > face.normal.dot(near[0].moved) + 1e-12;
      }
    }
    beyond_nominal += is_beyond;
  }
  EXPECT_GE(near_ones, rounds * 3 / 10);
  EXPECT_LE(near_ones, rounds * 8 / 10);
  EXPECT_GE(beyond_nominal, near_ones * 3 / 10) << "the nominal bound is not safe";
}

TEST(NearWhatTurns, no_point_of_a_touched_face_goes_farther_along_it_than_the_bound) {
  constexpr std::uint64_t seed = 283;
  Random random(seed);
  constexpr int rounds = 1000;
  int asked = 0;
  int beyond_nominal = 0;
  double share = 0;
  while (asked < rounds) {
    const Beside made = random_plank(random);
    const std::vector<NearPart> near = TurningJudge(made.header).near(made.step, made.start(), 0.05);
    if (near.empty() || near[0].faces.front().separation < 0) continue;
    const std::vector<Vec2d>& first = made.way().vertices.front();
    for (const NearFace& face : near[0].faces)
      for (std::size_t k = 0; k < first.size(); ++k) {
        const std::size_t next = (k + 1) % first.size();
        const Vec2d along(-face.normal.y(), face.normal.x());
        if (std::abs((first[next] - first[k]).normalized().dot(along)) < 1 - 1e-12) continue;
        const bool is_far_side = std::any_of(first.begin(), first.end(), [&](const Vec2d& vertex) {
          return (vertex - first[k]).dot(face.normal) > 1e-9;
        });
        if (is_far_side) continue;
        const double u = random.between(0, 1);
        const auto point = [&](const std::vector<Vec2d>& at) { return Vec2d((1 - u) * at[k] + u * at[next]); };
        if ((point(first) - made.start().position).norm() > half_height) continue;
        const Vec2d went = point(made.way().vertices.back()) - point(first);
        const double off = std::abs(along.dot(went - near[0].moved));
        EXPECT_LE(off, near[0].unsure_along + 1e-12) << "seed " << seed << ", " << asked << " asked";
        share += near[0].unsure_along / near[0].unsure;
        beyond_nominal += off > 1e-9;
        ++asked;
      }
  }
  EXPECT_GE(beyond_nominal, rounds / 2);
  EXPECT_LE(share, 0.5 * asked) << "much less than across";
}

TEST(NearWhatTurns, who_keeps_to_the_safe_bound_of_one_face_ends_free) {
  constexpr std::uint64_t seed = 282;
  Random random(seed);
  constexpr int rounds = 1000;
  int asked = 0;
  int nominal_enters = 0;
  while (asked < rounds) {
    const Beside made = random_plank(random);
    const TurningJudge judge(made.header);
    const std::vector<NearPart> near = judge.near(made.step, made.start(), 0.05);
    if (near.empty() || near[0].faces.front().separation < 0) continue;
    ++asked;
    for (const NearFace& face : near[0].faces) {
      // As far against the face as it allows, and along it as far as was requested.
      const double bound = face.normal.dot(near[0].moved);
      const Vec2d along(-face.normal.y(), face.normal.x());
      const Vec2d aside = along * random.between(-1, 1) * made.step.requested.norm() + bound * face.normal;
      const Vec2d start = made.start().position;
      EXPECT_FALSE(overlaps(made, start + aside + near[0].unsure * face.normal, 1))
          << "seed " << seed << ", " << asked << " asked";
      nominal_enters += overlaps(made, start + aside - face.separation * face.normal, 1);
    }
  }
  EXPECT_GE(nominal_enters, rounds / 10);
}

/// Where a motion enters the plank in small straight steps, and by which faces they were apart just before.
struct SlowWay {
  double closest = std::numeric_limits<double>::infinity();  ///< [m]
  bool enters = false;
  int against = 0;  ///< Faces that look against the motion's horizontal part.
  int not_against = 0;
};

SlowWay slow_way(const Beside& made, const Vec2d& motion) {
  const TurningJudge judge(made.header);
  SlowWay found;
  for (int k = 0; k <= small_steps && !found.enters; ++k) {
    const double share = static_cast<double>(k) / small_steps;
    const PathPoint<double> there{made.start().position + share * motion, share};
    const std::vector<NearPart> near = judge.near(made.step, there, 1);
    if (near.empty()) continue;
    found.closest = std::min(found.closest, near[0].faces.front().separation);
    found.enters = near[0].faces.front().separation < 0;
    if (found.enters) continue;
    found.against = found.not_against = 0;
    for (const NearFace& face : near[0].faces)
      (face.normal.x() * motion.x() < 0 ? found.against : found.not_against) += 1;
  }
  return found;
}

TEST(NearWhatTurns, opposes_what_is_run_into_against_the_motion_and_nothing_that_stays_away) {
  constexpr std::uint64_t seed = 283;
  Random random(seed);
  constexpr int rounds = 1500;
  int asked = 0;
  int met = 0;
  int unsure = 0;
  int entered = 0;
  while (asked < rounds) {
    const Beside made = random_plank(random);
    const TurningJudge judge(made.header);
    if (judge.near_at_begin(made.step, 0.3).empty() || !judge.near_at_begin(made.step, 0).empty()) continue;
    ++asked;
    const Vec2d motion(random.between(-0.8, 0.8), random.between(-0.1, 0.1));
    const Opposition opposition = judge.opposes(made.step, made.start(), motion);
    const SlowWay slow = slow_way(made, motion);
    met += opposition == Opposition::met;
    unsure += opposition == Opposition::unsure;
    entered += slow.enters;
    if (slow.enters && slow.not_against == 0) {
      EXPECT_NE(opposition, Opposition::none) << "seed " << seed << ", " << asked << " asked";
    }
    // A small step is no longer than 4 mm, and a side of the plank comes at most as much closer.
    if (opposition == Opposition::met) {
      EXPECT_LE(slow.closest, 8e-3) << "seed " << seed << ", " << asked << " asked";
    }
  }
  EXPECT_GE(entered, rounds * 3 / 10);
  EXPECT_LE(entered, rounds * 7 / 10);
  EXPECT_GE(met, rounds * 2 / 10);
  EXPECT_LE(met, rounds * 7 / 10);
  EXPECT_GT(unsure, 0);
}

TEST(NearWhatTurns, does_not_oppose_who_goes_away) {
  const Beside made = beside(plank(0.1, 2), {0.1 + 0.3125, 0}, 0, 0, {0, 0}, {0, 0});
  const TurningJudge judge(made.header);
  EXPECT_EQ(judge.opposes(made.step, made.start(), {0.1, 0}), Opposition::none);
  EXPECT_EQ(judge.opposes(made.step, made.start(), {-0.1, 0}), Opposition::met);
}

TEST(NearWhatTurns, runs_into_what_does_not_touch_yet) {
  const Beside made = beside(plank(1, 0.5), {0, half_height + 0.01}, 0, 0.01, {0, -0.5}, {0, 0.1});
  const TurningJudge judge(made.header);
  EXPECT_TRUE(judge.runs_into(made.step, made.start(), Vec2d::Zero(), 1e-6)) << "it rises by 0.1 m";
  EXPECT_FALSE(judge.runs_into(made.step, made.start(), Vec2d::Zero(), 0.02)) << "it is no farther away";
  EXPECT_FALSE(judge.runs_into(made.step, made.start(), Vec2d(0, 0.2), 1e-6)) << "the octagon rises faster";
}

}  // namespace
}  // namespace paperproof::compare::detail
