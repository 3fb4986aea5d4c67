#include "studies/bullet.hpp"
#include "runs/run_case.hpp"

#include <gtest/gtest.h>

namespace paperproof::compare {
namespace {

TEST(Wilson, is_as_tabulated) {
  EXPECT_DOUBLE_EQ(wilson(0, 0).high, 1);
  EXPECT_DOUBLE_EQ(wilson(0, 10).low, 0);
  EXPECT_NEAR(wilson(0, 10).high, 0.2775, 1e-4);
  EXPECT_NEAR(wilson(5, 10).low, 0.2366, 1e-4);
  EXPECT_NEAR(wilson(5, 10).high, 0.7634, 1e-4);
  EXPECT_NEAR(wilson(10, 10).low, 0.7225, 1e-4);
}

TEST(BulletTheory, is_as_worked_out_by_hand) {
  EXPECT_NEAR(bullet_theory({"penetration_resolution"}, 0.01).lowest.value(), 0.6, 1e-12);
  EXPECT_NEAR(bullet_theory({"discrete"}, 0.1).lowest.value(), 81, 1e-12);
  EXPECT_NEAR(bullet_theory({"mask"}, 0.1).lowest.value(), (1.25 + 2.0 / 32) * 60, 1e-9) << "three rows, less one";
  EXPECT_EQ(bullet_theory({"mask"}, 0.01).lowest, 0) << "no middle of a pixel is in it";
  EXPECT_FALSE(bullet_theory({"pixel_colour"}, 0.1).lowest);
  EXPECT_NEAR(bullet_theory({"speculative_march"}, 0.01).lowest.value(), 0.6, 1e-12);
  EXPECT_FALSE(bullet_theory({"speculative_march"}, 0.1).lowest) << "thicker than its unit";
  // The rows 0, 0.3125, 0.9375, 1.25 leave a gap of circles from 0.10385 m on.
  EXPECT_NEAR(bullet_theory({"wind_back"}, 0.1).lowest.value(), 6.2308, 1e-3);
  EXPECT_TRUE(bullet_theory({"octagon_sweep"}, 0.01).known);
  EXPECT_FALSE(bullet_theory({"box2d", {{"continuous", "off"}}}, 0.01).known);
}

TEST(LowestSpeed, measured_is_that_of_theory_as_near_as_the_phases_are) {
  constexpr int phases = 40;  // a window of a fortieth opens 2.5 % above the border
  for (const char* name : {"penetration_resolution", "wind_back"}) {
    const Row row = lowest_speed_through({name}, 0.1, phases);
    const double theory = bullet_theory({name}, 0.1).lowest.value();
    ASSERT_TRUE(row.border_high) << name;
    EXPECT_GE(*row.border_high, theory) << name;
    EXPECT_LE(*row.border_high, theory * 1.03) << name;
  }
}

TEST(BulletSweep, tries_octagon_sweep_over_a_million_times_on_the_standard_grid) {
  EXPECT_GE(bullet_sweep(GridSize::standard, {"octagon_sweep"}).size(), 1'000'000U);
  for (const BulletContender& contender : bullet_contenders({}))
    EXPECT_NO_THROW(check(bullet_sweep(GridSize::quick, contender))) << contender.called();
}

/// Of eight phases.
int phases_through(const std::vector<Case::Setting>& knobs) {
  int through = 0;
  for (const char* phase : {"0", "0.125", "0.25", "0.375", "0.5", "0.625", "0.75", "0.875"}) {
    Case one;
    one.scene = "paper";
    one.parameters = {{"speed", "100"}, {"thickness", "0.01"}, {"phase", phase}};
    one.contender = "box2d";
    one.knobs = knobs;
    through += run_case(one).tunnels.value_or(0) > 0;
  }
  return through;
}

TEST(KnobsOfBox2d, open_and_close_its_holes) {
  EXPECT_EQ(phases_through({}), 0);
  EXPECT_EQ(phases_through({{"solids", "kinematic"}, {"bullet", "off"}}), 0);
  EXPECT_EQ(phases_through({{"solids", "dynamic"}}), 0);
  EXPECT_GT(phases_through({{"solids", "dynamic"}, {"bullet", "off"}}), 0);
  EXPECT_GT(phases_through({{"continuous", "off"}}), 0);
  Case swept;
  swept.scene = "sweeping_paper";
  swept.contender = "box2d";
  EXPECT_EQ(run_case(swept).tunnels, 0);
  swept.knobs = {{"movers", "transform"}};
  const Row put = run_case(swept);
  EXPECT_EQ(put.knob, "movers=transform");
  EXPECT_EQ(put.tunnels, 1) << "paper that is put beyond the character was never on the way";
}

}  // namespace
}  // namespace paperproof::compare
