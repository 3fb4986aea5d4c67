/// Play, judged: keys held and jumps at random, on levels as players meet them, at 60, 240 and 1,000 steps a second.
/// Every clause holds but for what is known and open, and the ground that is named is the ground that is stood on.
/// Levels and heroes step with the same bits on the same levels: `LevelInPlay`, `HeroInPlay`.
#include "agreement/recorded.hpp"
#include "agreement/run_trace.hpp"
#include "oracle/exact.hpp"
#include "support/play_levels.hpp"
#include "support/steps_wanted.hpp"

#include <paperproof/controller.hpp>

#include <gtest/gtest.h>

#include <cstdio>

namespace paperproof::test {
namespace {

using compare::TraceHeader;

struct Played {
  int steps = 0;
  int in_air = 0;
  int steering = 0;  ///< Against something, in the air.
  int dropped = 0;
  int stuck = 0;
  int misnamed_ground = 0;  ///< Not named where it is grounded, or named and not touched.

  [[nodiscard]] int wrong() const { return dropped + stuck + misnamed_ground; }
};

class Game {
 public:
  Game(PlayLevel level, double rate, std::uint64_t seed)
      : random_(seed),
        rate_(rate),
        scenery_(play_level(level, random_)),
        controller_(scenery_, character()),
        scratch_(controller_.make_scratch()),
        trace_(header(), "play",
               name_of(level) + "_at_" + std::to_string(static_cast<int>(rate)) + "_" + std::to_string(seed)),
        oracle_(scenery_.as_run(), header().points) {
    state_.position = {random_.between(-25, 25), 12};
  }

  /// Ten seconds of play, or so many steps.
  void play(int most, Played& played) {
    const int steps = std::min(most, static_cast<int>(10 * rate_));
    for (int step = 0; step < steps; ++step) {
      if (held_-- <= 0) press();
      take(played);
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
    header.dt = 1 / rate_;
    header.gravity = {0, -30};
    header.character = controller_.character();
    const auto hull = controller_.character().shape.hull();
    header.points.assign(hull.begin(), hull.end());
    header.scenery = scenery_.as_run();
    return header;
  }

  void press() {
    held_ = static_cast<int>(random_.between(0.2, 2.5) * rate_);
    input_.move = random_.integer(-1, 1);
    input_.jump = random_.chance(0.25);
  }

  void take(Played& played) {
    const CharacterState<double> before = state_;
    const StepStatus status = controller_.step(state_, input_, {{0, -30}, 1 / rate_}, scratch_, report_);
    trace_.write(recorded<double>(report_, state_, {}), before, input_, false);
    ++played.steps;
    played.in_air += !state_.grounded;
    played.steering += !state_.grounded && *input_.move != 0 && !report_.move.contacts.empty();
    played.dropped += status == StepStatus::dropped;
    played.stuck += status == StepStatus::stuck;
    const Ground<double>& ground = report_.move.ground;
    const bool holds = ground.state == GroundState::walkable || ground.state == GroundState::wedge;
    played.misnamed_ground += state_.grounded != holds || (ground.state != GroundState::air &&
                                                           oracle_.separation(state_.position, ground.collider) > 1e-6);
  }

  Random random_;
  double rate_;
  Scenery<double> scenery_;
  Controller<double> controller_;
  Scratch<double> scratch_;
  RunTrace trace_;
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
                                   << played.steps << ": " << played.dropped << " dropped, " << played.stuck
                                   << " stuck, " << played.misnamed_ground << " misnamed ground";
    }
  }
  BrokenByRuns::all().expect_only_what_is_known();
  std::printf("%s: %d steps, %d in the air, %d of them steering against something\n", name_of(GetParam()).c_str(),
              played.steps, played.in_air, played.steering);
  EXPECT_GE(played.in_air, played.steps / 20) << "who never falls cannot hang";
}

INSTANTIATE_TEST_SUITE_P(EveryLevel, Play, ::testing::ValuesIn(all_play_levels),
                         [](const ::testing::TestParamInfo<PlayLevel>& level) { return name_of(level.param); });

}  // namespace
}  // namespace paperproof::test
