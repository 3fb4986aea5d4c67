#include "records/case.hpp"
#include "runs/run_case.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace paperproof::compare {
namespace {

Row run(const std::string& scene, const std::vector<Case::Setting>& settings, const std::string& contender) {
  Case one;
  one.scene = scene;
  one.parameters = settings;
  one.contender = contender;
  return run_case(one);
}

TEST(TightFamilies, are_answered_by_octagon_sweep_wherever_tip_and_corner_stand) {
  for (const char* angle : {"0.1", "10", "60"})
    for (const char* offset : {"-0.15", "0", "1e-9", "0.1"}) {
      const Row row = run("spike", {{"angle", angle}, {"offset", offset}}, "octagon_sweep");
      EXPECT_EQ(row.verdict, Verdict::holds) << angle << " " << offset << ": " << row.reason;
    }
  for (const char* overlap : {"1e-6", "1e-3", "0.1", "0.3"}) {
    const Row row = run("corner", {{"overlap", overlap}}, "octagon_sweep");
    EXPECT_EQ(row.verdict, Verdict::holds) << overlap << ": " << row.reason;
  }
}

TEST(TightFamilies, what_closes_in_crushes_where_it_leaves_no_room_and_only_there) {
  for (const char* scene : {"closing_walls", "closing_lift"})
    for (const char* closing : {"0.3", "3", "30", "300"})
      for (const char* clearance : {"-0.1", "1e-6", "0.001", "0.1", "0.5"}) {
        const Row row = run(scene, {{"closing", closing}, {"clearance", clearance}}, "octagon_sweep");
        EXPECT_EQ(row.verdict, Verdict::holds) << scene << " " << closing << " " << clearance << ": " << row.reason;
        const int crushes = clearance[0] == '-' ? 1 : 0;
        EXPECT_EQ(row.crushes.value_or(0), crushes) << scene << " " << closing << " " << clearance;
      }
}

TEST(TightFamilies, show_a_spike_between_the_points_to_those_who_look_at_points) {
  EXPECT_EQ(run("spike", {}, "speculative").verdict, Verdict::tunnels);
  EXPECT_EQ(run("spike", {}, "penetration_resolution").verdict, Verdict::tunnels);
  EXPECT_EQ(run("spike", {}, "box2d").verdict, Verdict::holds);
}

}  // namespace
}  // namespace paperproof::compare
