/// What the article states and its table does not check.
#include "compare/scene_runs.hpp"

#include <cmath>

namespace paperproof::compare {
namespace {

constexpr double unit = 1.0 / 32;

std::vector<TraceStep> steps_of(const Scene& scene, const std::string& contender,
                                const std::vector<KnobSetting>& knobs) {
  RunOptions options = quick();
  options.contenders = {contender};
  options.reference = false;
  options.max_replay_steps = scene.steps;
  options.knobs = knobs;
  return run_scene(scene, options).runs.front().steps;
}

std::size_t first_touch(const std::vector<TraceStep>& steps, ColliderIndex collider) {
  const auto found = std::find_if(steps.begin(), steps.end(), [collider](const TraceStep& step) {
    return std::any_of(step.contacts.begin(), step.contacts.end(),
                       [collider](const auto& contact) { return contact.collider == collider; });
  });
  return static_cast<std::size_t>(found - steps.begin());
}

/// How far it goes to the left while it goes up, on the whole [m].
double backwards_while_rising(const std::vector<TraceStep>& steps) {
  double back = 0;
  for (const TraceStep& step : steps) {
    const Vec2d way = step.path.back().position - step.path.front().position;
    if (way.y() > 0) back += std::max(0.0, -way.x());
  }
  return back;
}

TEST(Overhang, springs_a_rising_character_back_unless_the_rule_ends_the_rise) {
  const Scene scene = built_in("jump_into_overhang");
  for (const char* contender : {"penetration_resolution", "speculative_march", "speculative"}) {
    const auto with = steps_of(scene, contender, {});
    const auto without = steps_of(scene, contender, {parse_knob("jump_rules=off")});
    const auto height = [](const TraceStep& step) { return step.path.back().position.y(); };
    const std::size_t met = first_touch(with, 1);
    ASSERT_LT(met, with.size());
    ASSERT_EQ(first_touch(without, 1), met);
    const double one_step = scene.character.jump_speed * scene.dt;
    EXPECT_LE(height(with[met]), height(with[met - 1]) + one_step);
    for (std::size_t step = met + 1; step < with.size(); ++step)
      ASSERT_LE(height(with[step]), height(with[step - 1]) + unit) << contender << " falls from there on";
    // A quarter of what it rises along the overhang goes back: of one step, and of all that were left.
    double highest = 0;
    for (const TraceStep& step : without) highest = std::max(highest, height(step));
    const double rises_on = highest - height(without[met]);
    EXPECT_GT(rises_on, 0.5) << contender;
    EXPECT_NEAR(backwards_while_rising(without), 0.25 * rises_on, 4 * unit) << contender;
    EXPECT_LE(backwards_while_rising(with), 0.25 * one_step + unit) << contender;
    EXPECT_GT(backwards_while_rising(without), backwards_while_rising(with) + 2 * unit) << contender;
  }
}

}  // namespace
}  // namespace paperproof::compare
