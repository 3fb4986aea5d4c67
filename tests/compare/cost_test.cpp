/// What is timed: who steps when, and where from. The times themselves are no matter for tests.
#include "runs/cost.hpp"
#include "compare/scene_runs.hpp"

namespace paperproof::compare {
namespace {

/// Writes down what is done with it.
class Scribe final : public Contender {
 public:
  Scribe(char name, bool engine, std::string& log) : name_(name), engine_(engine), log_(log) {}
  [[nodiscard]] const TraceHeader& header() const noexcept override { return header_; }
  void step(const StepInput&, std::span<TraceStep>) override { log_ += '?'; }
  void step_unrecorded(const StepInput& input) override {
    EXPECT_EQ(input.gravity, Vec2d(0, -3));
    log_ += name_;
  }
  bool keep_wishes(bool) override { return engine_; }
  void step_bare(const StepInput&, std::size_t k) override { log_ += std::to_string(k); }
  [[nodiscard]] Pose pose(std::size_t) const override { return {}; }
  void place(const Pose& pose, std::size_t) override {
    EXPECT_EQ(pose.position, Vec2d(1, 2));
    log_ += '<';
  }

 private:
  char name_;
  bool engine_;
  std::string& log_;
  TraceHeader header_;
};

TEST(Cost, contenders_take_turns_and_are_put_back_where_the_judged_run_was) {
  Scene scene = empty_sky(4);
  scene.start.position = {1, 2};
  scene.gravity = {0, -3};
  std::string log;
  Scribe a('a', false, log);
  Scribe b('b', true, log);
  const std::vector<Respawn> respawns{{1, 0}, {3, 0}, {40, 0}};
  const std::vector<TimedRun> runs{{&a, respawns, 1}, {&b, {}, 2}};
  const std::vector<Costs> costs = measure_costs(runs, scene, script_of(scene), 4);
  const std::string round = "<a<aa<a<bbbb<0123";
  std::string expected;
  for (int pass = 0; pass < 1 + 9; ++pass) expected += pass == 0 ? round : round + "<012<012";
  EXPECT_EQ(log, expected) << "a warm-up and nine repeats; of b the third step twice more, warm and cold";
  ASSERT_EQ(costs.size(), 2U);
  EXPECT_FALSE(costs[0].bare);
  ASSERT_TRUE(costs[1].bare && costs[1].step);
  EXPECT_FALSE(costs[0].step) << "somebody was put back in it";
  for (const Cost& cost : {costs[0].full, costs[1].full, *costs[1].bare}) {
    EXPECT_GT(cost.ns_per_step_min, 0);
    EXPECT_LE(cost.ns_per_step_min, cost.ns_per_step_median);
    EXPECT_LE(cost.ns_per_step_median, cost.ns_per_step_max);
  }
}

TEST(Cost, box2d_alone_goes_the_way_of_the_run) {
  for (const char* name : {"lift_up", "one_way_from_above", "flush_tiles"}) {
    const Scene scene = built_in(name);
    const Scenery scenery(scene.scenery);
    const auto twin = make_contender("box2d", ScalarKind::binary64, scene, scenery);
    ASSERT_TRUE(twin->keep_wishes(true));
    const std::vector<Vec2d> way =
        way_of(*twin, scene, [&](const StepInput& now, std::size_t) { twin->step_unrecorded(now); });
    twin->keep_wishes(false);
    place_at_start(*twin, scene);
    EXPECT_EQ(way_of(*twin, scene, [&](const StepInput& now, std::size_t step) { twin->step_bare(now, step); }), way)
        << name;
  }
}

}  // namespace
}  // namespace paperproof::compare
