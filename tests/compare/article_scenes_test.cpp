/// What the article states, on the scenes that show it: with the knob that it is about turned one way and the other.
#include "compare/scene_runs.hpp"

#include <cmath>

namespace paperproof::compare {
namespace {

constexpr std::array searching{"penetration_resolution", "speculative_march", "speculative"};
constexpr double unit = 1.0 / 32;

/// One contender's row, and all of its steps.
struct Shown {
  Row row;
  std::vector<TraceStep> steps;

  Shown(const Scene& scene, const std::string& contender, const std::vector<std::string>& knobs = {}) {
    RunOptions options = quick();
    options.contenders = {contender};
    options.reference = false;
    options.max_replay_steps = 20'000;
    for (const std::string& knob : knobs) options.knobs.push_back(parse_knob(knob));
    ReportScene result = run_scene(scene, options);
    row = result.rows.front();
    steps = result.runs.front().steps;
  }
  [[nodiscard]] const Vec2d& end_of(std::size_t step) const { return steps[step].path.back().position; }
  [[nodiscard]] std::size_t first_touch(ColliderIndex collider) const {
    const auto found = std::find_if(steps.begin(), steps.end(), [collider](const TraceStep& step) {
      return std::any_of(step.contacts.begin(), step.contacts.end(),
                         [collider](const auto& contact) { return contact.collider == collider; });
    });
    return static_cast<std::size_t>(found - steps.begin());
  }
  [[nodiscard]] double highest() const {
    double highest = -HUGE_VAL;
    for (const TraceStep& step : steps) highest = std::max(highest, step.path.back().position.y());
    return highest;
  }
  /// How far it goes to the left while it goes up, on the whole [m].
  [[nodiscard]] double backwards_while_rising() const {
    double back = 0;
    for (const TraceStep& step : steps) {
      const Vec2d way = step.path.back().position - step.path.front().position;
      if (way.y() > 0) back += std::max(0.0, -way.x());
    }
    return back;
  }
  [[nodiscard]] int inside() const { return row.steps_ending_inside.value_or(-1); }
};

TEST(AllPairs, hold_in_the_floor_who_rises_out_of_it_by_direction) {
  const Scene scene = built_in("stuck_points");
  const double start = scene.start.position.y();
  // 5 m/s under 10 m/s², 60 steps per second: v²/2g less v dt/2.
  const double rise = 1.25 - 5.0 / 120;
  for (const char* contender : searching) {
    EXPECT_NEAR(Shown(scene, contender, {"pairs=direction"}).highest(), start + rise, 1e-9) << contender;
    const Shown all(scene, contender, {"pairs=all"});
    EXPECT_GE(all.highest(), 20 * unit - 1e-12) << contender << ": out of the floor";
    EXPECT_LE(all.highest(), 21 * unit) << contender << ": and not a unit more";
  }
}

TEST(Wall, lets_nobody_jump_who_stands_beside_it_and_wants_toward_it) {
  const Scene scene = built_in("jump_beside_wall");
  for (const std::string_view kind : technique_names()) {
    const std::string contender(kind);
    const double start = scene.start.position.y();
    if (kind != "grid") {  // which jumps by squares, and has none in the time
      EXPECT_GT(Shown(scene, contender, {"jump_rules=off"}).highest(), start + 4 * unit) << contender;
    }
    EXPECT_LE(Shown(scene, contender).highest(), start + unit) << contender;
  }
}

TEST(Overhang, springs_a_rising_character_back_unless_the_rule_ends_the_rise) {
  const Scene scene = built_in("jump_into_overhang");
  for (const char* contender : searching) {
    const Shown with(scene, contender);
    const Shown without(scene, contender, {"jump_rules=off"});
    const std::size_t met = with.first_touch(1);
    ASSERT_LT(met, with.steps.size());
    ASSERT_EQ(without.first_touch(1), met);
    EXPECT_LE(with.end_of(met).y(), with.end_of(met - 1).y() + scene.character.jump_speed * scene.dt);
    for (std::size_t step = met + 1; step < with.steps.size(); ++step)
      ASSERT_LE(with.end_of(step).y(), with.end_of(step - 1).y() + unit) << contender << " falls from there on";
    // A quarter of what it rises along the overhang goes back: of one step, and of all that were left.
    const double rises_on = without.highest() - without.end_of(met).y();
    EXPECT_GT(rises_on, 0.5) << contender;
    EXPECT_NEAR(without.backwards_while_rising(), 0.25 * rises_on, 4 * unit) << contender;
    EXPECT_LE(with.backwards_while_rising(), 0.25 * scene.character.jump_speed * scene.dt + unit) << contender;
    EXPECT_GT(without.backwards_while_rising(), with.backwards_while_rising() + 2 * unit) << contender;
  }
}

TEST(Jitter, of_penetration_resolution_at_a_floor_is_a_hop_of_less_than_a_unit) {
  const Shown hops(built_in("stuck_points"), "penetration_resolution");
  ASSERT_TRUE(hops.row.rest_peak_to_peak_m);
  EXPECT_GT(*hops.row.rest_peak_to_peak_m, unit / 2);
  EXPECT_LE(*hops.row.rest_peak_to_peak_m, unit);
  EXPECT_GT(hops.row.contact_toggles.value_or(0), 100);
  for (const char* contender : {"speculative", "octagon_sweep"})
    EXPECT_LE(Shown(built_in("stuck_points"), contender).row.rest_peak_to_peak_m.value_or(1), 1e-12) << contender;
}

TEST(Iterations, leave_less_inside_where_a_slope_meets_a_wall) {
  const auto after = [](const char* scene, const char* iterations) {
    return Shown(built_in(scene), "penetration_resolution", {std::string("iterations=") + iterations});
  };
  constexpr double rounding = 1e-12;
  EXPECT_GT(after("valley", "1").row.max_penetration_m.value_or(0), unit / 2);
  EXPECT_LT(after("valley", "2").row.max_penetration_m.value_or(1), rounding);
  const Shown twice = after("leaning_valley", "2");
  EXPECT_GT(after("leaning_valley", "1").inside(), 10 * twice.inside());
  EXPECT_GT(twice.row.max_penetration_m.value_or(0), unit / 4);
  const Shown four = after("leaning_valley", "4");
  EXPECT_EQ(four.inside(), 0);
  const Shown many = after("leaning_valley", "32");
  for (std::size_t step = 0; step < four.steps.size(); ++step)
    ASSERT_EQ(many.end_of(step), four.end_of(step)) << "nothing is left for more, step " << step;
}

TEST(Iterations, of_discrete_leave_less_depth_each) {
  for (const char* scene : {"wedge_60", "valley", "leaning_valley"}) {
    double last = HUGE_VAL;
    for (const char* iterations : {"iterations=1", "iterations=2", "iterations=4", "iterations=8", "iterations=32"}) {
      const double depth = Shown(built_in(scene), "discrete", {iterations}).row.max_penetration_m.value_or(0);
      EXPECT_LT(depth, last) << scene << ", " << iterations;
      last = depth;
    }
    EXPECT_LT(last, 0.004) << scene;
  }
}

TEST(Grid, ends_a_move_exactly_in_the_next_square_also_for_the_eye) {
  const Shown walk(built_in("one_square"), "grid");
  EXPECT_EQ(walk.inside(), 0) << "its head is tested";
  EXPECT_EQ(walk.highest(), 1.5) << "one square up";
  // 3.4 squares were wanted: what is drawn is 0.4 m beside the square when the key is up, and glides there.
  std::size_t still = 0;
  while (still + 1 < walk.steps.size() && (walk.steps[still].requested.x() != 0 || still < 34)) ++still;
  EXPECT_NEAR(walk.steps[still - 1].remainder.x(), 0.4, 1e-9);
  const std::size_t glides = 4;  // 0.4 m at 6 m/s, 60 steps per second
  EXPECT_NEAR(walk.steps[still + glides - 1].remainder.x(), 0, 1e-9);
  EXPECT_EQ(walk.steps.back().remainder.x(), 0);
  EXPECT_EQ(walk.end_of(walk.steps.size() - 1), Vec2d(3.5, 0.5));
}

}  // namespace
}  // namespace paperproof::compare
