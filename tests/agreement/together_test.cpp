/// Characters that take turns, in the campaign's crowds. What they owe solids the campaign judges.
#include "controller/together.hpp"
#include "campaign/families.hpp"
#include "oracle/pair.hpp"
#include "runs/input_cursor.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace paperproof::test {
namespace {

using stepping::Together;

/// A run of one of the campaign's crowds. In some of them movers turn. The campaign judges them; this file compares
/// steps.
compare::RandomRun draw(std::uint64_t seed) {
  const compare::Family& family = *compare::families_named(seed % 4 == 0 ? "crowd" : "crowd_movers").front();
  compare::RandomRun run = family.draw(family.first_seed + seed);
  const bool is_near = run.scene.start.position.norm() < 100;  // they turn about the origin
  if (seed % 4 == 1 && is_near)
    for (compare::MoverDef& mover : run.scene.movers) mover.turns = {{0, 0}, {run.scene.dt * run.scene.steps, 0.3}};
  return run;
}

class Party {
  compare::RandomRun run_;

 public:
  explicit Party(std::uint64_t seed) : run_(draw(seed)) {
    const compare::Scene& scene = run_.scene;
    std::vector<Vec2d> places{scene.start.position};
    for (const compare::OtherCharacter& other : scene.others) places.push_back(other.start.position);
    all = Together(places, scene.scenery.colliders, scene.character);
    all.gravity = scene.gravity;
  }

  Together all = stepping::standing({});
  std::vector<CharacterState> before;  ///< The last step.
  compare::ExactPair pair{run_.scene.character.shape.hull()};

  /// Until the run is over. @return whether there was one.
  bool step() {
    if (step_ == run_.scene.steps) return false;
    for (const compare::Launch& launch : run_.launches_before(step_))
      all.states[launch.character].velocity = launch.velocity;
    before = all.states;
    const compare::StepInput input = cursor_.at(step_++);
    all.inputs.assign(input.players.begin(), input.players.end());
    all.dt = input.dt;
    std::ranges::copy(input.movers, all.movers.begin());
    all.step();
    return true;
  }

 private:
  compare::Script script_ = script_of(run_.scene);
  compare::InputCursor cursor_{run_.scene, script_};
  int step_ = 0;
};

/// Calls `check(party)` after each step of random parties. @return how many steps of characters there were.
template <class Check>
int step_parties(std::uint64_t first_seed, const Check& check) {
  const int wanted = std::max(20 * steps_per_family(), 10'000);  // a few parties are not like all
  int steps = 0;
  for (std::uint64_t seed = first_seed; steps < wanted; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Party party(seed);
    for (int step = 0; party.step(); ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step);
      check(party);
      steps += static_cast<int>(party.all.states.size());
      if (testing::Test::HasFatalFailure()) return steps;
    }
  }
  return steps;
}

/// The way of one leads past another as that stands in the turn of the first.
bool passes(const Together& all, const std::vector<CharacterState>& before, const compare::ExactPair& pair,
            std::size_t i, std::size_t other) {
  if (pair.overlap(before[i].position, before[other].position)) return true;
  const Vec2d place = (all.turn[other] < all.turn[i] ? all.states : before)[other].position;
  const std::vector<PathPoint>& path = all.reports[i].move.path;
  for (std::size_t k = 1; k < path.size(); ++k)
    if (pair.meet_between(path[k - 1].position, place, path[k].position, place)) return false;
  return true;
}

TEST(Together, at_random_no_two_come_to_overlap_none_gets_past_another_and_none_is_crushed_by_one) {
  std::size_t met = 0;
  const int steps = step_parties(1, [&](const Party& party) {
    const Together& all = party.all;
    std::vector<std::size_t> turns = all.turn;
    std::sort(turns.begin(), turns.end());
    for (std::size_t i = 0; i < turns.size(); ++i) {
      ASSERT_EQ(turns[i], i) << "each has one turn";
      ASSERT_FALSE(is_refused(all.reports[i].status));
      for (const ColliderIndex by : all.reports[i].move.crushed) ASSERT_FALSE(all.is_body(by)) << i;
      for (std::size_t other = 0; other < turns.size(); ++other) {
        if (other == i) continue;
        ASSERT_TRUE(passes(all, party.before, party.pair, i, other)) << i << " through " << other;
        ASSERT_TRUE(!party.pair.overlap(all.states[i].position, all.states[other].position) ||
                    party.pair.overlap(party.before[i].position, party.before[other].position))
            << i << " and " << other;
      }
      met += all.met(i).size();
    }
  });
  EXPECT_GT(met, static_cast<std::size_t>(steps / 20));
}

/// In 40 columns, thrown down and aside; the floor is level.
TEST(Together, a_thousand_that_fall_onto_each_other_neither_overlap_nor_pass_and_none_is_crushed) {
  constexpr std::size_t columns = 40;
  Random random(1);
  std::vector<Vec2d> places;
  const auto count = shortened(std::size_t{1000});
  for (std::size_t i = 0; i < count; ++i)
    places.emplace_back(static_cast<double>(i % columns) + random.between(0.85, 1.15),
                        0.8 + 1.5 * static_cast<double>(i / columns) + random.between(-0.05, 0.05));
  Together all = stepping::under_gravity(
      places, {compare::box(-1, -1, 42, 0), compare::box(-1, 0, 0, 90), compare::box(41, 0, 42, 90)});
  for (CharacterState& state : all.states) state.velocity = {random.between(-5, 5), random.between(-15, 0)};
  const compare::ExactPair pair(CharacterDef{}.shape.hull());
  std::size_t met = 0;
  for (int step = 0; step < 60; ++step) {
    const std::vector<CharacterState> before = all.states;
    all.step();
    for (std::size_t i = 0; i < places.size(); ++i) {
      ASSERT_TRUE(all.reports[i].move.crushed.empty()) << i << " in step " << step;
      met += all.met(i).size();
      for (std::size_t other = 0; other < places.size(); ++other) {
        const Vec2d& one = before[i].position;
        const Vec2d& another = before[other].position;
        if (other == i || std::abs(one.x() - another.x()) > 5 || std::abs(one.y() - another.y()) > 5) continue;
        ASSERT_TRUE(passes(all, before, pair, i, other)) << i << " through " << other << " in step " << step;
        ASSERT_FALSE(pair.overlap(all.states[i].position, all.states[other].position)) << i << " and " << other;
      }
    }
  }
  EXPECT_GT(met, 10 * count);
}

/// Whether none of the others comes where one may have touched it.
bool is_far_from_all(const Party& party, std::size_t i) {
  const Together& all = party.all;
  const Box2 might = all.controller->reach(party.before[i], all.context());
  const Box2 reach = might.merged(all.controller->reach(all.reports[i].move));
  for (std::size_t other = 0; other < all.states.size(); ++other) {
    const Box2 places = Box2::between(party.before[other].position, all.states[other].position);
    if (other != i && reach.overlaps(places + all.controller->character().shape.box())) return false;
  }
  return true;
}

TEST(Together, at_random_who_is_far_from_all_steps_as_alone) {
  int far = 0;
  StepReport report;
  const int steps = step_parties(1'000'000, [&](Party& party) {
    Together& all = party.all;
    for (std::size_t i = 0; i < all.states.size(); ++i) {
      if (!is_far_from_all(party, i)) continue;
      CharacterState alone = party.before[i];
      all.controller->step(alone, all.inputs[i], all.context(), all.scratch, report);
      ASSERT_TRUE(stepping::same_step(all.states[i], all.reports[i], alone, report)) << i;
      ++far;
    }
  });
  std::printf("%d steps, %d of them far from all others\n", steps, far);
  EXPECT_GT(far, steps / 8);
}

TEST(Together, at_random_the_order_in_which_they_are_given_decides_nothing) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(steps_per_family()) / 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Party ordered(seed);
    Party shuffled(seed);
    Random random(seed);
    for (int step = 0; ordered.step(); ++step) {
      std::vector<std::size_t>& order = shuffled.all.order;
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
      shuffled.step();
      ASSERT_EQ(ordered.all.turn, shuffled.all.turn) << step;
      for (std::size_t i = 0; i < order.size(); ++i)
        ASSERT_TRUE(stepping::same_step(ordered.all.states[i], ordered.all.reports[i], shuffled.all.states[i],
                                        shuffled.all.reports[i]))
            << i << " in step " << step;
    }
  }
}

}  // namespace
}  // namespace paperproof::test
