/// Characters that take turns among random boxes and slopes, some of which move or turn.
#include "controller/together.hpp"
#include "oracle/pair.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace paperproof::test {
namespace {

using stepping::Together;

/// It goes to and fro, and may turn so.
struct Swing {
  Vec2d middle;
  Vec2d by;
  double pace;   ///< [radians/s]
  double angle;  ///< At most [radians].

  [[nodiscard]] MoverMotion at(double time) const {
    const double share = std::sin(pace * time);
    return {{0, 0}, middle + share * by, 0, share * angle};
  }
};

ColliderDef block(const Vec2d& middle, double half_width, double half_height, double angle, MoverIndex mover) {
  const Vec2d along = half_width * compare::towards(angle);
  const Vec2d across = half_height * compare::towards(angle + 90 * compare::degree);
  return compare::polygon(
      {middle - along - across, middle + along - across, middle + along + across, middle - along + across}, mover);
}

class Party {
 public:
  explicit Party(std::uint64_t seed) : random(seed) {
    std::vector<ColliderDef> colliders{compare::box(-30, -2, 30, 0)};
    for (int i = 0; i < 6; ++i) {
      const Vec2d middle(random.between(-6, 6), random.between(0, 6));
      colliders.push_back(
          block(middle, random.between(0.1, 2), random.between(0.05, 0.6), i % 2 * random.between(-1, 1), no_mover));
    }
    const bool turn = random.chance(0.2);
    for (int i = random.integer(0, 3); i > 0; --i) {
      colliders.push_back(
          block({0, 0}, random.between(0.3, 2), random.between(0.1, 1), 0, static_cast<MoverIndex>(swings.size())));
      swings.push_back(
          {{random.between(-4, 4), random.between(-0.5, 4)}, random.point(2), random.between(0.5, 6), turn ? 0.5 : 0});
    }
    const CharacterDef walker{.snap = 0.2, .step_height = 0.2};
    const int count = random.chance(0.1) ? random.integer(20, 40) : random.integer(2, 12);
    all = stepping::under_gravity(std::vector<Vec2d>(static_cast<std::size_t>(count)), colliders,
                                  random.chance(0.5) ? walker : CharacterDef{});
    for (std::size_t k = 0; k < swings.size(); ++k) all.movers[k] = moved(swings[k].at(0), swings[k].at(0));
    for (std::size_t i = 0; i < all.states.size(); ++i) place(i);
  }

  Random random;
  std::vector<Swing> swings;
  Together all = stepping::standing({});
  std::vector<CharacterState> before;  ///< The last step.

  void step() {
    before = all.states;
    time_ += all.dt;
    for (Input& input : all.inputs) {
      if (step_ % 20 == 0) input.move = random.integer(-1, 1);
      input.jump = random.chance(input.jump ? 0.8 : 0.05);
    }
    ++step_;
    for (std::size_t k = 0; k < swings.size(); ++k) all.movers[k] = moved(all.movers[k], swings[k].at(time_));
    all.step();
  }

 private:
  static MoverMotion moved(const MoverMotion& from, const MoverMotion& to) {
    return {from.to, to.to, from.to_angle, to.to_angle};
  }

  /// Somewhere free, or else far from all.
  void place(std::size_t i) {
    const double half = 1.2 * std::sqrt(static_cast<double>(all.states.size())) + 1;
    CharacterState& state = all.states[i];
    for (int tries = 0; tries < 200; ++tries) {
      state.position = {random.between(-half, half), random.between(0.6, half + 2)};
      if (all.controller->overlaps(state.position, all.context(), all.scratch) != std::size_t{0}) continue;
      state.velocity = {random.between(-10, 10), random.between(-20, 5)};
      if (random.chance(0.05)) state.velocity *= 30;
      if (std::none_of(all.states.begin(), all.states.begin() + static_cast<std::ptrdiff_t>(i),
                       [&](const CharacterState& other) { return pair.overlap(other.position, state.position); }))
        return;
    }
    state.position = {12 + 2 * static_cast<double>(i), 1};
  }

 public:
  compare::ExactPair pair{CharacterDef{}.shape.hull()};

 private:
  double time_ = 0;
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
    for (int step = 0; step < 60; ++step) {
      SCOPED_TRACE(testing::Message() << "step " << step);
      party.step();
      check(party);
      steps += static_cast<int>(party.all.states.size());
      if (testing::Test::HasFatalFailure()) return steps;
    }
  }
  return steps;
}

/// Of the steps of characters.
struct Shares {
  int met = 0;
  int rode = 0;     ///< On another.
  int pushed = 0;   ///< By another.
  int crushed = 0;  ///< By a mover.

  void count(const Party& party, std::size_t i) {
    const Together& all = party.all;
    const std::vector<Contact> others = all.met(i);
    const Vec2d way = all.states[i].position - party.before[i].position;
    const bool rides = all.is_body(party.before[i].ride.ground);
    met += !others.empty();
    rode += rides;
    // Another comes to it, and it goes away farther than it would.
    pushed += !rides && std::any_of(others.begin(), others.end(), [&](const Contact& contact) {
      return way.dot(contact.normal) > std::max(party.before[i].velocity.dot(contact.normal), 0.0) * all.dt + 1e-3;
    });
    crushed += !all.reports[i].move.crushed.empty();
  }
};

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
  Shares shares;
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
      shares.count(party, i);
    }
  });
  std::printf("%d steps: %d met others, %d rode on one, %d were pushed by one, %d crushed\n", steps, shares.met,
              shares.rode, shares.pushed, shares.crushed);
  EXPECT_GT(shares.met, steps / 20);
  EXPECT_GT(shares.rode, steps / 100);
  EXPECT_GT(shares.pushed, steps / 2000);
  EXPECT_GT(shares.crushed, steps / 10000);
}

/// In 40 columns, thrown down and aside; the floor is level.
TEST(Together, a_thousand_that_fall_onto_each_other_neither_overlap_nor_pass_and_none_is_crushed) {
  constexpr std::size_t columns = 40;
  Random random(1);
  std::vector<Vec2d> places;
  for (std::size_t i = 0; i < 1000; ++i)
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
        const Vec2d apart = before[i].position - before[other].position;
        if (other == i || apart.cwiseAbs().maxCoeff() > 5) continue;
        ASSERT_TRUE(passes(all, before, pair, i, other)) << i << " through " << other << " in step " << step;
        ASSERT_FALSE(pair.overlap(all.states[i].position, all.states[other].position)) << i << " and " << other;
      }
    }
  }
  EXPECT_GT(met, 10'000U);
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
  EXPECT_GT(far, steps / 4);
}

TEST(Together, at_random_the_order_in_which_they_are_given_decides_nothing) {
  for (std::uint64_t seed = 1; seed <= static_cast<std::uint64_t>(steps_per_family()) / 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Party ordered(seed);
    Party shuffled(seed);
    Random random(seed);
    for (int step = 0; step < 60; ++step) {
      std::vector<std::size_t>& order = shuffled.all.order;
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
      ordered.step();
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
