/// No room to spare between what stands and what moves, and between what moves and what moves: what rests is as solid
/// as what stands still, and only what comes closer crushes.
#include "agreement/judged_step.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace paperproof::test {
namespace {

using compare::StepJudgement;

constexpr double dt = 1.0 / 60;

ColliderDef cabin(MoverIndex mover) {
  ColliderDef collider{
      .points = {{-1, -1}, {1, -1}, {1, 2}, {0.3125, 2}, {0.3125, 0}, {-0.3125, 0}, {-0.3125, 2}, {-1, 2}}};
  collider.mover = mover;
  return collider;
}

TEST(ExactFit, a_plate_that_comes_down_crushes_and_the_floor_does_not) {
  Judged run({box(-5, -1, 5, 0), box(-2, 1.25, 2, 1.5, 0)}, {0, half_height}, dt);
  run.gravity = {0, -30};
  const StepJudgement judged = run.step_by({0, -3}, {.move = 0});
  EXPECT_TRUE(holds(judged));
  EXPECT_EQ(run.crushed(), std::set<ColliderIndex>{1});
  EXPECT_EQ(judged.crushed, std::vector<ColliderIndex>{1});
}

TEST(ExactFit, a_cabin_as_wide_as_the_character_carries_it_up) {
  for (const double above_floor : {0.375, 1e-3, 5e-7, 1e-9, 0.0}) {
    Judged run({cabin(0)}, {0, half_height + above_floor}, dt);
    run.gravity = {0, -30};
    for (int step = 1; step <= 3; ++step) {
      EXPECT_TRUE(holds(run.step_by({0, 5}))) << above_floor;
      EXPECT_TRUE(run.crushed().empty()) << above_floor;
      EXPECT_NEAR(run.state.position.y(), 5 * step + half_height, 1e-6) << above_floor;
      EXPECT_TRUE(run.state.grounded) << above_floor;
    }
  }
}

TEST(ExactFit, under_a_lift_that_rests_it_bumps_its_head) {
  for (const double at : {0.0, 0.1, 7.3}) {  // where the lift rests, sideways
    Judged run({box(-5, -1, 5, 0), box(-2 - at, 1.25, 2 - at, 1.5, 0)}, {0, half_height}, dt);
    run.gravity = {0, -30};
    run.motions[0] = {{at, 0}, {at, 0}};
    for (int step = 0; step < 30; ++step) {
      EXPECT_TRUE(holds(run.step_by({0, 0}, {.move = 0, .jump = step >= 5}))) << step;
      EXPECT_EQ(run.state.position, Vec2d(0, half_height)) << step;
      EXPECT_EQ(run.report.status, StepStatus::moved);
      if (step == 5) {
        EXPECT_TRUE(std::any_of(run.report.move.contacts.begin(), run.report.move.contacts.end(),
                                [](const Contact<double>& c) { return c.collider == 1 && c.side == Side::top; }));
      }
    }
    EXPECT_TRUE(run.state.grounded);
  }
}

TEST(ExactFit, in_a_cabin_that_rests_it_falls_to_the_floor_and_stands) {
  Judged run({cabin(0)}, {0, 1}, dt);
  run.gravity = {0, -30};
  for (int step = 0; step < 60; ++step) {
    EXPECT_TRUE(holds(run.step_by(Vec2d(0, 0)))) << step;
    EXPECT_EQ(run.state.position.x(), 0);
  }
  EXPECT_TRUE(run.state.grounded);
  EXPECT_NEAR(run.state.position.y(), half_height, 1e-6);
}

/// What happened in all cases.
struct Tally {
  int cases = 0;
  int steps = 0;
  int crushed = 0;
  int carried = 0;
  int stuck = 0;
  int bumped = 0;
  int bumped_standing = 0;  ///< It jumped from where it stands.
  int broken = 0;
  int unfounded = 0;  ///< Contacts, where all rests.

  [[nodiscard]] bool is_right() const { return broken == 0 && unfounded == 0; }
};

enum class Movers : std::uint8_t { rest, go };

/// Walls, floors and plates at a small distance on opposite sides of a character; each stands, rests or goes.
class Fit {
 public:
  Fit(std::uint64_t seed, Movers movers) : seed_(seed), random_(seed), movers_(movers) {
    constexpr std::array gaps{0.0, 1e-9, 1e-8, 1e-7, 2e-7};
    gap_ = gaps[static_cast<std::size_t>(random_.integer(0, 4))];
    position_ = {coordinate(), coordinate()};
    common_ = motion();
    const int sides = random_.integer(0, 2);
    if (sides != 1) add_pair(0);
    if (sides != 0) add_pair(1);
  }

  void go(Tally& tally) {
    Judged run(colliders_, position_, dt);
    constexpr std::array pulls{0, -10, -30};
    run.gravity = {0, pulls[static_cast<std::size_t>(random_.integer(0, 2))]};
    run.motions = offsets_;
    ++tally.cases;
    for (int step = 0; step < 3; ++step) {
      for (std::size_t k = 0; k < run.motions.size(); ++k)
        run.motions[k] = {run.motions[k].to, run.motions[k].to + ways_[k]};
      const Input input{.move = random_.integer(-1, 1), .jump = random_.chance(0.4)};
      const Vec2d before = run.state.position;
      const bool stood = run.state.grounded;
      const StepJudgement judged = run.step(input);
      ++tally.steps;
      tally.crushed += run.report.status == StepStatus::crushed;
      tally.stuck += run.report.status == StepStatus::stuck;
      tally.carried += run.state.ride.ground != Ride<double>::none && run.state.position != before;
      const bool bumps = touches(run.report.move, Side::top);
      tally.bumped += bumps;
      tally.bumped_standing += bumps && stood && run.state.grounded;
      const int unfounded_here = movers_ == Movers::rest ? unfounded(judged, run.report.move) : 0;
      if (holds(judged) && unfounded_here == 0) continue;
      tally.broken += !holds(judged);
      tally.unfounded += unfounded_here;
      std::printf("breaks: seed %d, step %d, gap %g, status %d: %zu entered, %zu passed, %zu refuted, %d unfounded\n",
                  static_cast<int>(seed_), step, gap_, static_cast<int>(run.report.status), judged.entered.size(),
                  judged.tunnelled.size() + judged.corner_cut.size(), judged.crushed_with_room.size(), unfounded_here);
      return;
    }
  }

 private:
  static bool touches(const MoveResult<double>& move, Side side) {
    return std::any_of(move.contacts.begin(), move.contacts.end(),
                       [side](const Contact<double>& contact) { return contact.side == side; });
  }
  /// Of a grid, so that no gap is rounded away.
  double coordinate() { return random_.integer(-64, 64) / 64.0; }
  Vec2d motion() {
    const double scale = random_.chance(0.5) ? 1.0 / 16 : 1.0 / 3;
    Vec2d way{random_.integer(-2, 2) * scale, random_.integer(-2, 2) * scale};
    if (random_.chance(0.5)) way[random_.integer(0, 1)] = 0;
    return way;
  }

  /// @param axis 0: left and right, 1: below and above.
  void add_pair(int axis) {
    for (const double sign : {-1.0, 1.0}) {
      const double half = axis == 0 ? half_width : half_height;
      Vec2d lower = position_ - Vec2d(2, 2);
      Vec2d upper = position_ + Vec2d(2, 2);
      if (random_.chance(0.2)) lower[1 - axis] = position_[1 - axis];  // there is a way around
      const double near = position_[axis] + sign * (half + gap_);
      (sign < 0 ? lower : upper)[axis] = near + sign * random_.integer(1, 4) / 8.0;
      (sign < 0 ? upper : lower)[axis] = near;
      ColliderDef def = box(lower.x(), lower.y(), upper.x(), upper.y());
      const int kind = random_.integer(0, 4);
      if (kind > 0) {
        def.mover = static_cast<MoverIndex>(ways_.size());
        Vec2d offset{coordinate(), coordinate()};
        if (gap_ > 0 && random_.chance(0.5)) offset *= 1.0 / 3;
        for (Vec2d& point : def.points) point -= offset;
        offsets_.push_back({offset, offset});
        const Vec2d way = kind == 1 ? Vec2d(0, 0) : kind == 2 ? motion() : common_;
        ways_.push_back(movers_ == Movers::go ? way : Vec2d(0, 0));
      }
      colliders_.push_back(def);
    }
  }

  std::uint64_t seed_;
  Random random_;
  Movers movers_;
  double gap_ = 0;
  Vec2d position_;
  Vec2d common_;  ///< Of the parts of a cabin, per step [m].
  std::vector<ColliderDef> colliders_;
  std::vector<MoverMotion<double>> offsets_;
  std::vector<Vec2d> ways_;
};

TEST(ExactFit, of_any_kind_is_neither_entered_nor_passed_and_only_what_comes_closer_crushes) {
  constexpr int cases = sampled(10000);
  Tally all;
  for (std::uint64_t seed = 1; all.cases < cases && all.broken < 20; ++seed) Fit(seed, Movers::go).go(all);
  std::printf("%d cases, %d steps, %d crushed, %d carried, %d stuck, %d bumped; %d broken\n", all.cases, all.steps,
              all.crushed, all.carried, all.stuck, all.bumped, all.broken);
  EXPECT_EQ(all.broken, 0);
  EXPECT_GE(all.crushed, cases / 20);
  EXPECT_GE(all.carried, cases / 20);
  EXPECT_GE(all.bumped, cases / 20);
}

/// Who jumps where it stands, and bumps its head at once, stands again, and the jump led into the ceiling alone; so
/// with a push against a wall where nothing pulls down.
TEST(ExactFit, what_the_motion_does_not_lead_into_is_no_contact) {
  constexpr int cases = sampled(10000);
  Tally all;
  for (std::uint64_t seed = 1; all.cases < cases && all.is_right(); ++seed) Fit(seed, Movers::rest).go(all);
  std::printf("%d cases, %d steps, %d bumped where they stand; %d broken, %d unfounded\n", all.cases, all.steps,
              all.bumped_standing, all.broken, all.unfounded);
  EXPECT_TRUE(all.is_right());
  EXPECT_GE(all.bumped_standing, cases / 20);
}

/// A lift that goes metres in one step and leaves no room under the ceiling. The way aside leads down past the rim of
/// the lift, by what the character stands above it: 5e-7 m. Where the lift is narrow that is enough for the rim and for
/// the ceiling, and where it is wide one of them is passed within the hit distance, which is not asked for. The
/// controller ends 5e-7 m under the ceiling. The judge finds room for 1e-7 m, too: these crushes are known and open,
/// and counted.
TEST(ExactFit, a_lift_that_closes_it_crushes_only_where_no_way_aside_is_open) {
  constexpr int lifts = sampled(8000);
  constexpr std::uint64_t seed = 15;
  Random random(seed);
  int crushed = 0;
  int gave_way = 0;
  int nearer = 0;
  for (int n = 0; n < lifts; ++n) {
    const double half = random.between(0.2, 4);
    const double rise = random.between(0.5, 5);
    const double clearance = random.chance(0.5) ? 0 : random.log_between(1e-9, 1e-7);
    const double ceiling = 2 * half_height + rise + clearance;
    const double to_the_left = random.between(-half, half);
    const double stands = Tolerances<double>{}.stop;
    constexpr double hit = 1e-7;
    const double to_rim = half + half_width / 2 - std::abs(to_the_left);
    const double kept = stands - (2 * stands - clearance) / (rise + to_rim) * to_rim;  // by the way that keeps most
    if (kept >= hit && kept < 1.26e-7) continue;
    Judged run({box(-20, ceiling, 20, ceiling + 1), box(-half, -0.1, half, 0, 0)}, {to_the_left, half_height}, dt);
    run.gravity = {0, -10};
    const double kept_nearer = stands - (stands + hit - clearance) / (rise + 0.25) * to_rim;
    for (int step = 0; step < 2; ++step) {
      const bool right = holds(run.step_by({0, step == 0 ? rise : 0}));
      nearer += !right;
      ASSERT_TRUE(right || (kept < hit && kept_nearer >= hit))
          << "seed " << seed << ", lift " << n << ", step " << step << ": half as wide as " << half << ", rise " << rise
          << ", clearance " << clearance << ", from " << to_the_left;
    }
    const bool lies_on_it = !run.on_it().empty();
    crushed += lies_on_it;
    gave_way += !lies_on_it && std::abs(run.state.position.x()) > half;
  }
  std::printf("%d lifts: %d crushed, %d gave way; %d crushed with room for 1e-7 m only\n", lifts, crushed, gave_way,
              nearer);
  EXPECT_GE(crushed, lifts / 20);
  EXPECT_GE(gave_way, lifts / 10);
  EXPECT_LE(nearer, lifts / 15);
}

}  // namespace
}  // namespace paperproof::test
