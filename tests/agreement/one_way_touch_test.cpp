/// One-way movers that reach the character exactly when a step ends, or touch it when one begins.
///
/// What the offset of a mover leaves of the position is rounded: so was the side that the character was taken for, and
/// a touch by a motion along the surface was not known to be near. It ended up to 8e-12 m below, and was not held any
/// more.
#include "agreement/recorded.hpp"
#include "oracle/judge.hpp"
#include "support/random_runs.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <sstream>

namespace paperproof::test {
namespace {

using compare::Judge;
using compare::Place;

struct Tally {
  int steps = 0;
  int touching = 0;  ///< Steps that begin with a gap of less than 1e-11 m, above;
  int beneath = 0;   ///< and not above.
  int held = 0;      ///< Steps that begin above and have a contact.
};

/// A one-way mover and a character that come together.
class Meeting {
 public:
  explicit Meeting(std::uint64_t seed)
      : seed_(seed),
        random_(seed),
        angle_(random_.chance(0.3) ? 0 : random_.between(-1, 1)),
        along_(std::cos(angle_), std::sin(angle_)),
        normal_(-along_.y(), along_.x()),
        middle_(random_.chance(0.5) ? Vec2d{0, 0} : Vec2d{random_.between(-1e4, 1e4), random_.between(-1e4, 1e4)}),
        scenery_({{{.shape = ColliderDef::Shape::chain,
                    .points = {middle_ - half * along_, middle_ + half * along_},
                    .one_way = Vec2d{0, 1},
                    .mover = 0}}}),
        controller_(scenery_, {}),
        scratch_(controller_.make_scratch()) {
    for (const Vec2d& corner : controller_.character().shape.hull()) low_ = std::min(low_, normal_.dot(corner));
  }

  void go(Tally& tally) {
    const double dt = random_.chance(0.5) ? 1.0 / 60 : random_.log_between(1e-4, 0.1);
    const Vec2d gravity{0, random_.chance(0.7) ? -30.0 : 0.0};
    state_.velocity = Vec2d::Zero();
    if (random_.chance(0.7))
      state_.velocity = {random_.either_sign_log_between(1e-3, 100), random_.either_sign_log_between(1e-3, 100)};
    const Vec2d way = (state_.velocity + gravity * dt) * dt;
    Vec2d to{random_.between(-2, 2), random_.between(-2, 2)};
    if (random_.chance(0.3)) to = Vec2d::Zero();
    // The requested motion ends where the two touch, but for rounding; the mover comes from below by `closes`.
    const double closes = random_.chance(0.3) ? 0 : random_.log_between(1e-16, 10);
    const double slides = random_.chance(0.3) ? 0 : random_.between(-1, 1);
    state_.position = middle_ + to + along_ * random_.between(-1, 1) - normal_ * low_ - way;
    motion_ = {to - (normal_ * closes + along_ * slides + way), to};
    TraceStepJudge judge(*this, dt);
    for (int step = 0; step < 6 && !::testing::Test::HasFailure(); ++step) {
      take(judge, gravity, dt, tally);
      motion_ = {motion_.to, motion_.to};
      if (random_.chance(0.5)) motion_.to += Vec2d{random_.between(-0.1, 0.1), random_.between(-0.1, 0.1)};
    }
  }

 private:
  static constexpr double half = 3;  ///< Of the chain's length [m].

  struct TraceStepJudge {
    TraceStepJudge(const Meeting& meeting, double dt) : judge(header(meeting, dt)) {}
    static compare::TraceHeader header(const Meeting& meeting, double dt) {
      compare::TraceHeader header;
      const auto hull = meeting.controller_.character().shape.hull();
      header.points.assign(hull.begin(), hull.end());
      header.scenery = meeting.scenery_.as_run();
      header.dt = dt;
      return header;
    }
    Judge judge;
  };

  /// Exactly: the way to the middle of the chain is stopped by it.
  [[nodiscard]] bool above(const Judge& judge, const Vec2d& position, double fraction) const {
    const std::vector<MoverMotion<double>> motions{motion_};
    const Vec2d middle = middle_ + motion_.at(fraction);
    return judge.scenery().meets(Place(position, motions, fraction), Place(middle, motions, fraction), 0);
  }

  void take(TraceStepJudge& judge, const Vec2d& gravity, double dt, Tally& tally) {
    const std::vector<MoverMotion<double>> motions{motion_};
    const bool begins_above = above(judge.judge, state_.position, 0);
    const double gap = normal_.dot(state_.position - middle_ - motion_.from) + low_;
    const CharacterState<double> before = state_;
    controller_.step(state_, {}, {gravity, dt, motions}, scratch_, report_);
    const compare::StepJudgement judged = judge.judge.judge(recorded(report_, state_, motions));
    const Vec2d place = state_.position - middle_ - motion_.to;
    // Beyond the tips nothing holds it.
    const bool beside = std::abs(place.dot(along_)) > half - 1.5;
    ++tally.steps;
    if (std::abs(gap) < 1e-11) ++(begins_above ? tally.touching : tally.beneath);
    tally.held += begins_above && !report_.move.contacts.empty();
    EXPECT_FALSE(judged.broke()) << where(before, gap);
    if (begins_above && !beside) {
      EXPECT_TRUE(above(judge.judge, state_.position, 1))
          << where(before, gap) << ", ends at " << normal_.dot(place) + low_;
    } else if (!begins_above) {
      EXPECT_TRUE(report_.move.contacts.empty()) << where(before, gap);
    }
  }

  [[nodiscard]] std::string where(const CharacterState<double>& before, double gap) const {
    std::ostringstream text;
    text.precision(17);
    text << "seed " << seed_ << ", angle " << angle_ << ", from " << before.position.transpose() << " at "
         << before.velocity.transpose() << ", gap " << gap << ", mover " << motion_.from.transpose() << " to "
         << motion_.to.transpose() << ", contacts " << report_.move.contacts.size() << ", status "
         << static_cast<int>(report_.status);
    return text.str();
  }

  std::uint64_t seed_;
  Random random_;
  double angle_;
  Vec2d along_;
  Vec2d normal_;
  Vec2d middle_;
  double low_ = std::numeric_limits<double>::infinity();
  Scenery<double> scenery_;
  Controller<double> controller_;
  Scratch<double> scratch_;
  CharacterState<double> state_;
  StepReport<double> report_;
  MoverMotion<double> motion_;
};

TEST(OneWayMover, holds_who_it_touches_exactly) {
  Tally tally;
  const int cases = steps_wanted("PAPERPROOF_ONE_WAY_CASES", sampled(400)) * 10;
  for (int i = 0; i < cases && !HasFailure(); ++i) Meeting(7000003 + static_cast<std::uint64_t>(i)).go(tally);
  std::printf("%d steps, %d touching from above, %d from beneath, %d held\n", tally.steps, tally.touching,
              tally.beneath, tally.held);
  EXPECT_GE(tally.touching, tally.steps * 0.02);
  EXPECT_GE(tally.beneath, tally.steps * 0.02);
  EXPECT_GE(tally.held, tally.steps * 0.2);
}

}  // namespace
}  // namespace paperproof::test
