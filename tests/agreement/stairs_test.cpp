/// Walkers that climb stairs and follow their ground down, in levels as players meet them: every clause holds but for
/// what is known and open.
#include "agreement/judged_step.hpp"
#include "agreement/run_trace.hpp"
#include "support/play_levels.hpp"
#include "support/random.hpp"
#include "support/steps_wanted.hpp"

#include <gtest/gtest.h>

namespace paperproof::test {
namespace {

class Stairs : public ::testing::TestWithParam<PlayLevel> {};

/// A lift or a press that goes to and fro.
ColliderDef shuttle(Random& random) {
  const double x = random.between(-25, 25);
  const double y = random.between(-12, -9);
  const double width = random.between(0.3, 4);
  return box(x, y, x + width, y + random.between(0.05, 0.5), 0);
}

TEST_P(Stairs, are_climbed_and_descended_within_the_guarantee) {
  const int wanted = steps_wanted("PAPERPROOF_STAIRS_STEPS", 4000);
  int steps = 0;
  int climbed = 0;
  int descended = 0;
  for (std::uint64_t seed = 1; steps < wanted; ++seed) {
    Random random(seed);
    SceneryDef def = play_level(GetParam(), random);
    def.colliders.push_back(shuttle(random));
    CharacterDef character;
    character.shape = play_shape(random.integer(0, 2));
    character.step_height = random.between(0.1, 0.6);
    character.snap = random.between(0.01, 0.6);
    const double dt = 1.0 / random.integer(30, 120);
    Judged run(def.colliders, {random.between(-25, 25), random.between(-8, 8)}, dt, character);
    run.gravity = {0, -30};
    run.looks_for_room = false;  // the trace's judge does
    compare::TraceHeader header;
    header.dt = dt;
    header.gravity = run.gravity;
    header.character = run.controller.character();
    header.points.assign(character.shape.hull().begin(), character.shape.hull().end());
    header.scenery = run.scenery.as_run();
    RunTrace trace(std::move(header), "stairs", name_of(GetParam()) + "_" + std::to_string(seed));
    const Vec2d speed{random.between(-2, 2), random.between(-1, 1)};
    Input input;
    for (int i = 0; i < 200; ++i, ++steps) {
      if (i % 25 == 0) input = {.move = random.chance(0.5) ? 1.0 : random.between(-1, 1), .jump = random.chance(0.1)};
      const CharacterState<double> before = run.state;
      run.step_by((i / 50 % 2 == 0 ? speed : Vec2d(-speed)) * dt, input);
      trace.write(recorded<double>(run.report, run.state, run.motions), before, input, false);
      double up = 0;
      const auto& path = run.report.move.path;
      for (std::size_t k = 1; k < path.size(); ++k)
        if (path[k].position.x() == path[k - 1].position.x() && path[k].fraction == path[k - 1].fraction &&
            path[k].fraction > 0)
          up = std::max(up, path[k].position.y() - path[k - 1].position.y());
      if (run.report.status != StepStatus::moved) continue;
      ASSERT_LE(up, character.step_height + 1e-5) << "seed " << seed << ", step " << i;
      climbed += up > 1e-3 && run.state.grounded;
      descended +=
          before.grounded && run.state.grounded && before.position.y() - run.state.position.y() > 30 * dt * dt + 1e-3;
    }
  }
  BrokenByRuns::all().expect_only_what_is_known(name_of(GetParam()));
  if (GetParam() == PlayLevel::kerbs) {
    EXPECT_GE(climbed, steps / 2000);
    EXPECT_GE(descended, steps / 1000);
  }
}

INSTANTIATE_TEST_SUITE_P(EveryLevel, Stairs, ::testing::ValuesIn(all_play_levels),
                         [](const ::testing::TestParamInfo<PlayLevel>& level) { return name_of(level.param); });

}  // namespace
}  // namespace paperproof::test
