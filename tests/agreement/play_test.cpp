/// Play, judged: keys held and jumps at random, on levels as players meet them, at 60, 240 and 1,000 steps a second.
/// Nobody hangs, ends inside, passes anything, is stopped by what it does not name, or stands on what it does not
/// touch.
#include "agreement/recorded.hpp"
#include "oracle/judge.hpp"
#include "support/play_levels.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <cstdio>

namespace paperproof::test {
namespace {

using compare::ExactContact;
using compare::Judge;
using compare::StepJudgement;
using compare::TraceHeader;
using compare::TraceStep;

struct Played {
  int steps = 0;
  int in_air = 0;
  int steering = 0;  ///< Against something, in the air.
  int hanging = 0;
  int broken = 0;   ///< Ended inside, or passed something.
  int unnamed = 0;  ///< Stopped by what exact arithmetic confirms, and the report does not name.
  int dropped = 0;
  int stuck = 0;
  int misnamed_ground = 0;  ///< Not named where it is grounded, or named and not touched.

  [[nodiscard]] int wrong() const { return hanging + broken + unnamed + dropped + stuck + misnamed_ground; }
};

class Game {
 public:
  Game(PlayLevel level, double rate, std::uint64_t seed)
      : random_(seed),
        rate_(rate),
        scenery_(play_level(level, random_)),
        controller_(scenery_, character()),
        scratch_(controller_.make_scratch()),
        judge_(header()),
        oracle_(scenery_.as_run(), header().points) {
    state_.position = {random_.between(-25, 25), 12};
  }

  /// Ten seconds of play, or so many steps.
  void play(int most, Played& played) {
    const int steps = std::min(most, static_cast<int>(10 * rate_));
    for (int step = 0; step < steps; ++step) {
      if (held_-- <= 0) press();
      take(step, played);
      if (played.wrong() > 0) return;
    }
  }

 private:
  CharacterDef character() {
    CharacterDef def;
    def.shape = play_shape(random_.integer(0, 2));
    if (random_.chance(0.5)) def.snap = 0.3;
    return def;
  }

  TraceHeader header() {
    TraceHeader header;
    header.contender = "octagon_sweep";
    header.scalar = "double";
    header.dt = 1 / rate_;
    header.character.max_climb_degrees = controller_.character().max_climb_degrees;
    const auto hull = controller_.character().shape.hull();
    header.points.assign(hull.begin(), hull.end());
    header.scenery = scenery_.as_run();
    for (std::size_t i = 0; i < header.scenery.colliders.size(); ++i) header.ids.push_back(std::to_string(i));
    return header;
  }

  void press() {
    held_ = static_cast<int>(random_.between(0.2, 2.5) * rate_);
    input_.move = random_.integer(-1, 1);
    input_.jump = random_.chance(0.25);
  }

  void take(int step, Played& played) {
    const StepStatus status = controller_.step(state_, input_, {{0, -30}, 1 / rate_}, scratch_, report_);
    TraceStep record = recorded<double>(report_, state_, {});
    record.step = step;
    record.grounded = state_.grounded;
    record.stuck = status == StepStatus::stuck;
    record.dropped = status == StepStatus::dropped;
    const StepJudgement judged = judge_.judge(record);
    ++played.steps;
    played.in_air += !state_.grounded;
    played.steering += !state_.grounded && *input_.move != 0 && !record.contacts.empty();
    played.hanging += judged.hangs;
    played.broken += judged.broke();
    played.dropped += record.dropped;
    played.stuck += record.stuck;
    const Ground<double>& ground = report_.move.ground;
    const bool holds = ground.state == GroundState::walkable || ground.state == GroundState::wedge;
    played.misnamed_ground += state_.grounded != holds || (ground.state != GroundState::air &&
                                                           oracle_.separation(state_.position, ground.collider) > 1e-6);
    if (played.wrong() > 0) describe(record, judged);
  }

  static void describe(const TraceStep& record, const StepJudgement& judged) {
    const auto vector = [](const char* name, const Vec2d& v) { std::printf(" %s (%.17g, %.17g)", name, v.x(), v.y()); };
    std::printf("step %d:", record.step);
    vector("requested", record.requested);
    std::printf(" steered %.17g", record.steered);
    for (const PathPoint<double>& corner : record.path) vector("way", corner.position);
    for (const Contact<double>& contact : record.contacts) {
      vector("\n  named", contact.normal);
      std::printf(" of %u at %g", contact.collider, contact.fraction);
    }
    for (const ExactContact& contact : judged.contacts) {
      vector("\n  exact", contact.normal);
      std::printf(" of %u at %g", contact.collider, contact.fraction);
    }
    std::printf("\n");
  }

  /// An exact contact that is not reported, in a step that did not go where it was asked to go.
  static bool stopped_by_what_is_not_named(const TraceStep& record, const StepJudgement& judged) {
    const Vec2d way = record.path.back().position - record.path.front().position;
    if ((way - record.requested).norm() <= 1e-6) return false;
    if (record.contacts.empty()) return true;
    return std::any_of(judged.contacts.begin(), judged.contacts.end(), [&](const ExactContact& exact) {
      // A flush neighbour of what is named, reached just where the step ends, holds nothing by itself.
      return std::none_of(record.contacts.begin(), record.contacts.end(), [&](const Contact<double>& named) {
        return named.collider == exact.collider || named.normal.dot(exact.normal) > 1 - 1e-12;
      });
    });
  }

  Random random_;
  double rate_;
  Scenery<double> scenery_;
  Controller<double> controller_;
  Scratch<double> scratch_;
  Judge judge_;
  compare::ExactScenery oracle_;
  CharacterState<double> state_;
  StepReport<double> report_;
  Input input_;
  int held_ = 0;
};

class Play : public ::testing::TestWithParam<PlayLevel> {};

TEST_P(Play, never_hangs_at_any_rate) {
  const int wanted = steps_wanted("PAPERPROOF_PLAY_STEPS", sampled(4000));
  Played played;
  for (const double rate : {60.0, 240.0, 1000.0}) {
    const int until = played.steps + wanted;
    for (std::uint64_t seed = 1; played.steps < until; ++seed) {
      Game(GetParam(), rate, 7919 * seed + static_cast<std::uint64_t>(GetParam())).play(until - played.steps, played);
      ASSERT_EQ(played.wrong(), 0) << name_of(GetParam()) << " at " << rate << " Hz, seed " << seed << ", step "
                                   << played.steps << ": " << played.hanging << " hang, " << played.broken
                                   << " broken, " << played.unnamed << " stopped by what is not named, "
                                   << played.dropped << " dropped, " << played.stuck << " stuck, "
                                   << played.misnamed_ground << " misnamed ground";
    }
  }
  std::printf("%s: %d steps, %d in the air, %d of them steering against something\n", name_of(GetParam()).c_str(),
              played.steps, played.in_air, played.steering);
  EXPECT_GE(played.in_air, played.steps / 20) << "who never falls cannot hang";
}

INSTANTIATE_TEST_SUITE_P(EveryLevel, Play, ::testing::ValuesIn(all_play_levels),
                         [](const ::testing::TestParamInfo<PlayLevel>& level) { return name_of(level.param); });

}  // namespace
}  // namespace paperproof::test
