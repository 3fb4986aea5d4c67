/// More of everything than a report or a state keeps inline: movers that crush, what lies on a character. No fixed
/// number decides what is safe or what is named. Contacts and corners of one step, pistons, and what comes beside are
/// in tests/situations.
#include "controller/stepping.hpp"
#include "oracle/exact.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace paperproof::test {
namespace {

using compare::box;
using compare::half_height;
using compare::half_width;
using Colliders = std::set<ColliderIndex>;

/// A character among movers, which nothing pulls.
struct AmongMovers : stepping::Stepper {
  compare::ExactScenery exact{scenery->as_run(), hull()};

  AmongMovers(const std::vector<ColliderDef>& colliders, const Vec2d& position, double length_of_step)
      : Stepper(colliders) {
    state.position = position;
    gravity = {0, 0};
    dt = length_of_step;
  }
  [[nodiscard]] Colliders crushed() const { return {report.move.crushed.begin(), report.move.crushed.end()}; }
  /// All that exact arithmetic finds on the way.
  [[nodiscard]] Colliders gone_through() const {
    Colliders all;
    const auto& path = report.move.path;
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      for (const ColliderIndex collider : exact.met({path[i].position, movers, path[i].fraction},
                                                    {path[i + 1].position, movers, path[i + 1].fraction}))
        all.insert(collider);
    return all;
  }
};

constexpr double paper_thickness = 0.001;
constexpr double paper_distance = 0.002;

/// A niche as wide as the character and a little more, and papers above it, each with a mover of its own.
std::vector<ColliderDef> niche_with_papers(int papers) {
  std::vector<ColliderDef> colliders{box(-3, -1, 3, 0), box(-3, 0, -0.4, 2), box(0.4, 0, 3, 2)};
  for (int i = 0; i < papers; ++i) {
    const double bottom = 2.5 + i * paper_distance;
    colliders.push_back(box(-0.35, bottom, 0.35, bottom + paper_thickness, static_cast<MoverIndex>(i)));
  }
  return colliders;
}
constexpr ColliderIndex first_paper = 3;

/// A niche, wide or narrow, and papers of any number, size and speed that come down into it.
struct RandomPapers {
  std::vector<ColliderDef> colliders;
  std::vector<MoverMotion> motions;

  explicit RandomPapers(Random& random) {
    const double wide = half_width + random.log_between(1e-6, 0.2);
    const bool roomy = random.chance(0.3);
    const double right = roomy ? wide + random.between(0.7, 3) : wide;
    colliders = {box(-5, -40, 5, 0), box(-5, 0, -wide, 3), box(right, 0, 5, 2)};
    const bool at_one_speed = random.chance(0.5);
    const double speed = random.log_between(0.1, 20);
    double bottom = 2 * half_height + 0.1 + random.log_between(1e-6, 1);
    const int papers = static_cast<int>(random.chance(0.3) ? random.between(65, 151) : random.log_between(1, 151));
    for (int i = 0; i < papers; ++i) {
      const double top = bottom + random.log_between(1e-6, 0.05);
      const double left_end = -random.between(0.05, wide + 0.1);
      colliders.push_back(box(left_end, bottom, random.between(0.05, wide + 0.1), top, static_cast<MoverIndex>(i)));
      const double aside = random.chance(0.2) ? random.between(-0.05, 0.05) : 0;
      motions.push_back({{0, 0}, {aside, at_one_speed ? -speed : -random.log_between(0.1, 20)}});
      bottom = top + random.log_between(1e-6, 0.02);
    }
  }
};

/// Whether a crush was without room, `presses/chambers` of the campaign asks.
TEST(AnyNumber, of_random_papers_are_named_where_they_crush_and_none_is_passed) {
  constexpr double contact_reach = 1e-6;  ///< What comes nearer than this may be called a contact [m].
  const unsigned cases = sampled(400U);
  unsigned crushed = 0;
  unsigned by_many = 0;
  for (std::uint64_t seed = 1; seed <= cases && !HasFailure(); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const RandomPapers papers(random);
    const double above_floor = random.log_between(1e-7, 0.1);
    AmongMovers run(papers.colliders, {0, half_height + above_floor}, random.chance(0.5) ? 1 : 1.0 / 60);
    if (random.chance(0.5)) run.gravity = {0, -30};
    run.movers = papers.motions;
    run.step();
    const Colliders named = run.crushed();
    const Colliders met = run.gone_through();
    EXPECT_EQ(named.size(), run.report.move.crushed.size()) << "each once";
    for (const ColliderIndex collider : met) EXPECT_TRUE(named.contains(collider)) << collider;
    for (const ColliderIndex collider : named) {
      EXPECT_GE(collider, first_paper) << "the niche";
      if (!met.contains(collider)) {
        EXPECT_LE(run.exact.separation({run.state.position, run.movers, 1}, collider), contact_reach);
      }
    }
    crushed += !named.empty();
    by_many += named.size() > 64;
  }
  std::printf("%u cases, %u with a crush, %u by more than 64\n", cases, crushed, by_many);
  EXPECT_GE(crushed, cases / 4);
  EXPECT_GE(by_many, cases / 20);
  EXPECT_GE(cases - crushed, cases / 100) << "with room beside";
}

/// How many more than a state remembers.
class MoreOnIt : public testing::TestWithParam<int> {};

/// Where nothing is crushed and it stays, nothing else is passed; the judge asks it of fewer papers in
/// tests/situations/crush.json.
TEST_P(MoreOnIt, than_is_remembered_keep_it_where_it_is_until_they_have_gone_back) {
  const int papers = static_cast<int>(Crushers::capacity()) + GetParam();
  AmongMovers run(niche_with_papers(papers), {0, half_height + 1e-6}, 1);
  run.step_with_mover_by(0, -1.9);
  ASSERT_EQ(run.crushed().size(), static_cast<std::size_t>(papers));
  EXPECT_EQ(run.crushed(), run.gone_through());
  EXPECT_EQ(run.state.crushers.size(), Crushers::capacity());
  const StepReport copy = run.report;
  const Vec2d stays = run.state.position;
  for (int step = 0; step < 20; ++step) {
    run.step_with_mover_by(0, step < 10 ? -0.01 : 0.01);
    EXPECT_EQ(run.state.position, stays) << step;
    EXPECT_TRUE(run.crushed().empty()) << step;
    EXPECT_EQ(run.report.status, StepStatus::stuck) << step;
  }
  ASSERT_EQ(copy.move.crushed.size(), static_cast<std::size_t>(papers)) << "a copy keeps its names itself, each once";
  EXPECT_EQ(copy.move.crushed.back(), first_paper + static_cast<ColliderIndex>(papers) - 1);
  // The remembered ones are off before the others: it still does not know where the others came from.
  for (std::size_t k = 0; k < run.movers.size(); ++k) {
    const Vec2d from = run.movers[k].to;
    run.movers[k] = {from, k < Crushers::capacity() ? from + Vec2d(0, 1.9) : from};
  }
  run.step();
  EXPECT_EQ(run.report.status, StepStatus::stuck);
  EXPECT_EQ(run.state.position, stays);
  ASSERT_EQ(run.state.crushers.size(), static_cast<std::size_t>(std::min(GetParam(), 8)));
  EXPECT_FALSE(run.state.crushers[0].has_side);
  run.step_with_mover_by(0, 3);
  EXPECT_EQ(run.report.status, StepStatus::moved);
  EXPECT_TRUE(run.state.crushers.empty());
  EXPECT_EQ(run.state.position, stays);
}
INSTANTIATE_TEST_SUITE_P(AnyNumber, MoreOnIt, testing::Values(1, 5, 56, 57, 192));

}  // namespace
}  // namespace paperproof::test
