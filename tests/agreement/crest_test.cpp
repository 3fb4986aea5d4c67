/// Flights and walks over the knee where two flanks meet, each flank of one tile or two: nothing but the flanks, and
/// what the character has between their normals at a crest, is ever met, and where both flanks are walked on the
/// horizontal speed stays what it is.
#include "agreement/judged_step.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace paperproof::test {
namespace {

using compare::StepJudgement;

constexpr double degree = std::numbers::pi / 180;

enum class Made : std::uint8_t { tiles, tiles_of_a_mover, polygon, chain, one_way };

/// What happened over all knees.
struct Crossings {
  int knees = 0;
  int steps = 0;
  int crossed = 0;  ///< Ended on the other side.
  int touched = 0;  ///< Steps with a contact.
  int broken = 0;
  int ghosts = 0;  ///< Contacts with a normal that the surface does not have there.
  int slowed = 0;  ///< Steps that took horizontal speed, where all is walked on.

  [[nodiscard]] bool is_right() const { return broken == 0 && ghosts == 0 && slowed == 0; }
};

/// Two flanks that meet at `knee`, and somebody who comes along the first of them.
class Knee {
 public:
  Knee(std::uint64_t seed, double steepest) : seed_(seed), random_(seed), steepest_(steepest) {
    character_.shape = play_shape(random_.integer(0, 2));
    knee_ = {random_.between(-20, 20), random_.between(-20, 20)};
    for (double& rise : rises_) rise = any_rise();
    // The other side of a steep segment may be met from below.
    made_ = static_cast<Made>(random_.integer(0, is_walked_on() ? 4 : 2));
    build();
    dt_ = random_.chance(0.3) ? 1.0 / 60 : 1 / random_.log_between(60, 8192);
    gravity_ = {0, -random_.log_between(1, 50)};
    place();
  }

  void go(Crossings& all) {
    Judged run(colliders_, position_, dt_, character_);
    if (!run.on_it().empty()) return;
    run.gravity = gravity_;
    run.state.velocity = velocity_;
    run.state.grounded = grounded_;
    ++all.knees;
    for (int step = 0; step < 6; ++step) {
      const StepJudgement judged = run.step_by(lift_ * dt_);
      ++all.steps;
      all.touched += !run.report.move.contacts.empty();
      all.broken += !holds(judged);
      for (const Contact<double>& contact : run.report.move.contacts) all.ghosts += !belongs(contact.normal);
      all.slowed += is_walked_on() && lift_ == Vec2d(0, 0) && run.state.velocity.x() != velocity_.x();
      if (!all.is_right()) return describe(run, step);
    }
    all.crossed += towards_.dot(run.state.position - position_) > distance_;
  }

 private:
  double any_rise() {
    constexpr std::array some{-45.0, 0.0, 45.0, 50.0, -50.0};
    if (random_.chance(0.4)) return some[static_cast<std::size_t>(random_.integer(0, 4))];
    return random_.between(-steepest_, steepest_);
  }
  [[nodiscard]] Vec2d along(int side) const {
    const double angle = rises_[static_cast<std::size_t>(side)] * degree;
    return {std::cos(angle), std::sin(angle)};
  }
  [[nodiscard]] Vec2d normal(int side) const { return {-along(side).y(), along(side).x()}; }
  [[nodiscard]] bool is_walked_on() const { return steepest_ <= character_.max_climb_degrees; }

  void build() {
    std::vector<Vec2d> ground{knee_ - along(0) * 4, knee_, knee_ + along(1) * 4};
    if (random_.chance(0.5)) ground.insert(ground.begin() + 1, knee_ - along(0) * random_.log_between(1e-2, 3));
    if (random_.chance(0.5)) ground.insert(ground.end() - 1, knee_ + along(1) * random_.log_between(1e-2, 3));
    const double bottom = knee_.y() - 20;
    switch (made_) {
      case Made::tiles:
      case Made::tiles_of_a_mover:
        for (std::size_t i = 1; i < ground.size(); ++i) {
          const Vec2d& a = ground[i - 1];
          const Vec2d& b = ground[i];
          colliders_.push_back({.points = {{a.x(), bottom}, {b.x(), bottom}, b, a}});
          if (made_ == Made::tiles_of_a_mover) colliders_.back().mover = 0;
        }
        break;
      case Made::polygon:
        colliders_.push_back({.points = {{ground.front().x(), bottom}, {ground.back().x(), bottom}}});
        colliders_.back().points.insert(colliders_.back().points.end(), ground.rbegin(), ground.rend());
        break;
      case Made::chain:
      case Made::one_way:
        colliders_.push_back({.shape = ColliderDef::Shape::chain, .points = ground});
        if (made_ == Made::one_way) colliders_.back().one_way = Vec2d(0, 1);
        break;
    }
  }

  /// Up to a few steps from where the character's last point to touch the flank is at the knee.
  void place() {
    const int side = random_.integer(0, 1);
    const Vec2d on = side == 0 ? along(0) : -along(1);  // towards the knee
    const Vec2d n = normal(side);
    Vec2d lowest = character_.shape.hull().front();
    for (const Vec2d& point : character_.shape.hull())
      if (n.dot(point) < n.dot(lowest) - 1e-12) lowest = point;
    const double speed = random_.log_between(0.1, 30);
    velocity_ = on * speed;
    if (made_ == Made::tiles_of_a_mover && random_.chance(0.5))
      lift_ = {random_.between(-3, 3), random_.between(-3, 3)};
    velocity_ += lift_;
    if (random_.chance(0.4)) velocity_ += n * random_.either_sign_log_between(1e-9, 3);
    const double gap = random_.chance(0.6) ? Tolerances<double>{}.stop : random_.log_between(2e-7, 1e-3);
    grounded_ = random_.chance(0.5);
    towards_ = on;
    distance_ = speed * dt_ * random_.between(0, 5);
    position_ = knee_ - lowest + n * gap - on * distance_;
  }

  /// Whether the surface has a place with this normal, for what is above it. A facet of which more than a micrometre is
  /// less than a nanometre inside what covers it counts as open.
  [[nodiscard]] bool belongs(const Vec2d& n) const {
    constexpr double same = 1e-3;
    if ((n - normal(0)).norm() < same || (n - normal(1)).norm() < same) return true;
    const auto left_of = [](const Vec2d& a, const Vec2d& b) { return a.x() * b.y() - a.y() * b.x() > 0; };
    return rises_[0] > rises_[1] && left_of(normal(1), n) && left_of(n, normal(0));
  }

  void describe(const Judged& run, int step) const {
    std::printf(
        "seed %d, step %d of %g s: flanks of %.17g and %.17g degrees, made as %d, velocity (%.17g, %.17g), gravity "
        "%g\n",
        static_cast<int>(seed_), step, dt_, rises_[0], rises_[1], static_cast<int>(made_), velocity_.x(), velocity_.y(),
        gravity_.y());
    for (const Contact<double>& contact : run.report.move.contacts)
      std::printf("  meets %u with normal (%.17g, %.17g) at %g\n", contact.collider, contact.normal.x(),
                  contact.normal.y(), contact.fraction);
    std::printf("  goes on with (%.17g, %.17g)\n", run.state.velocity.x(), run.state.velocity.y());
  }

  std::uint64_t seed_;
  Random random_;
  double steepest_;  ///< Flank [degrees].
  CharacterDef character_;
  Vec2d knee_;
  std::array<double, 2> rises_{};  ///< Of the flanks, towards larger x [degrees].
  Made made_ = Made::tiles;
  std::vector<ColliderDef> colliders_;
  double dt_ = 0;
  Vec2d gravity_;
  Vec2d position_;
  Vec2d velocity_;
  Vec2d lift_{0, 0};     ///< Velocity of the mover.
  Vec2d towards_;        ///< The knee, along a flank,
  double distance_ = 0;  ///< and how far it is.
  bool grounded_ = false;
};

class Crest : public ::testing::TestWithParam<double> {};

TEST_P(Crest, is_crossed_as_the_law_says) {
  constexpr int knees = sampled(20000);
  Crossings all;
  for (std::uint64_t seed = 1; all.knees < knees && all.is_right(); ++seed) Knee(seed, GetParam()).go(all);
  std::printf("%d knees, %d steps, %d crossed, %d touched; %d broken, %d ghosts, %d slowed\n", all.knees, all.steps,
              all.crossed, all.touched, all.broken, all.ghosts, all.slowed);
  EXPECT_TRUE(all.is_right());
  EXPECT_GE(all.crossed, knees / 2);
  EXPECT_GE(all.touched, all.steps / 4);
  EXPECT_LE(all.touched, all.steps * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Degrees, Crest, ::testing::Values(50.0, 89.0));

}  // namespace
}  // namespace paperproof::test
