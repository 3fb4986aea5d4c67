/// Runs among bodies that Box2D moves. How stacks carry and crates crush is said by the answers of their scenes.
#include "compare/scene_runs.hpp"

#include <cmath>
#include <map>
#include <string>

namespace paperproof::compare {
namespace {

constexpr double half_height = 20.0 / 32;  // of the article's character at 32 pixels per metre

ReportScene ran(const Scene& scene, std::vector<std::string> contenders, bool reference = false) {
  RunOptions options = quick();
  options.contenders = std::move(contenders);
  options.reference = reference;
  options.max_replay_steps = scene.steps;
  return run_scene(scene, options);
}

TEST(Bodies, go_the_same_way_for_every_contender_and_for_the_twin) {
  const ReportScene result = ran(built_in("stack_100"), {"octagon_sweep", "speculative"}, true);
  const std::vector<TraceStep>& mine = run_of(result, "octagon_sweep").steps;
  const std::vector<TraceStep>& other = run_of(result, "speculative").steps;
  const std::vector<TraceStep>& twin = run_of(result, "box2d").steps;
  ASSERT_TRUE(mine.size() == 600 && other.size() == 600 && twin.size() == 600);
  for (std::size_t i = 0; i < mine.size(); ++i)
    for (std::size_t k = 0; k < mine[i].movers.size(); ++k) {
      EXPECT_EQ(mine[i].movers[k].to, other[i].movers[k].to) << i;
      EXPECT_LE((mine[i].movers[k].to - twin[i].movers[k].to).norm(), 1e-6) << i;
      if (i > 0) {
        EXPECT_EQ(mine[i].movers[k].from, mine[i - 1].movers[k].to) << i;
      }
    }
}

TEST(Bodies, are_lifted_by_what_goes_along_a_path) {
  Scene scene = empty_sky(120);
  for (const auto& [id, bottom] : {std::pair{"lift", -1.0}, {"crate", 0.015}}) {
    scene.ids.emplace_back(id);
    scene.scenery.colliders.push_back({.points = {{-1, bottom}, {1, bottom}, {1, bottom + 1}, {-1, bottom + 1}},
                                       .mover = static_cast<MoverIndex>(scene.movers.size())});
    scene.movers.push_back({.id = id, .path = {{.time = 0, .at = {0, 0}}, {.time = 2, .at = {0, 6}}}});
  }
  scene.movers[1].path = {{}};
  scene.movers[1].body = Body{};
  scene.start.position = {0, 1.015 + half_height + 5e-7};
  const ReportScene result = ran(scene, {"octagon_sweep"});
  // Known and open: who does not ride yet is met at the time at which it would come down onto the crate as that stood.
  std::map<std::string, int> broken = row_of(result, "octagon_sweep").broken;
  EXPECT_LE(broken["time_of_impact"], 1);
  broken.erase("time_of_impact");
  EXPECT_TRUE(broken.empty()) << row_of(result, "octagon_sweep").reason;
  EXPECT_NEAR(run_of(result, "octagon_sweep").steps.back().path.back().position.y(), 6 + scene.start.position.y(),
              0.01);
}

TEST(Bodies, that_box2d_cannot_have_leave_rows_that_say_why) {
  Scene points = empty_sky(10);
  points.ids.emplace_back("grain");
  points.scenery.colliders.push_back({.points = {{9, 9}, {9 + 1e-9, 9}, {9, 9 + 1e-9}}, .mover = 0});
  points.movers.push_back({.id = "grain", .path = {{}}, .body = Body{}});
  Scene instants = built_in("stack_1");
  instants.dt = 1e-12;
  for (const auto& [scene, reason] : {std::pair{points, "single point"}, {instants, "shorter than 1e-9 s"}}) {
    const ReportScene result = ran(scene, {"octagon_sweep"}, true);
    for (const char* contender : {"octagon_sweep", "box2d"}) {
      const Row& row = row_of(result, contender);
      EXPECT_EQ(row.verdict, Verdict::not_applicable);
      EXPECT_TRUE(holds(row.reason, "the scene's bodies are moved by Box2D, and ")) << row.reason;
      EXPECT_TRUE(holds(row.reason, reason)) << row.reason;
    }
  }
}

}  // namespace
}  // namespace paperproof::compare
