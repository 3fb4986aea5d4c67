/// More of everything than a report or a state keeps inline: movers that crush, what lies on a character, contacts and
/// corners of one step. No fixed number decides what is safe or what is named.
#include "agreement/judged_step.hpp"
#include "agreement/known_and_open.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace paperproof::test {
namespace {

using compare::StepJudgement;

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
/// What comes nearer than this may be called a contact [m].
constexpr double contact_reach = 1e-6;

class CrushInOneStep : public testing::TestWithParam<int> {};

TEST_P(CrushInOneStep, all_are_named_and_none_is_passed) {
  const int papers = GetParam();
  for (const double down : {-1.9, -6.0}) {  // ends on the character, and below everything
    Judged run(niche_with_papers(papers), {0, half_height + 1e-6}, 1);
    run.looks_for_room = papers <= 9;
    const StepJudgement judged = run.step_by({0, down});
    EXPECT_EQ(run.crushed(), run.gone_through());
    EXPECT_FALSE(run.report.move.crushed.overflowed());
    EXPECT_EQ(run.crushed().size(), static_cast<std::size_t>(papers)) << down;
    EXPECT_EQ(run.report.move.crushed.size(), static_cast<std::size_t>(papers)) << "each once";
    EXPECT_TRUE(judged.tunnelled.empty());
    EXPECT_TRUE(judged.entered.empty());
    EXPECT_TRUE(judged.crushed_with_room.empty());
    if (run.looks_for_room) {
      EXPECT_EQ(judged.crushed.size(), static_cast<std::size_t>(papers));
    }
    const StepReport<double> copy = run.report;
    run.step_by({0, 0});
    EXPECT_EQ(copy.move.crushed.size(), static_cast<std::size_t>(papers)) << "a copy keeps its names itself";
    EXPECT_EQ(copy.move.crushed.back(), first_paper + static_cast<ColliderIndex>(papers) - 1);
  }
}
INSTANTIATE_TEST_SUITE_P(AnyNumber, CrushInOneStep, testing::Values(1, 8, 9, 64, 65, 70, 200));

/// What happened in all cases.
struct Tally {
  int cases = 0;
  int crushed = 0;
  int by_many = 0;  ///< By more than a report keeps inline, at once.
  int roomy = 0;    ///< There is room beside the papers,
  int spared = 0;   ///< and nothing crushed although something came down past the head.
  int judged = 0;   ///< The judge looked for room, too,
  int refuted = 0;  ///< and found some: known and open. What follows is not asked.
};

/// A niche, wide or narrow, and papers of any number, size and speed that come down into it.
class Papers {
 public:
  explicit Papers(std::uint64_t seed) : random_(seed) {
    const double wide = half_width + random_.log_between(1e-6, 0.2);
    roomy_ = random_.chance(0.3);
    const double right = roomy_ ? wide + random_.between(0.7, 3) : wide;
    colliders_ = {box(-5, -40, 5, 0), box(-5, 0, -wide, random_.between(0.5, 4)),
                  box(right, 0, 5, random_.between(0.5, 4))};
    const bool at_one_speed = random_.chance(0.5);
    const double speed = random_.log_between(0.1, 20);
    double bottom = 2 * half_height + 0.1 + random_.log_between(1e-6, 1);
    const int papers = static_cast<int>(random_.chance(0.3) ? random_.between(65, 151) : random_.log_between(1, 151));
    for (int i = 0; i < papers; ++i) {
      const double top = bottom + random_.log_between(1e-6, 0.05);
      const double left_end = -random_.between(0.05, wide + 0.1);
      colliders_.push_back(box(left_end, bottom, random_.between(0.05, wide + 0.1), top, static_cast<MoverIndex>(i)));
      const double aside = random_.chance(0.2) ? random_.between(-0.05, 0.05) : 0;
      ways_.emplace_back(aside, at_one_speed ? -speed : -random_.log_between(0.1, 20));
      bottom = top + random_.log_between(1e-6, 0.02);
    }
  }

  /// Down in one step, on in another, and back. @return what is wrong, or nothing.
  std::string go(Tally& tally) {
    const double above_floor = random_.log_between(1e-7, 0.1);
    Judged run(colliders_, {0, half_height + above_floor}, random_.chance(0.5) ? 1 : 1.0 / 60);
    if (random_.chance(0.5)) run.gravity = {0, -30};
    run.looks_for_room = ways_.size() <= 3;
    ++tally.cases;
    tally.roomy += roomy_;
    tally.judged += run.looks_for_room;
    std::set<ColliderIndex> on_it;
    for (const double share : {1.0, 0.3, -2.0}) {
      for (std::size_t k = 0; k < run.motions.size(); ++k)
        run.motions[k] = {run.motions[k].to, run.motions[k].to + share * ways_[k]};
      const StepJudgement judged = run.step({.move = random_.integer(-1, 1)});
      const std::set<ColliderIndex> named = run.crushed();
      tally.crushed += !named.empty();
      tally.by_many += named.size() > 64;
      tally.spared += roomy_ && share == 1 && named.empty();
      if (!judged.crushed_with_room.empty()) {
        ++tally.refuted;
        return {};
      }
      if (!holds(judged)) return "the judge says so";
      if (run.report.move.crushed.overflowed() || named.size() != run.report.move.crushed.size())
        return "not each is named once";
      for (const ColliderIndex collider : named)
        if (collider < first_paper) return "the niche is named";
      const std::set<ColliderIndex> met = run.gone_through();
      for (const ColliderIndex collider : met)
        if (!named.contains(collider) && !on_it.contains(collider)) return "passed, unnamed";
      for (const ColliderIndex collider : named)
        if (!met.contains(collider) && run.gap_to(collider) > contact_reach) return "named, but never there";
      on_it = run.on_it();
      for (const ColliderIndex collider : on_it)
        if (!met.contains(collider)) return "inside, unmet";
    }
    return {};
  }

 private:
  Random random_;
  bool roomy_ = false;
  std::vector<ColliderDef> colliders_;
  std::vector<Vec2d> ways_;  ///< Of the papers, in a step.
};

TEST(AnyNumber, of_random_papers_are_named_where_they_crush_and_none_is_passed) {
  const int cases = steps_wanted("PAPERPROOF_CRUSH_CASES", sampled(400));
  Tally all;
  for (std::uint64_t seed = 1; all.cases < cases && !HasFailure(); ++seed) {
    const std::string wrong = Papers(seed).go(all);
    EXPECT_EQ(wrong, "") << "seed " << seed;
  }
  std::printf(
      "%d cases, %d steps with a crush, %d by more than 64; %d with room beside, %d of them spared; %d judged, %d of "
      "them refuted\n",
      all.cases, all.crushed, all.by_many, all.roomy, all.spared, all.judged, all.refuted);
  EXPECT_GE(all.crushed, cases / 3);
  EXPECT_GE(all.by_many, cases / 20);
  EXPECT_GE(all.spared, cases / 100);
  EXPECT_GE(all.judged, cases / 10);
  EXPECT_LE(all.refuted, most_broken("presses", compare::Clause::crush, 3 * cases, "chambers"));
}

/// How many more than a state remembers.
class MoreOnIt : public testing::TestWithParam<int> {};

TEST_P(MoreOnIt, than_is_remembered_keep_it_where_it_is_until_they_have_gone_back) {
  const int papers = static_cast<int>(Crushers<double>::capacity()) + GetParam();
  Judged run(niche_with_papers(papers), {0, half_height + 1e-6}, 1);
  run.looks_for_room = papers < 20;
  StepJudgement judged = run.step_by({0, -1.9});
  ASSERT_EQ(run.crushed().size(), static_cast<std::size_t>(papers));
  EXPECT_EQ(run.state.crushers.size(), Crushers<double>::capacity());
  const Vec2d stays = run.state.position;
  for (int step = 0; step < 20; ++step) {
    judged = run.step_by({0, step < 10 ? -0.01 : 0.01});
    EXPECT_EQ(run.state.position, stays) << step;
    EXPECT_TRUE(run.crushed().empty()) << step;
    EXPECT_EQ(run.report.status, StepStatus::stuck) << step;
    EXPECT_TRUE(judged.tunnelled.empty() && judged.entered.empty() && judged.corner_cut.empty()) << step;
  }
  // The remembered ones are off before the others: it still does not know where the others came from.
  for (int k = 0; k < static_cast<int>(Crushers<double>::capacity()); ++k) {
    MoverMotion<double>& motion = run.motions[static_cast<std::size_t>(k)];
    motion = {motion.to, motion.to + Vec2d(0, 1.9)};
  }
  for (std::size_t k = Crushers<double>::capacity(); k < run.motions.size(); ++k)
    run.motions[k].from = run.motions[k].to;
  judged = run.step();
  EXPECT_EQ(run.report.status, StepStatus::stuck);
  EXPECT_EQ(run.state.position, stays);
  ASSERT_EQ(run.state.crushers.size(), static_cast<std::size_t>(std::min(GetParam(), 8)));
  EXPECT_FALSE(run.state.crushers[0].has_side);
  judged = run.step_by({0, 3});
  EXPECT_EQ(run.report.status, StepStatus::moved);
  EXPECT_TRUE(judged.tunnelled.empty() && judged.entered.empty() && judged.corner_cut.empty());
  EXPECT_TRUE(run.state.crushers.empty());
  EXPECT_EQ(run.state.position, stays);
}
INSTANTIATE_TEST_SUITE_P(AnyNumber, MoreOnIt, testing::Values(1, 5, 60));

/// Without the rest of what lies on it, it would give way to the side.
TEST(AnyNumber, with_more_on_it_than_is_remembered_it_gives_way_to_nothing_and_is_crushed_by_what_comes) {
  for (const int papers : {4, 20}) {
    std::vector<ColliderDef> colliders = niche_with_papers(papers);
    colliders.erase(colliders.begin() + 2);  // open to the right
    const auto ram = static_cast<MoverIndex>(papers);
    colliders.push_back(box(-2, 0.5, -0.4 - 1e-3, 0.6, ram));
    colliders.erase(colliders.begin() + 1);
    colliders.push_back(box(3, 0, 4, 4));
    Judged run(colliders, {0, half_height + 1e-6}, 1);
    // From far away in one step: the papers come at once, and leave no time to give way.
    for (std::size_t k = 0; k < run.motions.size(); ++k) run.motions[k] = {{0, 0}, {0, k < ram ? -1.9 : 0}};
    StepJudgement judged = run.step();
    if (run.crushed().empty()) continue;
    const Vec2d stays = run.state.position;
    for (std::size_t k = 0; k < run.motions.size(); ++k)
      run.motions[k] = {run.motions[k].to, run.motions[k].to + (k < ram ? Vec2d(0, 0) : Vec2d(0.3, 0))};
    judged = run.step();
    EXPECT_TRUE(judged.tunnelled.empty() && judged.entered.empty() && judged.corner_cut.empty());
    if (papers <= static_cast<int>(Crushers<double>::capacity())) continue;
    EXPECT_EQ(run.state.position, stays);
    EXPECT_EQ(run.crushed(), std::set<ColliderIndex>{static_cast<ColliderIndex>(2 + papers - 1)});
  }
}

TEST(AnyNumber, of_tiles_under_the_feet_are_contacts) {
  constexpr double width = 0.001;
  std::vector<ColliderDef> colliders;
  for (int i = -400; i < 400; ++i) colliders.push_back(box(i * width, -1, (i + 1) * width, 0));
  Judged run(colliders, {0, half_height + 0.1}, 1.0 / 60);
  run.gravity = {0, -30};
  while (!run.state.grounded) run.step();
  std::set<ColliderIndex> touched;
  for (const Contact<double>& contact : run.report.move.contacts) {
    EXPECT_EQ(contact.side, Side::bottom);
    touched.insert(contact.collider);
  }
  EXPECT_FALSE(run.report.move.contacts.overflowed());
  EXPECT_GT(touched.size(), 300U);  // its feet are 10 px = 0.3125 m wide
  EXPECT_EQ(touched.size(), run.report.move.contacts.size());
}

/// Each comes a little later and goes a little faster than the one before it.
TEST(AnyNumber, of_movers_that_push_one_after_the_other_push_it_all_the_way) {
  constexpr int pushers = 80;
  constexpr double slowest = 1;
  constexpr double faster = 0.04;
  constexpr double at_once = 1.0 / (pushers + 10);  // of the step, between two impacts
  std::vector<ColliderDef> colliders;
  std::vector<double> ways;
  // Pushed so far when the k-th one comes.
  double reached = -half_width;
  for (int k = 0; k < pushers; ++k) {
    const double way = slowest + faster * k;
    const double begins = reached - way * at_once * (k + 1);
    colliders.push_back(box(begins - 0.5, -0.1, begins, 0.1, static_cast<MoverIndex>(k)));
    ways.push_back(way);
    reached += way * at_once;
  }
  Judged run(colliders, {0, 0}, 1);
  for (std::size_t k = 0; k < ways.size(); ++k) run.motions[k] = {{0, 0}, {ways[k], 0}};
  const StepJudgement judged = run.step();
  EXPECT_TRUE(judged.tunnelled.empty() && judged.end_overlap.empty());
  EXPECT_TRUE(run.crushed().empty());
  EXPECT_EQ(run.report.status, StepStatus::dropped) << "more impacts than it may want anything itself for";
  EXPECT_FALSE(run.report.move.path.overflowed());
  EXPECT_GT(run.report.move.path.size(), static_cast<std::size_t>(pushers));
  const double last_way = ways.back();
  const double expected = reached + half_width + last_way * (1 - at_once * (pushers + 1));
  EXPECT_NEAR(run.state.position.x(), expected, 1e-3);
}

}  // namespace
}  // namespace paperproof::test
